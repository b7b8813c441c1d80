#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "trivalent/dual/network_checks.h"
#include "trivalent/remesh/mesh_components.h"
#include "trivalent/remesh/mesh_quality.h"
#include "trivalent/remesh/remesh.h"
#include "trivalent/remesh/tube_ends.h"
#include "trivalent/shell/json.h"
#include "trivalent/view/color_scale.h"
#include "trivalent/view/table_row.h"

namespace trivalent::shell {

/// Where the bonds of a structure come from.
enum class BondSource {
  file,     ///< they are known
  distance  ///< they were found by distance, as dual::find_bonds()
};

using dual::TableRow;

// Numbers of the libraries as JSON; lengths are in the unit of what was measured.
[[nodiscard]] Json quality_json(const remesh::MeshQuality& quality);
[[nodiscard]] Json components_json(const remesh::MeshComponents& components);
[[nodiscard]] Json distance_json(const remesh::TwoSidedDistance& distance);
/// How a net came about, and where it bends more tightly than C60.
[[nodiscard]] Json net_json(const remesh::RemeshResult& net);
/// JSON has only text as keys.
[[nodiscard]] Json histogram_json(const std::map<int, int>& histogram);
[[nodiscard]] Json network_json(const dual::NetworkReport& network);
[[nodiscard]] Json scale_json(const dual::ColorScale& scale);

// The same for people.
[[nodiscard]] std::string histogram_text(const std::map<int, int>& histogram);
/// The number of pairs of faces that intersect, as far as they were counted.
[[nodiscard]] std::string crossings_text(int pairs);
/// As (10,10).
[[nodiscard]] std::string tube_text(const remesh::ChiralIndices& tube);

[[nodiscard]] std::vector<TableRow> quality_rows(const remesh::MeshQuality& quality);
/// Nothing for a single component, which the quality describes.
[[nodiscard]] std::vector<TableRow> components_rows(const remesh::MeshComponents& components);
[[nodiscard]] std::vector<TableRow> distance_rows(const remesh::TwoSidedDistance& distance);
[[nodiscard]] std::vector<TableRow> net_rows(const remesh::RemeshResult& net);
[[nodiscard]] std::vector<TableRow> network_rows(const dual::NetworkReport& network);

void append(std::vector<TableRow>& rows, const std::vector<TableRow>& more);

}  // namespace trivalent::shell
