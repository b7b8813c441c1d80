#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trivalent/remesh/mesh_components.h"
#include "trivalent/remesh/mesh_diagnosis.h"
#include "trivalent/remesh/mesh_quality.h"
#include "trivalent/remesh/mesh_repair.h"
#include "trivalent/remesh/surface_shape.h"
#include "trivalent/shell/plan.h"
#include "trivalent/shell/surface_source.h"

namespace trivalent::shell {

/// What can be made of a file.
enum class Verdict {
  sound,     ///< it is a surface as it is
  mendable,  ///< it becomes one by repair
  hopeless   ///< nothing can be built on it
};

[[nodiscard]] std::string_view name_of(Verdict verdict);

/// Edges between faces that meet at a larger angle [degree] are counted as sharp.
inline constexpr double inspected_feature_angle = 40.0;

struct InspectOptions {
  dual::ShellOptions shell = {};      ///< the planned shell
  remesh::RepairOptions repair = {};  ///< the planned repair; its edge_length_on is set by inspect
  CellOptions cell = {};              ///< of which the file shows one
};

/// Everything known about a file with a surface; lengths in its own unit.
struct Inspection {
  Verdict verdict = Verdict::hopeless;
  std::string reason = {};  ///< for the verdict, with a way out
  bool is_read = false;     ///< else nothing below is known
  std::vector<std::string> reading_notes = {};
  remesh::MeshDiagnosis diagnosis = {};  ///< includes crossing faces
  remesh::BoundingBox box = {};
  std::vector<std::string> repair_notes = {};  ///< what the planned repair would do
  std::optional<remesh::TriMesh> mesh = {};    ///< after the repair; none if it fails
  // Of that mesh:
  remesh::MeshQuality quality = {};
  remesh::MeshComponents components = {};
  remesh::FeatureLines features = {};
  std::optional<Plan> plan = {};
  double tight_fraction = 0.0;  ///< part of the area that bends more tightly than C60

  [[nodiscard]] Json json() const;
  [[nodiscard]] std::vector<dual::TableRow> rows() const;
};

/// Reads a file ("-": standard input), diagnoses, repairs and measures it, and plans a shell. A
/// file that cannot be read is a result, too: Verdict::hopeless.
///
/// @throws dual::InvalidOption, remesh::InvalidOption if an option is out of its range.
[[nodiscard]] Inspection inspect(const std::string& path, const InspectOptions& options);
/// The same for triangles that are in memory.
[[nodiscard]] Inspection inspect(const remesh::TriangleSoup& soup, const InspectOptions& options);

}  // namespace trivalent::shell
