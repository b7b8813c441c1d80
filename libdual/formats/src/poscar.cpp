#include "trivalent/formats/poscar.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <ostream>

#include "cell_frame.h"
#include "columns_of_text.h"
#include "one_structure.h"
#include "species_data.h"
#include "trivalent/dual/check_atoms.h"
#include "trivalent/dual/columns.h"
#include "trivalent/formats/elements.h"
#include "trivalent/formats/text_file.h"

namespace trivalent::dual {
namespace {

using potentials::Species;

/// Whether a line begins with one of these letters, in any case: all that VASP looks at.
bool begins_with(std::string_view line, std::string_view letters) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first != std::string_view::npos && letters.find(line[first]) != std::string_view::npos;
}

class PoscarReader {
 public:
  PoscarReader(std::string_view text, const TextSource& source, const ReadOptions& options)
      : lines_(text, source), options_(options) {}

  StructureFile read() {
    static_cast<void>(lines_.require("the comment line"));
    read_cell();
    read_species();
    std::string_view line = lines_.require("Direct or Cartesian");
    const bool has_flags = begins_with(line, "sS");
    if (has_flags) line = lines_.require("Direct or Cartesian");
    if (!begins_with(line, "dDcCkK")) {
      lines_.fail("expected Direct or Cartesian, found ", in_quotes(line));
    }
    read_positions(begins_with(line, "cCkK"), has_flags);
    note_rest();
    return std::move(file_);
  }

 private:
  void split(std::string_view what) { split_fields(lines_.require(what), fields_); }

  void read_cell() {
    split("the scale of the cell");
    if (fields_.size() != 1 && fields_.size() != 3) lines_.fail("expected 1 or 3 scales");
    Eigen::Vector3d scale;
    for (int i = 0; i < 3; ++i) {
      scale[i] =
          lines_.fortran_real(fields_[fields_.size() == 3 ? static_cast<std::size_t>(i) : 0]);
    }
    const std::size_t line_of_scale = lines_.line_number();
    Eigen::Matrix3d& cell = file_.structure.atoms.box.cell;
    for (int i = 0; i < 3; ++i) {
      split("a cell vector");
      if (fields_.size() < 3) lines_.fail("expected three components of a cell vector");
      for (int k = 0; k < 3; ++k) {
        cell(k, i) = lines_.fortran_real(fields_[static_cast<std::size_t>(k)]);
      }
    }
    const double volume = std::abs(cell.determinant());
    if (volume == 0.0) lines_.fail("the cell vectors lie in a plane or on a line");
    if (scale[0] < 0.0 && scale[0] == scale[1] && scale[0] == scale[2]) {
      scale.setConstant(std::cbrt(-scale[0] / volume));  // a negative scale is the volume
    }
    if (scale.minCoeff() <= 0.0) lines_.fail_at(line_of_scale, "a scale is not positive");
    scale_ = scale;
    cell = scale.asDiagonal() * cell;
    file_.structure.atoms.box.periodic = {true, true, true};
  }

  /// "C_pv" and "C/abcdef" are names that VASP itself writes.
  [[nodiscard]] Species element_of(std::string_view word) const {
    const std::string_view symbol = word.substr(0, word.find_first_of("_/"));
    const auto element = element_of_symbol(symbol);
    if (!element) {
      lines_.fail("element ", in_quotes(word), "; the potentials know C and H");
    }
    return *element;
  }

  void read_species() {
    split("elements and their numbers");
    if (fields_.empty()) lines_.fail("expected elements or their numbers");
    std::vector<Species> elements = options_.elements;
    if (fields_.front().find_first_not_of("0123456789") != std::string_view::npos) {
      elements.clear();
      for (const std::string_view word : fields_) elements.push_back(element_of(word));
      split("the numbers of atoms");
    } else if (elements.empty()) {
      lines_.fail("the file does not name its elements; --elements does, as in --elements C");
    }
    if (fields_.size() != elements.size()) {
      lines_.fail(elements.size(), " elements, but ", fields_.size(), " numbers of atoms");
    }
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      const auto most = static_cast<std::int64_t>(lines_.n_remaining());  // a row takes more
      const auto count = static_cast<std::size_t>(lines_.integer(fields_[i], 0, most));
      auto& species = file_.structure.atoms.species;
      species.insert(species.end(), count, elements[i]);
    }
  }

