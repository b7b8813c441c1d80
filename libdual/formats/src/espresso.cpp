#include "trivalent/formats/espresso.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <ostream>
#include <string_view>

#include "cell_frame.h"
#include "columns_of_text.h"
#include "length_units.h"
#include "one_structure.h"
#include "species_data.h"
#include "trivalent/dual/check_atoms.h"
#include "trivalent/dual/columns.h"
#include "trivalent/formats/elements.h"
#include "trivalent/formats/text_file.h"

namespace trivalent::dual {
namespace {

class EspressoReader {
 public:
  EspressoReader(std::string_view text, const TextSource& source) : lines_(text, source) {}

  StructureFile read() {
    while (const auto line = lines_.next()) {
      split(*line);
      if (fields_.empty()) continue;
      const std::string card = lower_case(fields_[0]);
      if (card == "atomic_positions") {
        read_positions();
      } else if (card == "cell_parameters") {
        read_cell();
      } else {
        read_setting(std::string(*line));
      }
    }
    return assemble();
  }

 private:
  /// Fields without comments, commas and brackets.
  void split(std::string_view line) {
    line = line.substr(0, line.find_first_of("!#"));
    clean_.assign(line);
    for (char& letter : clean_) {
      if (std::string_view("(){},").find(letter) != std::string_view::npos) letter = ' ';
    }
    split_fields(clean_, fields_);
  }

  [[nodiscard]] std::string unit_or(std::string_view otherwise) const {
    return lower_case(fields_.size() > 1 ? fields_[1] : otherwise);
  }

  [[nodiscard]] Eigen::Vector3d vector(std::size_t first) const {
    if (fields_.size() < first + 3) lines_.fail("expected three numbers");
    return {lines_.fortran_real(fields_[first]), lines_.fortran_real(fields_[first + 1]),
            lines_.fortran_real(fields_[first + 2])};
  }

  void read_cell() {
    cell_unit_ = unit_or("alat");
    line_of_cell_ = lines_.line_number();
    for (int i = 0; i < 3; ++i) {
      split(lines_.require("a cell vector"));
      cell_.col(i) = vector(0);
    }
  }

  void read_positions() {
    position_unit_ = unit_or("alat");
    line_of_positions_ = lines_.line_number();
    if (!n_atoms_) lines_.fail("nat must stand before ATOMIC_POSITIONS");
    for (std::int64_t i = 0; i < *n_atoms_; ++i) {
      split(lines_.require(concat("atom ", i + 1, " of ", *n_atoms_)));
      if (fields_.size() < 4) lines_.fail("expected element, x, y and z of an atom");
      // Labels may be as C1, C_h or C-h.
      const std::string_view label = fields_[0];
      const auto element = element_of_symbol(label.substr(0, label.find_first_of("0123456789_-")));
      if (!element) lines_.fail("element ", in_quotes(label), "; the potentials know C and H");
      structure_.atoms.species.push_back(*element);
      structure_.atoms.positions.push_back(vector(1));
      moves_.push_back({flag(4), flag(5), flag(6)});
    }
  }

  /// Whether an atom moves along an axis, 0 or 1; it does if nothing is said.
  [[nodiscard]] int flag(std::size_t field) const {
    return field < fields_.size() ? static_cast<int>(lines_.integer(fields_[field], 0, 1)) : 1;
  }

  /// name = value, several in a line.
  void read_setting(std::string line) {
    std::ranges::replace(line, '=', ' ');
    split(line);
    for (std::size_t i = 0; i + 1 < fields_.size(); ++i) {
      const std::string name = lower_case(fields_[i]);
      if (name == "nat") n_atoms_ = lines_.integer(fields_[i + 1], 0, max_atoms());
      if (name == "a") lattice_ = lines_.fortran_real(fields_[i + 1]);
      // celldm(1) has lost its brackets.
      if (name == "celldm" && fields_[i + 1] == "1" && i + 2 < fields_.size()) {
        lattice_ = bohr * lines_.fortran_real(fields_[i + 2]);
      }
      if (name == "ibrav" && fields_[i + 1] != "0") {
        lines_.fail("ibrav ", fields_[i + 1], "; only cells of CELL_PARAMETERS (ibrav 0) are read");
      }
    }
  }

  [[nodiscard]] std::int64_t max_atoms() const {
    return static_cast<std::int64_t>(lines_.n_remaining());  // a row takes more
  }

  [[nodiscard]] double length_of(const std::string& unit, std::size_t line) const {
    if (unit == "angstrom") return 1.0;
    if (unit == "bohr") return bohr;
    if (unit == "alat" && lattice_) return *lattice_;
    if (unit == "alat") lines_.fail_at(line, "alat needs celldm(1) or A");
    lines_.fail_at(line, "the unit ", in_quotes(unit), " is not known");
  }

