#include "trivalent/formats/mol2.h"

#include <array>
#include <limits>
#include <optional>
#include <ostream>
#include <unordered_map>

#include "bond_pairs.h"
#include "cell_frame.h"
#include "columns_of_text.h"
#include "one_structure.h"
#include "trivalent/dual/check_atoms.h"
#include "trivalent/formats/cell_angles.h"
#include "trivalent/formats/elements.h"
#include "trivalent/formats/text_file.h"
#include "trivalent/potentials/bonds.h"

namespace trivalent::dual {
namespace {

constexpr std::string_view section_mark = "@<TRIPOS>";

class Mol2Reader {
 public:
  Mol2Reader(std::string_view text, const TextSource& source) : lines_(text, source) {}

  StructureFile read(std::optional<int> wanted) {
    int n_molecules = 0;
    StructureFile file;
    std::string_view section;
    while (const auto line = lines_.next()) {
      if (line->starts_with(section_mark)) {
        section = line->substr(section_mark.size());
        section = section.substr(0, section.find_last_not_of(" \t") + 1);
        if (section != "MOLECULE") continue;
        if (n_molecules > 0 && n_molecules == wanted) break;
        ++n_molecules;
        begin();
        continue;
      }
      read_row(section, *line);
    }
    if (n_molecules == 0) lines_.fail("the file has no @<TRIPOS>MOLECULE");
    if (wanted && *wanted > n_molecules) {
      lines_.fail("there is no structure ", *wanted, "; the file has ", n_molecules);
    }
    if (!wanted && n_molecules > 1) {
      file.notes.push_back(concat("the last of ", n_molecules, " structures is taken"));
    }
    structure_.bonds = potentials::bonds_between(structure_.atoms, pairs_);
    file.structure = std::move(structure_);
    return file;
  }

 private:
  void begin() {
    structure_ = {};
    atom_of_id_.clear();
    pairs_.clear();
  }

  void read_row(std::string_view section, std::string_view line) {
    split_fields(line, fields_);
    if (fields_.empty() || fields_[0].starts_with('#')) return;
    if (section == "ATOM") read_atom();
    if (section == "BOND") read_bond();
    if (section == "CRYSIN") read_cell();
  }

  void read_atom() {
    if (fields_.size() < 6) lines_.fail("expected id, name, x, y, z and type of an atom");
    const std::string_view type = fields_[5];
    const auto element = element_of_symbol(type.substr(0, type.find('.')));
    if (!element) lines_.fail("type ", in_quotes(type), "; the potentials know C and H");
    const auto index = static_cast<int>(structure_.atoms.size());
    if (!atom_of_id_.emplace(fields_[0], index).second) {
      lines_.fail("a second atom with the id ", in_quotes(fields_[0]));
    }
    structure_.atoms.species.push_back(*element);
    structure_.atoms.positions.emplace_back(lines_.real(fields_[2]), lines_.real(fields_[3]),
                                            lines_.real(fields_[4]));
  }

  void read_bond() {
    if (fields_.size() < 4) lines_.fail("expected id, two atoms and type of a bond");
    pairs_.push_back({atom_of(fields_[1]), atom_of(fields_[2])});
  }

  [[nodiscard]] int atom_of(std::string_view id) const {
    const auto found = atom_of_id_.find(id);
    if (found == atom_of_id_.end()) lines_.fail("there is no atom ", in_quotes(id));
    return found->second;
  }

  void read_cell() {
    if (fields_.size() < 6) lines_.fail("expected three lengths and three angles of a cell");
    CellAngles parameters = {};
    for (std::size_t k = 0; k < 3; ++k) {
      parameters.lengths[k] = lines_.real(fields_[k]);
      parameters.angles[k] = lines_.real(fields_[k + 3]);
    }
    potentials::Box& box = structure_.atoms.box;
    box.cell = cell_of(parameters);
    if (!box.cell.allFinite()) lines_.fail("no cell has these lengths and angles");
    box.periodic = {true, true, true};
  }

  LineReader lines_;
  std::vector<std::string_view> fields_;
  Structure structure_;
  std::unordered_map<std::string_view, int> atom_of_id_;
  std::vector<std::array<int, 2>> pairs_;
};

/// The Tripos type of an atom with so many bonds.
std::string_view type_of(potentials::Species species, int bonds) {
  if (species == potentials::Species::hydrogen) return "H";
  if (bonds >= 4) return "C.3";
  return bonds == 2 ? "C.1" : "C.ar";
}

}  // namespace

StructureFile read_mol2(const std::filesystem::path& path, const ReadOptions& options) {
  const TextSource source = {.reader = "read_mol2", .path = path};
  require_no_atom_style(source, options);
  const std::string text = read_text(source);
  return Mol2Reader(text, source).read(options.frame);
}

std::vector<std::string> write_mol2(std::ostream& out, const Structure& structure,
                                    const WriteOptions& options) {
  const potentials::Atoms& atoms = structure.atoms;
  check_atoms("write_mol2", atoms);
  CellFrame frame = {.positions = atoms.positions, .cell = {}, .notes = {}};
  if (atoms.box.is_periodic()) frame = cell_frame(atoms, CellKind::triangular);
  const std::vector<std::array<int, 2>> pairs = bond_pairs(structure, frame.notes);
  std::vector<int> n_bonds(atoms.size(), 0);
  for (const auto& pair : pairs) {
    for (const int atom : pair) ++n_bonds[static_cast<std::size_t>(atom)];
  }
  std::vector<std::string_view> types;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    types.push_back(type_of(atoms.species[i], n_bonds[i]));
  }
  out << "@<TRIPOS>MOLECULE\ncarbon shell\n"
      << atoms.size() << ' ' << pairs.size() << " 1 0 0\nSMALL\nNO_CHARGES\n\n@<TRIPOS>ATOM\n";
  std::string line;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    line = concat(i + 1, ' ', symbol_of(atoms.species[i]), i + 1);
    append_vector(line, frame.positions[i], options.digits);
    out << line << ' ' << types[i] << " 1 UNL\n";
  }
  out << "@<TRIPOS>BOND\n";
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto is_aromatic = [&](int atom) {
      return types[static_cast<std::size_t>(atom)] == "C.ar";
    };
    const bool is_ring = is_aromatic(pairs[k][0]) && is_aromatic(pairs[k][1]);
    out << k + 1 << ' ' << pairs[k][0] + 1 << ' ' << pairs[k][1] + 1
        << (is_ring ? " ar\n" : " 1\n");
  }
  if (!atoms.box.is_periodic()) return std::move(frame.notes);
  const CellAngles parameters = cell_angles(frame.cell);
  line = "@<TRIPOS>CRYSIN\n";
  for (const auto& values : {parameters.lengths, parameters.angles}) {
    for (const double value : values) {
      append_real(line, value, Digits::seventeen_significant);
      line += ' ';
    }
  }
  out << line << "1 1\n";
  return std::move(frame.notes);
}

}  // namespace trivalent::dual
