#include "crystal/net_patch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace trivalent::remesh {

NetPatch::NetPatch(const ConstrainedMesh& constrained, const std::vector<MotionFrame>& frames,
                   VertexHandle center, int rings, PatchMarks& marks) {
  const TriMesh& mesh = constrained.mesh;
  marks.begin(mesh.n_vertices());
  const auto add = [&](VertexHandle v) {
    if (count_ + 4 >= capacity) {  // room for splits
      whole_ = false;
      return;
    }
    marks.set(v, count_);
    vertex_[at(count_)] = v;
    ++count_;
  };
  origin_ = mesh.point(center);
  add(center);
  int ring_begin = 0;
  int inside = 0;
  for (int ring = 0; ring <= rings && whole_; ++ring) {
    const int ring_end = count_;
    for (int i = ring_begin; i < ring_end; ++i) {
      for (auto h = mesh.halfedge_handle(vertex_[at(i)]), first = h;;) {
        const VertexHandle to = mesh.to_vertex_handle(h);
        if (marks.number(to) < 0) add(to);
        if (!whole_) return;
        h = mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(h));
        if (h == first) break;
      }
    }
    inside = ring_end;
    ring_end_[at(ring)] = ring_end;
    ring_begin = ring_end;
  }
  for (int i = 0; i < count_; ++i) {
    const VertexHandle v = vertex_[at(i)];
    const Anchor& anchor = constrained.anchor(v);
    place_[at(i)] = in_lanes(mesh.point(v) - origin_);
    ring_[at(i)].fill(static_cast<std::uint8_t>(i));
    on_feature_[at(i)] = anchor.kind != FeatureKind::none;
    open_[at(i)] = mesh.is_boundary(v);
    goal_[at(i)] = open_[at(i)] ? 4 : 6;
    valence_[at(i)] = 0;
    mobility_[at(i)] = 0;
    if (i >= inside) continue;
    const MotionFrame& frame = frames[index(v)];
    mobility_[at(i)] = static_cast<std::uint8_t>(frame.freedoms);
    normal_[at(i)] = in_lanes(frame.normal);
    first_[at(i)] = in_lanes(frame.first);
    second_[at(i)] = in_lanes(frame.second);
    // The first halfedge of a boundary vertex is its boundary one: what follows counter-clockwise
    // ends at the other boundary neighbor.
    auto h = mesh.halfedge_handle(v);
    const auto first = h;
    if (open_[at(i)]) h = mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(h));
    const auto begin = open_[at(i)] ? h : first;
    int k = 0;
    do {
      if (k == most_neighbors) {
        whole_ = false;
        return;
      }
      ring_[at(i)][at(k++)] = static_cast<std::uint8_t>(marks.number(mesh.to_vertex_handle(h)));
      h = mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(h));
    } while (h != begin);
    valence_[at(i)] = static_cast<std::uint8_t>(k);
  }
}

int NetPatch::disorder() const {
  int sum = 0;
  for (int i = 0; i < count_; ++i) {
    if (is_inside(i)) sum += deviation(i) * deviation(i);
  }
  return sum;
}

int NetPatch::place_in_ring(int v, int neighbor) const {
  for (int k = 0; k < valence_[at(v)]; ++k) {
    if (ring_[at(v)][at(k)] == neighbor) return k;
  }
  return -1;
}

/// The neighbor that follows counter-clockwise, or -1 where the ring ends.
int NetPatch::next_in_ring(int v, int neighbor) const {
  const int k = place_in_ring(v, neighbor) + 1;
  if (k < valence_[at(v)]) return ring_[at(v)][at(k)];
  return open_[at(v)] ? -1 : ring_[at(v)][0];
}

int NetPatch::previous_in_ring(int v, int neighbor) const {
  const int k = place_in_ring(v, neighbor) - 1;
  if (k >= 0) return ring_[at(v)][at(k)];
  return open_[at(v)] ? -1 : ring_[at(v)][at(valence_[at(v)] - 1)];
}

