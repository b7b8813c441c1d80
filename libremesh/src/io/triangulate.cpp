#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <unordered_map>

#include "io/mesh_readers.h"
#include "mesh/numbered_positions.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/polygon_soup.h"

namespace trivalent::remesh {

namespace {

/// Cutting off ears takes quadratic time.
constexpr std::size_t max_corners_of_concave_polygon = 1000;

using Triangle = std::array<int, 3>;
using Points = std::vector<Eigen::Vector3d>;

/// Edges that a diagonal must not repeat, or the edge would belong to more than two triangles:
/// sides of polygons, and diagonals of polygons with other corners.
///
/// Vertices at the same position count as one, because repair() may weld them.
class TakenEdges {
 public:
  explicit TakenEdges(const PolygonSoup& soup)
      : soup_(soup), position_of_(number_positions(soup.points).number_of) {
    owner_of_.reserve(soup.corners.size());
    for (std::size_t i = 0; i < soup.ends.size(); ++i) {
      const std::span<const int> polygon = soup.polygon(i);
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        owner_of_[key(polygon[k], polygon[(k + 1) % polygon.size()])] = side;
      }
    }
  }

  /// Identifies the corners of polygon `i`, in whatever order. Repeated polygons are cut alike, so
  /// that they stay repeated.
  [[nodiscard]] std::uint64_t fingerprint(std::size_t i) const {
    std::uint64_t sum = 0;
    for (const int v : soup_.polygon(i)) {
      sum += spread_bits(spread_bits(static_cast<std::uint64_t>(position(v)) + 1));
    }
    return sum;
  }

  /// Whether a polygon with this fingerprint must not be cut from a to b.
  [[nodiscard]] bool is_taken(int a, int b, std::uint64_t fingerprint) const {
    const auto found = owner_of_.find(key(a, b));
    return found != owner_of_.end() && found->second != fingerprint;
  }
  void take(int a, int b, std::uint64_t fingerprint) {
    owner_of_.try_emplace(key(a, b), fingerprint);
  }

  /// Registers a vertex added to the soup, in a position of its own.
  void add_vertex() { position_of_.push_back(static_cast<int>(position_of_.size())); }

 private:
  static constexpr std::uint64_t side = 0;  // in place of a fingerprint

  struct SpreadBits {
    std::uint64_t operator()(std::uint64_t key) const { return spread_bits(key); }
  };

  [[nodiscard]] int position(int v) const { return position_of_[static_cast<std::size_t>(v)]; }
  [[nodiscard]] std::uint64_t key(int a, int b) const {
    const auto [low, high] = std::minmax({position(a), position(b)});
    return static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
  }

