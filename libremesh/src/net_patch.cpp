#include "net_patch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "spring_step.h"

namespace trivalent::remesh {

NetPatch::NetPatch(const ConstrainedMesh& constrained, VertexHandle center, int rings,
                   PatchMarks& marks) {
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
    place(i, (mesh.point(v) - origin_).cast<float>());
    ring_[at(i)].fill(static_cast<std::uint8_t>(i));
    on_feature_[at(i)] = anchor.kind != FeatureKind::none;
    open_[at(i)] = mesh.is_boundary(v);
    goal_[at(i)] = open_[at(i)] ? 4 : 6;
    valence_[at(i)] = 0;
    mobility_[at(i)] = 0;
    if (i >= inside) continue;
    const MotionFrame frame = motion_frame(constrained, v);
    mobility_[at(i)] = static_cast<std::uint8_t>(frame.freedoms);
    normal_[at(i)] = frame.normal.cast<float>();
    first_[at(i)] = frame.first.cast<float>();
    second_[at(i)] = frame.second.cast<float>();
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
  if (!on_feature_[at(kept)]) place(kept, 0.5F * (at_origin(kept) + at_origin(removed)));
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
  place(n, 0.5F * (at_origin(a) + at_origin(b)));
  normal_[at(n)] = (normal_[at(a)] + normal_[at(b)]).normalized();
  first_[at(n)] = normal_[at(n)].unitOrthogonal();
  second_[at(n)] = normal_[at(n)].cross(first_[at(n)]);
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
        const double length = (at_origin(c) - at_origin(d)).squaredNorm();
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

NetPatch::Spokes NetPatch::spokes_of(int i) const {
  Spokes s;
  const Ring& ring = ring_[at(i)];
  for (int k = 0; k < most_neighbors; ++k) {
    s.x[k] = x_[ring[at(k)]];
    s.y[k] = y_[ring[at(k)]];
    s.z[k] = z_[ring[at(k)]];
  }
  s.x -= x_[at(i)];
  s.y -= y_[at(i)];
  s.z -= z_[at(i)];
  return s;
}

namespace {
/// 1 for the first n lanes, 0 for the others.
struct LaneMasks {
  std::array<Eigen::Array<float, 8, 1>, 9> masks;
  LaneMasks() {
    for (int n = 0; n <= 8; ++n)
      for (int k = 0; k < 8; ++k) masks[static_cast<std::size_t>(n)][k] = k < n ? 1.0F : 0.0F;
  }
};
const LaneMasks lane_masks;
}  // namespace

void NetPatch::relax(double length, int sweeps, int reach) {
  const auto rest = static_cast<float>(length);
  const float longest_step = static_cast<float>(longest_spring_step) * rest;
  constexpr auto over = static_cast<float>(spring_overrelaxation);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (int i = 0; i < count_; ++i) {
      if (i == reach && vertex_[at(i)].is_valid()) {
        while (i < count_ && vertex_[at(i)].is_valid()) ++i;
        if (i == count_) break;
      }
      if (!is_inside(i) || mobility_[at(i)] == 0) continue;
      const Lanes& mask = lane_masks.masks[valence_[at(i)]];
      const Spokes d = spokes_of(i);
      const Eigen::Vector3f& t1 = first_[at(i)];
      const Eigen::Vector3f& t2 = second_[at(i)];
      const Lanes inverse_length =
          mask / (d.x * d.x + d.y * d.y + d.z * d.z + 1e-12F * rest * rest).sqrt();
      const Lanes slack = mask - rest * inverse_length;  // < 0: pressed
      const Lanes along_1 = d.x * t1.x() + d.y * t1.y() + d.z * t1.z();
      const Lanes along_2 = d.x * t2.x() + d.y * t2.y() + d.z * t2.z();
      const Lanes across = slack.max(0.0F);
      const Lanes x = along_1 * inverse_length;
      const Lanes y = along_2 * inverse_length;
      const Lanes along = mask - across;
      const float g1 = (slack * along_1).sum();
      const float h11 = (across + along * x * x).sum();
      Eigen::Vector3f step;
      if (mobility_[at(i)] == 1) {
        step = g1 / h11 * t1;
      } else {
        const float g2 = (slack * along_2).sum();
        const float h12 = (along * x * y).sum();
        const float h22 = (across + along * y * y).sum();
        const float factor = over / (h11 * h22 - h12 * h12);
        step = factor * (h22 * g1 - h12 * g2) * t1 + factor * (h11 * g2 - h12 * g1) * t2;
      }
      const float size = step.norm();
      if (!(size < 10.0F * rest)) continue;
      if (size > longest_step) step *= longest_step / size;
      place(i, at_origin(i) + step);
    }
  }
}

double NetPatch::strain(double length) const {
  const auto inverse = static_cast<float>(1.0 / length);
  double sum = 0.0;
  for (int i = 0; i < count_; ++i) {
    const int n = valence_[at(i)];
    if (n == 0) continue;
    const Spokes d = spokes_of(i);
    const Lanes stretch = (d.x * d.x + d.y * d.y + d.z * d.z).sqrt() * inverse - 1.0F;
    const Lanes squared = stretch * stretch;
    for (int k = 0; k < n; ++k) {
      sum += is_inside(ring_[at(i)][at(k)]) ? 0.5F * squared[k] : squared[k];
    }
  }
  return sum;
}

bool NetPatch::is_upright() const {
  for (int i = 0; i < count_; ++i) {
    if (!is_inside(i) || mobility_[at(i)] == 0) continue;
    const int n = valence_[at(i)];
    for (int k = 0; k < (open_[at(i)] ? n - 1 : n); ++k) {
      const Eigen::Vector3f b = at_origin(ring_[at(i)][at(k)]) - at_origin(i);
      const Eigen::Vector3f c = at_origin(ring_[at(i)][at(k + 1 == n ? 0 : k + 1)]) - at_origin(i);
      const Eigen::Vector3f area = b.cross(c);
      if (area.dot(normal_[at(i)]) <= 0.2F * std::max(b.squaredNorm(), c.squaredNorm()))
        return false;
    }
  }
  return true;
}

}  // namespace trivalent::remesh
