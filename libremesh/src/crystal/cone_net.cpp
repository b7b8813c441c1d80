#include "crystal/cone_net.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <unordered_map>

#include "crystal/defect_moves.h"
#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

namespace {

constexpr int sixths_of_turn = 6;

/// Twice the scalar product.
std::int64_t twice_dot(const LatticeVector& u, const LatticeVector& v) {
  return 2 * (u.x() * v.x() + u.y() * v.y()) + u.x() * v.y() + u.y() * v.x();
}

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

std::int64_t floor_of(std::int64_t a, std::int64_t b) {
  return a >= 0 ? a / b : -((-a + b - 1) / b);
}

}  // namespace

LatticeVector turned(LatticeVector v, int sixths) {
  const int times = (sixths % sixths_of_turn + sixths_of_turn) % sixths_of_turn;
  for (int i = 0; i < times; ++i) v = LatticeVector(-v.y(), v.x() + v.y());
  return v;
}

std::int64_t area_of(const LatticeVector& u, const LatticeVector& v) {
  return u.x() * v.y() - u.y() * v.x();
}

double length_of(const LatticeVector& v) {
  return std::sqrt(0.5 * static_cast<double>(twice_dot(v, v)));
}

std::complex<double> in_plane(const LatticeVector& v) {
  constexpr double height = 0.5 * std::numbers::sqrt3;
  const auto y = static_cast<double>(v.y());
  return {static_cast<double>(v.x()) + 0.5 * y, height * y};
}

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

int ConeNet::degree_of(int outgoing) const {
  int degree = 0;
  int h = outgoing;
  do {
    ++degree;
    h = opposite(previous(h));
  } while (h != outgoing);
  return degree;
}

/// Replaces a side by the other diagonal of its two triangles, if these are convex together.
///
/// @param min_area  Of the triangle that is left where the half-edge began.
bool ConeNet::flip(int h, int min_area) {
  const int g = opposite(h);
  if (h / 3 == g / 3) return false;
  // Corners in the frame of h, counter-clockwise: a, d, b, c; h goes from a to b.
  const LatticeVector a = corner(h);
  const LatticeVector b = a + side(h);
  const LatticeVector c = b + side(next(h));
  const int back = (sixths_of_turn - turn(h)) % sixths_of_turn;
  const LatticeVector from_a_to_d = turned(side(next(g)), back);
  const LatticeVector d = a + from_a_to_d;
  if (area_of(c - d, a - d) < min_area || area_of(b - d, c - d) <= 0) return false;

  std::vector<Inside> points = std::move(inside_[index(h / 3)]);
  const LatticeVector origin_there = corner(next(g));  // a, in the frame of g
  for (const Inside& p : inside_[index(g / 3)]) {
    points.push_back({p.vertex, turned(p.at - origin_there, back) + a});
  }
  const std::array<int, 4> old = {previous(h), next(g), previous(g), next(h)};
  const std::array<int, 4> now = {next(h), previous(h), next(g), previous(g)};
  const std::array<LatticeVector, 4> sides = {a - c, d - a, b - d, c - b};
  const std::array<int, 4> ends = {from(h), to(next(g)), to(h), to(next(h))};
  std::array<int, 4> opposites{};
  for (std::size_t k = 0; k < 4; ++k) {
    const int o = opposite(old[k]);
    const auto moved = std::ranges::find(old, o);
    opposites[k] = moved == old.end() ? o : now[static_cast<std::size_t>(moved - old.begin())];
  }
  for (std::size_t k = 0; k < 4; ++k) at(now[k]) = {ends[k], opposites[k], sides[k]};
  for (std::size_t k = 0; k < 4; ++k) at(opposites[k]).opposite = now[k];
  at(h) = {ends[3], g, c - d};
  at(g) = {ends[1], h, d - c};
  for (const int x : {h, g, now[0], now[1], now[2], now[3]}) outgoing_[index(from(x))] = x;

  std::vector<Inside>& left = inside_[index(h / 3)];
  std::vector<Inside>& right = inside_[index(g / 3)];
  left.clear();
  right.clear();
  const LatticeVector origin_of_left = d - corner(h);
  const LatticeVector origin_of_right = c - corner(g);
  for (const Inside& p : points) {
    if (area_of(c - d, p.at - d) >= 0) {
      left.push_back({p.vertex, p.at - origin_of_left});
    } else {
      right.push_back({p.vertex, p.at - origin_of_right});
    }
  }
  return true;
}

