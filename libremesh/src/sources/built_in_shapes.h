#pragma once

#include "sources/shape_parts.h"

/// The built-in shapes, one function each; shapes.cpp has the table of their names and parameters.
namespace trivalent::remesh {

// spheres.cpp
[[nodiscard]] TriMesh sphere(const Request& request);
[[nodiscard]] TriMesh ellipsoid(const Request& request);
// revolved_shapes.cpp
[[nodiscard]] TriMesh torus(const Request& request);
[[nodiscard]] TriMesh capsule(const Request& request);
[[nodiscard]] TriMesh tube(const Request& request);
[[nodiscard]] TriMesh open_tube(const Request& request);
// wavy_sheet.cpp
[[nodiscard]] TriMesh wavy_sheet(const Request& request);
// double_torus.cpp
[[nodiscard]] TriMesh double_torus(const Request& request);

// junctions.cpp
[[nodiscard]] TriMesh y_junction(const Request& request);
[[nodiscard]] TriMesh t_junction(const Request& request);
[[nodiscard]] TriMesh x_junction(const Request& request);
[[nodiscard]] TriMesh tetrapod(const Request& request);
[[nodiscard]] TriMesh six_arm_junction(const Request& request);
[[nodiscard]] TriMesh junction(const Request& request);
[[nodiscard]] TriMesh cubic_network(const Request& request);
[[nodiscard]] TriMesh diamond_network(const Request& request);
[[nodiscard]] TriMesh honeycomb_network(const Request& request);

// periodic_shapes.cpp
[[nodiscard]] TriMesh schwarz_p(const Request& request);
[[nodiscard]] TriMesh schwarz_d(const Request& request);
[[nodiscard]] TriMesh gyroid(const Request& request);
[[nodiscard]] TriMesh i_wp(const Request& request);
[[nodiscard]] TriMesh neovius(const Request& request);
[[nodiscard]] TriMesh plane(const Request& request);
[[nodiscard]] TriMesh periodic_tube(const Request& request);
[[nodiscard]] TriMesh wave(const Request& request);

}  // namespace trivalent::remesh
