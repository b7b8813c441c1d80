#include "cell_grid.h"

#include <tbb/parallel_sort.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "trivalent/potentials/error.h"
#include "validation.h"

namespace trivalent::potentials {

namespace {

// Reduced coordinates: multiples of the cell vectors. Directions that are not periodic never shift.
struct ReducedFrame {
  Eigen::Matrix3d cell;
  Eigen::Matrix3d inverse;
  std::array<bool, 3> periodic;

  explicit ReducedFrame(const Box& box)
      : cell(completed_cell(box)), inverse(cell.inverse()), periodic(box.periodic) {}

  [[nodiscard]] Eigen::Vector3d shift(const std::array<std::int16_t, 3>& image) const {
    return Box{.cell = cell}.offset(image);
  }
};

struct ReducedBounds {
  Eigen::Vector3d lowest = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d highest = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());
};

[[nodiscard]] ReducedBounds reduced_bounds(std::span<const GridPoint> points,
                                           const ReducedFrame& frame) {
  ReducedBounds bounds;
  for (const GridPoint& point : points) {
    const Eigen::Vector3d reduced = frame.inverse * point.position;
    bounds.lowest = bounds.lowest.cwiseMin(reduced);
    bounds.highest = bounds.highest.cwiseMax(reduced);
  }
  return bounds;
}

[[nodiscard]] std::int16_t checked_image(double count) {
  constexpr double most = std::numeric_limits<std::int16_t>::max();
  if (!(std::abs(count) <= most)) {
    throw InvalidAtoms(concat("neighbor list: ", count,
                              " cell lengths lie between neighbors or "
                              "between an atom and its cell; wrap the atoms or enlarge the cell"));
  }
  return static_cast<std::int16_t>(count);
}

// Atoms that spread over no more than one cell stay where they are: a flat sheet at the face of its
// cell then has no images on the other side.
void wrap_into_cell(std::vector<GridPoint>& points, const ReducedFrame& frame) {
  const ReducedBounds bounds = reduced_bounds(points, frame);
  for (int k = 0; k < 3; ++k) {
    const auto direction = static_cast<std::size_t>(k);
    if (!frame.periodic[direction] || bounds.highest[k] - bounds.lowest[k] <= 1.0) continue;
    for (GridPoint& point : points) {
      const double reduced = frame.inverse.row(k).dot(point.position);
      point.image[direction] = checked_image(-std::floor(reduced));
    }
  }
  for (GridPoint& point : points) point.position += frame.shift(point.image);
}

// Adds those images along one direction that lie within the cutoff of the atoms' own extent.
void add_images_along(int k, double cutoff, const ReducedFrame& frame,
                      std::vector<GridPoint>& points) {
  const ReducedBounds bounds = reduced_bounds(points, frame);
  // The planes of a cell are 1/|row of the inverse| apart; rounding must not lose an image.
  const double reach = cutoff * frame.inverse.row(k).norm() * (1.0 + 1e-9) + 1e-9;
  const double lowest = bounds.lowest[k] - reach;
  const double highest = bounds.highest[k] + reach;
  const std::size_t count = points.size();
  for (std::size_t p = 0; p < count; ++p) {
    const double reduced = frame.inverse.row(k).dot(points[p].position);
    const std::int16_t first = checked_image(std::ceil(lowest - reduced));
    const std::int16_t last = checked_image(std::floor(highest - reduced));
    for (int shift = first; shift <= last; ++shift) {
      if (shift == 0) continue;
      GridPoint image = points[p];
      image.image[static_cast<std::size_t>(k)] =
          checked_image(image.image[static_cast<std::size_t>(k)] + shift);
      image.position += shift * frame.cell.col(k);
      image.is_home = false;
      points.push_back(image);
    }
    if (points.size() >= std::numeric_limits<std::uint32_t>::max()) {
      throw InvalidAtoms(
          "neighbor list: more than 2^32 - 2 atoms and periodic images; the cell is "
          "too small for this cutoff");
    }
  }
}

[[nodiscard]] std::vector<GridPoint> points_with_images(const AtomsView& atoms, double cutoff) {
  std::vector<GridPoint> points;
  points.reserve(atoms.size());
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    points.push_back({atoms.positions[i], static_cast<std::uint32_t>(i), {0, 0, 0}, true});
  }
  if (!atoms.box.is_periodic()) return points;
  const ReducedFrame frame(atoms.box);
  wrap_into_cell(points, frame);
  for (int k = 0; k < 3; ++k) {
    if (frame.periodic[static_cast<std::size_t>(k)]) add_images_along(k, cutoff, frame, points);
  }
  return points;
}

}  // namespace

