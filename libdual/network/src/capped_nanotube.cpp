#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "even_out.h"
#include "ideal_edges.h"
#include "lattice_polyhedron.h"
#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/error.h"
#include "trivalent/dual/graphene.h"
#include "trivalent/dual/ideal_structures.h"

namespace trivalent::dual {
namespace {

constexpr double lattice_constant = std::numbers::sqrt3 * graphene_bond;
constexpr int outer_pentagons = 5;

/// A cap: the vectors from the pentagon at its pole to the five around it, each on a lattice that
/// is turned by 60° against the one before. Five triangles stand between them. Beyond, the lattice
/// closes around the tube, whose chiral vector is, but for a turn by 120°, the sum of the five.
struct Cap {
  std::array<LatticeVector, outer_pentagons> spokes;

  [[nodiscard]] LatticeVector spoke(std::size_t k) const { return spokes[k % outer_pentagons]; }
  /// From an outer pentagon to the next.
  [[nodiscard]] LatticeVector rim(std::size_t k) const {
    return sixth_turn * spoke(k + 1) - spoke(k);
  }
};

/// How far a cap is from the half of an icosahedron, whose spokes are all a fifth of their sum.
struct CapDefects {
  int adjacent_pentagons = 0;
  std::int64_t unevenness = 0;

  friend auto operator<=>(const CapDefects&, const CapDefects&) = default;
};

CapDefects defects_of(const Cap& cap, LatticeVector sum) {
  CapDefects defects;
  for (std::size_t k = 0; k < outer_pentagons; ++k) {
    const LatticeVector excess = 5 * cap.spoke(k) - sum;
    const LatticeVector next_excess = 5 * cap.spoke(k + 1) - sum;
    defects.unevenness += norm(excess) + norm(sixth_turn * next_excess - excess);
    for (const LatticeVector edge : {cap.spoke(k), cap.rim(k)}) {
      if (norm(edge) == 1) ++defects.adjacent_pentagons;
    }
  }
  return defects;
}

/// All triangles face outwards, and the rim runs around the tube without turning back.
bool is_sound(const Cap& cap, LatticeVector sum) {
  const LatticeVector around = sixth_turn * sixth_turn * sum;
  for (std::size_t k = 0; k < outer_pentagons; ++k) {
    if (cross(cap.spoke(k), sixth_turn * cap.spoke(k + 1)) <= 0) return false;
    if (twice_dot(cap.rim(k), around) <= 0) return false;
  }
  return true;
}

/// The cap whose pentagons are nearest to half of an icosahedron's, of those with the fewest
/// adjacent pentagons.
Cap roundest_cap(LatticeVector sum) {
  // Spokes within 1.5 lattice constants of a fifth of the sum: 8 or 9.
  constexpr std::int64_t reach = 2;
  constexpr std::int64_t max_excess = 5 * 5 * 9 / 4;
  const LatticeVector fifth = {sum.i / 5, sum.j / 5};
  std::vector<LatticeVector> near;
  for (std::int64_t i = fifth.i - reach; i <= fifth.i + reach + 1; ++i) {
    for (std::int64_t j = fifth.j - reach; j <= fifth.j + reach + 1; ++j) {
      if (norm(5 * LatticeVector{i, j} - sum) <= max_excess) near.push_back({i, j});
    }
  }
  std::optional<std::pair<CapDefects, Cap>> best;
  const std::size_t n = near.size();
  for (std::size_t choice = 0; choice < n * n * n * n; ++choice) {
    Cap cap = {};
    cap.spokes.back() = sum;
    std::size_t rest = choice;
    for (std::size_t k = 0; k + 1 < outer_pentagons; ++k, rest /= n) {
      cap.spokes[k] = near[rest % n];
      cap.spokes.back() = cap.spokes.back() - cap.spokes[k];
    }
    if (!is_sound(cap, sum)) continue;
    const CapDefects defects = defects_of(cap, sum);
    if (!best || defects < best->first) best = {defects, cap};
  }
  if (!best) throw InvalidOption("nanotube: no cap was found for this chiral vector");
  return best->second;
}

/// A tube with the same cap on both ends, one turned about an axis across the tube. The first cap
/// is above, z runs along the tube, and x around it, to the right when seen from outside.
class Capsule {
 public:
  explicit Capsule(const CappedNanotube& tube)
      : sum_{tube.m, tube.n},  // with the tube's lattice to its right, as nanotube() has it
        around_(sixth_turn * sixth_turn * sum_),
        cap_(roundest_cap(sum_)) {
    LatticeVector corner = {0, 0};
    for (std::size_t k = 0; k < outer_pentagons; ++k) {
      rim_[k] = corner;
      upper_end_ += along(corner) / outer_pentagons;
      corner = corner + cap_.rim(k);
    }
    // Of half an icosahedron's outer pentagons the pole is a fifth of a turn away. The equator of a
    // sphere is a quarter of a turn from it.
    const double rim = upper_end_;
    upper_end_ -= (0.25 - 0.2) * circumference();
    // Without a straight part, the triangles between the rims are an icosahedron's too.
    const double triangle_height = 0.5 * std::numbers::sqrt3 * circumference() / outer_pentagons;
    choose_other_end(2.0 * rim - triangle_height - tube.length);
  }

