#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <string_view>

#include "trivalent/formats/text_file.h"
#include "trivalent/formats/xyz.h"
#include "xyz_names.h"

namespace trivalent::dual {
namespace {

using potentials::Species;

struct TextEntry {
  std::string key;
  std::string value;
};

/// Takes the characters up to the closing mark off the line, with backslash escapes undone.
std::string take_delimited(std::string_view& rest, char close, const LineReader& lines) {
  std::string value;
  for (std::size_t i = 1; i < rest.size(); ++i) {
    if (rest[i] == close) {
      rest.remove_prefix(i + 1);
      return value;
    }
    if (rest[i] == '\\' && i + 1 < rest.size()) ++i;
    value += rest[i];
  }
  lines.fail("no closing ", close, " after ", quoted(rest));
}

std::string take_value(std::string_view& rest, const LineReader& lines) {
  if (rest.starts_with('"')) return take_delimited(rest, '"', lines);
  if (rest.starts_with('{')) return take_delimited(rest, '}', lines);
  const std::size_t end = std::min(rest.find_first_of(" \t"), rest.size());
  std::string value(rest.substr(0, end));
  rest.remove_prefix(end);
  return value;
}

/// Splits the comment line into key=value; a bare word stands for true.
std::vector<TextEntry> parse_header(std::string_view rest, const LineReader& lines) {
  std::vector<TextEntry> entries;
  while (true) {
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    if (rest.empty()) return entries;
    const std::size_t end = std::min(rest.find_first_of("= \t"), rest.size());
    TextEntry entry = {.key = std::string(rest.substr(0, end)), .value = "T"};
    rest.remove_prefix(end);
    if (rest.starts_with('=')) {
      rest.remove_prefix(1);
      entry.value = take_value(rest, lines);
    }
    entries.push_back(std::move(entry));
  }
}

std::optional<std::string> find_entry(const std::vector<TextEntry>& entries, std::string_view key) {
  for (const TextEntry& entry : entries) {
    if (entry.key == key) return entry.value;
  }
  return std::nullopt;
}

std::vector<double> reals(std::string_view text, std::size_t count, const LineReader& lines) {
  std::vector<std::string_view> fields;
  split_fields(text, fields);
  if (fields.size() != count) {
    lines.fail("expected ", count, " numbers, found ", quoted(text));
  }
  std::vector<double> values;
  values.reserve(count);
  for (const auto field : fields) values.push_back(lines.real(field));
  return values;
}

std::array<bool, 3> parse_periodic(std::string_view text, const LineReader& lines) {
  std::vector<std::string_view> fields;
  split_fields(text, fields);
  if (fields.size() != 3) lines.fail("pbc needs three of T and F, found ", quoted(text));
  std::array<bool, 3> periodic = {};
  for (int i = 0; i < 3; ++i) {
    const bool is_true = fields[i] == "T" || fields[i] == "True" || fields[i] == "1";
    const bool is_false = fields[i] == "F" || fields[i] == "False" || fields[i] == "0";
    if (!is_true && !is_false) lines.fail("pbc needs three of T and F, found ", quoted(text));
    periodic[i] = is_true;
  }
  return periodic;
}

potentials::Box parse_box(const std::vector<TextEntry>& header, const LineReader& lines) {
  potentials::Box box;
  const auto lattice = find_entry(header, "Lattice");
  if (lattice) {
    const std::vector<double> numbers = reals(*lattice, 9, lines);
    box.cell = Eigen::Map<const Eigen::Matrix3d>(numbers.data());
    box.periodic = {true, true, true};
  }
  if (const auto origin = find_entry(header, "Origin")) {
    box.origin = Eigen::Map<const Eigen::Vector3d>(reals(*origin, 3, lines).data());
  }
  if (const auto periodic = find_entry(header, "pbc"))
    box.periodic = parse_periodic(*periodic, lines);
  if (!lattice && box.is_periodic()) lines.fail("pbc says periodic, but there is no Lattice");
  return box;
}

/// What a property of the file becomes.
enum class Role { species, position, column, ignored };

struct Property {
  std::string name;
  Role role = Role::ignored;
  std::size_t first_field = 0;
  std::size_t n_fields = 0;
};

/// The properties in file order, and the columns that they fill (in the same order).
struct Layout {
  std::vector<Property> properties = {};
  std::vector<Column> columns = {};
  std::size_t n_fields = 0;    ///< per atom
  bool may_have_more = false;  ///< plain XYZ: anything may follow the position
  std::vector<std::string> notes = {};
};

std::vector<std::string_view> split_at_colons(std::string_view text) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = std::min(text.find(':'), text.size());
    parts.push_back(text.substr(0, end));
    if (end == text.size()) return parts;
    text.remove_prefix(end + 1);
  }
}

