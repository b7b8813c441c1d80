#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "trivalent/remesh/remesh.h"

namespace trivalent::apps {

enum class Remarks { all, none };
enum class ResultKind { table, json };

/// A line of a result as people read it; without a value it is a heading.
struct TableRow {
  std::string name;
  std::string value = {};
};

/// A result in both forms.
struct Result {
  std::vector<TableRow> table;
  nlohmann::ordered_json json;
};

/// Where the program talks: results to standard output, all else to standard error.
class Terminal {
 public:
  Terminal(Remarks remarks, ResultKind result_kind)
      : remarks_(remarks), result_kind_(result_kind) {}

  /// One sentence about what happens or was found.
  void note(std::string_view sentence) const;
  void notes(const std::vector<std::string>& sentences) const;
  /// A bar that grows in place on a terminal; elsewhere a line per iteration.
  void progress(const remesh::RemeshProgress& state) const;
  /// A line that the next one replaces on a terminal.
  void progress(const std::string& line) const;
  void print(const Result& result) const;

 private:
  Remarks remarks_;
  ResultKind result_kind_;
};

/// JSON text with an end of line; characters that are not UTF-8 (in file names) are replaced.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& json);

/// Numbers as people read them: fixed decimals, a percentage, or a few significant digits.
[[nodiscard]] std::string decimals(double value, int n_decimals);
[[nodiscard]] std::string percent(double fraction);
[[nodiscard]] std::string significant(double value, int n_digits = 4);

}  // namespace trivalent::apps
