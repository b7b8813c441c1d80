#include "crystal/cell_net_places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "mesh/geometry.h"
#include "mesh/point_grid.h"

namespace trivalent::remesh {

namespace {

/// [spacings] around a vertex over which its curvature is a mean.
constexpr double curvature_radius = 0.4;
/// [spacings] from saddle to saddle, at least.
constexpr double saddle_distance = 0.6;

/// The Gaussian curvature at every vertex, as the mean over the vertices around it.
std::vector<double> gauss_curvatures(const TriMesh& surface, double radius) {
  std::vector<double> missing_angle(surface.n_vertices(), 2.0 * std::numbers::pi);
  std::vector<double> area(surface.n_vertices(), 0.0);
  for (const auto h : surface.halfedges()) {
    if (h.is_boundary()) continue;
    missing_angle[index(h.to())] -= corner_angle(surface, h);
    area[index(h.to())] += face_area(surface, h.face()) / 3.0;
  }
  const PointGrid grid(surface, radius, radius);
  std::vector<double> curvatures(surface.n_vertices());
  for (const auto v : surface.vertices()) {
    double angles = 0.0;
    double areas = 0.0;
    grid.visit(surface.point(v), radius, [&](int i, const Eigen::Vector3d&) {
      angles += missing_angle[static_cast<std::size_t>(i)];
      areas += area[static_cast<std::size_t>(i)];
    });
    curvatures[index(v)] = angles / areas;
  }
  return curvatures;
}

class Places {
 public:
  explicit Places(const TriMesh& surface)
      : surface_(surface),
        distances_(surface.n_vertices(), std::numeric_limits<double>::infinity()) {}

  void add(VertexHandle v) {
    const Eigen::Vector3d& place = surface_.point(v);
    places_.push_back(place);
    for (const auto w : surface_.vertices()) {
      const Eigen::Vector3d& p = surface_.point(w);
      const double distance = (surface_.lattice.near(p, place) - p).norm();
      distances_[index(w)] = std::min(distances_[index(w)], distance);
    }
  }

  [[nodiscard]] bool has_fewer_than(int count) const {
    return places_.size() < static_cast<std::size_t>(count);
  }
  /// From the nearest place.
  [[nodiscard]] double distance(VertexHandle v) const { return distances_[index(v)]; }
  [[nodiscard]] VertexHandle farthest() const {
    const auto most = std::ranges::max_element(distances_);
    return VertexHandle(static_cast<int>(most - distances_.begin()));
  }
  [[nodiscard]] const std::vector<Eigen::Vector3d>& all() const { return places_; }

 private:
  const TriMesh& surface_;
  std::vector<double> distances_;
  std::vector<Eigen::Vector3d> places_;
};

}  // namespace

std::vector<Eigen::Vector3d> find_places(const TriMesh& surface, const CellNetPlaces& wanted) {
  const std::vector<double> curvatures =
      gauss_curvatures(surface, curvature_radius * wanted.spacing);
  std::vector<int> by_curvature(surface.n_vertices());
  std::iota(by_curvature.begin(), by_curvature.end(), 0);
  std::ranges::stable_sort(by_curvature, {},
                           [&](int i) { return curvatures[static_cast<std::size_t>(i)]; });
  Places places(surface);
  for (const int i : by_curvature) {
    if (!places.has_fewer_than(std::min(wanted.saddles, wanted.all))) break;
    const VertexHandle v(i);
    if (places.distance(v) >= saddle_distance * wanted.spacing) places.add(v);
  }
  while (places.has_fewer_than(wanted.all) && places.distance(places.farthest()) > 0.0) {
    places.add(places.farthest());
  }
  return places.all();
}

}  // namespace trivalent::remesh
