#include "trivalent/formats/cp2k.h"

#include <ostream>

#include "cell_frame.h"
#include "columns_of_text.h"
#include "length_units.h"
#include "one_structure.h"
#include "trivalent/dual/check_atoms.h"
#include "trivalent/formats/cell_angles.h"
#include "trivalent/formats/elements.h"
#include "trivalent/formats/text_file.h"

namespace trivalent::dual {
namespace {

class Cp2kReader {
 public:
  Cp2kReader(std::string_view text, const TextSource& source) : lines_(text, source) {
    structure_.atoms.box.periodic = {true, true, true};  // unless the file says otherwise
  }

  StructureFile read() {
    std::string section;
    while (const auto line = lines_.next()) {
      split_fields(line->substr(0, line->find_first_of("!#")), fields_);
      if (fields_.empty()) continue;
      const std::string word = lower_case(fields_[0]);
      if (word == "@include") lines_.fail("@INCLUDE is not followed; give the file that it names");
      if (word == "&cell" || word == "&coord") {
        section = word;
      } else if (word.starts_with('&')) {
        if (word == "&constraint") note_constraints();
        section.clear();
      } else if (section == "&cell") {
        read_cell(word);
      } else if (section == "&coord") {
        read_coordinate(word);
      }
    }
    return assemble();
  }

 private:
  [[nodiscard]] Eigen::Vector3d vector() const {
    // A unit may follow the name, as in A [bohr] 1 0 0.
    const bool has_unit = fields_.size() > 1 && fields_[1].starts_with('[');
    const std::size_t first = has_unit ? 2 : 1;
    if (fields_.size() < first + 3) lines_.fail("expected three numbers");
    const double unit = has_unit && lower_case(fields_[1]) == "[bohr]" ? bohr : 1.0;
    if (has_unit && unit == 1.0 && lower_case(fields_[1]) != "[angstrom]") {
      lines_.fail("the unit ", in_quotes(fields_[1]), " is not known");
    }
    return unit * Eigen::Vector3d(lines_.fortran_real(fields_[first]),
                                  lines_.fortran_real(fields_[first + 1]),
                                  lines_.fortran_real(fields_[first + 2]));
  }

  void read_cell(const std::string& word) {
    potentials::Box& box = structure_.atoms.box;
    if (word.size() == 1 && word[0] >= 'a' && word[0] <= 'c') {
      box.cell.col(word[0] - 'a') = vector();
    } else if (word == "abc") {
      const Eigen::Vector3d lengths = vector();
      parameters_.lengths = {lengths[0], lengths[1], lengths[2]};
    } else if (word == "alpha_beta_gamma") {
      const Eigen::Vector3d angles = vector();
      parameters_.angles = {angles[0], angles[1], angles[2]};
    } else if (word == "multiple_unit_cell") {
      lines_.fail("MULTIPLE_UNIT_CELL is not applied; give the supercell itself");
    } else if (word == "periodic" && fields_.size() > 1) {
      const std::string axes = lower_case(fields_[1]);
      for (std::size_t i = 0; i < 3; ++i) {
        box.periodic[i] = axes != "none" && axes.find("xyz"[i]) != std::string::npos;
      }
    }
  }

  void note_constraints() {
    notes_.push_back(concat("line ", lines_.line_number(),
                            ": &CONSTRAINT is not read; --fix of `relax` holds atoms"));
  }

  void read_coordinate(const std::string& word) {
    if (word == "scaled") {
      is_scaled_ = fields_.size() == 1 || lower_case(fields_[1]).find('f') == std::string::npos;
      return;
    }
    if (word == "unit" && fields_.size() > 1) {
      const std::string unit = lower_case(fields_[1]);
      if (unit != "angstrom" && unit != "bohr") lines_.fail("the unit ", unit, " is not known");
      unit_ = unit == "bohr" ? bohr : 1.0;
      return;
    }
    const auto element = element_of_symbol(fields_[0]);
    if (!element) lines_.fail("element ", in_quotes(fields_[0]), "; the potentials know C and H");
    structure_.atoms.species.push_back(*element);
    structure_.atoms.positions.push_back(vector());
  }

  StructureFile assemble() {
    potentials::Atoms& atoms = structure_.atoms;
    if (atoms.size() == 0) lines_.fail("the file has no atoms in &COORD");
    if (parameters_.lengths[0] > 0.0) atoms.box.cell = cell_of(parameters_);
    if (atoms.box.cell.isZero(0.0)) atoms.box.periodic = {false, false, false};
    if (!atoms.box.cell.allFinite()) lines_.fail("no cell has these lengths and angles");
    for (Eigen::Vector3d& x : atoms.positions) {
      x = is_scaled_ ? Eigen::Vector3d(atoms.box.cell * x) : Eigen::Vector3d(unit_ * x);
    }
    return {.structure = std::move(structure_), .notes = std::move(notes_)};
  }

  LineReader lines_;
  std::vector<std::string_view> fields_;
  CellAngles parameters_ = {.lengths = {0.0, 0.0, 0.0}, .angles = {90.0, 90.0, 90.0}};
  bool is_scaled_ = false;
  double unit_ = 1.0;  // of the coordinates [Å]
  Structure structure_;
  std::vector<std::string> notes_;
};

}  // namespace

StructureFile read_cp2k(const std::filesystem::path& path, const ReadOptions& options) {
  const TextSource source = {.reader = "read_cp2k", .path = path};
  require_one_structure(source, options);
  const std::string text = read_text(source);
  return Cp2kReader(text, source).read();
}

std::vector<std::string> write_cp2k(std::ostream& out, const Structure& structure,
                                    const WriteOptions& options) {
  const potentials::Atoms& atoms = structure.atoms;
  check_atoms("write_cp2k", atoms);
  CellFrame frame = cell_frame(atoms, CellKind::general);
  if (!atoms.box.is_periodic()) frame.notes.clear();  // free atoms stay free
  // Its xTB sums charges over all directions or none.
  const std::string_view axes = atoms.box.is_periodic() ? "XYZ" : "NONE";
  std::string text = concat(
      "&GLOBAL\n  PROJECT carbon\n  RUN_TYPE GEO_OPT\n&END GLOBAL\n&MOTION\n  &GEO_OPT\n"
      "    OPTIMIZER LBFGS\n    MAX_ITER 500\n  &END GEO_OPT\n&END MOTION\n&FORCE_EVAL\n"
      "  METHOD QUICKSTEP\n  &DFT\n    &QS\n      METHOD xTB\n      &XTB\n        DO_EWALD ",
      atoms.box.is_periodic() ? "T" : "F",
      "\n      &END XTB\n    &END QS\n    &POISSON\n      PERIODIC ", axes,
      "\n    &END POISSON\n    &SCF\n      SCF_GUESS MOPAC\n      EPS_SCF 1.0E-6\n"
      "      MAX_SCF 200\n    &END SCF\n  &END DFT\n  &SUBSYS\n    &CELL\n");
  for (int k = 0; k < 3; ++k) {
    text += concat("      ", "ABC"[k]);
    append_vector(text, frame.cell.col(k), Digits::seventeen_significant);
    text += '\n';
  }
  text += concat("      PERIODIC ", axes, "\n    &END CELL\n    &COORD\n");
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    text += concat("      ", symbol_of(atoms.species[i]));
    append_vector(text, frame.positions[i], options.digits);
    text += '\n';
  }
  out << text << "    &END COORD\n  &END SUBSYS\n&END FORCE_EVAL\n";
  return std::move(frame.notes);
}

}  // namespace trivalent::dual
