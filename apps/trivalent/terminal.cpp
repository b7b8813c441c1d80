#include "terminal.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <sstream>

#include "trivalent/shell/number_text.h"

namespace trivalent::apps {
namespace {

using shell::percent;
using shell::significant;

constexpr std::string_view clear_line = "\r\x1b[K";

bool is_terminal() { return isatty(STDERR_FILENO) == 1; }

std::string bar(const remesh::RemeshProgress& state) {
  constexpr int width = 24;
  const int filled = state.iterations > 0 ? width * state.iteration / state.iterations : width;
  const auto n_filled = static_cast<std::size_t>(std::clamp(filled, 0, width));
  return '[' + std::string(n_filled, '#') + std::string(width - n_filled, '.') + ']';
}

std::string state_line(const remesh::RemeshProgress& state) {
  std::ostringstream line;
  line << "remeshing " << state.iteration << '/' << state.iterations << ": " << state.vertices
       << " vertices, mean edge " << significant(state.mean_edge_length) << ", CV "
       << percent(state.relative_spread) << ", valence 6 " << percent(state.regular_fraction);
  return line.str();
}

/// Characters, not bytes: all but the continuation bytes of UTF-8.
std::size_t display_width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

}  // namespace

void Terminal::note(std::string_view sentence) const {
  if (remarks_ == Remarks::none) return;
  std::cerr << sentence << '\n';
}

void Terminal::notes(const std::vector<std::string>& sentences) const {
  for (const std::string& sentence : sentences) note("note: " + sentence);
}

void Terminal::progress(const remesh::RemeshProgress& state) const {
  if (remarks_ == Remarks::none) return;
  if (!is_terminal()) {
    std::cerr << state_line(state) << '\n';
    return;
  }
  const bool is_last = state.iteration >= state.iterations;
  std::cerr << clear_line << bar(state) << ' ' << state_line(state) << (is_last ? "\n" : "")
            << std::flush;
}

void Terminal::progress(const std::string& line) const {
  if (remarks_ == Remarks::none) return;
  std::cerr << (is_terminal() ? clear_line : "") << line << (is_terminal() ? "" : "\n")
            << std::flush;
}

void Terminal::print(const Result& result) const {
  if (result_kind_ == ResultKind::json) {
    std::cout << shell::json_text(result.json);
    return;
  }
  std::size_t width = 0;
  for (const TableRow& row : result.table) width = std::max(width, display_width(row.name));
  for (const TableRow& row : result.table) {
    if (row.value.empty()) {
      std::cout << row.name << '\n';
      continue;
    }
    const std::string filler(width + 2 - display_width(row.name), ' ');
    std::cout << "  " << row.name << filler << row.value << '\n';
  }
}

}  // namespace trivalent::apps