/// Whether the triangles around a vertex are all different, and it is no neighbor of itself.
bool ConeNet::is_inside_star(int outgoing) const {
  std::vector<int> triangles;
  int h = outgoing;
  do {
    if (to(h) == from(h)) return false;
    triangles.push_back(h / 3);
    h = opposite(previous(h));
  } while (h != outgoing);
  std::ranges::sort(triangles);
  return std::ranges::adjacent_find(triangles) == triangles.end();
}

/// Makes one triangle of the three around a vertex.
///
/// @return  False, with nothing done, if they do not lie around it.
bool ConeNet::remove_vertex(int outgoing) {
  if (!is_inside_star(outgoing)) return false;
  const int vertex = from(outgoing);
  std::array<int, 3> spokes = {outgoing, 0, 0};
  spokes[1] = opposite(previous(spokes[0]));
  spokes[2] = opposite(previous(spokes[1]));
  std::array<int, 3> rim{};
  for (std::size_t k = 0; k < 3; ++k) rim[k] = next(spokes[k]);
  const int kept = outgoing / 3;

  // Everything in the frame of the first triangle, with the vertex at the origin.
  std::vector<Inside> points;
  std::array<Halfedge, 3> sides = {at(rim[0]), at(rim[1]), at(rim[2])};
  int back = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const LatticeVector center = corner(spokes[k]);
    for (const Inside& p : inside_[index(spokes[k] / 3)]) {
      points.push_back({p.vertex, turned(p.at - center, back)});
    }
    sides[k].side = turned(sides[k].side, back);
    back = (back + sixths_of_turn - turn(previous(spokes[k]))) % sixths_of_turn;
  }
  points.push_back({vertex, LatticeVector::Zero()});
  const LatticeVector first = side(outgoing);  // where the rim begins
  const std::array<int, 3> now = {3 * kept, 3 * kept + 1, 3 * kept + 2};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto moved = std::ranges::find(rim, sides[k].opposite);
    if (moved != rim.end()) sides[k].opposite = now[static_cast<std::size_t>(moved - rim.begin())];
  }
  for (const int spoke : {spokes[1], spokes[2]}) {
    for (int k = 0; k < 3; ++k) at(spoke - spoke % 3 + k).to = -1;
    inside_[index(spoke / 3)].clear();
  }
  for (std::size_t k = 0; k < 3; ++k) at(now[k]) = sides[k];
  for (std::size_t k = 0; k < 3; ++k) at(sides[k].opposite).opposite = now[k];
  for (const int h : now) outgoing_[index(from(h))] = h;
  outgoing_[index(vertex)] = -1;
  for (Inside& p : points) p.at -= first;
  inside_[index(kept)] = std::move(points);
  return true;
}

void ConeNet::remove_flat_vertices(std::span<const int> valences) {
  constexpr int flat = 6;
  std::vector<int> left;
  for (std::size_t v = 0; v < valences.size(); ++v) {
    if (valences[v] == flat) left.push_back(static_cast<int>(v));
  }
  // In no order along the net, so that all triangles grow alike.
  std::ranges::stable_sort(left, {},
                           [](int v) { return hashed(0, static_cast<std::uint64_t>(v)); });
  constexpr int removable = 3;
  const auto lower_degree = [&](int v, int degree) {
    // What is removed next may lie on a side.
    const int min_area = degree == removable + 1 && is_inside_star(outgoing_[index(v)]) ? 0 : 1;
    int h = outgoing_[index(v)];
    const int last = h;
    do {
      const int following = opposite(previous(h));
      // The new side must not begin at the vertex again.
      const bool is_away = to(h) != v && to(next(h)) != v && to(next(opposite(h))) != v;
      if (is_away && flip(h, min_area)) return true;
      h = following;
    } while (h != last);
    return false;
  };
  // Where a vertex is a neighbor of itself, others must go first.
  std::size_t before = left.size() + 1;
  while (!left.empty() && left.size() < before) {
    before = left.size();
    std::erase_if(left, [&](int v) {
      int degree = degree_of(outgoing_[index(v)]);
      while (degree > removable && lower_degree(v, degree)) --degree;
      return degree == removable && remove_vertex(outgoing_[index(v)]);
    });
  }
}