std::array<std::int32_t, 3> image_between(const GridPoint& from, const GridPoint& to) {
  std::array<std::int32_t, 3> image{};
  for (std::size_t k = 0; k < 3; ++k) image[k] = to.image[k] - from.image[k];
  return image;
}

bool is_nearer(const AtomsView& atoms, const GridPoint& from, const GridPoint& to,
               Squared distances) {
  return is_nearer(atoms, {from.atom, to.atom, image_between(from, to)}, distances);
}

bool is_nearer(const AtomsView& atoms, ImagePair pair, Squared distances) {
  const bool is_clear =
      std::abs(distances.distance - distances.cutoff) > (rounding_margin - 1.0) * distances.cutoff;
  if (is_clear) return distances.distance < distances.cutoff;
  // Too close to call: computed again, always from the same one of the two.
  auto& [first, second, image] = pair;
  if (second < first || (second == first && image < std::array<std::int32_t, 3>{})) {
    std::swap(first, second);
    for (std::int32_t& k : image) k = -k;
  }
  const Eigen::Vector3d separation =
      atoms.box.shifted(atoms.positions[second] - atoms.positions[first], image);
  return separation.squaredNorm() < distances.cutoff;
}

CellGrid::CellGrid(const AtomsView& atoms, double cutoff)
    // A little larger than the cutoff, so that rounding cannot put neighbors two cells apart.
    : squared_cutoff_(cutoff * cutoff), cell_size_(cutoff * (1.0 + 1e-6)) {
  points_ = points_with_images(atoms, cutoff);
  sort_into_cells();
}

void CellGrid::sort_into_cells() {
  Eigen::Array3d lowest = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array3d highest = -lowest;
  for (const GridPoint& point : points_) {
    lowest = lowest.min(point.position.array());
    highest = highest.max(point.position.array());
  }
  // Twenty bits a direction: larger clusters get larger cells.
  constexpr double max_cells = 1 << 20;
  if (!points_.empty()) {
    cell_size_ = std::max(cell_size_, (highest - lowest).maxCoeff() / max_cells);
  }

  struct Place {
    Key key;
    std::uint32_t point;
    bool operator<(const Place& other) const {
      return key != other.key ? key < other.key : point < other.point;
    }
  };
  std::vector<Place> places(points_.size());
  for (std::size_t p = 0; p < points_.size(); ++p) {
    // Counting starts at 1, so that the cells around one never have a negative number.
    const Eigen::Array<Key, 3, 1> cell =
        ((points_[p].position.array() - lowest) / cell_size_).floor().cast<Key>() + 1;
    places[p] = {cell[0] | cell[1] << 21 | cell[2] << 42, static_cast<std::uint32_t>(p)};
  }
  tbb::parallel_sort(places.begin(), places.end());

  std::vector<GridPoint> sorted(points_.size());
  keys_.resize(points_.size());
  for (std::size_t p = 0; p < places.size(); ++p) {
    sorted[p] = points_[places[p].point];
    keys_[p] = places[p].key;
  }
  points_ = std::move(sorted);
}

void CellGrid::move_forward(Key key, std::array<Run, 9>& runs) const {
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const Key first = key + static_cast<Key>(row_offsets[k]) - 1;
    const Key last = first + 2;
    Run& run = runs[k];
    // A first call jumps; later ones find the row a few points on.
    if (run.end == 0) {
      run.begin = static_cast<std::size_t>(std::ranges::lower_bound(keys_, first) - keys_.begin());
    }
    while (run.begin < keys_.size() && keys_[run.begin] < first) ++run.begin;
    run.end = std::max(run.end, run.begin);
    while (run.end < keys_.size() && keys_[run.end] <= last) ++run.end;
  }
}

}  // namespace trivalent::potentials
