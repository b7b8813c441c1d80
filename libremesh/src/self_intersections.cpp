#include "self_intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "trivalent/remesh/mesh_quality.h"

namespace trivalent::remesh {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;

/// Candidates are tested by many threads, so many at a time.
constexpr std::size_t batch_size = 1 << 20;

/// Thrown out of CGAL's search, which has no other end than the last pair.
struct EnoughFound {};

using FacePair = std::array<int, 2>;

class IntersectionTest {
 public:
  IntersectionTest(std::span<const Eigen::Vector3d> points,
                   std::span<const std::array<int, 3>> triangles)
      : corners_(triangles.begin(), triangles.end()) {
    points_.reserve(points.size());
    for (const Eigen::Vector3d& p : points) points_.emplace_back(p.x(), p.y(), p.z());
  }

  [[nodiscard]] std::vector<Box> boxes() const {
    std::vector<Box> boxes;
    boxes.reserve(corners_.size());
    for (std::size_t f = 0; f < corners_.size(); ++f) {
      const Kernel::Triangle_3 face = triangle(corners_[f]);
      if (!face.is_degenerate()) boxes.emplace_back(face.bbox(), static_cast<int>(f));
    }
    return boxes;
  }

  /// Whether two faces, each with an area, meet elsewhere than in what they share.
  [[nodiscard]] bool operator()(const FacePair& pair) const {
    Corners a = corners_[static_cast<std::size_t>(pair[0])];
    Corners b = corners_[static_cast<std::size_t>(pair[1])];
    switch (shared_to_front(a, b)) {
      case 0:
        return CGAL::do_intersect(triangle(a), triangle(b));
      case 1:
        // They meet elsewhere just if an edge across from the shared vertex meets the other face.
        return CGAL::do_intersect(triangle(a), Kernel::Segment_3(point(b[1]), point(b[2]))) ||
               CGAL::do_intersect(triangle(b), Kernel::Segment_3(point(a[1]), point(a[2])));
      case 2:
        return is_folded_flat(a, b);
      default:
        return true;
    }
  }

 private:
  using Corners = std::array<int, 3>;

  [[nodiscard]] const Kernel::Point_3& point(int v) const {
    return points_[static_cast<std::size_t>(v)];
  }
  [[nodiscard]] Kernel::Triangle_3 triangle(const Corners& c) const {
    return {point(c[0]), point(c[1]), point(c[2])};
  }

  /// Moves shared vertices to the front of both, in one order; returns their number.
  static std::size_t shared_to_front(Corners& a, Corners& b) {
    std::size_t shared = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto same = std::find(b.begin(), b.end(), a[k]);
      if (same == b.end()) continue;
      std::swap(a[k], a[shared]);
      std::swap(*same, b[shared]);
      ++shared;
    }
    return shared;
  }

  /// Across a common edge, faces overlap only if they lie in one plane on the same side of it.
  [[nodiscard]] bool is_folded_flat(const Corners& a, const Corners& b) const {
    const Kernel::Point_3& p = point(a[0]);
    const Kernel::Point_3& q = point(a[1]);
    const Kernel::Point_3& tip_a = point(a[2]);
    const Kernel::Point_3& tip_b = point(b[2]);
    return CGAL::coplanar(p, q, tip_a, tip_b) &&
           CGAL::coplanar_orientation(p, q, tip_a, tip_b) == CGAL::POSITIVE;
  }

  std::vector<Corners> corners_;
  std::vector<Kernel::Point_3> points_;
};

/// Keeps the first few; which they are does not depend on the order in which they were found.
void keep_first(std::vector<FacePair>& pairs, std::size_t most_places) {
  std::sort(pairs.begin(), pairs.end());
  pairs.resize(std::min(pairs.size(), most_places));
}

CrossingFaces merged(CrossingFaces found, const CrossingFaces& more, std::size_t most_places) {
  found.count += more.count;
  found.first.insert(found.first.end(), more.first.begin(), more.first.end());
  keep_first(found.first, most_places);
  return found;
}

CrossingFaces test(const IntersectionTest& meet, const std::vector<FacePair>& candidates,
                   std::size_t most_places) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, candidates.size()), CrossingFaces(),
      [&](const tbb::blocked_range<std::size_t>& range, CrossingFaces found) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          if (!meet(candidates[i])) continue;
          ++found.count;
          found.first.push_back(candidates[i]);
          // Now and then, for sorting after every pair would take quadratic time.
          if (found.first.size() > 2 * most_places) keep_first(found.first, most_places);
        }
        return found;
      },
      [&](CrossingFaces a, const CrossingFaces& b) {
        return merged(std::move(a), b, most_places);
      });
}

}  // namespace

CrossingFaces find_crossing_faces(std::span<const Eigen::Vector3d> points,
                                  std::span<const std::array<int, 3>> triangles,
                                  std::size_t most_places) {
  const IntersectionTest meet(points, triangles);
  std::vector<Box> boxes = meet.boxes();
  std::vector<FacePair> candidates;
  candidates.reserve(batch_size);
  CrossingFaces found;
  constexpr auto enough = static_cast<std::size_t>(most_crossing_pairs);
  const auto test_batch = [&] {
    found = merged(std::move(found), test(meet, candidates, most_places), most_places);
    candidates.clear();
    if (found.count >= enough) throw EnoughFound();
  };
  try {
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
      candidates.push_back({std::min(a.info(), b.info()), std::max(a.info(), b.info())});
      if (candidates.size() == batch_size) test_batch();
    });
    test_batch();
  } catch (const EnoughFound&) {
    found.count = enough;
  }
  return found;
}

}  // namespace trivalent::remesh
