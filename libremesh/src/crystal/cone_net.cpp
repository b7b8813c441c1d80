#include "crystal/cone_net.h"

#include <algorithm>
#include <unordered_map>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

namespace {

constexpr int sixths_of_turn = 6;

/// As complex numbers.
LatticeVector product(const LatticeVector& u, const LatticeVector& v) {
  return {u.x() * v.x() - u.y() * v.y(), u.x() * v.y() + u.y() * v.x() + u.y() * v.y()};
}

/// u/v as complex numbers, if that is a lattice vector.
std::optional<LatticeVector> quotient(const LatticeVector& u, const LatticeVector& v) {
  const std::int64_t norm = twice_dot(v, v) / 2;
  if (norm == 0) return std::nullopt;
  const LatticeVector conjugate(v.x() + v.y(), -v.y());
  const LatticeVector p = product(u, conjugate);
  if (p.x() % norm != 0 || p.y() % norm != 0) return std::nullopt;
  return LatticeVector(p.x() / norm, p.y() / norm);
}

/// Sorts, and keeps one of those that are equal.
void sort_once(std::vector<int>& numbers) {
  std::ranges::sort(numbers);
  numbers.erase(std::ranges::unique(numbers).begin(), numbers.end());
}

/// Centers of triangles are thirds of lattice vectors.
constexpr std::int64_t thirds = 3;

std::int64_t floor_of(std::int64_t a, std::int64_t b) {
  return a >= 0 ? a / b : -((-a + b - 1) / b);
}

}  // namespace

ConeNet::ConeNet(std::span<const std::array<int, 3>> triangles, std::size_t n_vertices)
    : inside_(triangles.size()), outgoing_(n_vertices, -1) {
  halfedges_.reserve(3 * triangles.size());
  std::vector<int> valences(n_vertices, 0);
  for (const auto& corners : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int v = corners[k];
      outgoing_[static_cast<std::size_t>(v)] = n_halfedges();
      ++valences[static_cast<std::size_t>(v)];
      halfedges_.push_back(
          {corners[(k + 1) % 3], -1, turned(LatticeVector(1, 0), 2 * static_cast<int>(k))});
    }
  }
  link(triangles);
  remove_flat_vertices(valences);
  drop_removed();
  make_delaunay();
  number_vertices();
  motions_.reserve(halfedges_.size());
  for (int h = 0; h < n_halfedges(); ++h) motions_.push_back(motion_of(h));
}

void ConeNet::link(std::span<const std::array<int, 3>> triangles) {
  std::unordered_map<std::uint64_t, int> halfedge_of;
  const auto key = [](int a, int b) {
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32U) |
           static_cast<std::uint32_t>(b);
  };
  halfedge_of.reserve(3 * triangles.size());
  for (int h = 0; h < n_halfedges(); ++h) halfedge_of[key(from(h), to(h))] = h;
  for (int h = 0; h < n_halfedges(); ++h) at(h).opposite = halfedge_of.at(key(to(h), from(h)));
}

/// Where a half-edge begins, in the frame of its triangle.
LatticeVector ConeNet::corner(int h) const {
  const int first = h - h % 3;
  LatticeVector p = LatticeVector::Zero();
  for (int k = first; k < h; ++k) p += side(k);
  return p;
}

/// By so many sixths the frame of the triangle across a half-edge is turned: the vector of the
/// opposite half-edge there is the one back, turned by as much.
int ConeNet::turn(int h) const {
  LatticeVector v = -side(h);
  for (int sixths = 0; sixths < sixths_of_turn; ++sixths) {
    if (v == side(opposite(h))) return sixths;
    v = turned(v, 1);
  }
  return -1;
}

/// A point in the frame of the triangle across a half-edge.
///
/// @param scale  Of the point.
ConeNet::Place ConeNet::across(int h, const LatticeVector& q, std::int64_t scale) const {
  const int g = opposite(h);
  const LatticeVector there = turned(q - scale * corner(h), turn(h)) + scale * corner(next(g));
  return {g / 3, there};
}

/// Goes straight to a point, which is in the frame of the first triangle, and changes the frame
/// with every side that is crossed. No disclination lies on the way.
ConeNet::Place ConeNet::walk(Place from, LatticeVector to, std::int64_t scale) const {
  while (true) {
    int crossed = -1;
    for (int h = 3 * from.triangle; h < 3 * from.triangle + 3; ++h) {
      const LatticeVector begin = scale * corner(h);
      if (area_of(side(h), to - begin) >= 0) continue;
      const LatticeVector end = begin + scale * side(h);
      const LatticeVector way = to - from.at;
      if (area_of(way, begin - from.at) <= 0 && area_of(way, end - from.at) >= 0) crossed = h;
    }
    if (crossed < 0) return {from.triangle, to};
    const Place begin = across(crossed, from.at, scale);
    to = across(crossed, to, scale).at;
    from = begin;
  }
}

