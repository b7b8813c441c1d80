#include "lammps_types.h"

#include <algorithm>
#include <charconv>

namespace trivalent::dual {
namespace {

/// A word that names an element must name the one of the mass.
void check_symbol(std::string_view word, double mass, const LineReader& reader) {
  if (!is_element_symbol(word)) return;
  const auto named = element_of_symbol(word);
  if (named.has_value() && named == element_of_mass(mass)) return;
  if (!named.has_value() && !element_of_mass(mass)) return;
  reader.fail("the mass ", mass, " is not that of ", word, ", which the line or its label names");
}

}  // namespace

std::optional<int> LammpsTypes::find(std::string_view text) const {
  if (const auto label = labels_.find(text); label != labels_.end()) return label->second;
  int type = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), type);
  const bool is_number = error == std::errc{} && end == text.data() + text.size();
  return is_number && type >= 1 && type <= n_types_ ? std::optional(type) : std::nullopt;
}

void LammpsTypes::read_label(const LammpsLines& lines) {
  const auto& fields = lines.fields();
  if (fields.size() != 2) lines.reader().fail("expected type and label");
  const auto type = static_cast<int>(lines.reader().integer(fields[0], 1, n_types_));
  if (!lines.begins_with_letter() && fields[1].find_first_of("0123456789#*") == 0) {
    lines.reader().fail("a label begins with a letter, not as ", in_quotes(fields[1]));
  }
  if (!labels_.emplace(std::string(fields[1]), type).second) {
    lines.reader().fail("label ", in_quotes(fields[1]), " appears a second time");
  }
}

void LammpsTypes::read_mass(const LammpsLines& lines) {
  const auto& fields = lines.fields();
  const LineReader& reader = lines.reader();
  if (fields.size() != 2) reader.fail("expected type and mass");
  const auto type = find(fields[0]);
  if (!type) reader.fail("there is no type ", in_quotes(fields[0]), " among ", n_types_);
  const double mass = reader.real(fields[1]);
  if (!(mass > 0.0)) reader.fail("a mass must be > 0");
  if (!masses_.emplace(*type, mass).second) {
    reader.fail("type ", in_quotes(fields[0]), " has a second mass");
  }
  std::vector<std::string_view> words;
  split_fields(lines.comment(), words);
  if (!words.empty()) check_symbol(words.front(), mass, reader);
  for (const auto& [label, labeled] : labels_) {
    if (labeled == *type) check_symbol(label, mass, reader);
  }
}

std::optional<potentials::Species> LammpsTypes::element(int type) const {
  if (!elements_.empty()) {
    const auto index = static_cast<std::size_t>(type - 1);
    return index < elements_.size() ? std::optional(elements_[index]) : std::nullopt;
  }
  if (const auto mass = masses_.find(type); mass != masses_.end()) {
    return element_of_mass(mass->second);
  }
  for (const auto& [label, labeled] : labels_) {
    if (labeled == type && is_element_symbol(label)) return element_of_symbol(label);
  }
  if (n_types_ == 1) return potentials::Species::carbon;
  return std::nullopt;
}

std::vector<std::string> LammpsTypes::notes() const {
  std::vector<std::string> notes;
  for (int type = 1; type <= n_types_ && elements_.empty(); ++type) {
    const auto mass = masses_.find(type);
    const auto found = element(type);
    if (mass != masses_.end() && !found) {
      notes.push_back(concat("type ", type, " of mass ", mass->second, " is neither C nor H"));
    } else if (mass == masses_.end() && found) {
      notes.push_back(concat("type ", type, " has no mass; it is taken as ", symbol_of(*found),
                             " (--elements names another)"));
    }
  }
  return notes;
}

}  // namespace trivalent::dual
