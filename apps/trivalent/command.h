#pragma once

#include <span>
#include <string>
#include <string_view>

namespace trivalent::apps {

// Exit codes.
inline constexpr int done = 0;
inline constexpr int failed = 1;
inline constexpr int wrong_usage = 2;
inline constexpr int not_at_rest = 3;  // relax: the result is written

/// One subcommand of the program.
struct Command {
  std::string_view name;
  std::string_view synopsis;  ///< arguments in the usage line
  std::string_view meaning;   ///< one line for the list of subcommands
  /// Returns the exit code.
  int (*run)(const Command& self, std::span<const std::string> arguments);
};

extern const Command build_command;
extern const Command remesh_command;
extern const Command check_command;
extern const Command convert_command;
extern const Command dual_command;
extern const Command energy_command;
extern const Command lammps_command;
extern const Command relax_command;
extern const Command inspect_command;
extern const Command render_command;
extern const Command shape_command;
extern const Command view_command;

}  // namespace trivalent::apps