void NetPatch::remove_from_ring(int v, int neighbor) {
  Ring& ring = ring_[at(v)];
  const auto end = ring.begin() + valence_[at(v)];
  std::copy(ring.begin() + place_in_ring(v, neighbor) + 1, end,
            ring.begin() + place_in_ring(v, neighbor));
  --valence_[at(v)];
}

void NetPatch::insert_after(int v, int neighbor, int inserted) {
  Ring& ring = ring_[at(v)];
  const auto place = ring.begin() + place_in_ring(v, neighbor) + 1;
  const auto end = ring.begin() + valence_[at(v)];
  std::copy_backward(place, end, end + 1);
  *place = static_cast<std::uint8_t>(inserted);
  ++valence_[at(v)];
}

bool NetPatch::flip(int a, int b) {
  if (!is_inside(a) || !is_inside(b) || is_rigid(a, b)) return false;
  const int c = next_in_ring(a, b);
  const int d = previous_in_ring(a, b);
  if (c < 0 || d < 0 || !is_inside(c) || !is_inside(d)) return false;
  if (place_in_ring(c, d) >= 0) return false;
  if (valence_[at(a)] <= 4 || valence_[at(b)] <= 4) return false;
  if (valence_[at(c)] >= most_neighbors || valence_[at(d)] >= most_neighbors) return false;
  remove_from_ring(a, b);
  remove_from_ring(b, a);
  insert_after(c, a, d);
  insert_after(d, b, c);
  changes_.push_back(
      {PatchChange::Kind::flip, static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b)});
  return true;
}

bool NetPatch::collapse(int removed, int kept) {
  if (!is_inside(removed) || !is_inside(kept) || on_feature_[at(removed)]) return false;
  const int c = next_in_ring(removed, kept);
  const int d = previous_in_ring(removed, kept);
  int common = 0;
  for (int k = 0; k < valence_[at(removed)]; ++k) {
    const int u = ring_[at(removed)][at(k)];
    if (!is_inside(u)) return false;
    if (place_in_ring(kept, u) >= 0) ++common;
  }
  if (common != 2 || valence_[at(c)] <= 4 || valence_[at(d)] <= 4) return false;
  if (valence_[at(kept)] + valence_[at(removed)] - 4 > most_neighbors) return false;
  for (const int u : {c, d, kept}) remove_from_ring(u, removed);
  int last = c;
  for (int u = next_in_ring(removed, c); u != d; u = next_in_ring(removed, u)) {
    ring_[at(u)][at(place_in_ring(u, removed))] = static_cast<std::uint8_t>(kept);
    insert_after(kept, last, u);
    last = u;
  }
  valence_[at(removed)] = 0;
  if (!on_feature_[at(kept)]) place_[at(kept)] = 0.5F * (place_[at(kept)] + place_[at(removed)]);
  changes_.push_back({PatchChange::Kind::collapse, static_cast<std::uint8_t>(removed),
                      static_cast<std::uint8_t>(kept)});
  return true;
}

bool NetPatch::split(int a, int b) {
  if (!is_inside(a) || !is_inside(b) || is_rigid(a, b) || count_ == capacity) return false;
  const int c = next_in_ring(a, b);
  const int d = previous_in_ring(a, b);
  if (c < 0 || d < 0 || !is_inside(c) || !is_inside(d)) return false;
  if (valence_[at(c)] >= most_neighbors || valence_[at(d)] >= most_neighbors) return false;
  const int n = count_++;
  vertex_[at(n)] = VertexHandle();
  place_[at(n)] = 0.5F * (place_[at(a)] + place_[at(b)]);
  normal_[at(n)] = (normal_[at(a)] + normal_[at(b)]).normalized();
  const Eigen::Vector3d normal = normal_[at(n)].cast<double>().head<3>();
  first_[at(n)] = in_lanes(normal.unitOrthogonal());
  second_[at(n)] = normal_[at(n)].cross3(first_[at(n)]);
  mobility_[at(n)] = 2;
  on_feature_[at(n)] = false;
  open_[at(n)] = false;
  goal_[at(n)] = 6;
  valence_[at(n)] = 4;
  ring_[at(n)] = {static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(c),
                  static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(d)};
  ring_[at(a)][at(place_in_ring(a, b))] = static_cast<std::uint8_t>(n);
  ring_[at(b)][at(place_in_ring(b, a))] = static_cast<std::uint8_t>(n);
  insert_after(c, a, n);
  insert_after(d, b, n);
  changes_.push_back(
      {PatchChange::Kind::split, static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b)});
  return true;
}

