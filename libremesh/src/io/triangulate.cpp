#include <algorithm>
#include <numeric>
#include <optional>

#include "io/mesh_readers.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/polygon_soup.h"

namespace trivalent::remesh {

namespace {

/// Cutting ears takes quadratic time; larger polygons are an attack or an accident.
constexpr std::size_t most_corners_of_a_concave_polygon = 1000;

using Triangle = std::array<int, 3>;

/// One polygon, its corners also drawn in its mean plane, counter-clockwise.
class PlanarPolygon {
 public:
  PlanarPolygon(const std::vector<Eigen::Vector3d>& points, std::vector<int> corners)
      : corners_(std::move(corners)) {
    // Newell's normal: the area vector of the polygon, planar or not.
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    const Eigen::Vector3d& origin = points[static_cast<std::size_t>(corners_[0])];
    const auto at = [&](std::size_t k) -> Eigen::Vector3d {
      return points[static_cast<std::size_t>(corners_[k % size()])] - origin;
    };
    for (std::size_t k = 0; k < size(); ++k) normal += at(k).cross(at(k + 1));
    const Eigen::Vector3d x = normal.unitOrthogonal();
    const Eigen::Vector3d y = normal.normalized().cross(x);
    for (std::size_t k = 0; k < size(); ++k) plane_.emplace_back(at(k).dot(x), at(k).dot(y));
  }

  [[nodiscard]] std::size_t size() const { return corners_.size(); }

  [[nodiscard]] bool is_convex() const {
    for (std::size_t k = 0; k < size(); ++k) {
      if (turn(k, (k + 1) % size(), (k + 2) % size()) < 0.0) return false;
    }
    return true;
  }

  /// Both halves of the quad when it is cut from corner k to the one across.
  [[nodiscard]] std::array<Triangle, 2> quad_halves(std::size_t k) const {
    return {Triangle{corners_[k], corners_[(k + 1) % 4], corners_[(k + 2) % 4]},
            Triangle{corners_[k], corners_[(k + 2) % 4], corners_[(k + 3) % 4]}};
  }
  [[nodiscard]] bool quad_diagonal_lies_inside(std::size_t k) const {
    return turn(k, (k + 1) % 4, (k + 2) % 4) > 0.0 && turn(k, (k + 2) % 4, (k + 3) % 4) > 0.0;
  }

  void append_fan(std::vector<Triangle>& triangles) const {
    for (std::size_t k = 1; k + 1 < size(); ++k) {
      triangles.push_back({corners_[0], corners_[k], corners_[k + 1]});
    }
  }

  void append_ears(std::vector<Triangle>& triangles) const {
    std::vector<std::size_t> left(size());
    std::iota(left.begin(), left.end(), std::size_t{0});
    for (auto ear = find_ear(left); ear && left.size() > 3; ear = find_ear(left)) {
      const auto [before, tip, after] = around(left, *ear);
      triangles.push_back({corners_[before], corners_[tip], corners_[after]});
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(*ear));
    }
    // The last triangle, or what is left of a polygon that crosses itself and so has no ear.
    for (std::size_t k = 1; k + 1 < left.size(); ++k) {
      triangles.push_back({corners_[left[0]], corners_[left[k]], corners_[left[k + 1]]});
    }
  }

 private:
  /// Twice the signed area of the triangle of three corners.
  [[nodiscard]] double turn(std::size_t a, std::size_t b, std::size_t c) const {
    const Eigen::Vector2d ab = plane_[b] - plane_[a];
    const Eigen::Vector2d ac = plane_[c] - plane_[a];
    return ab.x() * ac.y() - ab.y() * ac.x();
  }

  static std::array<std::size_t, 3> around(const std::vector<std::size_t>& left, std::size_t k) {
    return {left[(k + left.size() - 1) % left.size()], left[k], left[(k + 1) % left.size()]};
  }

