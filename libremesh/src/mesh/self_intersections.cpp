#include "mesh/self_intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "mesh/unfolded_vertices.h"
#include "trivalent/remesh/mesh_quality.h"

namespace trivalent::remesh {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;

/// Candidates are tested by many threads, so many at a time.
constexpr std::size_t batch_size = 1 << 20;

constexpr auto max_crossings = static_cast<std::size_t>(max_crossing_pairs);

/// Thrown out of CGAL's search, which has no other end than the last pair.
struct EnoughFound {};

using BoxPair = std::array<int, 2>;

/// Triangles of a cell, and behind them those of the cells around that reach into it.
struct UnfoldedFaces {
  std::vector<Eigen::Vector3d> points = {};
  std::vector<std::array<int, 3>> triangles = {};
  std::size_t own = 0;              ///< triangles of the cell itself
  std::vector<int> face_of = {};    ///< of the triangles behind
  std::vector<char> is_ahead = {};  ///< of those: whether its image comes after the opposite one

  /// Whether a pair counts: of the two places where a face meets an image of another, one does.
  [[nodiscard]] bool counts(const BoxPair& pair) const {
    const auto later = static_cast<std::size_t>(pair[1]);
    if (later < own) return true;
    if (static_cast<std::size_t>(pair[0]) >= own) return false;
    const int face = face_of[later - own];
    return pair[0] < face || (pair[0] == face && is_ahead[later - own] != 0);
  }
  /// The pair by faces.
  [[nodiscard]] BoxPair faces(const BoxPair& pair) const {
    const auto later = static_cast<std::size_t>(pair[1]);
    return {pair[0], later < own ? pair[1] : face_of[later - own]};
  }
};

class IntersectionTest {
 public:
  explicit IntersectionTest(UnfoldedFaces faces) : faces_(std::move(faces)) {
    points_.reserve(faces_.points.size());
    for (const Eigen::Vector3d& p : faces_.points) points_.emplace_back(p.x(), p.y(), p.z());
  }

  [[nodiscard]] const UnfoldedFaces& faces() const { return faces_; }

  [[nodiscard]] std::vector<Box> boxes() const {
    std::vector<Box> boxes;
    boxes.reserve(faces_.triangles.size());
    for (std::size_t f = 0; f < faces_.triangles.size(); ++f) {
      const Kernel::Triangle_3 face = triangle(faces_.triangles[f]);
      if (!face.is_degenerate()) boxes.emplace_back(face.bbox(), static_cast<int>(f));
    }
    return boxes;
  }

  /// Whether two faces, each with an area, meet elsewhere than in what they share.
  [[nodiscard]] bool operator()(const BoxPair& pair) const {
    Corners a = faces_.triangles[static_cast<std::size_t>(pair[0])];
    Corners b = faces_.triangles[static_cast<std::size_t>(pair[1])];
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

  UnfoldedFaces faces_;
  std::vector<Kernel::Point_3> points_;
};

/// Keeps the first few; which they are does not depend on the order in which they were found.
void keep_first(std::vector<BoxPair>& pairs, std::size_t max_places) {
  std::sort(pairs.begin(), pairs.end());
  pairs.resize(std::min(pairs.size(), max_places));
}

CrossingFaces merged(CrossingFaces found, const CrossingFaces& more, std::size_t max_places) {
  found.count += more.count;
  found.first.insert(found.first.end(), more.first.begin(), more.first.end());
  keep_first(found.first, max_places);
  return found;
}

CrossingFaces test(const IntersectionTest& meet, const std::vector<BoxPair>& candidates,
                   std::size_t max_places) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, candidates.size()), CrossingFaces(),
      [&](const tbb::blocked_range<std::size_t>& range, CrossingFaces found) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          if (!meet(candidates[i])) continue;
          ++found.count;
          found.first.push_back(meet.faces().faces(candidates[i]));
          // Now and then, for sorting after every pair would take quadratic time.
          if (found.first.size() > 2 * max_places) keep_first(found.first, max_places);
        }
        return found;
      },
      [&](CrossingFaces a, const CrossingFaces& b) { return merged(std::move(a), b, max_places); });
}

/// Boxes that reach into a slab of space; those that reach into several are in each.
struct Slab {
  double begin = -std::numeric_limits<double>::infinity();  ///< along the axis
  double end = std::numeric_limits<double>::infinity();
  std::vector<Box> boxes;
};

int longest_axis(const std::vector<Box>& boxes) {
  CGAL::Bbox_3 around;
  for (const Box& box : boxes) around += box.bbox();
  const std::array sides = {around.xmax() - around.xmin(), around.ymax() - around.ymin(),
                            around.zmax() - around.zmin()};
  return static_cast<int>(std::ranges::max_element(sides) - sides.begin());
}