void add_column(Layout& layout, Property& property, std::string_view type) {
  const bool is_real = type == "R";
  const bool has_shape = property.n_fields == 1 || property.n_fields == 3;
  if (!has_shape || !(is_real || type == "I") || !is_xyz_name(property.name)) {
    layout.notes.push_back(concat("column ", quoted(property.name), " is not read (type ", type,
                                  ", ", property.n_fields, " components)"));
    return;
  }
  property.role = Role::column;
  Column column = {.name = property.name, .values = {}};
  if (is_real && property.n_fields == 3) column.values = std::vector<Eigen::Vector3d>();
  if (!is_real && property.n_fields == 1) column.values = std::vector<int>();
  if (!is_real && property.n_fields == 3) column.values = std::vector<std::array<int, 3>>();
  layout.columns.push_back(std::move(column));
}

void check_roles(const Layout& layout, const LineReader& lines) {
  const auto count = [&](Role role) {
    return std::count_if(layout.properties.begin(), layout.properties.end(),
                         [&](const Property& property) { return property.role == role; });
  };
  if (count(Role::species) != 1) lines.fail("Properties needs one species:S:1");
  if (count(Role::position) != 1) lines.fail("Properties needs one pos:R:3");
}

Layout parse_layout(std::string_view text, const LineReader& lines) {
  const auto parts = split_at_colons(text);
  if (parts.size() % 3 != 0) {
    lines.fail("Properties must be name:type:components, repeated; found ", quoted(text));
  }
  Layout layout;
  for (std::size_t i = 0; i < parts.size(); i += 3) {
    const std::string_view type = parts[i + 1];
    const auto n_fields = static_cast<std::size_t>(lines.integer(parts[i + 2], 1, 1000));
    Property property = {std::string(parts[i]), Role::ignored, layout.n_fields, n_fields};
    const bool is_symbol = property.name == "species" || property.name == "element";
    if (is_symbol && type == "S" && n_fields == 1) {
      property.role = Role::species;
    } else if (property.name == "pos" && type == "R" && n_fields == 3) {
      property.role = Role::position;
    } else {
      add_column(layout, property, type);
    }
    layout.n_fields += n_fields;
    layout.properties.push_back(std::move(property));
  }
  check_roles(layout, lines);
  return layout;
}

Species parse_species(std::string_view field, const LineReader& lines) {
  if (field == "C" || field == "6") return Species::carbon;
  if (field == "H" || field == "1") return Species::hydrogen;
  lines.fail("element ", quoted(field), "; the potentials know C and H");
}

class RowReader {
 public:
  RowReader(const LineReader& lines, const std::vector<std::string_view>& fields)
      : lines_(lines), fields_(fields) {}

  [[nodiscard]] Eigen::Vector3d vector(std::size_t first) const {
    return {lines_.real(fields_[first]), lines_.real(fields_[first + 1]),
            lines_.real(fields_[first + 2])};
  }
  [[nodiscard]] int integer(std::size_t field) const {
    using Limits = std::numeric_limits<int>;
    return static_cast<int>(lines_.integer(fields_[field], Limits::min(), Limits::max()));
  }
  void append(std::vector<double>& values, std::size_t first) const {
    values.push_back(lines_.real(fields_[first]));
  }
  void append(std::vector<int>& values, std::size_t first) const {
    values.push_back(integer(first));
  }
  void append(std::vector<Eigen::Vector3d>& values, std::size_t first) const {
    values.push_back(vector(first));
  }
  void append(std::vector<std::array<int, 3>>& values, std::size_t first) const {
    values.push_back({integer(first), integer(first + 1), integer(first + 2)});
  }

 private:
  const LineReader& lines_;
  const std::vector<std::string_view>& fields_;
};

