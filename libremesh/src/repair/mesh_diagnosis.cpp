#include "trivalent/remesh/mesh_diagnosis.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <utility>

#include "io/mesh_readers.h"
#include "mesh/edge_table.h"
#include "mesh/geometry.h"
#include "mesh/numbered_positions.h"
#include "mesh/self_intersections.h"

namespace trivalent::remesh {

namespace {

constexpr std::size_t max_places = 5;

class Diagnosis {
 public:
  explicit Diagnosis(const TriangleSoup& soup) : soup_(soup) {}

  MeshDiagnosis run() {
    result_.points = static_cast<int>(soup_.points.size());
    result_.faces = static_cast<int>(soup_.triangles.size());
    // Each has its own problems to report.
    tbb::parallel_invoke([this] { check_edges(); }, [this] { check_points(); },
                         [this] { check_faces(); });
    for (Finding& finding : findings_) {
      if (finding.count > 0) result_.findings.push_back(std::move(finding));
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] const Eigen::Vector3d& point(int v) const {
    return soup_.points[static_cast<std::size_t>(v)];
  }

  void report(Problem problem, std::vector<int> elements, int first_point) {
    Finding& finding = findings_[static_cast<std::size_t>(problem)];
    finding.problem = problem;
    ++finding.count;
    if (finding.first.size() < max_places) {
      finding.first.push_back({std::move(elements), point(first_point)});
    }
  }

  void check_points() {
    std::vector<char> is_used(soup_.points.size(), 0);
    for (const auto& triangle : soup_.triangles) {
      for (const int v : triangle) is_used[static_cast<std::size_t>(v)] = 1;
    }
    for (std::size_t v = 0; v < is_used.size(); ++v) {
      const int index = static_cast<int>(v);
      if (is_used[v] == 0) report(Problem::isolated_point, {index}, index);
    }
    // The earliest of every group of equal points leads it.
    std::vector<int> order(soup_.points.size());
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&](int v) { return std::array{point(v).x(), point(v).y(), point(v).z()}; };
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return std::pair(key(a), a) < std::pair(key(b), b); });
    std::vector<int> coincident;
    for (std::size_t i = 1; i < order.size(); ++i) {
      if (point(order[i]) == point(order[i - 1])) coincident.push_back(order[i]);
    }
    std::sort(coincident.begin(), coincident.end());
    for (const int v : coincident) report(Problem::coincident_point, {v}, v);
    check_far_points(is_used);
  }

  void check_far_points(const std::vector<char>& is_used) {
    constexpr double far = 100.0;  // times the median distance
    std::vector<int> used;
    for (std::size_t v = 0; v < is_used.size(); ++v) {
      if (is_used[v] != 0) used.push_back(static_cast<int>(v));
    }
    if (used.empty()) return;
    const auto median_of = [&](const auto& value) {
      std::vector<double> values;
      values.reserve(used.size());
      for (const int v : used) values.push_back(value(v));
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      return *middle;
    };
    Eigen::Vector3d center;
    for (int axis = 0; axis < 3; ++axis) {
      center[axis] = median_of([&](int v) { return point(v)[axis]; });
    }
    const auto distance = [&](int v) { return (point(v) - center).stableNorm(); };
    const double farthest = far * median_of(distance);
    for (const int v : used) {
      if (farthest > 0.0 && distance(v) > farthest) report(Problem::far_point, {v}, v);
    }
  }

  void check_faces() {
    const std::vector<char> is_repeated = repeated_faces(soup_.triangles);
    for (std::size_t f = 0; f < soup_.triangles.size(); ++f) {
      const int index = static_cast<int>(f);
      const auto [a, b, c] = soup_.triangles[f];
      if (doubled_area_vector(point(a), point(b), point(c)).isZero(0.0)) {
        report(Problem::flat_face, {index}, a);
      }
      if (is_repeated[f] != 0) report(Problem::repeated_face, {index}, a);
    }
  }

