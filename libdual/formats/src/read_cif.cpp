#include <Eigen/LU>
#include <array>
#include <cmath>
#include <gemmi/cif.hpp>
#include <gemmi/numb.hpp>
#include <gemmi/symmetry.hpp>
#include <optional>
#include <unordered_map>

#include "one_structure.h"
#include "trivalent/formats/cell_angles.h"
#include "trivalent/formats/cif.h"
#include "trivalent/formats/elements.h"
#include "trivalent/formats/text_file.h"

namespace trivalent::dual {
namespace {

namespace cif = gemmi::cif;
using Eigen::Vector3d;

/// Copies of a site nearer than this are one atom [Å]: files round fractions to four digits.
constexpr double same_place = 0.05;

class CifReader {
 public:
  CifReader(cif::Block& block, const TextSource& source) : block_(block), source_(source) {}

  StructureFile read() {
    is_macromolecular_ = has("_atom_site.Cartn_x");
    read_cell();
    if (is_macromolecular_) {
      read_cartesian_sites();
      note_group_left_out();
    } else {
      read_operations();
      read_fractional_sites();
    }
    return std::move(file_);
  }

 private:
  template <typename... Parts>
  [[noreturn]] void fail(const Parts&... parts) const {
    throw FileError(concat(source_.reader, ": ", source_.path.string(), ", block ", block_.name,
                           ": ", parts...));
  }

  [[nodiscard]] bool has(const std::string& tag) const { return bool(block_.find_values(tag)); }

  [[nodiscard]] double number(const std::string& text, const std::string& what) const {
    const double value = cif::as_number(text);
    if (!std::isfinite(value)) fail(what, " is ", in_quotes(text), ", not a number");
    return value;
  }

  void read_cell() {
    const std::string prefix = is_macromolecular_ ? "_cell." : "_cell_";
    cif::Table table = block_.find(
        prefix, {"length_a", "length_b", "length_c", "angle_alpha", "angle_beta", "angle_gamma"});
    if (!table.ok()) {
      if (is_macromolecular_) return;
      fail("there is no cell (_cell_length_a, ...)");
    }
    const cif::Table::Row row = table.one();
    CellAngles parameters = {};
    for (std::size_t k = 0; k < 3; ++k) {
      parameters.lengths[k] = number(row[k], "a length of the cell");
      parameters.angles[k] = number(row[k + 3], "an angle of the cell");
    }
    if (is_macromolecular_ && parameters.lengths == std::array{1.0, 1.0, 1.0}) return;
    potentials::Box& box = file_.structure.atoms.box;
    box.cell = cell_of(parameters);
    if (!box.cell.allFinite() || !(box.cell.determinant() > 0.0)) {
      fail("no cell has these lengths and angles");
    }
    box.periodic = {true, true, true};
  }

  void read_operations() {
    for (const char* tag : {"_space_group_symop_operation_xyz", "_symmetry_equiv_pos_as_xyz",
                            "_space_group_symop.operation_xyz"}) {
      for (const std::string& text : block_.find_values(tag)) {
        operations_.push_back(gemmi::parse_triplet(cif::as_string(text)));
      }
      if (!operations_.empty()) return;
    }
    for (const char* tag : {"_space_group_name_H-M_alt", "_symmetry_space_group_name_H-M"}) {
      const std::string* value = block_.find_value(tag);
      if (value == nullptr || cif::is_null(*value)) continue;
      const std::string name = cif::as_string(*value);
      const gemmi::SpaceGroup* group = gemmi::find_spacegroup_by_name(name);
      if (group == nullptr) fail("the space group ", in_quotes(name), " is not known");
      for (const gemmi::Op& operation : group->operations()) operations_.push_back(operation);
      return;
    }
    operations_.push_back(gemmi::Op::identity());
    file_.notes.emplace_back("the file names no symmetry: its sites are all the atoms");
  }

