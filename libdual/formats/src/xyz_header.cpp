#include "xyz_header.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <numeric>

#include "trivalent/formats/elements.h"
#include "xyz_names.h"

namespace trivalent::dual {
namespace {

constexpr std::string_view spaces_and_tabs = " \t";
constexpr std::array<std::string_view, 4> structural_keys = {"lattice", "origin", "properties",
                                                             "pbc"};

// What programs and people call the cell elsewhere.
constexpr std::array<std::string_view, 6> cell_names = {
    "cell", "unit_cell", "cell_vectors", "unitcell", "lattice_vectors", "lattice_vector"};

/// Number of letters to insert, remove or exchange to get from one word to another [Levenshtein].
std::size_t distance_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (const char letter : a) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t exchanged = diagonal + (letter == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({exchanged, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

bool is_key_end(char c) { return c == ' ' || c == '\t' || c == '"'; }

void skip_blanks(std::string_view& rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(spaces_and_tabs), rest.size()));
}

/// Takes the characters up to the closing mark off the line, with backslash escapes undone.
std::string take_quoted(std::string_view& rest, const LineReader& lines) {
  std::string value;
  const char mark = rest.front();
  for (std::size_t i = 1; i < rest.size(); ++i) {
    if (rest[i] == mark) {
      rest.remove_prefix(i + 1);
      return value;
    }
    if (rest[i] == '\\' && i + 1 < rest.size()) ++i;
    value += rest[i];
  }
  lines.fail("no closing ", mark, " after ", in_quotes(rest));
}

/// Takes an array with its brackets off the line, nested ones included.
std::string take_array(std::string_view& rest, const LineReader& lines) {
  std::string closing;  // brackets that are still to come, innermost last
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (rest[i] == '[') closing += ']';
    if (rest[i] == '{') closing += '}';
    if (rest[i] != ']' && rest[i] != '}') continue;
    if (rest[i] != closing.back()) break;
    closing.pop_back();
    if (!closing.empty()) continue;
    std::string value(rest.substr(0, i + 1));
    rest.remove_prefix(i + 1);
    // The older form: {1 2 3} is what "1 2 3" is.
    return value.front() == '{' ? value.substr(1, value.size() - 2) : value;
  }
  lines.fail("no closing ", rest.front() == '[' ? ']' : '}', " after ", in_quotes(rest));
}

std::string take_value(std::string_view& rest, const LineReader& lines) {
  const char first = rest.empty() ? ' ' : rest.front();
  if (first == '"' || first == '\'') return take_quoted(rest, lines);
  if (first == '[' || first == '{') return take_array(rest, lines);
  const std::size_t end = std::min(rest.find_first_of(spaces_and_tabs), rest.size());
  std::string value(rest.substr(0, end));
  rest.remove_prefix(end);
  return value;
}

/// The elements of an array: separated by blanks or commas, whatever the brackets.
std::vector<std::string> elements_of(std::string_view text) {
  std::string plain(text);
  std::replace_if(
      plain.begin(), plain.end(),
      [](char c) { return c == '[' || c == ']' || c == '{' || c == '}' || c == ','; }, ' ');
  std::vector<std::string_view> fields;
  split_fields(plain, fields);
  return {fields.begin(), fields.end()};
}

std::vector<double> reals(std::string_view key, std::string_view text, std::size_t count,
                          const LineReader& lines) {
  const std::vector<std::string> fields = elements_of(text);
  if (fields.size() != count) {
    lines.fail(key, ": expected ", count, " numbers, found ", in_quotes(text));
  }
  std::vector<double> values;
  for (const std::string& field : fields) values.push_back(lines.fortran_real(field));
  return values;
}

std::array<bool, 3> parse_periodic(std::string_view text, const LineReader& lines) {
  const std::vector<std::string> fields = elements_of(text);
  std::array<bool, 3> periodic = {};
  for (std::size_t i = 0; i < 3 && fields.size() == 3; ++i) {
    const std::string word = lower_case(fields[i]);
    const bool is_true = word == "t" || word == "true" || word == "1";
    const bool is_false = word == "f" || word == "false" || word == "0";
    if (!is_true && !is_false) lines.fail("pbc needs three of T and F, found ", in_quotes(text));
    periodic[i] = is_true;
  }
  if (fields.size() != 3) lines.fail("pbc needs three of T and F, found ", in_quotes(text));
  return periodic;
}

/// The words in front of the signs '=', in lower case.
std::vector<std::string> keys_in(std::string_view line) {
  std::vector<std::string> keys;
  for (std::size_t at = line.find('='); at != std::string_view::npos; at = line.find('=', at + 1)) {
    std::string_view before = line.substr(0, at);
    while (!before.empty() && is_key_end(before.back())) before.remove_suffix(1);
    const std::size_t begin = before.find_last_of(" \t\"'=,");
    keys.push_back(lower_case(begin == std::string_view::npos ? before : before.substr(begin + 1)));
  }
  return keys;
}

/// Refuses a key that seems to be one of the structure, unless that is there too.
void check_spelling(const std::string& key, const std::vector<std::string>& keys,
                    const LineReader& lines) {
  const auto has = [&](std::string_view known) {
    return std::ranges::find(keys, known) != keys.end();
  };
  if (!has("lattice") && std::ranges::find(cell_names, key) != cell_names.end()) {
    lines.fail("key ", in_quotes(key), " is not known; the key of the cell is Lattice");
  }
  for (const std::string_view known : structural_keys) {
    // One letter in four may be wrong: "original" is not "origin".
    const std::size_t max_distance = known.size() / 4;
    if (has(known) || distance_between(key, known) > max_distance) continue;
    lines.fail("key ", in_quotes(key), " is not known; is ", known, " meant?");
  }
}

}  // namespace

bool XyzHeader::has_keys(std::string_view line) {
  return std::ranges::any_of(keys_in(line), [](const std::string& key) {
    return std::ranges::find(structural_keys, key) != structural_keys.end();
  });
}

void XyzHeader::check_free_text(std::string_view line, const LineReader& lines) {
  const std::vector<std::string> keys = keys_in(line);
  for (const std::string& key : keys) check_spelling(key, keys, lines);
}

XyzHeader::XyzHeader(std::string_view line, const LineReader& lines) {
  std::string_view rest = line;
  while (true) {
    skip_blanks(rest);
    if (rest.empty()) break;
    add(take_entry(rest, lines), lines);
    if (!rest.empty() && spaces_and_tabs.find(rest.front()) == std::string_view::npos) {
      lines.fail("expected a blank before ", in_quotes(rest));
    }
  }
  std::vector<std::string> keys;
  for (const TextEntry& entry : structural_) keys.push_back(entry.key);
  for (const HeaderEntry& other : others_) keys.push_back(lower_case(other.key));
  for (const std::string& key : keys) check_spelling(key, keys, lines);
}

XyzHeader::TextEntry XyzHeader::take_entry(std::string_view& rest, const LineReader& lines) {
  TextEntry entry = {.key = {}, .value = "T"};
  if (rest.front() == '=') lines.fail("no key before ", in_quotes(rest));
  if (rest.front() == '"') {
    entry.key = take_quoted(rest, lines);
  } else {
    const std::size_t end = std::min(rest.find_first_of("= \t"), rest.size());
    entry.key = std::string(rest.substr(0, end));
    rest.remove_prefix(end);
  }
  std::string_view after = rest;
  skip_blanks(after);
  if (!after.starts_with('=')) return entry;
  after.remove_prefix(1);
  const bool has_blank =
      !after.empty() && spaces_and_tabs.find(after.front()) != std::string_view::npos;
  skip_blanks(after);
  rest = after;
  const bool is_bare = !rest.empty() && std::string_view("\"'[{").find(rest.front()) > 3;
  entry.value = take_value(rest, lines);
  const bool is_missing = entry.value.empty() && (is_bare || after.empty());
  if (is_missing || (is_bare && has_blank && entry.value.find('=') != std::string::npos)) {
    lines.fail("key ", in_quotes(entry.key), " has no value before ", in_quotes(after));
  }
  return entry;
}

void XyzHeader::add(TextEntry entry, const LineReader& lines) {
  const std::string lower = lower_case(entry.key);
  if (std::ranges::find(structural_keys, lower) != structural_keys.end()) {
    if (find(lower)) lines.fail("key ", in_quotes(entry.key), " appears a second time");
    structural_.push_back({lower, std::move(entry.value)});
    return;
  }
  const bool is_taken = std::ranges::any_of(
      others_, [&](const HeaderEntry& other) { return other.key == entry.key; });
  if (!is_xyz_name(entry.key) || is_taken) {
    notes_.push_back(concat("key ", in_quotes(entry.key), " is not kept: it ",
                            is_taken ? "appears a second time" : "is not a name"));
  } else if (const auto number = finite_number(entry.value)) {
    others_.push_back({std::move(entry.key), *number});
  } else {
    others_.push_back({std::move(entry.key), std::move(entry.value)});
  }
}

std::optional<std::string_view> XyzHeader::find(std::string_view key) const {
  for (const TextEntry& entry : structural_) {
    if (entry.key == key) return entry.value;
  }
  return std::nullopt;
}

potentials::Box XyzHeader::box(const LineReader& lines) const {
  potentials::Box box;
  const auto lattice = find("lattice");
  if (lattice) {
    const std::vector<double> numbers = reals("Lattice", *lattice, 9, lines);
    box.cell = Eigen::Map<const Eigen::Matrix3d>(numbers.data());
    box.periodic = {true, true, true};
  }
  if (const auto origin = find("origin")) {
    box.origin = Eigen::Map<const Eigen::Vector3d>(reals("Origin", *origin, 3, lines).data());
  }
  if (const auto periodic = find("pbc")) box.periodic = parse_periodic(*periodic, lines);
  if (!lattice && box.is_periodic()) lines.fail("pbc says periodic, but there is no Lattice");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!box.periodic[axis] || box.cell.col(static_cast<int>(axis)).norm() > 0.0) continue;
    lines.fail("pbc says periodic along a cell vector of Lattice that is zero");
  }
  return box;
}

}  // namespace trivalent::dual