  [[nodiscard]] double radius() const { return circumference() / (2.0 * std::numbers::pi); }
  [[nodiscard]] double upper_end() const { return upper_end_; }
  [[nodiscard]] double lower_end() const { return along(other_) - upper_end_; }

  [[nodiscard]] remesh::TriMesh mesh() const {
    const LatticeTriangulation net = triangulate(faces_);
    std::vector<Eigen::Vector3d> points;
    for (const auto& [face, at] : net.vertices) points.push_back(position(face, at));
    return remesh::make_mesh(points, net.triangles);
  }

  /// Where the line to the tube's axis, or in a cap to the sphere's center, meets the surface.
  [[nodiscard]] Eigen::Vector3d project(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d axis = {0.0, 0.0, std::clamp(point.z(), lower_end(), upper_end())};
    return axis + radius() * (point - axis).normalized();
  }

 private:
  static constexpr int n_corners = outer_pentagons + 1;
  static constexpr int n_tube_faces = 2 * outer_pentagons;

  /// Lengths in Å from here on; the lattice has its unit in sum_, around_, rim_ and other_ only.
  [[nodiscard]] double circumference() const {
    return lattice_constant * std::sqrt(static_cast<double>(norm(around_)));
  }
  [[nodiscard]] double along(LatticeVector point) const {
    constexpr double cell_area = 0.5 * std::numbers::sqrt3 * lattice_constant * lattice_constant;
    return cell_area * static_cast<double>(cross(around_, point)) / circumference();
  }
  [[nodiscard]] double angle(LatticeVector point) const {
    return 2.0 * std::numbers::pi * static_cast<double>(twice_dot(around_, point)) /
           static_cast<double>(2 * norm(around_));
  }

  /// The outer pentagons of the first cap, counted on around the tube.
  [[nodiscard]] LatticeVector upper(int k) const {
    const int turns = k >= 0 ? k / outer_pentagons : -((outer_pentagons - 1 - k) / outer_pentagons);
    return rim_[static_cast<std::size_t>(k - turns * outer_pentagons)] + turns * around_;
  }
  /// Those of the second, in the same direction.
  [[nodiscard]] LatticeVector lower(int k) const { return other_ - upper(-k); }

  static int upper_corner(int k) {
    return 1 + (k % outer_pentagons + outer_pentagons) % outer_pentagons;
  }
  static int lower_corner(int k) { return n_corners + upper_corner(-k); }

  /// Sets the point that the first outer pentagon is taken to, at this z or below, such that the
  /// caps do not meet.
  void choose_other_end(double z) {
    const LatticeVector& c = around_;
    const std::int64_t divisor = std::gcd(c.i, c.j);
    const LatticeVector turn = {c.i / divisor, c.j / divisor};
    const auto [p, q] = bezout(turn.i, -turn.j);
    const LatticeVector step = {q, p};  // cross(turn, step) = 1: the next row of points across c
    constexpr double rounding = 1e-9;
    auto steps = static_cast<std::int64_t>(std::floor(z / along(step) + rounding));
    do {
      other_ = steps-- * step;
      // Of the points in this row, the nearest to half-way between two outer pentagons, where an
      // icosahedron has it.
      const double half_way = 0.5 * static_cast<double>(divisor) / outer_pentagons;
      const double place =
          static_cast<double>(twice_dot(turn, other_)) / static_cast<double>(2 * norm(turn));
      const std::int64_t turns = std::llround(place - half_way);
      other_ = other_ - turns * turn;
    } while (!add_tube());
    add_caps();
  }

  /// Numbers with p a + q b = 1, for a and b without common divisor.
  static std::pair<std::int64_t, std::int64_t> bezout(std::int64_t a, std::int64_t b) {
    std::array<std::int64_t, 3> last = {a, 1, 0};
    std::array<std::int64_t, 3> next = {b, 0, 1};
    while (next[0] != 0) {
      const std::int64_t quotient = last[0] / next[0];
      for (std::size_t k = 0; k < 3; ++k) last[k] -= quotient * next[k];
      std::swap(last, next);
    }
    return {last[0] * last[1], last[0] * last[2]};
  }

  void add_caps() {
    for (const int first : {0, n_corners}) {
      for (int k = 0; k < outer_pentagons; ++k) {
        faces_.push_back({{first, first + upper_corner(k), first + upper_corner(k + 1)},
                          {LatticeVector{0, 0}, cap_.spoke(static_cast<std::size_t>(k)),
                           sixth_turn * cap_.spoke(static_cast<std::size_t>(k) + 1)}});
      }
    }
  }