  StructureFile assemble() {
    if (position_unit_.empty()) lines_.fail("the file has no ATOMIC_POSITIONS");
    if (cell_unit_.empty()) lines_.fail("the file has no CELL_PARAMETERS");
    potentials::Box& box = structure_.atoms.box;
    box.cell = length_of(cell_unit_, line_of_cell_) * cell_;
    box.periodic = {true, true, true};
    for (Eigen::Vector3d& x : structure_.atoms.positions) {
      x = position_unit_ == "crystal"
              ? Eigen::Vector3d(box.cell * x)
              : Eigen::Vector3d(length_of(position_unit_, line_of_positions_) * x);
    }
    const auto moves_freely = [](const auto& flags) { return flags == std::array{1, 1, 1}; };
    if (!std::ranges::all_of(moves_, moves_freely)) {
      structure_.columns.push_back({.name = std::string(selective_dynamics), .values = moves_});
    }
    return {.structure = std::move(structure_), .notes = {}};
  }

  LineReader lines_;
  std::string clean_;
  std::vector<std::string_view> fields_;
  std::optional<std::int64_t> n_atoms_;
  std::optional<double> lattice_;  // [Å]
  Eigen::Matrix3d cell_ = Eigen::Matrix3d::Zero();
  std::string cell_unit_;
  std::string position_unit_;
  std::size_t line_of_cell_ = 0;
  std::size_t line_of_positions_ = 0;
  std::vector<std::array<int, 3>> moves_;  // per atom, along each axis
  Structure structure_;
};

std::string_view pseudopotential_of(potentials::Species species) {
  return species == potentials::Species::carbon ? "C.pbe-n-kjpaw_psl.1.0.0.UPF"
                                                : "H.pbe-kjpaw_psl.1.0.0.UPF";
}

/// Appends a number that reads back the same, with a decimal point and no exponent: pymatgen skips
/// lines with others.
void append_plain(std::string& text, double value) {
  std::array<char, 512> buffer = {};
  const auto result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed);
  const std::string_view number(buffer.data(), result.ptr);
  text += ' ';
  text += number;
  if (number.find('.') == std::string_view::npos) text += ".0";
}

void append_plain(std::string& text, const Eigen::Vector3d& vector) {
  for (const double component : vector) append_plain(text, component);
}

}  // namespace

StructureFile read_espresso(const std::filesystem::path& path, const ReadOptions& options) {
  const TextSource source = {.reader = "read_espresso", .path = path};
  require_one_structure(source, options);
  const std::string text = read_text(source);
  return EspressoReader(text, source).read();
}

std::vector<std::string> write_espresso(std::ostream& out, const Structure& structure,
                                        const WriteOptions& options) {
  const potentials::Atoms& atoms = structure.atoms;
  check_atoms("write_espresso", atoms);
  CellFrame frame = cell_frame(atoms, CellKind::general);
  std::string species;
  int n_species = 0;
  for (const SpeciesData& known : known_species) {
    if (std::ranges::find(atoms.species, known.species) == atoms.species.end()) continue;
    ++n_species;
    species += concat(known.symbol, ' ', known.mass, ' ', pseudopotential_of(known.species), '\n');
  }
  std::string text = concat(
      "&control\n  calculation = 'relax'\n  pseudo_dir = './'\n/\n&system\n  ibrav = 0\n  nat = ",
      atoms.size(), "\n  ntyp = ", n_species,
      "\n  ecutwfc = 40.0\n  ecutrho = 320.0\n  occupations = 'smearing'\n  smearing = 'mv'\n"
      "  degauss = 0.01\n/\n&electrons\n/\n&ions\n/\nATOMIC_SPECIES\n",
      species, "CELL_PARAMETERS angstrom\n");
  for (int k = 0; k < 3; ++k) {
    append_plain(text, frame.cell.col(k));
    text += '\n';
  }
  text += "ATOMIC_POSITIONS angstrom\n";
  const auto* flags = find_column<std::array<int, 3>>(structure, selective_dynamics);
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    text += symbol_of(atoms.species[i]);
    if (options.digits == Digits::ten_decimals) {
      append_vector(text, frame.positions[i], options.digits);
    } else {
      append_plain(text, frame.positions[i]);
    }
    for (std::size_t k = 0; flags != nullptr && k < 3; ++k)
      text += (*flags)[i][k] != 0 ? " 1" : " 0";
    text += '\n';
  }
  out << text << "K_POINTS gamma\n";
  return std::move(frame.notes);
}

}  // namespace trivalent::dual
