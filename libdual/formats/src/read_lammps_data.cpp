#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string_view>

#include "species_data.h"
#include "trivalent/formats/lammps_data.h"
#include "trivalent/formats/text_file.h"

namespace trivalent::dual {
namespace {

using potentials::Species;
using Fields = std::vector<std::string_view>;

constexpr std::int64_t largest_id = std::numeric_limits<int>::max();

/// Where a row of the section Atoms has what. Three image flags may follow the coordinates.
struct AtomColumns {
  std::string_view style;
  std::size_t type;
  std::size_t first_coordinate;
};
// Those without a style hint are told apart by their number of columns, first match first.
constexpr std::array atom_columns = {AtomColumns{"atomic", 1, 2}, AtomColumns{"molecular", 2, 3},
                                     AtomColumns{"charge", 1, 3}, AtomColumns{"full", 2, 4}};

struct AtomRow {
  std::int64_t id = 0;
  int type = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::size_t line = 0;
};

struct BondRow {
  std::array<std::int64_t, 2> ids;
  std::size_t line = 0;
};

/// Lines of a data file without comments and empty lines.
class DataLines {
 public:
  DataLines(std::string_view text, const TextSource& source) : lines_(text, source) {}

  /// Reads the next line that holds anything; false at the end of the file.
  bool advance() {
    while (const auto line = lines_.next()) {
      const std::size_t hash = std::min(line->find('#'), line->size());
      comment_ = line->substr(std::min(hash + 1, line->size()));
      split_fields(line->substr(0, hash), fields_);
      if (!fields_.empty()) return true;
    }
    return false;
  }
  void skip_title() { static_cast<void>(lines_.require("a title")); }
  [[nodiscard]] const Fields& fields() const { return fields_; }
  [[nodiscard]] std::string_view comment() const { return comment_; }
  [[nodiscard]] const LineReader& reader() const { return lines_; }
  /// Section names begin with a letter, all else with a number.
  [[nodiscard]] bool is_section_name() const {
    return std::isalpha(static_cast<unsigned char>(fields_.front().front())) != 0;
  }

 private:
  LineReader lines_;
  Fields fields_;
  std::string_view comment_;
};

class DataReader {
 public:
  DataReader(std::string_view text, const TextSource& source) : lines_(text, source) {}

  StructureFile read() {
    lines_.skip_title();
    bool has_line = lines_.advance();
    for (; has_line && !lines_.is_section_name(); has_line = lines_.advance()) read_header_line();
    check_counts();
    while (has_line) has_line = read_section();
    return assemble();
  }

 private:
  void read_header_line();
  void check_counts() const;
  bool read_section();
  bool skip_section(std::string_view name);
  template <typename ReadRow>
  bool read_rows(std::string_view section, std::int64_t count, ReadRow read_row);
  void read_mass();
  void read_atom();
  void read_bond();
  void choose_columns(std::string_view hint);
  [[nodiscard]] potentials::Box box() const;
  [[nodiscard]] Species species_of(const AtomRow& atom) const;
  [[nodiscard]] StructureFile assemble();
  [[nodiscard]] int index_of(std::int64_t id, const BondRow& bond) const;