  /// Makes the ten triangles between the rims the only faces.
  ///
  /// @return  False if the caps meet, so that not all face outwards.
  bool add_tube() {
    faces_.clear();
    const auto place = [&](LatticeVector point) { return twice_dot(around_, point); };
    int top = 0;
    int bottom = -outer_pentagons;
    while (place(lower(bottom)) < place(upper(top))) ++bottom;
    const int last_top = top + outer_pentagons;
    const int last_bottom = bottom + outer_pentagons;
    while (top < last_top || bottom < last_bottom) {
      const bool goes_on_above =
          bottom == last_bottom ||
          (top < last_top && place(upper(top + 1)) <= place(lower(bottom + 1)));
      LatticeFace face = {{upper_corner(top), lower_corner(bottom), 0},
                          {upper(top), lower(bottom), {}}};
      if (goes_on_above) {
        ++top;
        face.corners[2] = upper_corner(top);
        face.at[2] = upper(top);
      } else {
        ++bottom;
        face.corners[2] = lower_corner(bottom);
        face.at[2] = lower(bottom);
      }
      if (cross(face.at[1] - face.at[0], face.at[2] - face.at[0]) <= 0) return false;
      faces_.push_back(face);
    }
    return true;
  }

  [[nodiscard]] Eigen::Vector3d position(int face, LatticeVector at) const {
    if (face < n_tube_faces) return on_surface(at);
    const bool is_upper = face < n_tube_faces + outer_pentagons;
    const int k = (face - n_tube_faces) % outer_pentagons;
    const std::array<double, 3> weights = faces_[static_cast<std::size_t>(face)].weights(at);
    const double pole = is_upper ? upper_end_ + radius() : lower_end() - radius();
    const auto corner = [&](int number) {
      return on_surface(is_upper ? upper(number) : lower(-number));
    };
    return project(weights[0] * Eigen::Vector3d(0.0, 0.0, pole) + weights[1] * corner(k) +
                   weights[2] * corner(k + 1));
  }

  /// Rolls the tube up; what goes beyond its straight part goes on along the sphere.
  [[nodiscard]] Eigen::Vector3d on_surface(LatticeVector point) const {
    const double z = along(point);
    const double end = std::clamp(z, lower_end(), upper_end());
    const double latitude = (z - end) / radius();
    const double beside = radius() * std::cos(latitude);
    return {beside * std::cos(angle(point)), beside * std::sin(angle(point)),
            end + radius() * std::sin(latitude)};
  }

  LatticeVector sum_;
  LatticeVector around_;
  Cap cap_;
  std::array<LatticeVector, outer_pentagons> rim_ = {};
  LatticeVector other_;
  double upper_end_ = 0.0;  ///< z of the straight part's upper end [Å]
  std::vector<LatticeFace> faces_;
};

void check(const CappedNanotube& tube) {
  if (tube.n < 1 || tube.m < 0) {
    throw InvalidOption(
        concat("nanotube: n = ", tube.n, ", m = ", tube.m, "; n must be at least 1, m at least 0"));
  }
  constexpr int max_index = 10000;
  if (tube.n > max_index || tube.m > max_index) {
    throw InvalidOption("nanotube: n and m can be at most 10000");
  }
  constexpr std::int64_t thinnest = 5;
  if (norm({tube.n, tube.m}) < thinnest * thinnest) {
    throw InvalidOption(concat("nanotube: (", tube.n, ",", tube.m,
                               ") is too thin for caps; (5,0) and (3,3) are the thinnest"));
  }
  if (!(tube.length >= 0.0)) {
    throw InvalidOption(
        concat("nanotube: the straight part is ", tube.length, " Å long; it must be 0 or more"));
  }
  const double around = lattice_constant * std::sqrt(static_cast<double>(norm({tube.n, tube.m})));
  const double area_per_atom = 0.75 * std::numbers::sqrt3 * graphene_bond * graphene_bond;
  require_few_atoms("nanotube", around * (tube.length + around / std::numbers::pi) / area_per_atom);
}

}  // namespace

Structure capped_nanotube(const CappedNanotube& tube) {
  check(tube);
  if (tube.open_end == Edges::periodic) {
    throw InvalidOption("nanotube: a tube with a cap is not periodic");
  }
  const Capsule capsule(tube);
  Structure structure = build_dual(capsule.mesh());
  even_out(structure, [&](const Eigen::Vector3d& point) { return capsule.project(point); });
  const Eigen::Vector3d center = {0.0, 0.0, 0.5 * (capsule.lower_end() + capsule.upper_end())};
  if (tube.open_end) {
    structure = part_of(structure, [&](std::size_t i) {
      return structure.atoms.positions[i].z() >= capsule.lower_end();
    });
    structure.rings.clear();  // of atoms that close_edges may take away
    close_edges(structure, *tube.open_end);
  }
  for (Eigen::Vector3d& position : structure.atoms.positions) position -= center;
  return structure;
}

}  // namespace trivalent::dual
