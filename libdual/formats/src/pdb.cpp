#include "trivalent/formats/pdb.h"

#include <algorithm>
#include <array>
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

class PdbReader {
 public:
  PdbReader(std::string_view text, const TextSource& source) : lines_(text, source) {}

  StructureFile read(std::optional<int> wanted) {
    wanted_ = wanted;
    while (const auto line = lines_.next()) read_record(*line);
    if (n_models_ == 0) n_models_ = 1;
    if (wanted && *wanted > n_models_) {
      lines_.fail("there is no structure ", *wanted, "; the file has ", n_models_);
    }
    if (structure_.atoms.size() == 0) lines_.fail("the file has no ATOM or HETATM record");
    StructureFile file;
    if (!wanted && n_models_ > 1) {
      file.notes.push_back(concat("the last of ", n_models_, " structures is taken"));
    }
    if (const auto note = note_of_group_left_out(space_group_)) file.notes.push_back(*note);
    add_bonds();
    file.structure = std::move(structure_);
    return file;
  }

 private:
  void read_record(std::string_view line) {
    const std::string_view record = columns_of(line, 0, 6);
    if (record == "CRYST1") read_cell(line);
    if (record == "MODEL") begin_model();
    const bool is_wanted = !wanted_ || n_models_ == *wanted_ || (n_models_ == 0 && *wanted_ == 1);
    if (is_wanted && (record == "ATOM" || record == "HETATM")) read_atom(line);
    if (record == "CONECT") read_bonds(line);
  }

  void begin_model() {
    ++n_models_;
    if (wanted_ && *wanted_ != n_models_) return;
    structure_.atoms.positions.clear();
    structure_.atoms.species.clear();
    atom_of_serial_.clear();
    pairs_.clear();
  }

  [[nodiscard]] double number(std::string_view line, std::size_t begin, std::size_t end) const {
    return lines_.real(columns_of(line, begin, end));
  }

  void read_cell(std::string_view line) {
    const CellAngles parameters = {
        .lengths = {number(line, 6, 15), number(line, 15, 24), number(line, 24, 33)},
        .angles = {number(line, 33, 40), number(line, 40, 47), number(line, 47, 54)}};
    if (parameters.lengths == std::array{1.0, 1.0, 1.0}) return;
    potentials::Box& box = structure_.atoms.box;
    box.cell = cell_of(parameters);
    if (!box.cell.allFinite() ||
        std::ranges::any_of(parameters.lengths, [](double length) { return length <= 0.0; })) {
      lines_.fail("no cell has these lengths and angles");
    }
    box.periodic = {true, true, true};
    space_group_ = columns_of(line, 55, 66);
  }

  void read_atom(std::string_view line) {
    if (const std::string_view place = columns_of(line, 16, 17); !place.empty() && place != "A") {
      lines_.fail("the atom has another place too (alternate location ", in_quotes(place),
                  "); keep one of them");
    }
    const std::string_view symbol = columns_of(line, 76, 78);
    const std::string_view name = columns_of(line, 12, 16);
    const auto element = symbol.empty() ? element_of_name(name) : element_of_symbol(symbol);
    if (!element) {
      lines_.fail("element ", in_quotes(symbol.empty() ? name : symbol),
                  "; the potentials know C and H");
    }
    const std::string_view serial = columns_of(line, 6, 11);
    const auto index = static_cast<int>(structure_.atoms.size());
    const bool is_new = atom_of_serial_.emplace(serial, index).second;
    if (!is_new) atom_of_serial_[serial] = ambiguous;
    structure_.atoms.species.push_back(*element);
    structure_.atoms.positions.emplace_back(number(line, 30, 38), number(line, 38, 46),
                                            number(line, 46, 54));
  }

  void read_bonds(std::string_view line) {
    const int first = atom_of(columns_of(line, 6, 11));
    for (std::size_t begin = 11; begin < 31; begin += 5) {
      const std::string_view serial = columns_of(line, begin, begin + 5);
      if (serial.empty()) continue;
      const int second = atom_of(serial);
      // Multiple bonds are repeated, and every bond stands at both of its atoms.
      if (first != second) pairs_.push_back({std::min(first, second), std::max(first, second)});
    }
  }

  [[nodiscard]] int atom_of(std::string_view serial) const {
    const auto found = atom_of_serial_.find(serial);
    if (found == atom_of_serial_.end()) lines_.fail("there is no atom ", in_quotes(serial));
    if (found->second == ambiguous) lines_.fail("several atoms have the number ", serial);
    return found->second;
  }

  void add_bonds() {
    std::ranges::sort(pairs_);
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    structure_.bonds = potentials::bonds_between(structure_.atoms, pairs_);
  }

  static constexpr int ambiguous = -1;