  void check_edges() {
    const std::vector<EdgeUse> uses = edge_uses(soup_.triangles);
    DisjointSets components(soup_.triangles.size());
    // Corners (3 f + k) of one vertex that are joined by edges of two faces form a fan.
    DisjointSets fans(3 * soup_.triangles.size());
    std::vector<EdgeUse> boundary;
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
      const EdgeUse& use = edge.front();
      for (const EdgeUse& other : edge) {
        components.join(static_cast<std::size_t>(use.face), static_cast<std::size_t>(other.face));
      }
      if (edge.size() == 1) boundary.push_back(use);
      if (edge.size() > 2) report(Problem::crowded_edge, {use.low, use.high}, use.low);
      if (edge.size() != 2) return;
      if (edge[0].upwards == edge[1].upwards) {
        report(Problem::misoriented_edge, {use.low, use.high}, use.low);
      }
      for (const int v : {use.low, use.high}) {
        fans.join(corner_of(edge[0].face, v), corner_of(edge[1].face, v));
      }
    });
    for (std::size_t f = 0; f < soup_.triangles.size(); ++f) {
      if (components.find(f) == f) ++result_.components;
    }
    check_boundary(boundary);
    check_vertices(fans);
  }

  void check_boundary(const std::vector<EdgeUse>& edges) {
    DisjointSets loops(soup_.points.size());
    for (const EdgeUse& edge : edges) {
      loops.join(static_cast<std::size_t>(edge.low), static_cast<std::size_t>(edge.high));
    }
    std::vector<char> is_seen(soup_.points.size(), 0);
    for (const EdgeUse& edge : edges) {
      if (std::exchange(is_seen[loops.find(static_cast<std::size_t>(edge.low))], 1) != 0) continue;
      ++result_.boundary_loops;
      if (result_.first_boundaries.size() < max_places) {
        result_.first_boundaries.push_back({{edge.low, edge.high}, point(edge.low)});
      }
    }
    result_.boundary_edges = static_cast<int>(edges.size());
  }

  [[nodiscard]] std::size_t corner_of(int face, int v) const {
    const auto& corners = soup_.triangles[static_cast<std::size_t>(face)];
    const auto k = std::find(corners.begin(), corners.end(), v) - corners.begin();
    return 3 * static_cast<std::size_t>(face) + static_cast<std::size_t>(k);
  }

  void check_vertices(DisjointSets& fans) {
    std::vector<int> fans_at(soup_.points.size(), 0);
    for (std::size_t corner = 0; corner < 3 * soup_.triangles.size(); ++corner) {
      if (fans.find(corner) != corner) continue;
      ++fans_at[static_cast<std::size_t>(soup_.triangles[corner / 3][corner % 3])];
    }
    for (std::size_t v = 0; v < fans_at.size(); ++v) {
      const int index = static_cast<int>(v);
      if (fans_at[v] > 1) report(Problem::pinched_vertex, {index}, index);
    }
  }

  const TriangleSoup& soup_;
  MeshDiagnosis result_;
  std::array<Finding, 1 + static_cast<std::size_t>(Problem::crossing_faces)> findings_;
};

}  // namespace

std::string_view name_of(Problem problem) {
  switch (problem) {
    case Problem::isolated_point:
      return "isolated point";
    case Problem::coincident_point:
      return "coincident point";
    case Problem::repeated_face:
      return "repeated face";
    case Problem::flat_face:
      return "flat face";
    case Problem::crowded_edge:
      return "edge of more than two faces";
    case Problem::misoriented_edge:
      return "misoriented edge";
    case Problem::pinched_vertex:
      return "pinched vertex";
    case Problem::far_point:
      return "point far off";
    case Problem::crossing_faces:
      return "pair of crossing faces";
  }
  return {};
}

bool MeshDiagnosis::is_oriented_manifold() const {
  return std::none_of(findings.begin(), findings.end(), [](const Finding& finding) {
    return finding.problem == Problem::crowded_edge ||
           finding.problem == Problem::misoriented_edge ||
           finding.problem == Problem::pinched_vertex;
  });
}

MeshDiagnosis diagnose(const TriangleSoup& soup) { return Diagnosis(soup).run(); }

Finding find_crossing_faces(const TriangleSoup& soup) {
  const NumberedPositions places = number_positions(soup.points);
  std::vector<std::array<int, 3>> triangles = soup.triangles;
  std::set<std::array<int, 3>> known;
  for (auto& triangle : triangles) {
    for (int& v : triangle) v = places.number_of[static_cast<std::size_t>(v)];
    std::array<int, 3> corners = triangle;
    std::sort(corners.begin(), corners.end());
    // All corners in one place: without an area, so that it crosses nothing.
    if (!known.insert(corners).second) triangle.fill(triangle[0]);
  }
  const CrossingFaces crossing = find_crossing_faces(places.positions, triangles);
  Finding finding{Problem::crossing_faces, crossing.count, {}};
  for (const auto& pair : crossing.first) {
    const int corner = triangles[static_cast<std::size_t>(pair[0])][0];
    finding.first.push_back(
        {{pair[0], pair[1]}, places.positions[static_cast<std::size_t>(corner)]});
  }
  return finding;
}

}  // namespace trivalent::remesh
