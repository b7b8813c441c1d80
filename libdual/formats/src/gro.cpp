#include "trivalent/formats/gro.h"

#include <algorithm>
#include <array>
#include <optional>
#include <ostream>

#include "cell_frame.h"
#include "columns_of_text.h"
#include "one_structure.h"
#include "trivalent/dual/check_atoms.h"
#include "trivalent/formats/elements.h"
#include "trivalent/formats/text_file.h"

namespace trivalent::dual {
namespace {

constexpr double nanometer = 10.0;            // [Å]
constexpr std::size_t first_coordinate = 20;  // column, behind residue, names and number

/// Where the components of a box line stand: v1x v2y v3z v1y v1z v2x v2z v3x v3y.
constexpr std::array<std::array<int, 2>, 9> box_order = {
    {{0, 0}, {1, 1}, {2, 2}, {1, 0}, {2, 0}, {0, 1}, {2, 1}, {0, 2}, {1, 2}}};

class GroReader {
 public:
  GroReader(std::string_view text, const TextSource& source) : lines_(text, source) {}

  StructureFile read(std::optional<int> wanted) {
    StructureFile file;
    int n_frames = 0;
    while (const auto title = lines_.next()) {
      if (is_blank(*title) && n_frames > 0) continue;
      Structure frame = read_frame();
      if (++n_frames == wanted.value_or(n_frames)) file.structure = std::move(frame);
      if (n_frames == wanted) return file;
    }
    if (n_frames == 0) lines_.fail("the file is empty");
    if (wanted) lines_.fail("there is no structure ", *wanted, "; the file has ", n_frames);
    if (n_frames > 1) {
      file.notes.push_back(concat("the last of ", n_frames, " structures is taken"));
    }
    return file;
  }

 private:
  Structure read_frame() {
    Structure structure;
    std::vector<std::string_view> fields;
    split_fields(lines_.require("the number of atoms"), fields);
    if (fields.size() != 1) lines_.fail("expected the number of atoms alone");
    const auto most = static_cast<std::int64_t>(lines_.n_remaining());  // a row takes more
    const std::int64_t n_atoms = lines_.integer(fields[0], 0, most);
    for (std::int64_t i = 0; i < n_atoms; ++i) {
      read_atom(lines_.require(concat("atom ", i + 1, " of ", n_atoms)), structure);
    }
    split_fields(lines_.require("the box"), fields);
    if (fields.size() != 3 && fields.size() != 9) lines_.fail("a box has 3 or 9 numbers");
    potentials::Box& box = structure.atoms.box;
    for (std::size_t k = 0; k < fields.size(); ++k) {
      box.cell(box_order[k][0], box_order[k][1]) = nanometer * lines_.real(fields[k]);
    }
    if (!box.cell.isZero(0.0)) box.periodic = {true, true, true};
    return structure;
  }

  /// Decimals are as many as between the points of two coordinates.
  void read_atom(std::string_view line, Structure& structure) const {
    const std::size_t first = line.find('.', first_coordinate);
    const std::size_t second = first == std::string::npos ? first : line.find('.', first + 1);
    if (second == std::string::npos) lines_.fail("expected columns of an atom up to z");
    const std::size_t width = second - first;
    if (line.size() < first_coordinate + 3 * width) lines_.fail("an atom lacks z");
    Eigen::Vector3d x;
    for (int k = 0; k < 3; ++k) {
      std::string_view field =
          line.substr(first_coordinate + static_cast<std::size_t>(k) * width, width);
      field.remove_prefix(std::min(field.find_first_not_of(' '), field.size()));
      x[k] = nanometer * lines_.real(field);
    }
    std::string_view name = line.substr(10, 5);
    name.remove_prefix(std::min(name.find_first_not_of(' '), name.size()));
    const auto element = element_of_name(name);
    if (!element) lines_.fail("atom ", in_quotes(name), "; the potentials know C and H");
    structure.atoms.positions.push_back(x);
    structure.atoms.species.push_back(*element);
  }

  LineReader lines_;
};

}  // namespace

StructureFile read_gro(const std::filesystem::path& path, const ReadOptions& options) {
  const TextSource source = {.reader = "read_gro", .path = path};
  require_no_atom_style(source, options);
  const std::string text = read_text(source);
  return GroReader(text, source).read(options.frame);
}

std::vector<std::string> write_gro(std::ostream& out, const Structure& structure,
                                   const WriteOptions& options) {
  const potentials::Atoms& atoms = structure.atoms;
  check_atoms("write_gro", atoms);
  CellFrame frame = {.positions = atoms.positions, .cell = Eigen::Matrix3d::Zero(), .notes = {}};
  if (atoms.box.is_periodic()) frame = cell_frame(atoms, CellKind::triangular);
  const int decimals = options.digits == Digits::seventeen_significant ? 10 : 3;
  if (decimals == 3) frame.notes.emplace_back("positions have 3 decimals of nm: 0.01 Å");
  out << "carbon shell\n" << atoms.size() << '\n';
  const auto width = static_cast<std::size_t>(decimals) + 5;
  std::string row;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    const Eigen::Vector3d x = frame.positions[i] / nanometer;
    if (x.cwiseAbs().maxCoeff() >= 999.0) {
      throw InvalidNetwork(concat("write_gro: atom ", i + 1,
                                  " is farther than 999 nm from the origin; its columns cannot "
                                  "hold that"));
    }
    constexpr std::size_t n_numbers = 100000;
    row = "    1UNL  ";
    append_right(row, symbol_of(atoms.species[i]), 5);
    append_right(row, std::to_string((i + 1) % n_numbers), 5);
    for (const double coordinate : x) append_fixed(row, coordinate, decimals, width);
    out << row << '\n';
  }
  std::string box;
  for (std::size_t k = 0; k < box_order.size(); ++k) {
    const double component = frame.cell(box_order[k][0], box_order[k][1]) / nanometer;
    box += k > 0 ? " " : "";
    append_real(box, component, Digits::ten_decimals);
  }
  out << box << '\n';
  return std::move(frame.notes);
}

}  // namespace trivalent::dual
