#include "columns_of_text.h"

#include <array>
#include <charconv>

#include "trivalent/formats/elements.h"
#include "trivalent/formats/text_file.h"

namespace trivalent::dual {

void append_vector(std::string& line, const Eigen::Vector3d& vector, Digits digits) {
  for (const double component : vector) {
    line += ' ';
    append_real(line, component, digits);
  }
}

void append_right(std::string& line, std::string_view word, std::size_t width) {
  if (word.size() < width) line.append(width - word.size(), ' ');
  line += word;
}

void append_fixed(std::string& line, double value, int decimals, std::size_t width) {
  std::array<char, 400> digits = {};  // the largest double has 309 before the point
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                          std::chars_format::fixed, decimals);
  append_right(line, {digits.data(), end}, width);
}

std::optional<potentials::Species> element_of_name(std::string_view name) {
  const std::string start = lower_case(name.substr(0, 2));
  if (start == "cl" || start == "cu" || start == "he" || start == "hg") return std::nullopt;
  return element_of_symbol(name.substr(0, 1));
}

std::string_view columns_of(std::string_view line, std::size_t begin, std::size_t end) {
  if (begin >= line.size()) return {};
  line = line.substr(begin, end - begin);
  const std::size_t first = line.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return line.substr(first, line.find_last_not_of(" \t") - first + 1);
}

}  // namespace trivalent::dual
