/// How a cone net comes from a net: all flat vertices are taken out of its metric.
#include <algorithm>

#include "crystal/cone_net.h"
#include "crystal/defect_moves.h"
#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

namespace {

/// Of a vertex that can be taken out: its triangles become one.
constexpr int removable_degree = 3;

}  // namespace

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
  const int back = -turn(h);
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
    back -= turn(previous(spokes[k]));
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

/// Flips one of the sides at a vertex of so many.
bool ConeNet::lower_degree(int v, int degree) {
  // What is removed next may lie on a side.
  const bool is_last = degree == removable_degree + 1;
  const int min_area = is_last && is_inside_star(outgoing_[index(v)]) ? 0 : 1;
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
  // Where a vertex is a neighbor of itself, others must go first.
  std::size_t before = left.size() + 1;
  while (!left.empty() && left.size() < before) {
    before = left.size();
    std::erase_if(left, [&](int v) {
      int degree = degree_of(outgoing_[index(v)]);
      while (degree > removable_degree && lower_degree(v, degree)) --degree;
      return degree == removable_degree && remove_vertex(outgoing_[index(v)]);
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

}  // namespace trivalent::remesh
