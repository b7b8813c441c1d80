#include "trivalent/remesh/surface_shape.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "mesh/geometry.h"

namespace trivalent::remesh {

namespace {

/// Signed angle between the normals of an edge's faces: > 0 where the surface is convex; 0 at a
/// boundary.
double bend_at(const TriMesh& mesh, EdgeHandle edge) {
  if (mesh.is_boundary(edge)) return 0.0;
  const double angle = dihedral_angle(mesh, edge);
  return std::isfinite(angle) ? angle : 0.0;
}

/// Area and integral of the mean curvature that belong to each vertex.
struct Bending {
  std::vector<double> area;
  std::vector<double> bend;
};

Bending bending_of(const TriMesh& mesh) {
  Bending result{std::vector<double>(mesh.n_vertices(), 0.0),
                 std::vector<double>(mesh.n_vertices(), 0.0)};
  for (const auto f : mesh.faces()) {  // each vertex has a third of the faces around
    const double third = face_area(mesh, f) / 3.0;
    for (const auto v : mesh.fv_range(f)) result.area[index(v)] += third;
  }
  // Half the angle times the length of an edge, which its two vertices share.
  for (const auto e : mesh.edges()) {
    const double share = 0.25 * bend_at(mesh, e) * edge_length(mesh, e);
    result.bend[index(e.v0())] += share;
    result.bend[index(e.v1())] += share;
  }
  return result;
}

}  // namespace

FeatureLines find_feature_lines(const TriMesh& mesh, double angle) {
  FeatureLines lines;
  for (const auto e : mesh.edges()) {
    if (std::abs(bend_at(mesh, e)) <= angle) continue;
    ++lines.edges;
    lines.length += edge_length(mesh, e);
  }
  return lines;
}

double tightly_curved_fraction(const TriMesh& mesh, double radius) {
  const auto [area, bend] = bending_of(mesh);
  double tight = 0.0;
  double total = 0.0;
  for (std::size_t v = 0; v < area.size(); ++v) {
    total += area[v];
    if (std::abs(bend[v]) * radius > area[v]) tight += area[v];
  }
  return total > 0.0 ? tight / total : 0.0;
}

double bending_integral(const TriMesh& mesh) {
  const auto [area, bend] = bending_of(mesh);
  double sum = 0.0;
  for (const auto v : mesh.vertices()) {
    const double a = area[index(v)];
    if (a > 0.0 && !v.is_boundary()) sum += 4.0 * bend[index(v)] * bend[index(v)] / a;
  }
  return sum;
}

double mean_curvature_integral(const TriMesh& mesh) {
  double sum = 0.0;
  for (const auto e : mesh.edges()) sum += 0.5 * bend_at(mesh, e) * edge_length(mesh, e);
  return sum;
}

double gauss_curvature_integral(const TriMesh& mesh) {
  const auto is_boundary = [](const auto e) { return e.is_boundary(); };
  if (std::ranges::none_of(mesh.edges(), is_boundary)) {
    return 2.0 * std::numbers::pi * euler_characteristic(mesh);
  }
  double sum = 0.0;
  for (const auto v : mesh.vertices()) {
    if (v.is_boundary()) continue;
    sum += 2.0 * std::numbers::pi;
    for (const auto h : mesh.vih_range(v)) sum -= corner_angle(mesh, h);
  }
  return sum;
}

FineParts find_fine_parts(const TriMesh& mesh, double radius) {
  constexpr std::size_t one_in = 1000;
  const auto [area, bend] = bending_of(mesh);
  std::vector<double> tightness;  // times the radius: > 1 is too tight
  for (std::size_t v = 0; v < area.size(); ++v) {
    const double at_radius = std::abs(bend[v]) * radius;
    if (at_radius > area[v] && area[v] > 0.0) tightness.push_back(at_radius / area[v]);
  }
  FineParts parts{.vertices = static_cast<int>(tightness.size())};
  const std::size_t accepted = mesh.n_vertices() / one_in;
  if (tightness.size() <= accepted) return parts;
  std::ranges::sort(tightness, std::greater());
  parts.growth = tightness[accepted];
  return parts;
}

}  // namespace trivalent::remesh