void NetPatch::mend_valences() {
  while (true) {
    int best_gain = 0;
    double best_length = 0.0;
    int best_a = -1;
    int best_b = -1;
    for (int a = 0; a < count_; ++a) {
      if (!is_inside(a) || deviation(a) <= 0) continue;
      for (int k = 0; k < valence_[at(a)]; ++k) {
        const int b = ring_[at(a)][at(k)];
        if (!is_inside(b) || is_rigid(a, b) || valence_[at(b)] <= 4) continue;
        const int c = next_in_ring(a, b);
        const int d = previous_in_ring(a, b);
        if (c < 0 || d < 0 || !is_inside(c) || !is_inside(d) || place_in_ring(c, d) >= 0) continue;
        const int gain = 2 * (deviation(a) + deviation(b) - deviation(c) - deviation(d)) - 4;
        if (gain <= 0 || gain < best_gain) continue;
        const double length = (place_[at(c)] - place_[at(d)]).squaredNorm();
        if (gain == best_gain && length >= best_length) continue;
        best_gain = gain;
        best_length = length;
        best_a = a;
        best_b = b;
      }
    }
    if (best_gain == 0 || !flip(best_a, best_b)) return;
  }
}

namespace {

using FourLanes = Eigen::Array4f;

/// Edges from one place to four others, one per lane: their components, and which of them count.
struct Spokes {
  FourLanes x, y, z, counts;

  [[nodiscard]] FourLanes squared_length() const { return x * x + y * y + z * z; }
  [[nodiscard]] FourLanes along(const Eigen::Vector4f& t) const {
    return x * t.x() + y * t.y() + z * t.z();
  }
};

/// Spokes number `first` to `first` + 3 of a vertex.
template <typename Ring>
[[gnu::always_inline]] inline Spokes spokes_from(const Eigen::Vector4f& center, const Ring& ring,
                                                 int valence, int first,
                                                 const Eigen::Vector4f* places) {
  constexpr std::array<float, 8> mask = {1.0F, 1.0F, 1.0F, 1.0F, 0.0F, 0.0F, 0.0F, 0.0F};
  Eigen::Matrix4f edges;
  for (int k = 0; k < 4; ++k) {
    edges.col(k) = places[ring[static_cast<std::size_t>(first + k)]] - center;
  }
  edges.transposeInPlace();
  const int idle = std::clamp(first + 4 - valence, 0, 4);
  return {edges.col(0).array(), edges.col(1).array(), edges.col(2).array(),
          FourLanes::Map(mask.data() + idle)};
}

/// The sums over the lanes of four terms.
Eigen::Vector4f lane_sums(const FourLanes& a, const FourLanes& b, const FourLanes& c,
                          const FourLanes& d) {
  Eigen::Matrix4f terms;
  terms << a.matrix(), b.matrix(), c.matrix(), d.matrix();
  terms.transposeInPlace();
  return (terms.col(0) + terms.col(1)) + (terms.col(2) + terms.col(3));
}

}  // namespace

