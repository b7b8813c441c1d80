#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports.h"
#include "trivalent/remesh/mesh_components.h"
#include "trivalent/shell/build_shell.h"

namespace trivalent::apps {

/// What a build will come to, known before its work starts.
struct BuildPlan {
  dual::ShellEstimate shell;
  double memory = 0.0;                ///< about so much at its peak [bytes]
  std::optional<double> free_memory;  ///< [bytes], if known
  double seconds = 0.0;               ///< about so long, with all processors
  int components = 0;
  /// Why the build cannot succeed, each with a way out; empty if nothing is known to stand against
  /// it.
  std::vector<std::string> obstacles;
};

/// @throws dual::InvalidOption, dual::InvalidNetwork as estimate_shell.
[[nodiscard]] BuildPlan plan_build(const remesh::TriMesh& mesh, const dual::ShellOptions& options);
/// The same, if the components of the mesh are known already.
[[nodiscard]] BuildPlan plan_build(const remesh::TriMesh& mesh,
                                   const remesh::MeshComponents& components,
                                   const dual::ShellOptions& options);

[[nodiscard]] Json plan_json(const BuildPlan& plan);
[[nodiscard]] std::vector<TableRow> plan_rows(const BuildPlan& plan);

}  // namespace trivalent::apps