/// A corner by its vertex, a place on a side by one of the two triangles.
ConeNet::Key ConeNet::key_of(const Place& place) const {
  const int first = 3 * place.triangle;
  for (int h = first; h < first + 3; ++h) {
    if (place.at == corner(h)) return {-1 - from(h), 0, 0};
  }
  for (int h = first; h < first + 3; ++h) {
    if (opposite(h) > h || area_of(side(h), place.at - corner(h)) != 0) continue;
    const Place there = across(h, place.at, 1);
    return {there.triangle, there.at.x(), there.at.y()};
  }
  return {place.triangle, place.at.x(), place.at.y()};
}

std::int64_t ConeNet::n_faces() const {
  std::int64_t sum = 0;
  for (int h = 0; h < n_halfedges(); h += 3) sum += area_of(side(h), side(h + 1));
  return sum;
}

void ConeNet::number_vertices() {
  for (int h = 0; h < n_halfedges(); ++h) vertex_at_[{-1 - from(h), 0, 0}] = from(h);
  for (std::size_t t = 0; t < inside_.size(); ++t) {
    for (const Inside& p : inside_[t]) {
      vertex_at_[key_of({static_cast<int>(t), p.at})] = p.vertex;
    }
  }
}

/// The two ends move in the triangles around them, each as seen from the triangle of the half-edge.
ConeNet::Motion ConeNet::motion_of(int halfedge) const {
  Motion motion;
  if (from(halfedge) == to(halfedge)) return motion;
  const int across = opposite(halfedge);
  const auto turned_unit = [](int sixths) { return turned(LatticeVector(1, 0), sixths); };
  const auto add = [&](int h, int sixths, bool is_of_end) {
    const LatticeVector factor = turned_unit(sixths);
    motion.steps.push_back({h, is_of_end, -factor});
    motion.steps.push_back({previous(h), is_of_end, factor});
    motion.sides.push_back(h);
    motion.sides.push_back(previous(h));
    motion.triangles.push_back(h - h % 3);
  };
  // Around the beginning counter-clockwise and around the end clockwise, from the triangle of the
  // half-edge to the one across.
  int around_from = 0;
  for (int h = halfedge;; h = opposite(previous(h))) {
    add(h, around_from, false);
    if (h == next(across)) break;
    around_from += turn(previous(h));
  }
  int around_to = 0;
  for (int h = next(halfedge);; h = next(opposite(h))) {
    add(h, around_to, true);
    if (h == across) break;
    around_to += turn(h);
  }
  // Seen from across the half-edge, both must have moved as they have around them.
  const LatticeVector direct = turned_unit(turn(halfedge));
  motion.numerator = turned_unit(around_from) - direct;
  motion.denominator = turned_unit(around_to) - direct;
  motion.ratio = quotient(motion.numerator, motion.denominator);
  sort_once(motion.sides);
  sort_once(motion.triangles);
  return motion;
}

bool ConeNet::move(int halfedge, const LatticeVector& by) {
  const Motion& motion = motions_[index(halfedge)];
  const std::optional<LatticeVector> by_of_end =
      motion.ratio ? product(*motion.ratio, by)
                   : quotient(product(motion.numerator, by), motion.denominator);
  if (!by_of_end) return false;
  for (const auto& [h, is_of_end, factor] : motion.steps) {
    at(h).side += product(factor, is_of_end ? *by_of_end : by);
  }
  const auto is_turned_over = [&](int h) { return area_of(side(h), side(next(h))) <= 0; };
  if (std::ranges::none_of(motion.triangles, is_turned_over)) return true;
  for (const auto& [h, is_of_end, factor] : motion.steps) {
    at(h).side -= product(factor, is_of_end ? *by_of_end : by);
  }
  return false;
}

std::vector<ConeNet::SideChange> ConeNet::side_changes(int halfedge) const {
  const Motion& motion = motions_[index(halfedge)];
  if (motion.denominator == LatticeVector::Zero()) return {};
  const std::complex<double> of_end = in_plane(motion.numerator) / in_plane(motion.denominator);
  std::vector<SideChange> changes;
  changes.reserve(motion.steps.size());
  for (const auto& [h, is_of_end, factor] : motion.steps) {
    changes.push_back({h, in_plane(factor) * (is_of_end ? of_end : 1.0)});
  }
  return changes;
}