  LineReader lines_;
  std::optional<int> wanted_;
  int n_models_ = 0;
  std::string_view space_group_;
  Structure structure_;
  std::unordered_map<std::string_view, int> atom_of_serial_;
  std::vector<std::array<int, 2>> pairs_;
};

/// Serial numbers below this are decimal.
constexpr std::size_t n_decimal_serials = 100000;

/// A number in five columns: decimal up to 99,999, then with a letter first and to the base 36
/// (A0000 is 100,000).
std::string hybrid_36(std::size_t number) {
  constexpr std::size_t base = 36;
  constexpr std::size_t first_letter = 10 * base * base * base * base;
  constexpr std::size_t n_upper = 26 * base * base * base * base;
  if (number < n_decimal_serials) return std::to_string(number);
  number -= n_decimal_serials;
  const bool is_upper = number < n_upper;
  if (!is_upper) number -= n_upper;
  number += first_letter;
  constexpr std::string_view upper = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ";
  constexpr std::string_view lower = "0123456789abcdefghijklmnopqrstuvwxyz";
  std::string text(5, '0');
  for (std::size_t k = text.size(); k > 0; --k) {
    text[k - 1] = (is_upper ? upper : lower)[number % base];
    number /= base;
  }
  return text;
}

void write_cell(std::ostream& out, const Eigen::Matrix3d& cell) {
  const CellAngles parameters = cell_angles(cell);
  std::string line = "CRYST1";
  for (const double length : parameters.lengths) append_fixed(line, length, 3, 9);
  for (const double angle : parameters.angles) append_fixed(line, angle, 2, 7);
  out << line << " P 1           1\n";
}

void write_atoms(std::ostream& out, const potentials::Atoms& atoms,
                 const std::vector<Eigen::Vector3d>& positions) {
  std::string line;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    const Eigen::Vector3d& x = positions[i];
    if (x.maxCoeff() >= 9999.0 || x.minCoeff() <= -999.0) {
      throw InvalidNetwork(concat("write_pdb: atom ", i + 1,
                                  " is beyond -999 to 9999 Å; its columns cannot hold that"));
    }
    const std::string_view symbol = symbol_of(atoms.species[i]);
    line = "HETATM";
    append_right(line, hybrid_36(i + 1), 5);
    line += concat("  ", symbol, "   UNL A   1    ");
    for (const double coordinate : x) append_fixed(line, coordinate, 3, 8);
    line += "  1.00  0.00          ";
    append_right(line, symbol, 2);
    out << line << '\n';
  }
}

void write_bonds(std::ostream& out, std::size_t n_atoms,
                 const std::vector<std::array<int, 2>>& pairs) {
  std::vector<std::vector<int>> bonded(n_atoms);
  for (const auto [a, b] : pairs) {
    bonded[static_cast<std::size_t>(a)].push_back(b);
    bonded[static_cast<std::size_t>(b)].push_back(a);
  }
  constexpr std::size_t per_record = 4;
  std::string line;
  for (std::size_t i = 0; i < n_atoms; ++i) {
    for (std::size_t k = 0; k < bonded[i].size(); ++k) {
      if (k % per_record == 0) {
        line += line.empty() ? "CONECT" : "\nCONECT";
        append_right(line, std::to_string(i + 1), 5);
      }
      append_right(line, std::to_string(bonded[i][k] + 1), 5);
    }
    if (!line.empty()) out << line << '\n';
    line.clear();
  }
}

}  // namespace

StructureFile read_pdb(const std::filesystem::path& path, const ReadOptions& options) {
  const TextSource source = {.reader = "read_pdb", .path = path};
  require_no_atom_style(source, options);
  const std::string text = read_text(source);
  return PdbReader(text, source).read(options.frame);
}

std::vector<std::string> write_pdb(std::ostream& out, const Structure& structure,
                                   const WriteOptions& /*options*/) {
  const potentials::Atoms& atoms = structure.atoms;
  check_atoms("write_pdb", atoms);
  CellFrame frame = {.positions = atoms.positions, .cell = {}, .notes = {}};
  const bool is_periodic = atoms.box.is_periodic();
  if (is_periodic) frame = cell_frame(atoms, CellKind::triangular);
  frame.notes.emplace_back("positions have 3 decimals");
  std::vector<std::array<int, 2>> pairs = bond_pairs(structure, frame.notes);
  if (!pairs.empty() && atoms.size() >= n_decimal_serials) {
    // MDAnalysis refuses a file with hybrid-36 in CONECT; others take such numbers modulo 100,000.
    pairs.clear();
    frame.notes.emplace_back(
        "bonds are left out: few readers know CONECT beyond atom 99,999; MOL2 has no such limit");
  }
  if (is_periodic) write_cell(out, frame.cell);
  write_atoms(out, atoms, frame.positions);
  write_bonds(out, atoms.size(), pairs);
  out << "END\n";
  return std::move(frame.notes);
}

}  // namespace trivalent::dual
