#pragma once

#include "trivalent/shell/build.h"

namespace trivalent::shell {

/// Notes where the shell is not what was asked for.
void note_misses(const dual::ShellSize& size, BuildResult& result);

/// Notes open edges, self-intersections and wrong bonds.
void note_findings(BuildResult& result);

}  // namespace trivalent::shell