/// Slabs across an axis with about as many boxes each: searches in them keep to the processor's
/// cache, and to their thread. A surface of n faces is about √n wide, so that few reach into
/// several; if many do, all are put into one.
std::vector<Slab> slabs_of(std::vector<Box> boxes, int axis) {
  constexpr std::size_t min_boxes = 1 << 13;
  constexpr double min_across = 16.0;  // boxes across a slab
  const auto count =
      std::min(boxes.size() / min_boxes,
               static_cast<std::size_t>(std::sqrt(static_cast<double>(boxes.size())) / min_across));
  std::vector<Slab> slabs(std::max<std::size_t>(count, 1));
  std::vector<double> lows;
  lows.reserve(boxes.size());
  for (const Box& box : boxes) lows.push_back(box.min_coord(axis));
  std::ranges::sort(lows);
  for (std::size_t i = 1; i < slabs.size(); ++i) {
    slabs[i].begin = slabs[i - 1].end = lows[i * lows.size() / slabs.size()];
  }
  std::size_t total = 0;
  for (const Box& box : boxes) {
    const auto is_before = [&](const Slab& slab) { return slab.end <= box.min_coord(axis); };
    auto slab = std::partition_point(slabs.begin(), slabs.end(), is_before);
    for (; slab != slabs.end() && slab->begin <= box.max_coord(axis); ++slab) {
      slab->boxes.push_back(box);
      ++total;
    }
    if (total > 2 * boxes.size()) return {{.boxes = std::move(boxes)}};
  }
  return slabs;
}

/// Crossings of boxes in a slab, at most max_crossing_pairs. A pair counts where the later of the
/// two begins, so that it counts once.
CrossingFaces search(Slab slab, int axis, const IntersectionTest& meet, std::size_t max_places) {
  std::vector<BoxPair> candidates;
  CrossingFaces found;
  const auto test_batch = [&] {
    found = merged(std::move(found), test(meet, candidates, max_places), max_places);
    candidates.clear();
    if (found.count >= max_crossings) throw EnoughFound();
  };
  try {
    CGAL::box_self_intersection_d(
        slab.boxes.begin(), slab.boxes.end(), [&](const Box& a, const Box& b) {
          const double begin = std::max(a.min_coord(axis), b.min_coord(axis));
          if (begin < slab.begin || begin >= slab.end) return;
          const BoxPair pair = {std::min(a.info(), b.info()), std::max(a.info(), b.info())};
          if (meet.faces().counts(pair)) candidates.push_back(pair);
          if (candidates.size() == batch_size) test_batch();
        });
    test_batch();
  } catch (const EnoughFound&) {
    found.count = max_crossings;
  }
  return found;
}

UnfoldedFaces unfolded(const TriMesh& mesh) {
  UnfoldedFaces faces;
  UnfoldedVertices vertices(mesh, faces.points);
  const auto box_of = [](const std::array<Eigen::Vector3d, 3>& corners) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& corner : corners) box.extend(corner);
    return box;
  };
  const auto moved = [](std::array<Eigen::Vector3d, 3> corners, const Eigen::Vector3d& by) {
    for (Eigen::Vector3d& corner : corners) corner += by;
    return corners;
  };
  Eigen::AlignedBox3d around;
  double largest = 0.0;
  std::vector<std::array<Eigen::Vector3d, 3>> at_home;
  for (const auto f : mesh.faces()) {
    at_home.push_back(corners_in_cell(mesh, f));
    const Eigen::AlignedBox3d box = box_of(at_home.back());
    around.extend(box);
    largest = std::max(largest, box.diagonal().norm());
    faces.triangles.push_back(vertices.numbers(f, at_home.back()));
  }
  faces.own = faces.triangles.size();
  for (const Eigen::Vector3d& translation : mesh.lattice.translations_within(2.0 * largest)) {
    const Lattice::Image image = mesh.lattice.image_of(translation);
    for (const auto f : mesh.faces()) {
      const auto corners = moved(at_home[static_cast<std::size_t>(f.idx())], translation);
      if (!around.intersects(box_of(corners))) continue;
      faces.triangles.push_back(vertices.numbers(f, corners));
      faces.face_of.push_back(f.idx());
      faces.is_ahead.push_back(image > Lattice::Image{0, 0, 0} ? 1 : 0);
    }
  }
  return faces;
}

CrossingFaces find_crossing(UnfoldedFaces faces, std::size_t max_places) {
  constexpr std::size_t at_a_time = 16;  // slabs, whatever the number of threads
  const IntersectionTest meet(std::move(faces));
  std::vector<Box> boxes = meet.boxes();
  const int axis = longest_axis(boxes);
  std::vector<Slab> slabs = slabs_of(std::move(boxes), axis);
  CrossingFaces found;
  for (std::size_t begin = 0; begin < slabs.size() && found.count < max_crossings;
       begin += at_a_time) {
    std::vector<CrossingFaces> found_in(std::min(at_a_time, slabs.size() - begin));
    tbb::parallel_for(std::size_t{0}, found_in.size(), [&](std::size_t i) {
      found_in[i] = search(std::move(slabs[begin + i]), axis, meet, max_places);
    });
    for (const CrossingFaces& more : found_in) found = merged(std::move(found), more, max_places);
  }
  found.count = std::min(found.count, max_crossings);
  return found;
}

}  // namespace

CrossingFaces find_crossing_faces(std::span<const Eigen::Vector3d> points,
                                  std::span<const std::array<int, 3>> triangles,
                                  std::size_t max_places) {
  return find_crossing({.points = {points.begin(), points.end()},
                        .triangles = {triangles.begin(), triangles.end()},
                        .own = triangles.size()},
                       max_places);
}

CrossingFaces find_crossing_faces(const TriMesh& mesh, std::size_t max_places) {
  if (mesh.lattice.is_periodic()) return find_crossing(unfolded(mesh), max_places);
  return find_crossing_faces(std::span(mesh.points(), mesh.n_vertices()), triangles_of(mesh),
                             max_places);
}

}  // namespace trivalent::remesh
