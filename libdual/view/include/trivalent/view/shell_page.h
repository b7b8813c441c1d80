#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trivalent/remesh/mesh.h"
#include "trivalent/view/shell_state.h"
#include "trivalent/view/table_row.h"

namespace trivalent::dual {

/// Everything a page shows. Texts may hold anything; the page shows them as text.
struct ShellPage {
  std::string title;
  std::string program = {};             ///< who made it, as in "trivalent 0.1.0"
  std::vector<ShellState> states = {};  ///< at least one, in the order of their making
  std::vector<std::string> notes = {};  ///< what was found on the way
  std::vector<TableRow> parameters = {};
  std::vector<TableRow> results = {};
  /// Drawn as a ghost [Å], unless it has more than max_ghost_faces; the page says so then.
  std::optional<remesh::TriMesh> surface = {};
};

inline constexpr std::size_t max_ghost_faces = 200000;
/// Of a state with more atoms the page shows a sample, and says so.
inline constexpr std::size_t max_page_atoms = 1000000;

/// Writes a page that a browser opens from disk: the viewer with the data in it. Maps of one name
/// share the color scale of the last state that has one. Positions are rounded to 0.001 Å, values
/// to some 10,000th of their scale.
///
/// @param viewer  The page without data: HTML in which `<!--shell-data-->` stands for them.
///
/// @throws InvalidNetwork as check_state, or if there is no state.
/// @throws InvalidOption  if the viewer has no place for data.
void write_shell_page(std::ostream& out, const ShellPage& page, std::string_view viewer);

/// The same into a file, which appears whole or not at all.
///
/// @throws FileError if the file cannot be written.
void write_shell_page(const std::filesystem::path& path, const ShellPage& page,
                      std::string_view viewer);

}  // namespace trivalent::dual
