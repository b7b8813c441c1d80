#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trivalent/dual/structure.h"
#include "trivalent/formats/text_file.h"

namespace trivalent::dual {

/// The comment line of extended XYZ as key=value: keys in any case, blanks around '=', values
/// bare, in quotes, or arrays in [] or {}. A bare word stands for true.
class XyzHeader {
 public:
  /// @throws FileError on anything else, on an array that is not closed, on a key of the structure
  ///   (Lattice, Origin, Properties, pbc) that comes twice, and on one that seems misspelled.
  XyzHeader(std::string_view line, const LineReader& lines);

  /// Whether a comment line has keys of the structure; in plain XYZ it is free text.
  [[nodiscard]] static bool has_keys(std::string_view line);
  /// Free text may hold anything, but no key that seems to be a misspelled one of the structure.
  ///
  /// @throws FileError
  static void check_free_text(std::string_view line, const LineReader& lines);

  /// The value of a key of the structure, given in lower case.
  [[nodiscard]] std::optional<std::string_view> find(std::string_view key) const;
  /// The box, periodic where pbc says so (with Lattice alone: everywhere).
  [[nodiscard]] potentials::Box box(const LineReader& lines) const;
  /// What is no part of the structure, numbers as numbers.
  [[nodiscard]] const std::vector<HeaderEntry>& others() const { return others_; }
  /// What was left out.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

 private:
  struct TextEntry {
    std::string key;
    std::string value;
  };
  static TextEntry take_entry(std::string_view& rest, const LineReader& lines);
  void add(TextEntry entry, const LineReader& lines);

  std::vector<TextEntry> structural_;  // keys in lower case
  std::vector<HeaderEntry> others_;
  std::vector<std::string> notes_;
};

}  // namespace trivalent::dual
