#pragma once

#include <optional>

#include "session.h"
#include "trivalent/shell/build_shell.h"

namespace trivalent::apps {

/// --atoms, --length, --scale and --bond, for shells to be made.
void add_shell_size_options(po::options_description& options);
/// At most one of --atoms, --length, --scale; the default number of atoms without any.
///
/// @throws UsageError if more than one is given.
[[nodiscard]] std::optional<dual::ShellSize> shell_size(const Session& session);

/// --length, --scale and --bond, for the dual of a mesh as it is.
void add_dual_size_options(po::options_description& options);
/// At most one of --length, --scale and --bond; none without any.
///
/// @throws UsageError if more than one is given.
[[nodiscard]] std::optional<dual::DualSize> dual_size(const Session& session);

}  // namespace trivalent::apps
