#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trivalent/dual/error.h"
#include "trivalent/formats/digits.h"

namespace trivalent::dual {

/// Where a text came from and who reads it, for messages.
struct TextSource {
  std::string reader;  ///< name of the public function
  std::filesystem::path path;
};

/// The whole content of a file, or of standard input if the path is "-"; gzip is unpacked and a
/// byte order mark removed on the way.
///
/// @throws FileError if the file is missing, unreadable, or packed to fill the memory: from 64 MB
///   on, it may not unpack to more than 200 times its size.
[[nodiscard]] std::string read_text(const TextSource& source);

[[nodiscard]] inline bool is_blank(std::string_view line) {
  return line.find_first_not_of(" \t") == line.npos;
}

/// A text line by line, and numbers out of its fields. Every complaint names file and line.
class LineReader {
 public:
  LineReader(std::string_view text, TextSource source);

  /// The next line without its end (\n, \r\n, or \r in a text without \n); none at the end of the
  /// text.
  [[nodiscard]] std::optional<std::string_view> next();
  /// The next line, which must exist; what says what it should hold.
  [[nodiscard]] std::string_view require(std::string_view what);
  /// Characters after the current line: a bound for everything still to come.
  [[nodiscard]] std::uint64_t n_remaining() const { return text_.size() - position_; }

  /// Reads a finite number.
  [[nodiscard]] double real(std::string_view field) const;
  /// The same, also with an exponent of Fortran: 1.5D-3.
  [[nodiscard]] double fortran_real(std::string_view field) const;
  /// Reads an integer from low to high.
  [[nodiscard]] std::int64_t integer(std::string_view field, std::int64_t low,
                                     std::int64_t high) const;

  [[nodiscard]] std::size_t line_number() const { return line_number_; }
  /// Complains about the current line, or an earlier one.
  template <typename... Parts>
  [[noreturn]] void fail(const Parts&... parts) const {
    fail_at(line_number_, parts...);
  }
  template <typename... Parts>
  [[noreturn]] void fail_at(std::size_t line_number, const Parts&... parts) const {
    throw FileError(concat(source_.reader, ": ", source_.path.string(), ", line ", line_number,
                           ": ", parts...));
  }

 private:
  std::string_view text_;
  TextSource source_;
  char line_end_;
  std::size_t position_ = 0;
  std::size_t line_number_ = 0;
};

/// Splits a line at blanks and tabs into fields (emptied first).
void split_fields(std::string_view line, std::vector<std::string_view>& fields);

/// The finite number that the text spells, if it spells one and nothing else.
[[nodiscard]] std::optional<double> finite_number(std::string_view text);

/// A piece of a file as it may appear in a message: short and printable.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// Appends numbers to a line that is being composed.
void append_real(std::string& line, double value, Digits digits);
void append_integer(std::string& line, std::int64_t value);

}  // namespace trivalent::dual
