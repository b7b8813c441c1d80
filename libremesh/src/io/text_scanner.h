#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// Bytes of a file and its name for messages.
struct Source {
  std::string_view bytes;
  std::string name;
};

/// Number that fills the whole word, in any notation of C, or as Microsoft's library writes what is
/// no number (1.#IND); may be infinite or NaN.
[[nodiscard]] std::optional<double> parse_number(std::string_view word);
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view word);

/// The beginning of a word from a file, in quotes and without control characters, for messages.
[[nodiscard]] std::string in_quotes(std::string_view word);

/// Letters A to Z in lower case.
[[nodiscard]] std::string lower_case(std::string text);

/// Whether a backslash at the end of a line joins the next one to it.
enum class Continuation { none, backslash };

/// Reads words line by line. Lines end in LF, CRLF or CR; comments run from # to there, but 1.#IND
/// is a number.
class TextScanner {
 public:
  TextScanner(const Source& source, Continuation continuation)
      : source_(source), continuation_(continuation) {}

  /// Next word of this line; empty at its end.
  std::string_view word();
  /// The next word of this line, without consuming it.
  [[nodiscard]] std::string_view peek() const { return TextScanner(*this).word(); }
  /// Next word of this or a later line; empty at the end of the text.
  std::string_view word_across_lines();
  /// Moves to the next line that has a word; false at the end of the text.
  bool next_line();
  /// Skips what is left of the line; true if that held a word.
  bool skip_rest_of_line();

  /// The rest of this line, whatever it holds; moves to the next one.
  std::string_view raw_line();
  /// Skips lines up to and with the next one that is blank.
  void skip_to_blank_line();
  /// So many bytes from behind the end of this line, whatever they hold.
  /// @throws FileError if fewer are left.
  std::string_view bytes_after_line(std::size_t count);

  /// The next number or integer, from this or a later line; `what` names it in the message.
  double number(std::string_view what);
  std::int64_t integer(std::string_view what);
  /// Three finite coordinates of vertex `index`, counted from 0; messages count from `first`, as
  /// the format does.
  Eigen::Vector3d position(std::size_t index, std::size_t first = 0);

  [[nodiscard]] std::size_t bytes_left() const { return source_.bytes.size() - at_; }
  [[nodiscard]] std::size_t offset() const { return at_; }
  [[nodiscard]] std::size_t line() const { return line_; }
  [[noreturn]] void fail(std::string_view problem) const;

 private:
  [[nodiscard]] bool at_end() const { return at_ == source_.bytes.size(); }
  [[nodiscard]] bool at_continuation() const;
  /// Whether a comment begins here, within or behind the word that began there.
  [[nodiscard]] bool at_comment(std::size_t word_begin) const;
  void skip_blanks();
  void skip_line_end();
  [[noreturn]] void fail_on(std::string_view word, std::string_view what) const;

  const Source& source_;
  Continuation continuation_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  bool within_line_ = false;  ///< next_line() or a word has been taken from this line
};

}  // namespace trivalent::remesh