  void note_group_left_out() {
    const std::string* value = block_.find_value("_symmetry.space_group_name_H-M");
    if (value == nullptr || cif::is_null(*value)) return;
    if (const auto note = note_of_group_left_out(cif::as_string(*value))) {
      file_.notes.push_back(*note);
    }
  }

  [[nodiscard]] potentials::Species element_of(const std::string& symbol,
                                               const std::string& label) const {
    // C4+ and C13 have an element, too.
    const auto element = element_of_symbol(symbol.substr(0, symbol.find_first_of("0123456789+-")));
    if (!element)
      fail("site ", label, ": element ", in_quotes(symbol), "; the potentials know C and H");
    return *element;
  }

  void check_occupancy(const cif::Table::Row& row, int column, const std::string& label) const {
    if (!row.has2(static_cast<std::size_t>(column))) return;
    const double occupancy =
        number(row[static_cast<std::size_t>(column)], "the occupancy of " + label);
    if (std::abs(occupancy - 1.0) < 1e-3) return;
    fail("site ", label, " is occupied by ", occupancy,
         "; disordered structures have no atoms to compute with");
  }

  void read_fractional_sites() {
    cif::Table table = block_.find(
        "_atom_site_", {"label", "fract_x", "fract_y", "fract_z", "?type_symbol", "?occupancy"});
    if (!table.ok() || table.length() == 0) fail("there are no sites (_atom_site_fract_x, ...)");
    std::unordered_map<std::string, std::uint32_t> atom_of_label;
    for (const cif::Table::Row row : table) {
      const std::string label = row.str(0);
      check_occupancy(row, 5, label);
      Vector3d fractions;
      for (int k = 0; k < 3; ++k) {
        fractions[k] = number(row[static_cast<std::size_t>(k) + 1], "a coordinate of " + label);
      }
      const auto first = static_cast<std::uint32_t>(file_.structure.atoms.size());
      atom_of_label.emplace(label, first);
      add_copies(fractions, element_of(row.has2(4) ? row.str(4) : label, label));
    }
    if (operations_.size() == 1) read_bonds(atom_of_label);
  }

  /// A site by all operations; the first copy stays where the file puts it.
  void add_copies(const Vector3d& fractions, potentials::Species species) {
    potentials::Atoms& atoms = file_.structure.atoms;
    std::vector<Vector3d> copies;
    for (const gemmi::Op& operation : operations_) {
      const auto image = operation.apply_to_xyz({fractions[0], fractions[1], fractions[2]});
      Vector3d copy(image[0], image[1], image[2]);
      if (!copies.empty()) copy = copy.array() - copy.array().floor();
      const bool is_new = std::ranges::none_of(copies, [&](const Vector3d& other) {
        const Vector3d apart = copy - other;
        return (atoms.box.cell * Vector3d(apart.array() - apart.array().round())).norm() <
               same_place;
      });
      if (is_new) copies.push_back(copy);
    }
    for (const Vector3d& copy : copies) {
      atoms.positions.push_back(atoms.box.cell * copy);
      atoms.species.push_back(species);
    }
  }

  void read_bonds(const std::unordered_map<std::string, std::uint32_t>& atom_of_label) {
    for (const cif::Table::Row row : block_.find(
             "_geom_bond_",
             {"atom_site_label_1", "atom_site_label_2", "?site_symmetry_2", "?site_symmetry_1"})) {
      const auto first = atom_of_label.find(row.str(0));
      const auto second = atom_of_label.find(row.str(1));
      if (first == atom_of_label.end() || second == atom_of_label.end()) {
        fail("a bond names ", row.str(0), " and ", row.str(1), ", which are not both sites");
      }
      potentials::Bond bond = {.first = first->second, .second = second->second};
      const auto there = row.has2(2) ? image_of(row.str(2)) : std::array{0, 0, 0};
      const auto here = row.has2(3) ? image_of(row.str(3)) : std::array{0, 0, 0};
      for (std::size_t k = 0; k < 3; ++k) bond.image[k] = there[k] - here[k];
      file_.structure.bonds.push_back(bond);
    }
  }