  DataLines lines_;
  std::map<std::string, std::int64_t> counts_;
  std::array<double, 3> low_ = {-0.5, -0.5, -0.5};  // LAMMPS's box if the header has none
  std::array<double, 3> high_ = {0.5, 0.5, 0.5};
  std::array<double, 3> tilts_ = {0.0, 0.0, 0.0};  // xy xz yz
  std::map<int, Species> species_;
  std::optional<AtomColumns> columns_;
  std::vector<AtomRow> atoms_;
  std::vector<BondRow> bonds_;
  std::vector<std::string> notes_;
};

void DataReader::read_header_line() {
  const Fields& fields = lines_.fields();
  const LineReader& reader = lines_.reader();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    constexpr std::array<std::string_view, 3> low_names = {"xlo", "ylo", "zlo"};
    if (fields.size() != 4 || fields[2] != low_names[axis]) continue;
    low_[axis] = reader.real(fields[0]);
    high_[axis] = reader.real(fields[1]);
    if (!(low_[axis] < high_[axis])) reader.fail("the box has no extent here");
    return;
  }
  if (fields.size() == 6 && fields[3] == "xy") {
    for (std::size_t i = 0; i < 3; ++i) tilts_[i] = reader.real(fields[i]);
    return;
  }
  std::string name;
  for (std::size_t i = 1; i < fields.size(); ++i) name += concat(i > 1 ? " " : "", fields[i]);
  if (name == "atoms" || name == "bonds" || name == "atom types") {
    counts_[name] = reader.integer(fields[0], 0, largest_id);
  }
}

void DataReader::check_counts() const {
  const LineReader& reader = lines_.reader();
  if (!counts_.contains("atoms")) reader.fail("the header does not say how many atoms there are");
  // The shortest row, "1 1 0 0 0" or "1 1 1 2", has four fields.
  constexpr std::uint64_t shortest_row = 8;
  for (const auto& [name, count] : counts_) {
    if (name == "atom types") continue;
    if (static_cast<std::uint64_t>(count) <= reader.n_remaining() / shortest_row) continue;
    reader.fail("the file declares ", count, ' ', name, ", but only ", reader.n_remaining(),
                " bytes follow; it is cut short or the count is wrong");
  }
}

bool DataReader::read_section() {
  std::string name;
  for (const auto field : lines_.fields()) name += concat(name.empty() ? "" : " ", field);
  const auto count = [&](const char* what) {
    return counts_.contains(what) ? counts_.at(what) : 0;
  };
  if (name == "Masses") return read_rows(name, count("atom types"), [this] { read_mass(); });
  if (name == "Bonds") return read_rows(name, count("bonds"), [this] { read_bond(); });
  if (name != "Atoms") return skip_section(name);
  if (!atoms_.empty()) lines_.reader().fail("a second section Atoms");
  choose_columns(lines_.comment());
  atoms_.reserve(static_cast<std::size_t>(count("atoms")));
  return read_rows(name, count("atoms"), [this] { read_atom(); });
}

bool DataReader::skip_section(std::string_view name) {
  notes_.push_back(concat("section ", quoted(name), " is not read"));
  while (lines_.advance()) {
    if (lines_.is_section_name()) return true;
  }
  return false;
}

template <typename ReadRow>
bool DataReader::read_rows(std::string_view section, std::int64_t count, ReadRow read_row) {
  for (std::int64_t row = 0; row < count; ++row) {
    if (!lines_.advance() || lines_.is_section_name()) {
      lines_.reader().fail("section ", section, " ends after ", row, " of ", count, " rows");
    }
    read_row();
  }
  if (!lines_.advance()) return false;
  if (lines_.is_section_name()) return true;
  lines_.reader().fail("section ", section, " has more than the declared ", count, " rows");
}

void DataReader::read_mass() {
  const Fields& fields = lines_.fields();
  const LineReader& reader = lines_.reader();
  if (fields.size() != 2) reader.fail("expected type and mass");
  const auto type = static_cast<int>(reader.integer(fields[0], 1, counts_.at("atom types")));
  const double mass = reader.real(fields[1]);
  for (const SpeciesData& known : known_species) {
    // Programs write 1 or 1.00794, 12 or 12.0107: half a unit of mass tells elements (not isotopes)
    // apart.
    if (std::abs(mass - known.mass) < 0.5) species_.emplace(type, known.species);
  }
  if (!species_.contains(type)) {
    notes_.push_back(concat("type ", type, " of mass ", mass, " is neither C nor H"));
  }
}

/// Takes the style from the hint after "Atoms #"; without one it is found at the first row.
void DataReader::choose_columns(std::string_view hint) {
  Fields words;
  split_fields(hint, words);
  if (words.empty()) return;
  const auto found = std::find_if(atom_columns.begin(), atom_columns.end(),
                                  [&](const AtomColumns& c) { return c.style == words.front(); });
  if (found == atom_columns.end()) {
    lines_.reader().fail("atom_style ", quoted(words.front()),
                         " is not known; use atomic, charge, molecular or full");
  }
  columns_ = *found;
}

void DataReader::read_atom() {
  const Fields& fields = lines_.fields();
  const LineReader& reader = lines_.reader();
  const auto fits = [&](const AtomColumns& columns) {
    return fields.size() == columns.first_coordinate + 3 ||
           fields.size() == columns.first_coordinate + 6;
  };
  if (!columns_) {
    const auto found = std::find_if(atom_columns.begin(), atom_columns.end(), fits);
    if (found != atom_columns.end()) columns_ = *found;
  }
  if (!columns_ || !fits(*columns_)) {
    reader.fail("an atom with ", fields.size(), " fields", columns_ ? " in atom_style " : "",
                columns_ ? columns_->style : "",
                "; expected id, type, coordinates as in atom_style "
                "atomic, charge, molecular or full");
  }
  AtomRow atom;
  atom.line = reader.line_number();
  atom.id = reader.integer(fields[0], 1, largest_id);
  atom.type = static_cast<int>(reader.integer(fields[columns_->type], 1, largest_id));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    atom.position[static_cast<int>(axis)] = reader.real(fields[columns_->first_coordinate + axis]);
  }
  atoms_.push_back(atom);
}

