#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string_view>

#include "lammps_header.h"
#include "lammps_types.h"
#include "trivalent/formats/lammps_data.h"
#include "trivalent/formats/text_file.h"
#include "trivalent/potentials/bonds.h"

namespace trivalent::dual {
namespace {

using potentials::Species;

/// Where a row of the section Atoms has what. Three image flags may follow the coordinates.
struct AtomColumns {
  AtomStyle style;
  std::size_t type;
  std::size_t first_coordinate;

  [[nodiscard]] bool fit(std::size_t n_fields) const {
    return n_fields == first_coordinate + 3 || n_fields == first_coordinate + 6;
  }
};
constexpr std::array atom_columns = {
    AtomColumns{AtomStyle::atomic, 1, 2}, AtomColumns{AtomStyle::molecular, 2, 3},
    AtomColumns{AtomStyle::charge, 1, 3}, AtomColumns{AtomStyle::full, 2, 4}};

/// Styles as a hint behind "Atoms #" names them.
struct StyleName {
  std::string_view name;
  AtomStyle style;
};
constexpr std::array style_names = {
    StyleName{"atomic", AtomStyle::atomic},  StyleName{"molecular", AtomStyle::molecular},
    StyleName{"bond", AtomStyle::molecular}, StyleName{"angle", AtomStyle::molecular},
    StyleName{"charge", AtomStyle::charge},  StyleName{"full", AtomStyle::full}};

struct AtomRow {
  std::int64_t id = 0;
  /// What may be the type: the second and the third field.
  std::array<std::string_view, 2> types = {};
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::size_t line = 0;
};

struct BondRow {
  std::array<std::int64_t, 2> ids;
  std::size_t line = 0;
};

class DataReader {
 public:
  DataReader(std::string_view text, const TextSource& source, const ReadOptions& options)
      : lines_(text, source),
        options_(options),
        title_(lines_.title()),
        header_(lines_),
        types_(header_.count("atom types"), options.elements) {}

  StructureFile read() {
    check_title();
    for (bool has_section = header_.has_section(); has_section;) has_section = read_section();
    return assemble();
  }

 private:
  void check_title() const;
  bool read_section();
  bool skip_section();
  template <typename ReadRow>
  bool read_rows(std::int64_t count, ReadRow read_row);
  void read_atom();
  void read_bond();
  void take_hint();
  void choose_columns(std::size_t n_fields);
  [[nodiscard]] AtomStyle choose_style() const;
  [[nodiscard]] std::optional<std::size_t> find_misfit(std::size_t field) const;
  [[nodiscard]] Species element_of(const AtomRow& atom, std::size_t field) const;
  [[nodiscard]] StructureFile assemble();
  void add_atoms(StructureFile& file);
  void add_bonds(StructureFile& file) const;
  [[nodiscard]] int index_of(std::int64_t id, const BondRow& bond) const;