  /// Of the identity: "1_655" and "655" are one cell along a, "1" is none.
  [[nodiscard]] std::array<std::int32_t, 3> image_of(const std::string& code) const {
    const std::size_t mark = code.find('_');
    const std::string digits = mark == std::string::npos ? code : code.substr(mark + 1);
    if (mark == std::string::npos && code == "1") return {0, 0, 0};
    if (digits.size() != 3 || digits.find_first_not_of("0123456789") != std::string::npos) {
      fail("the symmetry code of a bond is ", in_quotes(code), ", not as 1_655");
    }
    return {digits[0] - '5', digits[1] - '5', digits[2] - '5'};
  }

  void read_cartesian_sites() {
    cif::Table table =
        block_.find("_atom_site.", {"type_symbol", "Cartn_x", "Cartn_y", "Cartn_z", "?occupancy",
                                    "?pdbx_PDB_model_num", "?label_alt_id"});
    std::string model;
    for (const cif::Table::Row row : table) {
      const std::string label = concat("number ", file_.structure.atoms.size() + 1);
      check_occupancy(row, 4, label);
      if (row.has2(6) && row.str(6) != "A") {
        fail("atom ", label, " has another place too (alternate location ", in_quotes(row.str(6)),
             "); keep one of them");
      }
      if (row.has2(5) && row.str(5) != model) {
        model = row.str(5);  // the last model is taken
        file_.structure.atoms.positions.clear();
        file_.structure.atoms.species.clear();
      }
      Vector3d position;
      for (int k = 0; k < 3; ++k) {
        position[k] = number(row[static_cast<std::size_t>(k) + 1], "a coordinate of " + label);
      }
      file_.structure.atoms.positions.push_back(position);
      file_.structure.atoms.species.push_back(element_of(row.str(0), label));
    }
  }

  cif::Block& block_;
  const TextSource& source_;
  bool is_macromolecular_ = false;
  std::vector<gemmi::Op> operations_;
  StructureFile file_;
};

bool has_atoms(cif::Block& block) {
  return bool(block.find_values("_atom_site_fract_x")) ||
         bool(block.find_values("_atom_site.Cartn_x"));
}

StructureFile read_document(cif::Document& document, const TextSource& source,
                            const ReadOptions& options) {
  std::vector<cif::Block*> blocks;
  for (cif::Block& block : document.blocks) {
    if (has_atoms(block)) blocks.push_back(&block);
  }
  const auto n_blocks = static_cast<int>(blocks.size());
  const auto fail = [&](const auto&... parts) {
    throw FileError(concat(source.reader, ": ", source.path.string(), ": ", parts...));
  };
  if (n_blocks == 0) fail("no block has sites of atoms (_atom_site_fract_x or _atom_site.Cartn_x)");
  const int wanted = options.frame.value_or(n_blocks);
  if (wanted > n_blocks) fail("there is no structure ", wanted, "; the file has ", n_blocks);
  StructureFile file = CifReader(*blocks[static_cast<std::size_t>(wanted - 1)], source).read();
  if (!options.frame && n_blocks > 1) {
    file.notes.push_back(concat("the last of ", n_blocks, " structures is taken"));
  }
  return file;
}

}  // namespace

StructureFile read_cif(const std::filesystem::path& path, const ReadOptions& options) {
  const TextSource source = {.reader = "read_cif", .path = path};
  require_no_atom_style(source, options);
  const std::string text = read_text(source);
  try {
    cif::Document document = cif::read_memory(text.data(), text.size(), path.string().c_str());
    return read_document(document, source, options);
  } catch (const FileError&) {
    throw;
  } catch (const std::runtime_error& error) {  // gemmi's complaints name file and line
    throw FileError(concat("read_cif: ", error.what()));
  }
}

}  // namespace trivalent::dual