void ConeNet::drop_removed() {
  std::vector<int> new_triangle(inside_.size(), -1);
  int count = 0;
  for (std::size_t t = 0; t < inside_.size(); ++t) {
    if (halfedges_[3 * t].to >= 0) new_triangle[t] = count++;
  }
  for (std::size_t t = 0; t < inside_.size(); ++t) {
    if (new_triangle[t] < 0) continue;
    const auto n = index(new_triangle[t]);
    for (std::size_t k = 0; k < 3; ++k) {
      Halfedge h = halfedges_[3 * t + k];
      h.opposite = 3 * new_triangle[index(h.opposite / 3)] + h.opposite % 3;
      halfedges_[3 * n + k] = h;
    }
    if (n != t) inside_[n] = std::move(inside_[t]);
  }
  halfedges_.resize(3 * index(count));
  inside_.resize(index(count));
}

void ConeNet::make_delaunay() {
  const auto is_bad = [&](int h) {
    const auto opposed = [&](int x) {
      const LatticeVector& u = side(next(x));
      const LatticeVector v = -side(previous(x));
      // Angle at the corner across x.
      return std::array{twice_dot(-u, -v), area_of(v, u)};
    };
    const auto [dot_a, cross_a] = opposed(h);
    const auto [dot_b, cross_b] = opposed(opposite(h));
    return dot_a * cross_b + dot_b * cross_a < 0;
  };
  bool changed = true;
  while (changed) {
    changed = false;
    for (int h = 0; h < n_halfedges(); ++h) {
      if (opposite(h) > h && is_bad(h) && flip(h)) changed = true;
    }
  }
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
    for (int k = 0; k < 3; ++k) motion.halfedges.push_back(h - h % 3 + k);
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
  std::ranges::sort(motion.halfedges);
  motion.halfedges.erase(std::ranges::unique(motion.halfedges).begin(), motion.halfedges.end());
  return motion;
}

bool ConeNet::move(int halfedge, const LatticeVector& by) {
  const Motion& motion = motions_[index(halfedge)];
  const std::optional<LatticeVector> by_of_end =
      quotient(product(motion.numerator, by), motion.denominator);
  if (!by_of_end) return false;
  for (const auto& [h, is_of_end, factor] : motion.steps) {
    at(h).side += product(factor, is_of_end ? *by_of_end : by);
  }
  const auto is_turned_over = [&](int h) { return area_of(side(h), side(next(h))) <= 0; };
  if (std::ranges::none_of(motion.halfedges, is_turned_over)) return true;
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

ConeNet::Net ConeNet::net() const {
  Net net;
  std::map<Key, int> number_at;
  const auto number = [&](const Place& place) {
    const auto [entry, is_new] =
        number_at.try_emplace(key_of(place), static_cast<int>(net.places.size()));
    if (is_new) net.places.push_back(place);
    return entry->second;
  };
  constexpr std::int64_t thirds = 3;
  const std::array<std::array<LatticeVector, 3>, 2> corners = {
      {{LatticeVector(0, 0), LatticeVector(1, 0), LatticeVector(0, 1)},
       {LatticeVector(1, 0), LatticeVector(1, 1), LatticeVector(0, 1)}}};
  for (int t = 0; 3 * t < n_halfedges(); ++t) {
    const auto owns = [&](const LatticeVector& p) {
      for (int h = 3 * t; h < 3 * t + 3; ++h) {
        const std::int64_t left = area_of(side(h), p - thirds * corner(h));
        if (left < 0 || (left == 0 && h > opposite(h))) return false;
      }
      return true;
    };
    const LatticeVector a = corner(3 * t + 1);
    const LatticeVector b = corner(3 * t + 2);
    const LatticeVector low = a.cwiseMin(b).cwiseMin(LatticeVector::Zero());
    const LatticeVector high = a.cwiseMax(b).cwiseMax(LatticeVector::Zero());
    for (std::int64_t y = low.y() - 1; y <= high.y(); ++y) {
      for (std::int64_t x = low.x() - 1; x <= high.x(); ++x) {
        for (std::size_t down = 0; down < 2; ++down) {
          const auto third = static_cast<std::int64_t>(down + 1);
          const LatticeVector center(thirds * x + third, thirds * y + third);
          if (!owns(center)) continue;
          std::array<int, 3> triangle{};
          for (std::size_t k = 0; k < 3; ++k) {
            const LatticeVector end = thirds * (LatticeVector(x, y) + corners[down][k]);
            const Place place = walk({t, center}, end, thirds);
            triangle[k] = number({place.triangle, place.at / thirds});
          }
          net.triangles.push_back(triangle);
          net.first_edges.push_back({t, corners[down][1] - corners[down][0]});
        }
      }
    }
  }
  return net;
}

ConeNet::Mean ConeNet::mean_at(const ConeNet& moved, const Place& place) const {
  const int h = 3 * place.triangle;
  const LatticeVector a = moved.side(h);
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
