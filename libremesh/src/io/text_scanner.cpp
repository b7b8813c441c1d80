#include "io/text_scanner.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <system_error>

#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

bool is_line_end(char c) { return c == '\n' || c == '\r'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

/// What Microsoft's library writes for numbers that are none, such as -1.#IND00.
std::optional<double> parse_not_finite(std::string_view word) {
  const bool is_negative = word.starts_with('-');
  if (is_negative) word.remove_prefix(1);
  if (!word.starts_with("1.#")) return std::nullopt;
  if (word.substr(3, 3) != "INF") return std::numeric_limits<double>::quiet_NaN();
  return is_negative ? -std::numeric_limits<double>::infinity()
                     : std::numeric_limits<double>::infinity();
}

/// std::from_chars takes no plus sign.
std::string_view without_plus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return word;
}

}  // namespace

std::optional<double> parse_number(std::string_view word) {
  word = without_plus(word);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || end != word.data() + word.size()) return parse_not_finite(word);
  // Too small or too large for a double: strtod tells which, by 0 or infinity.
  if (error == std::errc::result_out_of_range)
    return std::strtod(std::string(word).c_str(), nullptr);
  if (error != std::errc()) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
  word = without_plus(word);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

void TextScanner::skip_line_end() {
  const bool is_pair = source_.bytes.substr(at_, 2) == "\r\n";
  at_ += is_pair ? 2 : 1;
  ++line_;
  within_line_ = false;
}

std::string in_quotes(std::string_view word) {
  constexpr std::size_t longest_shown = 40;
  std::string shown(word.substr(0, longest_shown));
  for (char& c : shown) {
    // What a terminal might obey.
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) c = '?';
  }
  return '\'' + shown + (word.size() > longest_shown ? "...'" : "'");
}

std::string lower_case(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

bool TextScanner::at_comment(std::size_t word_begin) const {
  if (source_.bytes[at_] != '#') return false;
  const std::string_view word = source_.bytes.substr(word_begin, at_ - word_begin);
  return word != "1." && word != "-1." && word != "+1.";
}

bool TextScanner::at_continuation() const {
  return continuation_ == Continuation::backslash && source_.bytes[at_] == '\\' &&
         at_ + 1 < source_.bytes.size() && is_line_end(source_.bytes[at_ + 1]);
}

void TextScanner::skip_blanks() {
  const std::string_view bytes = source_.bytes;
  while (!at_end()) {
    if (is_blank(bytes[at_])) {
      ++at_;
    } else if (bytes[at_] == '#') {
      while (!at_end() && !is_line_end(bytes[at_])) ++at_;
    } else if (at_continuation()) {
      ++at_;
      skip_line_end();
    } else {
      return;
    }
  }
}

std::string_view TextScanner::word() {
  skip_blanks();
  const std::string_view bytes = source_.bytes;
  const std::size_t begin = at_;
  while (!at_end() && !is_blank(bytes[at_]) && !is_line_end(bytes[at_]) && !at_comment(begin) &&
         !at_continuation()) {
    ++at_;
  }
  within_line_ = within_line_ || at_ > begin;
  return bytes.substr(begin, at_ - begin);
}

std::string_view TextScanner::raw_line() {
  const std::size_t begin = at_;
  while (!at_end() && !is_line_end(source_.bytes[at_])) ++at_;
  const std::string_view line = source_.bytes.substr(begin, at_ - begin);
  if (!at_end()) skip_line_end();
  return line;
}

void TextScanner::skip_to_blank_line() {
  (void)raw_line();
  while (!at_end() && raw_line().find_first_not_of(" \t") != std::string_view::npos) {
  }
}

std::string_view TextScanner::bytes_after_line(std::size_t count) {
  (void)raw_line();
  if (count > bytes_left()) {
    fail(concat("declares ", count, " bytes, more than the ", bytes_left(),
                " that are left; is it cut short?"));
  }
  const std::string_view bytes = source_.bytes.substr(at_, count);
  at_ += count;
  return bytes;
}

bool TextScanner::next_line() {
  if (within_line_) skip_rest_of_line();
  for (;;) {
    skip_blanks();
    if (at_end()) return false;
    if (!is_line_end(source_.bytes[at_])) break;
    skip_line_end();
  }
  within_line_ = true;
  return true;
}

std::string_view TextScanner::word_across_lines() {
  for (;;) {
    const std::string_view found = word();
    if (!found.empty() || at_end()) return found;
    skip_line_end();
  }
}

bool TextScanner::skip_rest_of_line() {
  bool held_word = false;
  while (!word().empty()) held_word = true;
  return held_word;
}

double TextScanner::number(std::string_view what) {
  const std::string_view next = word_across_lines();
  const auto value = parse_number(next);
  if (!value) fail_on(next, what);
  return *value;
}

std::int64_t TextScanner::integer(std::string_view what) {
  const std::string_view next = word_across_lines();
  const auto value = parse_integer(next);
  if (!value) fail_on(next, what);
  return *value;
}

Eigen::Vector3d TextScanner::position(std::size_t index, std::size_t first) {
  Eigen::Vector3d p;
  for (double& x : p) x = number("a coordinate");
  if (p.allFinite()) return p;
  fail(concat("vertex ", index + first, " (counted from ", first,
              ") has a coordinate that is not a finite number"));
}

void TextScanner::fail(std::string_view problem) const {
  throw FileError(concat("read_mesh: ", source_.name, ": line ", line_, ": ", problem));
}

void TextScanner::fail_on(std::string_view word, std::string_view what) const {
  if (word.empty()) fail(concat("the file ends where ", what, " should stand; is it cut short?"));
  fail(concat(in_quotes(word), " stands where ", what, " should"));
}

}  // namespace trivalent::remesh