void read_row(const Layout& layout, const LineReader& lines,
              const std::vector<std::string_view>& fields, Structure& structure) {
  const RowReader row(lines, fields);
  std::size_t column = 0;
  for (const Property& property : layout.properties) {
    const std::size_t first = property.first_field;
    if (property.role == Role::species) {
      structure.atoms.species.push_back(parse_species(fields[first], lines));
    } else if (property.role == Role::position) {
      structure.atoms.positions.push_back(row.vector(first));
    } else if (property.role == Role::column) {
      std::visit([&](auto& values) { row.append(values, first); },
                 structure.columns[column++].values);
    }
  }
}

std::int64_t read_count(LineReader& lines) {
  std::vector<std::string_view> fields;
  split_fields(lines.require("the number of atoms"), fields);
  if (fields.size() != 1) lines.fail("expected the number of atoms alone");
  return lines.integer(fields.front(), 0, std::numeric_limits<int>::max());
}

void check_room(const LineReader& lines, const Layout& layout, std::int64_t n_atoms) {
  // A field takes at least one character and one blank or line end; the last may lack it.
  const std::uint64_t shortest_row = 2 * layout.n_fields;
  if (static_cast<std::uint64_t>(n_atoms) * shortest_row <= lines.n_remaining() + 1) return;
  lines.fail("the file declares ", n_atoms, " atoms, but only ", lines.n_remaining(),
             " bytes follow; it is cut short or the count is wrong");
}

void read_rows(LineReader& lines, const Layout& layout, std::int64_t n_atoms,
               Structure& structure) {
  structure.columns = layout.columns;
  structure.atoms.positions.reserve(static_cast<std::size_t>(n_atoms));
  structure.atoms.species.reserve(static_cast<std::size_t>(n_atoms));
  std::vector<std::string_view> fields;
  for (std::int64_t i = 0; i < n_atoms; ++i) {
    split_fields(lines.require(concat("atom ", i + 1, " of ", n_atoms)), fields);
    const bool has_right_number =
        layout.may_have_more ? fields.size() >= layout.n_fields : fields.size() == layout.n_fields;
    if (!has_right_number) {
      lines.fail("expected ", layout.n_fields, " fields for an atom, found ", fields.size());
    }
    read_row(layout, lines, fields, structure);
  }
}

/// Everything in the header that is no part of the structure; numbers as numbers.
std::vector<HeaderEntry> other_entries(const std::vector<TextEntry>& header) {
  std::set<std::string> seen = {"Lattice", "Origin", "Properties", "pbc"};
  std::vector<HeaderEntry> entries;
  for (const TextEntry& entry : header) {
    if (!is_xyz_name(entry.key) || !seen.insert(entry.key).second) continue;
    if (const auto number = finite_number(entry.value)) {
      entries.push_back({entry.key, *number});
    } else {
      entries.push_back({entry.key, entry.value});
    }
  }
  return entries;
}

void note_what_follows(LineReader& lines, std::vector<std::string>& notes) {
  while (const auto line = lines.next()) {
    if (line->find_first_not_of(" \t") == std::string_view::npos) continue;
    notes.push_back("further structures follow the first and are not read");
    return;
  }
}

}  // namespace

StructureFile read_xyz(const std::filesystem::path& path) {
  const TextSource source = {.reader = "read_xyz", .path = path};
  const std::string text = read_text(source);
  LineReader lines(text, source);
  const std::int64_t n_atoms = read_count(lines);
  const std::string_view comment = lines.require("the comment line");

  // Plain XYZ has free text here, which may hold anything.
  const bool has_keys = comment.find("Properties=") != std::string_view::npos ||
                        comment.find("Lattice=") != std::string_view::npos;
  const auto header = has_keys ? parse_header(comment, lines) : std::vector<TextEntry>();
  const auto properties = find_entry(header, "Properties");
  Layout layout = parse_layout(properties.value_or("species:S:1:pos:R:3"), lines);
  layout.may_have_more = !properties;
  StructureFile file = {.structure = {.header = other_entries(header)}, .notes = layout.notes};
  file.structure.atoms.box = parse_box(header, lines);
  check_room(lines, layout, n_atoms);
  read_rows(lines, layout, n_atoms, file.structure);
  note_what_follows(lines, file.notes);
  return file;
}

}  // namespace trivalent::dual
