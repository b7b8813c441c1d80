#pragma once

#include <functional>
#include <string>
#include <vector>

#include "session.h"
#include "trivalent/remesh/mesh.h"
#include "trivalent/remesh/mesh_repair.h"
#include "trivalent/remesh/polygon_soup.h"

namespace trivalent::apps {

/// --repair, --holes, --components, --wrap-alpha and --wrap-offset.
void add_repair_options(po::options_description& options);

/// @throws UsageError if a name is unknown.
[[nodiscard]] remesh::RepairOptions repair_options(const Session& session);

/// Reads points and triangles from a file, or from standard input if the path is "-".
[[nodiscard]] remesh::TriangleSoup read_soup(const std::string& path);

/// The same, made a sound surface for nets of the edge length that belongs to a surface.
[[nodiscard]] remesh::RepairResult read_surface(
    const std::string& path, const Session& session,
    std::function<double(const remesh::TriMesh&)> edge_length_on);

}  // namespace trivalent::apps