  LammpsLines lines_;
  const ReadOptions& options_;
  std::string_view title_;
  LammpsHeader header_;
  LammpsTypes types_;
  std::set<std::string> seen_sections_;
  std::optional<AtomStyle> style_;  // as the caller or the hint says
  std::optional<AtomColumns> columns_;
  std::vector<AtomRow> atoms_;
  std::vector<BondRow> bonds_;
  std::vector<std::string> notes_;
};

/// LAMMPS itself writes the units of a file into its title.
void DataReader::check_title() const {
  constexpr std::string_view key = "units = ";
  const std::size_t at = title_.find(key);
  if (at == std::string_view::npos) return;
  std::vector<std::string_view> words;
  split_fields(title_.substr(at + key.size()), words);
  if (words.empty() || words.front() == "metal" || words.front() == "real") return;
  lines_.reader().fail_at(1, "the file is in units ", words.front(),
                          ", whose lengths are not in Å; write it in units metal or real");
}

bool DataReader::read_section() {
  const std::string name = lines_.words_from(0);
  if (!seen_sections_.insert(name).second) lines_.reader().fail("a second section ", name);
  const std::int64_t n_types = header_.count("atom types");
  if (name == "Atom Type Labels") return read_rows(n_types, [&] { types_.read_label(lines_); });
  if (name == "Masses") return read_rows(n_types, [&] { types_.read_mass(lines_); });
  if (name == "Bonds") return read_rows(header_.count("bonds"), [&] { read_bond(); });
  if (name != "Atoms") return skip_section();
  take_hint();
  atoms_.reserve(static_cast<std::size_t>(header_.count("atoms")));
  return read_rows(header_.count("atoms"), [&] { read_atom(); });
}

bool DataReader::skip_section() {
  notes_.push_back(concat("section ", in_quotes(lines_.words_from(0)), " is not read"));
  while (lines_.advance()) {
    if (lines_.is_section_name()) return true;
  }
  return false;
}

template <typename ReadRow>
bool DataReader::read_rows(std::int64_t count, ReadRow read_row) {
  const std::string section = lines_.words_from(0);
  for (std::int64_t row = 0; row < count; ++row) {
    if (!lines_.advance() || lines_.is_section_name()) {
      lines_.reader().fail("section ", section, " ends after ", row, " of ", count, " rows");
    }
    read_row();
  }
  if (!lines_.advance()) return false;
  if (lines_.begins_with_letter()) return true;
  lines_.reader().fail("section ", section, " has more than the declared ", count, " rows");
}

void DataReader::take_hint() {
  std::vector<std::string_view> words;
  split_fields(lines_.comment(), words);
  style_ = options_.atom_style;
  if (words.empty()) return;
  const auto found = std::ranges::find(style_names, words.front(), &StyleName::name);
  if (found == style_names.end()) {
    lines_.reader().fail("atom_style ", in_quotes(words.front()),
                         " is not known; use atomic, charge, bond, angle, molecular or full");
  }
  if (!style_) style_ = found->style;
}

/// From the first row, as far as its number of fields says. Molecular and charge have as many.
void DataReader::choose_columns(std::size_t n_fields) {
  for (const AtomColumns& columns : atom_columns) {
    const bool is_wanted = !style_ || *style_ == columns.style;
    if (!is_wanted || !columns.fit(n_fields)) continue;
    columns_ = columns;
    return;
  }
}

void DataReader::read_atom() {
  const auto& fields = lines_.fields();
  const LineReader& reader = lines_.reader();
  if (!columns_) choose_columns(fields.size());
  if (!columns_ || !columns_->fit(fields.size())) {
    reader.fail("an atom with ", fields.size(), " fields; expected id, type and coordinates as in ",
                style_ ? "the atom_style that is named"
                       : "atom_style atomic, charge, molecular or "
                         "full");
  }
  AtomRow atom;
  atom.line = reader.line_number();
  atom.id = reader.integer(fields[0], 1, max_lammps_id);
  atom.types = {fields[1], fields[2]};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    atom.position[static_cast<int>(axis)] = reader.real(fields[columns_->first_coordinate + axis]);
  }
  atoms_.push_back(atom);
}

void DataReader::read_bond() {
  const auto& fields = lines_.fields();
  const LineReader& reader = lines_.reader();
  if (fields.size() != 4) reader.fail("expected id, type and two atoms of a bond");
  const BondRow bond = {.ids = {reader.integer(fields[2], 1, max_lammps_id),
                                reader.integer(fields[3], 1, max_lammps_id)},
                        .line = reader.line_number()};
  if (bond.ids[0] == bond.ids[1]) reader.fail("the bond joins atom ", bond.ids[0], " to itself");
  bonds_.push_back(bond);
}

/// Index of the first atom whose field (1 or 2) is no type; none if all are.
std::optional<std::size_t> DataReader::find_misfit(std::size_t field) const {
  const auto found = std::ranges::find_if(
      atoms_, [&](const AtomRow& atom) { return !types_.find(atom.types[field - 1]); });
  if (found == atoms_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - atoms_.begin());
}

/// Tells molecular from charge where only the contents can: the one has the type in its third
/// field, the other in its second.
AtomStyle DataReader::choose_style() const {
  if (style_) return *style_;
  const bool is_open = columns_->style == AtomStyle::molecular;
  if (!is_open || !bonds_.empty()) return columns_->style;
  const bool may_be_molecular = !find_misfit(2);
  const bool may_be_charge = !find_misfit(1);
  if (may_be_molecular != may_be_charge) {
    return may_be_molecular ? AtomStyle::molecular : AtomStyle::charge;
  }
  for (const AtomRow& atom : atoms_) {
    if (!may_be_charge) break;
    if (types_.find(atom.types[0]) == types_.find(atom.types[1]) || types_.size() == 1) continue;
    lines_.reader().fail_at(atom.line,
                            "atom_style may be molecular or charge; the section's name must say "
                            "it, as in 'Atoms # charge', or --atom-style");
  }
  return AtomStyle::molecular;
}

Species DataReader::element_of(const AtomRow& atom, std::size_t field) const {
  const std::string_view text = atom.types[field - 1];
  const auto type = types_.find(text);
  if (!type) {
    lines_.reader().fail_at(atom.line, "atom ", atom.id, " is of type ", in_quotes(text),
                            "; the file has ", types_.size(), " types");
  }
  if (const auto element = types_.element(*type)) return *element;
  lines_.reader().fail_at(atom.line, "atom ", atom.id, " is of type ", text,
                          ", for which Masses has no mass of C or H; --elements names the elements "
                          "of the types");
}

/// The atoms are sorted by id.
int DataReader::index_of(std::int64_t id, const BondRow& bond) const {
  const auto found = std::ranges::lower_bound(atoms_, id, {}, &AtomRow::id);
  if (found == atoms_.end() || found->id != id) {
    lines_.reader().fail_at(bond.line, "the bond names atom ", id, ", which does not exist");
  }
  return static_cast<int>(found - atoms_.begin());
}

void DataReader::add_atoms(StructureFile& file) {
  std::size_t type_field = 1;
  if (columns_) {
    const AtomStyle style = choose_style();
    type_field = std::ranges::find(atom_columns, style, &AtomColumns::style)->type;
  }
  std::ranges::sort(atoms_, {}, &AtomRow::id);
  potentials::Atoms& atoms = file.structure.atoms;
  for (std::size_t i = 0; i < atoms_.size(); ++i) {
    if (i > 0 && atoms_[i].id == atoms_[i - 1].id) {
      lines_.reader().fail_at(std::max(atoms_[i].line, atoms_[i - 1].line), "atom ", atoms_[i].id,
                              " appears a second time");
    }
    atoms.positions.push_back(atoms_[i].position);
    atoms.species.push_back(element_of(atoms_[i], type_field));
  }
  const bool has_gaps =
      !atoms_.empty() && atoms_.back().id != static_cast<std::int64_t>(atoms_.size());
  if (has_gaps) file.notes.push_back("atom ids have gaps; atoms are renumbered in their order");
}

void DataReader::add_bonds(StructureFile& file) const {
  std::vector<std::array<int, 2>> pairs;
  std::set<std::array<int, 2>> seen;
  for (const BondRow& bond : bonds_) {
    pairs.push_back({index_of(bond.ids[0], bond), index_of(bond.ids[1], bond)});
    if (seen.insert({std::min(pairs.back()[0], pairs.back()[1]),
                     std::max(pairs.back()[0], pairs.back()[1])})
            .second) {
      continue;
    }
    file.notes.push_back(
        concat(unused_bonds, "line ", bond.line,
               " is a second bond of two atoms, and the file does not say which images they join"));
    return;
  }
  file.structure.bonds = potentials::bonds_between(file.structure.atoms, pairs);
}

StructureFile DataReader::assemble() {
  const LineReader& reader = lines_.reader();
  if (static_cast<std::int64_t>(atoms_.size()) != header_.count("atoms")) {
    reader.fail("the file has no section Atoms");
  }
  if (static_cast<std::int64_t>(bonds_.size()) != header_.count("bonds")) {
    reader.fail("the file declares bonds, but has no section Bonds");
  }
  StructureFile file = {.notes = std::move(notes_)};
  file.structure.atoms.box = header_.box();
  if (!header_.has_box()) {
    file.notes.push_back("the header has no box; LAMMPS's own is taken, from -0.5 to 0.5 Å");
  }
  add_atoms(file);
  add_bonds(file);
  for (std::string& note : types_.notes()) file.notes.push_back(std::move(note));
  return file;
}

}  // namespace

StructureFile read_lammps_data(const std::filesystem::path& path, const ReadOptions& options) {
  const TextSource source = {.reader = "read_lammps_data", .path = path};
  if (options.frame.value_or(1) != 1) {
    throw InvalidOption(concat(
        "read_lammps_data: a data file holds one structure; there is no number ", *options.frame));
  }
  const std::string text = read_text(source);
  return DataReader(text, source, options).read();
}

}  // namespace trivalent::dual