ConeNet ConeNet::enlarged(int times) const {
  ConeNet larger = *this;
  for (Halfedge& h : larger.halfedges_) h.side *= times;
  return larger;
}

/// Whether a large triangle is the one of all that a point counts for, which may lie on a side.
///
/// @param p  Three times as large.
bool ConeNet::owns(int triangle, const LatticeVector& p) const {
  for (int h = 3 * triangle; h < 3 * triangle + 3; ++h) {
    const std::int64_t left = area_of(side(h), p - thirds * corner(h));
    if (left < 0 || (left == 0 && h > opposite(h))) return false;
  }
  return true;
}

/// The triangles of the lattice whose centers a large one owns.
std::vector<ConeNet::Small> ConeNet::triangles_in(int triangle) const {
  const std::array<std::array<LatticeVector, 3>, 2> corners = {
      {{LatticeVector(0, 0), LatticeVector(1, 0), LatticeVector(0, 1)},
       {LatticeVector(1, 0), LatticeVector(1, 1), LatticeVector(0, 1)}}};
  const LatticeVector a = corner(3 * triangle + 1);
  const LatticeVector b = corner(3 * triangle + 2);
  const LatticeVector low = a.cwiseMin(b).cwiseMin(LatticeVector::Zero());
  const LatticeVector high = a.cwiseMax(b).cwiseMax(LatticeVector::Zero());
  std::vector<Small> found;
  for (std::int64_t y = low.y() - 1; y <= high.y(); ++y) {
    for (std::int64_t x = low.x() - 1; x <= high.x(); ++x) {
      const LatticeVector p(x, y);
      for (std::size_t down = 0; down < 2; ++down) {
        const auto third = static_cast<std::int64_t>(down + 1);
        const LatticeVector center = thirds * p + LatticeVector(third, third);
        const auto& [first, second, last] = corners[down];
        if (owns(triangle, center)) found.push_back({center, {p + first, p + second, p + last}});
      }
    }
  }
  return found;
}

ConeNet::Net ConeNet::net() const {
  Net net;
  std::map<Key, int> number_at;
  const auto number = [&](const Place& place) {
    const auto [entry, is_new] =
        number_at.try_emplace(key_of(place), static_cast<int>(net.places.size()));
    if (is_new) net.places.push_back(place);
    return entry->second;
  };
  for (int t = 0; 3 * t < n_halfedges(); ++t) {
    for (const auto& [center, corners] : triangles_in(t)) {
      std::array<int, 3> triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        const Place place = walk({t, center}, thirds * corners[k], thirds);
        triangle[k] = number({place.triangle, place.at / thirds});
      }
      net.triangles.push_back(triangle);
      net.first_edges.push_back({t, corners[1] - corners[0]});
    }
  }
  return net;
}

ConeNet::Mean ConeNet::mean_at(const ConeNet& moved, const Place& place) const {
  const int h = 3 * place.triangle;
  const LatticeVector& a = moved.side(h);
  const LatticeVector b = moved.corner(h + 2);
  const LatticeVector here = area_of(place.at, b) * side(h) + area_of(a, place.at) * corner(h + 2);
  return mean_of({place.triangle, here}, area_of(a, b));
}

ConeNet::Mean ConeNet::mean_on_side(int h, int part, int parts) const {
  return mean_of({h / 3, parts * corner(h) + part * side(h)}, parts);
}

/// @param scale  Of the place: `at` is so many times as large.
ConeNet::Mean ConeNet::mean_of(const Place& place, std::int64_t scale) const {
  const LatticeVector low(floor_of(place.at.x(), scale), floor_of(place.at.y(), scale));
  const LatticeVector rest = place.at - scale * low;
  const bool is_up = rest.x() + rest.y() <= scale;
  const double x = static_cast<double>(rest.x()) / static_cast<double>(scale);
  const double y = static_cast<double>(rest.y()) / static_cast<double>(scale);
  const std::array<LatticeVector, 3> steps = {is_up ? LatticeVector(0, 0) : LatticeVector(1, 1),
                                              LatticeVector(1, 0), LatticeVector(0, 1)};
  Mean mean{};
  mean.weights = is_up ? std::array{1.0 - x - y, x, y} : std::array{x + y - 1.0, 1.0 - y, 1.0 - x};
  for (std::size_t k = 0; k < 3; ++k) {
    // A disclination may lie between the place and a corner of no weight.
    if (mean.weights[k] == 0.0) continue;
    const Place there = walk(place, scale * (low + steps[k]), scale);
    mean.vertices[k] = vertex_at_.at(key_of({there.triangle, there.at / scale}));
  }
  return mean;
}

}  // namespace trivalent::remesh