void DataReader::read_bond() {
  const Fields& fields = lines_.fields();
  const LineReader& reader = lines_.reader();
  if (fields.size() != 4) reader.fail("expected id, type and two atoms of a bond");
  bonds_.push_back(
      {.ids = {reader.integer(fields[2], 1, largest_id), reader.integer(fields[3], 1, largest_id)},
       .line = reader.line_number()});
}

potentials::Box DataReader::box() const {
  potentials::Box box;
  box.origin = Eigen::Vector3d(low_[0], low_[1], low_[2]);
  box.cell.diagonal() = Eigen::Vector3d(high_[0], high_[1], high_[2]) - box.origin;
  box.cell(0, 1) = tilts_[0];
  box.cell(0, 2) = tilts_[1];
  box.cell(1, 2) = tilts_[2];
  box.periodic = {true, true, true};
  return box;
}

Species DataReader::species_of(const AtomRow& atom) const {
  const auto found = species_.find(atom.type);
  if (found != species_.end()) return found->second;
  lines_.reader().fail_at(atom.line, "atom ", atom.id, " is of type ", atom.type,
                          ", for which Masses has no mass of C or H");
}

/// The atoms are sorted by id.
int DataReader::index_of(std::int64_t id, const BondRow& bond) const {
  const auto found =
      std::lower_bound(atoms_.begin(), atoms_.end(), id,
                       [](const AtomRow& atom, std::int64_t i) { return atom.id < i; });
  if (found == atoms_.end() || found->id != id) {
    lines_.reader().fail_at(bond.line, "the bond names atom ", id, ", which does not exist");
  }
  return static_cast<int>(found - atoms_.begin());
}

StructureFile DataReader::assemble() {
  const LineReader& reader = lines_.reader();
  if (static_cast<std::int64_t>(atoms_.size()) != counts_.at("atoms")) {
    reader.fail("the file has no section Atoms");
  }
  if (static_cast<std::int64_t>(bonds_.size()) != counts_["bonds"]) {
    reader.fail("the file declares bonds, but has no section Bonds");
  }
  std::sort(atoms_.begin(), atoms_.end(),
            [](const AtomRow& a, const AtomRow& b) { return a.id < b.id; });
  StructureFile file = {.notes = std::move(notes_)};
  potentials::Atoms& atoms = file.structure.atoms;
  atoms.box = box();
  for (std::size_t i = 0; i < atoms_.size(); ++i) {
    if (i > 0 && atoms_[i].id == atoms_[i - 1].id) {
      reader.fail_at(std::max(atoms_[i].line, atoms_[i - 1].line), "atom ", atoms_[i].id,
                     " appears a second time");
    }
    atoms.positions.push_back(atoms_[i].position);
    atoms.species.push_back(species_of(atoms_[i]));
  }
  std::vector<std::array<int, 2>> pairs;
  for (const BondRow& bond : bonds_) {
    pairs.push_back({index_of(bond.ids[0], bond), index_of(bond.ids[1], bond)});
  }
  file.structure.bonds = potentials::bonds_between(atoms, pairs);
  const bool has_gaps =
      !atoms_.empty() && atoms_.back().id != static_cast<std::int64_t>(atoms_.size());
  if (has_gaps) file.notes.push_back("atom ids have gaps; atoms are renumbered in their order");
  return file;
}

}  // namespace

StructureFile read_lammps_data(const std::filesystem::path& path) {
  const TextSource source = {.reader = "read_lammps_data", .path = path};
  const std::string text = read_text(source);
  return DataReader(text, source).read();
}

}  // namespace trivalent::dual
