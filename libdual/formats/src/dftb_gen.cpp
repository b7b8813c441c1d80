#include "trivalent/formats/dftb_gen.h"

#include <algorithm>
#include <ostream>

#include "cell_frame.h"
#include "columns_of_text.h"
#include "one_structure.h"
#include "species_data.h"
#include "trivalent/dual/check_atoms.h"
#include "trivalent/formats/elements.h"
#include "trivalent/formats/text_file.h"

namespace trivalent::dual {
namespace {

using potentials::Species;

class GenReader {
 public:
  GenReader(std::string_view text, const TextSource& source) : lines_(text, source) {}

  StructureFile read() {
    split("the number of atoms and the kind of boundary");
    if (fields_.size() != 2 || fields_[1].size() != 1) {
      lines_.fail("expected the number of atoms and C, S or F");
    }
    const char kind = lower_case(fields_[1])[0];
    if (kind == 'h') lines_.fail("helical boundaries (H) are not known; write the file as S");
    if (kind != 'c' && kind != 's' && kind != 'f') {
      lines_.fail("the kind of boundary is C, S or F, not ", in_quotes(fields_[1]));
    }
    const auto n_atoms =
        lines_.integer(fields_[0], 0, static_cast<std::int64_t>(lines_.n_remaining()));
    read_elements();
    for (std::int64_t i = 0; i < n_atoms; ++i) read_atom(i);
    if (kind != 'c') read_cell(kind == 'f');
    return {.structure = std::move(structure_), .notes = {}};
  }

 private:
  /// Splits the next line that is not a comment.
  void split(std::string_view what) {
    do {
      const std::string_view line = lines_.require(what);
      split_fields(line.substr(0, line.find('#')), fields_);
    } while (fields_.empty());
  }

  void read_elements() {
    split("the elements");
    for (const std::string_view symbol : fields_) {
      const auto element = element_of_symbol(symbol);
      if (!element) lines_.fail("element ", in_quotes(symbol), "; the potentials know C and H");
      elements_.push_back(*element);
    }
  }

  [[nodiscard]] Eigen::Vector3d vector(std::size_t first) const {
    return {lines_.fortran_real(fields_[first]), lines_.fortran_real(fields_[first + 1]),
            lines_.fortran_real(fields_[first + 2])};
  }

  void read_atom(std::int64_t index) {
    split(concat("atom ", index + 1));
    if (fields_.size() != 5) lines_.fail("expected number, type, x, y and z of an atom");
    const auto type = lines_.integer(fields_[1], 1, static_cast<std::int64_t>(elements_.size()));
    structure_.atoms.species.push_back(elements_[static_cast<std::size_t>(type - 1)]);
    structure_.atoms.positions.push_back(vector(2));
  }

  void read_cell(bool are_fractions) {
    potentials::Box& box = structure_.atoms.box;
    for (int i = -1; i < 3; ++i) {
      split(i < 0 ? "the origin of the cell" : "a cell vector");
      if (fields_.size() != 3) lines_.fail("expected three numbers");
      if (i >= 0) box.cell.col(i) = vector(0);  // the origin means nothing to DFTB+
    }
    box.periodic = {true, true, true};
    if (!are_fractions) return;
    for (Eigen::Vector3d& x : structure_.atoms.positions) x = box.cell * x;
  }

  LineReader lines_;
  std::vector<std::string_view> fields_;
  std::vector<Species> elements_;
  Structure structure_;
};

}  // namespace

StructureFile read_dftb_gen(const std::filesystem::path& path, const ReadOptions& options) {
  const TextSource source = {.reader = "read_dftb_gen", .path = path};
  require_one_structure(source, options);
  const std::string text = read_text(source);
  return GenReader(text, source).read();
}

std::vector<std::string> write_dftb_gen(std::ostream& out, const Structure& structure,
                                        const WriteOptions& options) {
  const potentials::Atoms& atoms = structure.atoms;
  check_atoms("write_dftb_gen", atoms);
  CellFrame frame = {.positions = atoms.positions, .cell = {}, .notes = {}};
  if (atoms.box.is_periodic()) frame = cell_frame(atoms, CellKind::general);
  std::string text = concat(atoms.size(), atoms.box.is_periodic() ? " S\n" : " C\n");
  std::vector<Species> elements;
  for (const SpeciesData& known : known_species) {
    if (std::ranges::find(atoms.species, known.species) == atoms.species.end()) continue;
    elements.push_back(known.species);
    text += concat(' ', known.symbol);
  }
  text += '\n';
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    const auto type = std::ranges::find(elements, atoms.species[i]) - elements.begin() + 1;
    text += concat(i + 1, ' ', type);
    append_vector(text, frame.positions[i], options.digits);
    text += '\n';
  }
  if (atoms.box.is_periodic()) {
    append_vector(text, Eigen::Vector3d::Zero(), options.digits);
    text += '\n';
    for (int k = 0; k < 3; ++k) {
      append_vector(text, frame.cell.col(k), options.digits);
      text += '\n';
    }
  }
  out << text;
  return std::move(frame.notes);
}

}  // namespace trivalent::dual
