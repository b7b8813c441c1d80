#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trivalent/remesh/mesh_components.h"
#include "trivalent/shell/build_shell.h"
#include "trivalent/shell/json.h"
#include "trivalent/view/table_row.h"

namespace trivalent::shell {

/// What a build will come to, known before its work starts.
struct Plan {
  dual::ShellEstimate shell;
  double memory = 0.0;                ///< about so much at its peak [bytes]
  std::optional<double> free_memory;  ///< [bytes], if known
  double seconds = 0.0;               ///< about so much processor time, relaxation included
  int components = 0;
  /// Why the build cannot succeed, each with a way out; empty if nothing is known to prevent it.
  std::vector<std::string> obstacles = {};

  /// Refuses a build that cannot succeed.
  ///
  /// @throws remesh::InvalidMesh with the first obstacle.
  void require_feasible() const;

  [[nodiscard]] Json json() const;
  [[nodiscard]] std::vector<dual::TableRow> rows() const;
};

/// Estimates atoms, memory and time of a build, and finds what is known to prevent it.
///
/// @throws dual::InvalidOption, dual::InvalidNetwork as estimate_shell.
[[nodiscard]] Plan plan(const remesh::TriMesh& mesh, const dual::ShellOptions& options);
/// The same, if the components of the mesh are known already.
[[nodiscard]] Plan plan(const remesh::TriMesh& mesh, const remesh::MeshComponents& components,
                        const dual::ShellOptions& options);

}  // namespace trivalent::shell