  void read_positions(bool are_cartesian, bool have_flags) {
    potentials::Atoms& atoms = file_.structure.atoms;
    std::vector<std::array<int, 3>> flags;
    for (std::size_t i = 0; i < atoms.species.size(); ++i) {
      split(concat("atom ", i + 1, " of ", atoms.species.size()));
      if (fields_.size() < (have_flags ? 6U : 3U)) {
        lines_.fail("expected ", have_flags ? "three coordinates and three flags" : "x, y and z");
      }
      Eigen::Vector3d x;
      for (int k = 0; k < 3; ++k) x[k] = lines_.fortran_real(fields_[static_cast<std::size_t>(k)]);
      atoms.positions.push_back(are_cartesian ? Eigen::Vector3d(scale_.cwiseProduct(x))
                                              : Eigen::Vector3d(atoms.box.cell * x));
      if (have_flags) flags.push_back({flag(3), flag(4), flag(5)});
    }
    if (have_flags) {
      file_.structure.columns.push_back({.name = std::string(selective_dynamics), .values = flags});
    }
  }

  [[nodiscard]] int flag(std::size_t field) const {
    std::string_view word = fields_[field];
    if (word.starts_with('.')) word.remove_prefix(1);
    if (begins_with(word, "tT")) return 1;
    if (begins_with(word, "fF")) return 0;
    lines_.fail("expected T or F, found ", in_quotes(fields_[field]));
  }

  void note_rest() {
    while (const auto line = lines_.next()) {
      if (line->find_first_not_of(" \t") == std::string_view::npos) continue;
      file_.notes.emplace_back("velocities and what follows the positions are left out");
      return;
    }
  }

  LineReader lines_;
  const ReadOptions& options_;
  std::vector<std::string_view> fields_;
  Eigen::Vector3d scale_ = Eigen::Vector3d::Ones();
  StructureFile file_;
};

void write_head(std::ostream& out, const potentials::Atoms& atoms, const Eigen::Matrix3d& cell,
                Digits digits) {
  out << "carbon shell\n1.0\n";
  for (int i = 0; i < 3; ++i) {
    std::string line;
    append_vector(line, cell.col(i), digits);
    out << line << '\n';
  }
  std::string symbols;
  std::string counts;
  for (const SpeciesData& known : known_species) {
    const auto count = std::ranges::count(atoms.species, known.species);
    if (count == 0) continue;
    symbols += concat(' ', known.symbol);
    counts += concat(' ', count);
  }
  out << symbols << '\n' << counts << '\n';
}

}  // namespace

StructureFile read_poscar(const std::filesystem::path& path, const ReadOptions& options) {
  const TextSource source = {.reader = "read_poscar", .path = path};
  require_one_structure(source, options);
  const std::string text = read_text(source);
  return PoscarReader(text, source, options).read();
}

std::vector<std::string> write_poscar(std::ostream& out, const Structure& structure,
                                      const WriteOptions& options) {
  check_atoms("write_poscar", structure.atoms);
  const potentials::Atoms& atoms = structure.atoms;
  CellFrame frame = cell_frame(atoms, CellKind::general);
  std::vector<std::size_t> order(atoms.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return atoms.species[i]; });
  if (!std::ranges::is_sorted(order)) {
    frame.notes.emplace_back("the order of the atoms changed: carbon is first");
  }
  write_head(out, atoms, frame.cell, options.digits);
  const auto* flags = find_column<std::array<int, 3>>(structure, selective_dynamics);
  out << (flags != nullptr ? "Selective dynamics\nDirect\n" : "Direct\n");
  const Eigen::Matrix3d inverse = frame.cell.inverse();
  std::string line;
  for (const std::size_t i : order) {
    line.clear();
    append_vector(line, inverse * frame.positions[i], Digits::seventeen_significant);
    for (std::size_t k = 0; flags != nullptr && k < 3; ++k)
      line += (*flags)[i][k] != 0 ? " T" : " F";
    line += '\n';
    out << line;
  }
  return std::move(frame.notes);
}

}  // namespace trivalent::dual
