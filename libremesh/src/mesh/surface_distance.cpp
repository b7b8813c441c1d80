#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "mesh/geometry.h"
#include "mesh/surface_projector.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_quality.h"

namespace trivalent::remesh {

namespace {

std::vector<double> distances_to(const SurfaceProjector& surface,
                                 std::span<const Eigen::Vector3d> points) {
  std::vector<double> distances(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(),
                    [&](std::size_t i) { distances[i] = surface.distance(points[i]); });
  return distances;
}

/// Uniform in [0, 1), the same on every platform.
double uniform(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1p-53;
}

/// One random point in each of `count` parts of equal area, in the order of the faces.
std::vector<Eigen::Vector3d> sample_by_area(const TriMesh& mesh, int count) {
  const double area = surface_area(mesh);
  std::mt19937_64 generator(20131);
  std::vector<Eigen::Vector3d> samples;
  samples.reserve(static_cast<std::size_t>(count));
  auto face = mesh.faces_begin();
  double area_before = 0.0;
  double area_here = face_area(mesh, *face);
  for (int i = 0; i < count; ++i) {
    const double wanted = (i + uniform(generator)) * area / count;
    while (area_before + area_here < wanted && std::next(face) != mesh.faces_end()) {
      area_before += area_here;
      area_here = face_area(mesh, *++face);
    }
    const auto [a, b, c] = corners_of(mesh, *face);
    // The square root makes up for the triangle's growing width.
    const double s = std::sqrt(uniform(generator));
    const double t = uniform(generator);
    samples.emplace_back((1.0 - s) * a + s * (1.0 - t) * b + s * t * c);
  }
  return samples;
}

std::vector<Eigen::Vector3d> vertices_with_faces(const TriMesh& mesh) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(mesh.n_vertices());
  for (const auto v : mesh.vertices()) {
    if (!mesh.is_isolated(v)) points.push_back(mesh.point(v));
  }
  return points;
}

SurfaceDistance distance_between(const TriMesh& from, const TriMesh& to, int samples) {
  const SurfaceProjector surface(to);
  SurfaceDistance result;
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (const double d : distances_to(surface, sample_by_area(from, samples))) {
    sum += d;
    sum_of_squares += d * d;
    result.max = std::max(result.max, d);
  }
  result.mean = sum / samples;
  result.root_mean_square = std::sqrt(sum_of_squares / samples);
  for (const double d : distances_to(surface, vertices_with_faces(from)))
    result.max = std::max(result.max, d);
  return result;
}

}  // namespace

double TwoSidedDistance::max() const { return std::max(to_original.max, from_original.max); }

double TwoSidedDistance::root_mean_square() const {
  return std::max(to_original.root_mean_square, from_original.root_mean_square);
}

TwoSidedDistance measure_distance(const TriMesh& mesh, const TriMesh& original, int samples) {
  if (samples < 1)
    throw InvalidOption(concat("measure_distance: samples must be >= 1, but is ", samples));
  for (const TriMesh* surface : {&mesh, &original}) {
    if (surface_area(*surface) > 0.0) continue;
    throw InvalidMesh(concat("measure_distance: the ", surface == &mesh ? "mesh" : "original",
                             " has no face with an area"));
  }
  return {distance_between(mesh, original, samples), distance_between(original, mesh, samples),
          bounding_box(original).diagonal()};
}

std::vector<double> distances_to_surface(std::span<const Eigen::Vector3d> points,
                                         const TriMesh& surface) {
  if (!(surface_area(surface) > 0.0)) {
    throw InvalidMesh("distances_to_surface: the surface has no face with an area");
  }
  return distances_to(SurfaceProjector(surface), points);
}

}  // namespace trivalent::remesh
