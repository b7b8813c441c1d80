#pragma once

#include <optional>
#include <string>
#include <vector>

#include "build_plan.h"
#include "session.h"
#include "trivalent/remesh/mesh_components.h"
#include "trivalent/remesh/mesh_diagnosis.h"
#include "trivalent/remesh/mesh_repair.h"
#include "trivalent/remesh/polygon_soup.h"
#include "trivalent/remesh/surface_shape.h"

namespace trivalent::apps {

/// What can be made of a file.
enum class Verdict {
  sound,     ///< it is a surface as it is
  mendable,  ///< it becomes one by repair
  hopeless   ///< nothing can be built on it
};

/// Everything known about a file with a surface; in its own unit of length.
struct Inspection {
  Verdict verdict = Verdict::hopeless;
  std::string reason = {};  ///< for the verdict, with a way out
  bool is_read = false;     ///< else nothing below is known
  std::vector<std::string> reading_notes = {};
  remesh::MeshDiagnosis diagnosis = {};  ///< crossing faces are among the findings
  remesh::BoundingBox box = {};
  std::vector<std::string> repair_notes = {};  ///< what the repair asked for would do
  std::optional<remesh::TriMesh> mesh = {};    ///< after it; none if it fails
  // Of that mesh.
  remesh::MeshQuality quality = {};
  remesh::MeshComponents components = {};
  remesh::FeatureLines features = {};
  std::optional<BuildPlan> plan = {};
  double tight_fraction = 0.0;  ///< of the area, bent more tightly than C60
};

/// Looks at a file; `session` says which repair and which size of shell is thought of.
[[nodiscard]] Inspection inspect(const std::string& path, const Session& session);

[[nodiscard]] Result describe(const Inspection& inspection);

}  // namespace trivalent::apps
