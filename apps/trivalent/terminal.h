#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "trivalent/remesh/remesh.h"
#include "trivalent/shell/json.h"
#include "trivalent/view/table_row.h"

namespace trivalent::apps {

enum class Remarks { all, none };
enum class ResultKind { table, json };

using dual::TableRow;
using shell::Json;

/// A result in both forms.
struct Result {
  std::vector<TableRow> table;
  Json json;
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

}  // namespace trivalent::apps