  const PolygonSoup& soup_;
  std::vector<int> position_of_;
  std::unordered_map<std::uint64_t, std::uint64_t, SpreadBits> owner_of_;
};

/// One polygon, its corners also drawn in its mean plane, counter-clockwise.
class PlanarPolygon {
 public:
  PlanarPolygon(const Points& points, std::vector<int> corners) : corners_(std::move(corners)) {
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
  [[nodiscard]] int corner(std::size_t k) const { return corners_[k]; }

  [[nodiscard]] bool is_convex() const {
    for (std::size_t k = 0; k < size(); ++k) {
      if (turn(k, (k + 1) % size(), (k + 2) % size()) < 0.0) return false;
    }
    return true;
  }

  /// Whether both halves of a quad cut from corner k to the opposite one have positive area.
  [[nodiscard]] bool quad_diagonal_lies_inside(std::size_t k) const {
    return turn(k, (k + 1) % 4, (k + 2) % 4) > 0.0 && turn(k, (k + 2) % 4, (k + 3) % 4) > 0.0;
  }

  /// Whether corner b can be cut off along the line from a to c, without regard of other polygons.
  /// @param left  Corners of the polygon that have not been cut off yet, in order.
  [[nodiscard]] bool is_ear(const std::vector<std::size_t>& left,
                            const std::array<std::size_t, 3>& abc) const {
    const auto [a, b, c] = abc;
    if (turn(a, b, c) <= 0.0) return false;
    return std::none_of(left.begin(), left.end(), [&, a = a, b = b, c = c](std::size_t p) {
      // Corners at the place of a, b or c (polygons that touch themselves) do not block the ear.
      if (plane_[p] == plane_[a] || plane_[p] == plane_[b] || plane_[p] == plane_[c]) return false;
      return turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
    });
  }

  /// Adds the midpoint of corners a and c, which becomes vertex `vertex`; returns its corner.
  std::size_t add_midpoint(std::size_t a, std::size_t c, int vertex) {
    corners_.push_back(vertex);
    plane_.emplace_back(0.5 * (plane_[a] + plane_[c]));
    return corners_.size() - 1;
  }

 private:
  /// Twice the signed area of the triangle of three corners.
  [[nodiscard]] double turn(std::size_t a, std::size_t b, std::size_t c) const {
    const Eigen::Vector2d ab = plane_[b] - plane_[a];
    const Eigen::Vector2d ac = plane_[c] - plane_[a];
    return ab.x() * ac.y() - ab.y() * ac.x();
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

/// Splits the polygons of one soup, in order.
class Triangulation {
 public:
  explicit Triangulation(const PolygonSoup& soup)
      : soup_(soup), result_{soup.points, {}, soup.notes} {
    result_.triangles.reserve(soup.ends.size());
    const auto is_larger = [&](std::size_t i) { return soup.polygon(i).size() > 3; };
    for (std::size_t i = 0; i < soup.ends.size() && !taken_; ++i) {
      if (is_larger(i)) taken_.emplace(soup);
    }
  }

  TriangleSoup run() {
    for (std::size_t i = 0; i < soup_.ends.size(); ++i) split(i);
    add_notes();
    return std::move(result_);
  }

 private:
  void split(std::size_t i) {
    if (soup_.polygon(i).size() > 3) fingerprint_ = taken_->fingerprint(i);
    std::vector<int> corners = without_repetitions(soup_.polygon(i));
    const std::size_t size = corners.size();
    repeated_ += soup_.polygon(i).size() - size;
    if (size < 3) {
      ++dropped_;
    } else if (size == 3) {
      result_.triangles.push_back({corners[0], corners[1], corners[2]});
    } else if (size == 4) {
      ++quads_;
      split_quad(PlanarPolygon(soup_.points, std::move(corners)));
    } else {
      ++larger_;
      split_larger(PlanarPolygon(soup_.points, std::move(corners)), i);
    }
  }

  void split_quad(PlanarPolygon quad) {
    const auto squared_length = [&](std::size_t k) {
      return (soup_.points[static_cast<std::size_t>(quad.corner(k))] -
              soup_.points[static_cast<std::size_t>(quad.corner(k + 2))])
          .squaredNorm();
    };
    std::size_t cut = squared_length(0) <= squared_length(1) ? 0 : 1;
    if (!quad.quad_diagonal_lies_inside(cut) && quad.quad_diagonal_lies_inside(1 - cut))
      cut = 1 - cut;
    if (is_taken(quad, {cut, cut + 2})) {
      ++avoided_;
      cut = 1 - cut;
      const bool only_taken_lies_inside =
          quad.quad_diagonal_lies_inside(1 - cut) && !quad.quad_diagonal_lies_inside(cut);
      if (only_taken_lies_inside || is_taken(quad, {cut, cut + 2}))
        return cut_off_ears(std::move(quad));
    }
    append(quad, {cut, cut + 1, cut + 2});
    append(quad, {cut, cut + 2, (cut + 3) % 4});
    taken_->take(quad.corner(cut), quad.corner(cut + 2), fingerprint_);
  }

  void split_larger(PlanarPolygon polygon, std::size_t i) {
    const bool is_convex = polygon.is_convex();
    const bool is_fan_free = is_convex && fan_is_free(polygon);
    if (is_fan_free) {
      append_fan(polygon);
    } else if (polygon.size() <= max_corners_of_concave_polygon) {
      if (is_convex) ++avoided_;
      cut_off_ears(std::move(polygon));
    } else {
      throw InvalidMesh(
          concat("triangulate: face ", i, " has ", polygon.size(), " corners and ",
                 is_convex ? "its diagonals are edges of other faces" : "is not convex",
                 "; split it first"));
    }
  }

  [[nodiscard]] bool fan_is_free(const PlanarPolygon& polygon) const {
    for (std::size_t k = 2; k + 1 < polygon.size(); ++k) {
      if (is_taken(polygon, {0, k})) return false;
    }
    return true;
  }

  void append_fan(const PlanarPolygon& polygon) {
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
      append(polygon, {0, k, k + 1});
      if (k > 1) taken_->take(polygon.corner(0), polygon.corner(k), fingerprint_);
    }
  }

  void cut_off_ears(PlanarPolygon polygon) {
    std::vector<std::size_t> left(polygon.size());
    std::iota(left.begin(), left.end(), std::size_t{0});
    // New vertices in the middle of cuts can be needed once at each corner; in polygons that cross
    // or touch themselves one may call for the next without end.
    const std::size_t max_cuts = 2 * polygon.size();
    for (std::size_t cuts = 0; left.size() > 3 && cuts < max_cuts; ++cuts) {
      const std::optional<Ear> ear = find_ear(polygon, left);
      if (!ear) break;
      cut_off(polygon, left, *ear);
    }
    // The last triangle, or what is left of a polygon that crosses itself.
    for (std::size_t k = 1; k + 1 < left.size(); ++k) {
      append(polygon, {left[0], left[k], left[k + 1]});
    }
  }

  /// A corner that can be cut off.
  struct Ear {
    std::size_t place = 0;  ///< among the corners that are left
    bool is_free = true;    ///< whether the cut may be an edge
  };

  static std::array<std::size_t, 3> around(const std::vector<std::size_t>& left, std::size_t k) {
    return {left[(k + left.size() - 1) % left.size()], left[k], left[(k + 1) % left.size()]};
  }

  /// The first ear whose cut may be an edge, else the first ear.
  [[nodiscard]] std::optional<Ear> find_ear(const PlanarPolygon& polygon,
                                            const std::vector<std::size_t>& left) const {
    std::optional<Ear> found;
    for (std::size_t k = 0; k < left.size(); ++k) {
      const std::array<std::size_t, 3> corners = around(left, k);
      if (!polygon.is_ear(left, corners)) continue;
      if (!is_taken(polygon, {corners[0], corners[2]})) return Ear{k, true};
      if (!found) found = Ear{k, false};
    }
    return found;
  }

  void cut_off(PlanarPolygon& polygon, std::vector<std::size_t>& left, const Ear& ear) {
    const auto [before, tip, after] = around(left, ear.place);
    const auto place = left.begin() + static_cast<std::ptrdiff_t>(ear.place);
    if (ear.is_free) {
      append(polygon, {before, tip, after});
      taken_->take(polygon.corner(before), polygon.corner(after), fingerprint_);
      left.erase(place);
      return;
    }
    // Every cut is taken: a new vertex in its middle makes it two new edges.
    const auto point = [&](std::size_t k) -> const Eigen::Vector3d& {
      return result_.points[static_cast<std::size_t>(polygon.corner(k))];
    };
    const Eigen::Vector3d middle = 0.5 * (point(before) + point(after));
    const std::size_t added =
        polygon.add_midpoint(before, after, static_cast<int>(result_.points.size()));
    result_.points.push_back(middle);
    taken_->add_vertex();
    ++added_;
    append(polygon, {before, tip, added});
    append(polygon, {tip, after, added});
    *place = added;
  }

  [[nodiscard]] bool is_taken(const PlanarPolygon& polygon,
                              const std::array<std::size_t, 2>& ends) const {
    return taken_->is_taken(polygon.corner(ends[0]), polygon.corner(ends[1]), fingerprint_);
  }

  void append(const PlanarPolygon& polygon, const std::array<std::size_t, 3>& corners) {
    result_.triangles.push_back(
        {polygon.corner(corners[0]), polygon.corner(corners[1]), polygon.corner(corners[2])});
  }

  void add_note(std::size_t count, std::string_view before, std::string_view thing,
                std::string_view after) {
    if (count == 0) return;
    result_.notes.push_back(concat(before, ' ', counted(count, thing), after));
  }

  void add_notes() {
    // A corner may come again further on in its polygon.
    const std::size_t folded = std::erase_if(result_.triangles, [](const Triangle& t) {
      return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
    });
    add_note(folded, "dropped", "triangle", " that repeated a corner");
    add_note(repeated_, "merged", "repeated corner", " of faces");
    add_note(dropped_, "dropped", "face", " with fewer than 3 corners");
    add_note(quads_, "split", "quad", "");
    add_note(larger_, "split", "face", " of more than 4 corners");
    add_note(avoided_, "split", "face",
             " along other diagonals, because an edge was there already");
    add_note(added_, "added", "point", " within faces all of whose diagonals were edges already");
  }

  const PolygonSoup& soup_;
  TriangleSoup result_;
  std::optional<TakenEdges> taken_;  ///< if any polygon has more than three corners
  std::uint64_t fingerprint_ = 0;    ///< of the polygon at hand
  std::size_t repeated_ = 0;
  std::size_t dropped_ = 0;
  std::size_t quads_ = 0;
  std::size_t larger_ = 0;
  std::size_t avoided_ = 0;
  std::size_t added_ = 0;
};

}  // namespace

TriangleSoup triangulate(const PolygonSoup& soup) { return Triangulation(soup).run(); }

}  // namespace trivalent::remesh
