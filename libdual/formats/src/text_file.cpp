#include "trivalent/formats/text_file.h"

#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <memory>

namespace trivalent::dual {
namespace {

constexpr std::string_view blanks = " \t\v\f\r";
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // of UTF-8

// No large structure packs better than this; what does is made to fill the memory.
constexpr std::size_t best_compression = 200;
constexpr std::size_t surely_harmless = std::size_t{64} << 20;

bool is_bomb(std::size_t unpacked, gzFile file) {
  return gzdirect(file) == 0 && unpacked > surely_harmless &&
         unpacked / best_compression > static_cast<std::size_t>(gzoffset(file));
}

// std::from_chars knows no leading plus.
std::string_view without_plus(std::string_view field) {
  const bool has_plus = field.size() > 1 && field[0] == '+' && field[1] != '-';
  return has_plus ? field.substr(1) : field;
}

}  // namespace

std::string read_text(const TextSource& source) {
  const bool is_standard_input = source.path == "-";
  const std::string name = is_standard_input ? "standard input" : source.path.string();
  const auto fail = [&](const std::string& reason) {
    throw FileError(concat(source.reader, ": cannot read ", name, ": ", reason));
  };
  errno = 0;
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(
      is_standard_input ? gzdopen(dup(STDIN_FILENO), "rb") : gzopen(name.c_str(), "rb"), gzclose);
  if (!file) fail(errno != 0 ? std::strerror(errno) : "out of memory");
  std::string text;
  std::vector<char> block(std::size_t{1} << 16);
  while (true) {
    errno = 0;
    const int n_read = gzread(file.get(), block.data(), static_cast<unsigned>(block.size()));
    if (n_read > 0) text.append(block.data(), static_cast<std::size_t>(n_read));
    if (is_bomb(text.size(), file.get()))
      fail(concat("it unpacks to more than ", best_compression, " times its size"));
    if (n_read == static_cast<int>(block.size())) continue;
    int code = Z_OK;
    const char* message = gzerror(file.get(), &code);
    if (code == Z_ERRNO) fail(std::strerror(errno));
    if (code != Z_OK && code != Z_STREAM_END) fail(message);
    if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
    return text;
  }
}

LineReader::LineReader(std::string_view text, TextSource source)
    : text_(text),
      source_(std::move(source)),
      line_end_(text.find('\n') == std::string_view::npos ? '\r' : '\n') {}

std::optional<std::string_view> LineReader::next() {
  if (position_ >= text_.size()) return std::nullopt;
  const std::size_t end = std::min(text_.find(line_end_, position_), text_.size());
  std::string_view line = text_.substr(position_, end - position_);
  if (line.ends_with('\r')) line.remove_suffix(1);
  position_ = std::min(end + 1, text_.size());
  ++line_number_;
  return line;
}

std::string_view LineReader::require(std::string_view what) {
  const auto line = next();
  if (!line) fail("the file ends here; expected ", what);
  return *line;
}

double LineReader::real(std::string_view field) const {
  const auto value = finite_number(field);
  if (!value) fail(in_quotes(field), " is not a finite number");
  return *value;
}

double LineReader::fortran_real(std::string_view field) const {
  const std::size_t exponent = field.find_first_of("dD");
  if (exponent == std::string_view::npos) return real(field);
  std::string number(field);
  number[exponent] = 'e';
  if (const auto value = finite_number(number)) return *value;
  return real(field);  // which complains
}

std::int64_t LineReader::integer(std::string_view field, std::int64_t low,
                                 std::int64_t high) const {
  const std::string_view digits = without_plus(field);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size() || value < low || value > high) {
    fail(in_quotes(field), " is not an integer from ", low, " to ", high);
  }
  return value;
}

void split_fields(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  std::size_t begin = line.find_first_not_of(blanks);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
    fields.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(blanks, end);
  }
}

std::optional<double> finite_number(std::string_view text) {
  const std::string_view digits = without_plus(text);
  const char* const end = digits.data() + digits.size();
  double value = 0.0;
  const auto [parsed, error] = std::from_chars(digits.data(), end, value);
  const bool is_number = error == std::errc{} && parsed == end && std::isfinite(value);
  return is_number ? std::optional(value) : std::nullopt;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string result = "'";
  for (const char character : text.substr(0, longest)) {
    const bool is_printable = std::isprint(static_cast<unsigned char>(character)) != 0;
    result += is_printable ? character : '?';
  }
  result += text.size() > longest ? "...'" : "'";
  return result;
}

void append_real(std::string& line, double value, Digits digits) {
  // The largest double has 309 digits before its decimal point.
  std::array<char, 512> buffer = {};
  char* const end = buffer.data() + buffer.size();
  const auto result =
      digits == Digits::ten_decimals
          ? std::to_chars(buffer.data(), end, value, std::chars_format::fixed, 10)
          : std::to_chars(buffer.data(), end, value, std::chars_format::general, 17);
  line.append(buffer.data(), result.ptr);
}

void append_integer(std::string& line, std::int64_t value) { line += std::to_string(value); }

}  // namespace trivalent::dual