/// SpringStep, for four edges at a time.
NetPatch::Vector NetPatch::spring_step(int i, float rest) const {
  constexpr auto over = static_cast<float>(spring_overrelaxation);
  const Vector& t1 = first_[at(i)];
  const Vector& t2 = second_[at(i)];
  FourLanes pull_1 = FourLanes::Zero();
  FourLanes pull_2 = FourLanes::Zero();
  FourLanes stiffness_11 = FourLanes::Zero();
  FourLanes stiffness_12 = FourLanes::Zero();
  FourLanes stiffness_22 = FourLanes::Zero();
  for (int first = 0; first < valence_[at(i)]; first += 4) {
    const Spokes d =
        spokes_from(place_[at(i)], ring_[at(i)], valence_[at(i)], first, place_.data());
    const FourLanes inverse = d.counts / (d.squared_length() + 1e-12F * rest * rest).sqrt();
    const FourLanes slack = d.counts - rest * inverse;  // < 0: pressed
    const FourLanes along_1 = d.along(t1);
    const FourLanes along_2 = d.along(t2);
    const FourLanes across = slack.max(0.0F);
    const FourLanes along = (d.counts - across) * inverse * inverse;
    pull_1 += slack * along_1;
    pull_2 += slack * along_2;
    stiffness_11 += across + along * along_1 * along_1;
    stiffness_12 += along * along_1 * along_2;
    stiffness_22 += across + along * along_2 * along_2;
  }
  const Eigen::Vector4f sums = lane_sums(pull_1, pull_2, stiffness_11, stiffness_22);
  if (mobility_[at(i)] == 1) return sums[0] / sums[2] * t1;
  const float h12 = stiffness_12.sum();
  const float factor = over / (sums[2] * sums[3] - h12 * h12);
  return factor * (sums[3] * sums[0] - h12 * sums[1]) * t1 +
         factor * (sums[2] * sums[1] - h12 * sums[0]) * t2;
}

void NetPatch::relax(double length, int sweeps, int reach) {
  const auto rest = static_cast<float>(length);
  const float longest_step = static_cast<float>(longest_spring_step) * rest;
  // Every other one, then the others: a vertex is seldom next to the one before and need not wait
  // for it in the processor.
  std::array<std::uint8_t, capacity> movers;
  int n_movers = 0;
  for (const int parity : {0, 1}) {
    for (int i = parity; i < count_; i += 2) {
      if (i >= reach && vertex_[at(i)].is_valid()) continue;
      if (is_free(i)) movers[at(n_movers++)] = static_cast<std::uint8_t>(i);
    }
  }
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (int k = 0; k < n_movers; ++k) {
      const int i = movers[at(k)];
      Vector step = spring_step(i, rest);
      const float squared = step.squaredNorm();
      if (!(squared < 100.0F * rest * rest)) continue;
      if (squared > longest_step * longest_step) step *= longest_step / std::sqrt(squared);
      place_[at(i)] += step;
    }
  }
}

double NetPatch::strain(double length) const {
  const auto inverse = static_cast<float>(1.0 / length);
  double sum = 0.0;
  for (int i = 0; i < count_; ++i) {
    for (int first = 0; first < valence_[at(i)]; first += 4) {
      const Spokes d =
          spokes_from(place_[at(i)], ring_[at(i)], valence_[at(i)], first, place_.data());
      const FourLanes stretch = d.squared_length().sqrt() * inverse - 1.0F;
      // An edge between two vertices inside is met from both.
      FourLanes weights = d.counts;
      for (int k = 0; k < 4; ++k) {
        if (is_inside(ring_[at(i)][at(first + k)])) weights[k] *= 0.5F;
      }
      sum += (weights * stretch * stretch).sum();
    }
  }
  return sum;
}

int NetPatch::steep_corners() const {
  int steep = 0;
  for (int i = 0; i < count_; ++i) {
    if (!is_inside(i) || mobility_[at(i)] == 0) continue;
    const int n = valence_[at(i)];
    for (int k = 0; k < (open_[at(i)] ? n - 1 : n); ++k) {
      const Vector b = place_[ring_[at(i)][at(k)]] - place_[at(i)];
      const Vector c = place_[ring_[at(i)][at(k + 1 == n ? 0 : k + 1)]] - place_[at(i)];
      const Vector area = b.cross3(c);
      if (area.dot(normal_[at(i)]) <= 0.2F * std::max(b.squaredNorm(), c.squaredNorm())) ++steep;
    }
  }
  return steep;
}

}  // namespace trivalent::remesh
