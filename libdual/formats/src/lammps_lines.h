#pragma once

#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include "trivalent/formats/text_file.h"

namespace trivalent::dual {

/// Lines of a LAMMPS data file, without comments and empty lines.
class LammpsLines {
 public:
  LammpsLines(std::string_view text, const TextSource& source) : lines_(text, source) {}

  /// Reads the next line that holds anything; false at the end of the file.
  bool advance();
  /// The first line, which LAMMPS never looks at.
  [[nodiscard]] std::string_view title() { return lines_.require("a title"); }
  [[nodiscard]] const std::vector<std::string_view>& fields() const { return fields_; }
  /// Fields from the given one on, with one blank between them.
  [[nodiscard]] std::string words_from(std::size_t first) const;
  /// What follows '#' on the line.
  [[nodiscard]] std::string_view comment() const { return comment_; }
  [[nodiscard]] const LineReader& reader() const { return lines_; }
  /// Whether the line begins a section; rows of a section may begin with a type label.
  [[nodiscard]] bool is_section_name() const;
  /// Whether the line begins with a letter: no row of numbers.
  [[nodiscard]] bool begins_with_letter() const {
    return std::isalpha(static_cast<unsigned char>(fields_.front().front())) != 0;
  }

 private:
  LineReader lines_;
  std::vector<std::string_view> fields_;
  std::string_view comment_;
};

}  // namespace trivalent::dual