  [[nodiscard]] bool is_ear(const std::vector<std::size_t>& left, std::size_t k) const {
    const auto [a, b, c] = around(left, k);
    if (turn(a, b, c) <= 0.0) return false;
    return std::none_of(left.begin(), left.end(), [&, a = a, b = b, c = c](std::size_t p) {
      // Corners at the place of a, b or c (polygons that touch themselves) do not block the ear.
      if (plane_[p] == plane_[a] || plane_[p] == plane_[b] || plane_[p] == plane_[c]) return false;
      return turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
    });
  }

  [[nodiscard]] std::optional<std::size_t> find_ear(const std::vector<std::size_t>& left) const {
    for (std::size_t k = 0; k < left.size(); ++k) {
      if (is_ear(left, k)) return k;
    }
    return std::nullopt;
  }

  std::vector<int> corners_;
  std::vector<Eigen::Vector2d> plane_;
};

std::vector<int> without_repetitions(std::span<const int> polygon) {
  std::vector<int> corners;
  for (const int v : polygon) {
    if (corners.empty() || corners.back() != v) corners.push_back(v);
  }
  while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  return corners;
}

void append_quad(const PlanarPolygon& quad, const std::vector<Eigen::Vector3d>& points,
                 std::vector<Triangle>& triangles) {
  const auto length_of_cut = [&](std::size_t k) {
    const auto [a, b, c] = quad.quad_halves(k)[0];
    return (points[static_cast<std::size_t>(a)] - points[static_cast<std::size_t>(c)])
        .squaredNorm();
  };
  std::size_t cut = length_of_cut(0) <= length_of_cut(1) ? 0 : 1;
  if (!quad.quad_diagonal_lies_inside(cut) && quad.quad_diagonal_lies_inside(1 - cut))
    cut = 1 - cut;
  for (const Triangle& half : quad.quad_halves(cut)) triangles.push_back(half);
}

}  // namespace

TriangleSoup triangulate(const PolygonSoup& soup) {
  TriangleSoup result{soup.points, {}, soup.notes};
  result.triangles.reserve(soup.ends.size());
  std::size_t repeated = 0;
  std::size_t dropped = 0;
  std::size_t quads = 0;
  std::size_t larger = 0;
  for (std::size_t i = 0; i < soup.ends.size(); ++i) {
    std::vector<int> corners = without_repetitions(soup.polygon(i));
    const std::size_t size = corners.size();
    repeated += soup.polygon(i).size() - size;
    if (size < 3) {
      ++dropped;
    } else if (size == 3) {
      result.triangles.push_back({corners[0], corners[1], corners[2]});
    } else if (size == 4) {
      ++quads;
      append_quad(PlanarPolygon(soup.points, std::move(corners)), soup.points, result.triangles);
    } else {
      ++larger;
      const PlanarPolygon polygon(soup.points, std::move(corners));
      if (polygon.is_convex()) {
        polygon.append_fan(result.triangles);
      } else if (size <= most_corners_of_a_concave_polygon) {
        polygon.append_ears(result.triangles);
      } else {
        throw InvalidMesh(concat("triangulate: face ", i, " has ", size,
                                 " corners and is not convex; split it first"));
      }
    }
  }
  // A corner may come again further on in its polygon.
  const std::size_t folded = std::erase_if(result.triangles, [](const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  });
  if (folded > 0) {
    result.notes.push_back(
        concat("dropped ", counted(folded, "triangle"), " that repeated a corner"));
  }
  if (repeated > 0)
    result.notes.push_back(concat("merged ", counted(repeated, "repeated corner"), " of faces"));
  if (dropped > 0) {
    result.notes.push_back(
        concat("dropped ", counted(dropped, "face"), " with fewer than 3 corners"));
  }
  if (quads > 0) result.notes.push_back(concat("split ", counted(quads, "quad")));
  if (larger > 0)
    result.notes.push_back(concat("split ", counted(larger, "face"), " of more than 4 corners"));
  return result;
}

}  // namespace trivalent::remesh
