#include "lattice_polyhedron.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace trivalent::dual {
namespace {

/// Twice the area of a triangle in cells; positive if it is counter-clockwise.
std::int64_t orientation(LatticeVector a, LatticeVector b, LatticeVector c) {
  return cross(b - a, c - a);
}

/// One side of a face: from its corner of this number to the next.
struct Side {
  int face;
  std::size_t first;
};

class Triangulator {
 public:
  explicit Triangulator(std::span<const LatticeFace> faces) : faces_(faces) {
    for (std::size_t f = 0; f < faces.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        sides_[{faces[f].corners[k], faces[f].corners[(k + 1) % 3]}] = {static_cast<int>(f), k};
      }
    }
    for (std::size_t f = 0; f < faces.size(); ++f) divide(static_cast<int>(f));
  }

  [[nodiscard]] LatticeTriangulation take() && { return std::move(result_); }

 private:
  /// A vertex's place, the same however it was reached: a corner's number after -1, or a face, the
  /// first of two, and the point on its lattice.
  using Key = std::tuple<int, std::int64_t, std::int64_t>;

  /// Adds the lattice triangles whose middle lies on a face.
  void divide(int f) {
    const std::array<LatticeVector, 3>& corners = faces_[f].at;
    const auto [low, high] = std::ranges::minmax(corners, {}, &LatticeVector::j);
    for (std::int64_t j = low.j - 1; j <= high.j; ++j) {
      const auto [first, last] = columns(corners, j);
      for (std::int64_t i = first - 2; i <= last + 1; ++i) {
        add(f, {{{i, j}, {i + 1, j}, {i, j + 1}}});
        add(f, {{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}});
      }
    }
  }

  /// From where to where a face reaches between the rows j and j + 1.
  static std::pair<std::int64_t, std::int64_t> columns(const std::array<LatticeVector, 3>& corners,
                                                       std::int64_t j) {
    double first = std::numeric_limits<double>::max();
    double last = std::numeric_limits<double>::lowest();
    for (std::size_t k = 0; k < 3; ++k) {
      const LatticeVector from = corners[k];
      const LatticeVector along = corners[(k + 1) % 3] - from;
      for (const std::int64_t row : {j, j + 1}) {
        double part =
            along.j == 0 ? 0.0 : static_cast<double>(row - from.j) / static_cast<double>(along.j);
        part = std::clamp(part, 0.0, 1.0);
        const double i = static_cast<double>(from.i) + part * static_cast<double>(along.i);
        first = std::min(first, i);
        last = std::max(last, i);
      }
    }
    return {static_cast<std::int64_t>(std::floor(first)),
            static_cast<std::int64_t>(std::ceil(last))};
  }

  void add(int f, const std::array<LatticeVector, 3>& triangle) {
    const LatticeVector middle = triangle[0] + triangle[1] + triangle[2];  // in thirds
    for (std::size_t k = 0; k < 3; ++k) {
      if (orientation(3 * faces_[f].at[k], 3 * faces_[f].at[(k + 1) % 3], middle) < 0) return;
    }
    std::array<int, 3> vertices = {};
    std::ranges::transform(triangle, vertices.begin(),
                           [&](LatticeVector corner) { return vertex(f, middle, corner); });
    // One whose middle is on an edge belongs to both faces.
    std::array<int, 3> key = vertices;
    std::ranges::sort(key);
    if (known_.insert(key).second) result_.triangles.push_back(vertices);
  }

  /// The number of the vertex that the straight line from a point of a face, given in thirds,
  /// leads to.
  int vertex(int face, LatticeVector start, LatticeVector end) {
    while (true) {
      const std::array<LatticeVector, 3>& at = faces_[face].at;
      std::size_t crossed = 3;
      for (std::size_t k = 0; k < 3; ++k) {
        const LatticeVector a = at[k];
        const LatticeVector b = at[(k + 1) % 3];
        if (orientation(a, b, end) >= 0) continue;
        // Whoever leaves over a side has its first corner at the right and its second at the left.
        if (orientation(start, 3 * end, 3 * a) <= 0 && orientation(start, 3 * end, 3 * b) >= 0) {
          crossed = k;
        }
      }
      if (crossed == 3) return number(face, end);
      start = across(face, crossed, start, 3);
      end = across(face, crossed, end, 1);
      face = beyond(face, crossed).face;
    }
  }

  [[nodiscard]] Side beyond(int face, std::size_t side) const {
    const std::array<int, 3>& corners = faces_[face].corners;
    return sides_.at({corners[(side + 1) % 3], corners[side]});
  }

  /// A point, given in parts of the lattice constant, on the lattice of the face beyond a side.
  [[nodiscard]] LatticeVector across(int face, std::size_t side, LatticeVector point,
                                     std::int64_t parts) const {
    const std::array<LatticeVector, 3>& here = faces_[face].at;
    const Side other = beyond(face, side);
    const std::array<LatticeVector, 3>& there = faces_[other.face].at;
    const LatticeVector along_here = here[(side + 1) % 3] - here[side];
    const LatticeVector along_there = there[other.first] - there[(other.first + 1) % 3];
    LatticeVector turn = {1, 0};
    for (int sixth = 0; sixth < 6 && turn * along_here != along_there; ++sixth) {
      turn = turn * sixth_turn;
    }
    assert(turn * along_here == along_there);
    return parts * there[(other.first + 1) % 3] + turn * (point - parts * here[side]);
  }

  int number(int face, LatticeVector at) {
    for (std::size_t k = 0; k < 3; ++k) {
      const LatticeFace& here = faces_[face];
      if (orientation(here.at[k], here.at[(k + 1) % 3], at) != 0) continue;
      if (at == here.at[k]) return number({-1, here.corners[k], 0}, face, at);
      if (at == here.at[(k + 1) % 3]) continue;
      const int other = beyond(face, k).face;
      if (other > face) break;
      at = across(face, k, at, 1);
      face = other;
      break;
    }
    return number({face, at.i, at.j}, face, at);
  }

  int number(const Key& key, int face, LatticeVector at) {
    const auto [found, is_new] =
        numbers_.try_emplace(key, static_cast<int>(result_.vertices.size()));
    if (is_new) result_.vertices.push_back({.face = face, .at = at});
    return found->second;
  }

  std::span<const LatticeFace> faces_;
  std::map<std::pair<int, int>, Side> sides_;
  std::map<Key, int> numbers_;
  std::set<std::array<int, 3>> known_;
  LatticeTriangulation result_;
};

}  // namespace

std::array<double, 3> LatticeFace::weights(LatticeVector point) const {
  const auto area = static_cast<double>(orientation(at[0], at[1], at[2]));
  std::array<double, 3> parts = {};
  for (std::size_t k = 0; k < 3; ++k) {
    parts[k] = static_cast<double>(orientation(point, at[(k + 1) % 3], at[(k + 2) % 3])) / area;
  }
  return parts;
}

LatticeTriangulation triangulate(std::span<const LatticeFace> faces) {
  return Triangulator(faces).take();
}

}  // namespace trivalent::dual
