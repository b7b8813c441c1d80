#pragma once

#include <string>

#include "session.h"
#include "trivalent/shell/build.h"
#include "trivalent/shell/build_files.h"
#include "trivalent/shell/surface_source.h"

namespace trivalent::apps {

[[nodiscard]] Grammar grammar_of_build();

/// What the command line of build says.
struct BuildRequest {
  std::string shape;
  remesh::RepairOptions repair;
  shell::CellOptions cell;
  shell::BuildOptions build;
  shell::BuildFileOptions files;
};

/// @throws UsageError if the options make no sense.
[[nodiscard]] BuildRequest build_request(const Session& session);

}  // namespace trivalent::apps
