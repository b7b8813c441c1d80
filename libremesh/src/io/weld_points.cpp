#include "io/weld_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "io/mesh_readers.h"
#include "mesh/edge_table.h"
#include "mesh/numbered_positions.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

std::vector<std::array<int, 3>> triangles_of(const PolygonSoup& soup) {
  std::vector<std::array<int, 3>> triangles;
  triangles.reserve(soup.ends.size());
  for (std::size_t i = 0; i < soup.ends.size(); ++i) {
    const std::span<const int> corners = soup.polygon(i);
    if (corners.size() == 3) triangles.push_back({corners[0], corners[1], corners[2]});
  }
  return triangles;
}

/// Whether every edge is run through once upwards and once downwards: without a table of edges, by
/// a sum that is zero then, and hardly ever else.
bool is_surely_closed(std::span<const std::array<int, 3>> triangles) {
  std::uint64_t sum = 0;
  for (const auto& triangle : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = triangle[k];
      const int to = triangle[(k + 1) % 3];
      const auto [low, high] = std::minmax(from, to);
      const std::uint64_t edge =
          spread_bits(spread_bits(index(low)) ^ static_cast<std::uint64_t>(high));
      sum += from < to ? edge : 0 - edge;
    }
  }
  return sum == 0;
}

/// Points that may be welded, each within its tolerance; the others have none.
class Tolerances {
 public:
  explicit Tolerances(const PolygonSoup& soup) : shortest_edge_(soup.points.size(), 0.0) {
    const std::vector<std::array<int, 3>> triangles = triangles_of(soup);
    if (is_surely_closed(triangles)) return;
    const std::vector<EdgeUse> uses = edge_uses(triangles);
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
      if (edge.size() == 2) return;
      for (const int v : {edge[0].low, edge[0].high}) shortest_edge_[index(v)] = unbounded;
    });
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
      const auto [low, high] = std::array{edge[0].low, edge[0].high};
      const double length = (soup.points[index(low)] - soup.points[index(high)]).norm();
      for (const int v : {low, high}) {
        shortest_edge_[index(v)] = std::min(shortest_edge_[index(v)], length);
      }
    });
    for (std::size_t v = 0; v < soup.points.size(); ++v) {
      if (shortest_edge_[v] > 0.0) points_.push_back(static_cast<int>(v));
    }
  }

  [[nodiscard]] const std::vector<int>& points() const { return points_; }

  [[nodiscard]] double at(int v, const Eigen::Vector3d& p) const {
    constexpr double of_edge = 1e-6;
    constexpr double of_coordinate = 4.0 * std::numeric_limits<float>::epsilon();
    constexpr double max_of_edge = 0.1;  // keeps every triangle
    const double edge = shortest_edge_[index(v)];
    return std::min(max_of_edge * edge,
                    std::max(of_edge * edge, of_coordinate * p.cwiseAbs().maxCoeff()));
  }

 private:
  static constexpr double unbounded = std::numeric_limits<double>::infinity();
  std::vector<double> shortest_edge_;  // 0 where nothing is to be welded
  std::vector<int> points_;
};

/// Points that become one, and how far apart they were.
struct CloseSets {
  DisjointSets sets;
  std::size_t joined = 0;
  double max_distance = 0.0;
};

/// Sweeps the points in the order of a direction along which hardly any two are level.
CloseSets join_close(const PolygonSoup& soup, const Tolerances& tolerances) {
  constexpr std::size_t max_looked_at = 1000;  // per point; bounds files made to take long
  const Eigen::Vector3d direction = Eigen::Vector3d(1.0, 0.6180339887, 0.3819660113).normalized();
  struct Placed {
    double along = 0.0;
    double tolerance = 0.0;
    int point = 0;
  };
  std::vector<Placed> placed;
  for (const int v : tolerances.points()) {
    const Eigen::Vector3d& p = soup.points[index(v)];
    placed.push_back({p.dot(direction), tolerances.at(v, p), v});
  }
  std::sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) {
    return a.along != b.along ? a.along < b.along : a.point < b.point;
  });
  CloseSets close{DisjointSets(soup.points.size())};
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const Placed& a = placed[i];
    for (std::size_t k = i + 1; k < std::min(placed.size(), i + 1 + max_looked_at); ++k) {
      const Placed& b = placed[k];
      if (b.along - a.along > a.tolerance) break;
      const double distance = (soup.points[index(a.point)] - soup.points[index(b.point)]).norm();
      if (distance > std::min(a.tolerance, b.tolerance)) continue;
      const std::size_t set_a = close.sets.find(index(a.point));
      const std::size_t set_b = close.sets.find(index(b.point));
      if (set_a == set_b) continue;
      close.sets.join(set_a, set_b);
      ++close.joined;
      close.max_distance = std::max(close.max_distance, distance);
    }
  }
  return close;
}

/// Drops the points that became others, and counts corners anew.
void renumber(PolygonSoup& soup, DisjointSets& sets) {
  std::vector<int> new_index(soup.points.size());
  std::vector<Eigen::Vector3d> kept;
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    const std::size_t first = sets.find(v);  // the smallest of its set, so it was numbered before
    if (first == v) {
      new_index[v] = static_cast<int>(kept.size());
      kept.push_back(soup.points[v]);
    } else {
      new_index[v] = new_index[first];
    }
  }
  soup.points = std::move(kept);
  for (int& v : soup.corners) v = new_index[index(v)];
}

}  // namespace

void weld_points(PolygonSoup& soup) {
  const std::size_t corners = soup.points.size();
  if (corners == 0) return;
  NumberedPositions numbered = number_positions(soup.points);
  soup.points = std::move(numbered.positions);
  for (int& v : soup.corners) v = numbered.number_of[index(v)];
  CloseSets close = join_close(soup, Tolerances(soup));
  if (close.joined > 0) renumber(soup, close.sets);
  std::string note =
      concat("welded ", counted(corners, "corner"), " into ", soup.points.size(), " vertices");
  if (close.joined > 0) {
    note += concat(", ", close.joined, " of them apart by rounding, up to ", close.max_distance);
  }
  soup.notes.push_back(std::move(note));
}

}  // namespace trivalent::remesh
