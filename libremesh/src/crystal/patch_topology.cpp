#include "crystal/patch_topology.h"

#include <algorithm>
#include <span>

#include "mesh/geometry.h"

namespace trivalent::remesh {

namespace {

/// The next halfedge that leaves the same vertex, counter-clockwise.
HalfedgeHandle next_spoke(const TriMesh& mesh, HalfedgeHandle h) {
  return mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(h));
}

/// Of vertices that have lost an edge.
constexpr int min_valence = 4;
constexpr int min_boundary_valence = 3;

}  // namespace

PatchTopology::PatchTopology(const ConstrainedMesh& constrained, VertexHandle center,
                             PatchReach reach, PatchMarks& marks) {
  const TriMesh& mesh = constrained.mesh;
  collect(mesh, center, reach, marks);
  if (!whole_) return;
  for (int i = 0; i < count_; ++i) {
    const VertexHandle v = vertex_[at(i)];
    ring_[at(i)].fill(static_cast<std::uint8_t>(i));
    valence_[at(i)] = 0;
    on_feature_[at(i)] = v.is_valid() && constrained.anchor(v).kind != FeatureKind::none;
    is_corner_[at(i)] = v.is_valid() && constrained.anchor(v).kind == FeatureKind::corner;
    open_[at(i)] = v.is_valid() && mesh.is_boundary(v);
    goal_[at(i)] = open_[at(i)] ? 4 : 6;
    if (!v.is_valid() || i >= ring_end_[at(reach.known)]) continue;
    whole_ = find_ring(mesh, i, marks);
    if (!whole_) return;
  }
}

void PatchTopology::collect(const TriMesh& mesh, VertexHandle center, PatchReach reach,
                            PatchMarks& marks) {
  marks.begin(mesh.n_vertices());
  add(center, marks);
  int ring_begin = 0;
  for (int ring = 0; ring <= reach.known; ++ring) {
    if (ring == reach.inner + 1) ring_begin = inner_;
    const int ring_end = count_;
    ring_end_[at(ring)] = ring_end;
    if (ring == reach.inner) {
      inner_ = ring_end + 1;
      if (count_ == capacity) return;
      vertex_[at(count_++)] = VertexHandle();
    }
    for (int i = ring_begin; i < ring_end; ++i) {
      for (auto h = mesh.halfedge_handle(vertex_[at(i)]), first = h;;) {
        const VertexHandle to = mesh.to_vertex_handle(h);
        if (marks.number(to) < 0 && !add(to, marks)) return;
        h = next_spoke(mesh, h);
        if (h == first) break;
      }
    }
    ring_begin = ring_end;
  }
  whole_ = true;
}

bool PatchTopology::add(VertexHandle v, PatchMarks& marks) {
  if (count_ == capacity) return false;
  marks.set(v, count_);
  vertex_[at(count_++)] = v;
  return true;
}

bool PatchTopology::find_ring(const TriMesh& mesh, int i, const PatchMarks& marks) {
  // The first halfedge of a boundary vertex is its boundary one: what follows counter-clockwise
  // ends at the other boundary neighbor.
  HalfedgeHandle h = mesh.halfedge_handle(vertex_[at(i)]);
  if (open_[at(i)]) h = next_spoke(mesh, h);
  const HalfedgeHandle begin = h;
  int k = 0;
  do {
    if (k == max_valence) return false;
    ring_[at(i)][at(k++)] = static_cast<std::uint8_t>(marks.number(mesh.to_vertex_handle(h)));
    h = next_spoke(mesh, h);
  } while (h != begin);
  valence_[at(i)] = static_cast<std::uint8_t>(k);
  return true;
}

int PatchTopology::disorder() const {
  int sum = 0;
  for (int i = 0; i < inner_; ++i) {
    if (is_inside(i)) sum += deviation(i) * deviation(i);
  }
  return sum;
}

int PatchTopology::place_in_ring(int v, int neighbor) const {
  for (int k = 0; k < valence_[at(v)]; ++k) {
    if (ring_[at(v)][at(k)] == neighbor) return k;
  }
  return -1;
}

int PatchTopology::next_in_ring(int v, int neighbor) const {
  const int k = place_in_ring(v, neighbor) + 1;
  if (k < valence_[at(v)]) return ring_[at(v)][at(k)];
  return open_[at(v)] ? -1 : ring_[at(v)][0];
}

int PatchTopology::previous_in_ring(int v, int neighbor) const {
  const int k = place_in_ring(v, neighbor) - 1;
  if (k >= 0) return ring_[at(v)][at(k)];
  return open_[at(v)] ? -1 : ring_[at(v)][at(valence_[at(v)] - 1)];
}

void PatchTopology::remove_from_ring(int v, int neighbor) {
  Ring& ring = ring_[at(v)];
  const auto end = ring.begin() + valence_[at(v)];
  std::copy(ring.begin() + place_in_ring(v, neighbor) + 1, end,
            ring.begin() + place_in_ring(v, neighbor));
  --valence_[at(v)];
}

void PatchTopology::insert_at(int v, int place, int inserted) {
  Ring& ring = ring_[at(v)];
  const auto begin = ring.begin() + place;
  const auto end = ring.begin() + valence_[at(v)];
  std::copy_backward(begin, end, end + 1);
  *begin = static_cast<std::uint8_t>(inserted);
  ++valence_[at(v)];
}

void PatchTopology::insert_after(int v, int neighbor, int inserted) {
  insert_at(v, place_in_ring(v, neighbor) + 1, inserted);
}

void PatchTopology::replace_in_ring(int v, int neighbor, int by) {
  ring_[at(v)][at(place_in_ring(v, neighbor))] = static_cast<std::uint8_t>(by);
}

bool PatchTopology::can_lose_edge(int v) const {
  return valence_[at(v)] > (open_[at(v)] ? min_boundary_valence : min_valence);
}

void PatchTopology::record(PatchChange::Kind kind, int from, int to) {
  changes_.push_back({kind, static_cast<std::uint8_t>(from), static_cast<std::uint8_t>(to)});
}

bool PatchTopology::flip(int a, int b) {
  if (!is_inside(a) || !is_inside(b) || is_rigid(a, b)) return false;
  const int c = next_in_ring(a, b);
  const int d = previous_in_ring(a, b);
  if (c < 0 || d < 0 || !is_inside(c) || !is_inside(d)) return false;
  if (is_neighbor(c, d)) return false;
  if (!can_lose_edge(a) || !can_lose_edge(b)) return false;
  if (valence_[at(c)] >= max_valence || valence_[at(d)] >= max_valence) return false;
  remove_from_ring(a, b);
  remove_from_ring(b, a);
  insert_after(c, a, d);
  insert_after(d, b, c);
  record(PatchChange::Kind::flip, a, b);
  return true;
}

bool PatchTopology::collapse(int removed, int kept) {
  if (!is_inside(removed) || !is_inside(kept)) return false;
  if (open_[at(removed)] && open_[at(kept)]) return collapse_on_boundary(removed, kept);
  if (on_feature_[at(removed)]) return false;
  const int c = next_in_ring(removed, kept);
  const int d = previous_in_ring(removed, kept);
  int common = 0;
  for (int k = 0; k < valence_[at(removed)]; ++k) {
    const int u = ring_[at(removed)][at(k)];
    if (!is_inside(u)) return false;
    if (is_neighbor(kept, u)) ++common;
  }
  if (common != 2 || !can_lose_edge(c) || !can_lose_edge(d)) return false;
  if (valence_[at(kept)] + valence_[at(removed)] - 4 > max_valence) return false;
  for (const int u : {c, d, kept}) remove_from_ring(u, removed);
  int last = c;
  for (int u = next_in_ring(removed, c); u != d; u = next_in_ring(removed, u)) {
    replace_in_ring(u, removed, kept);
    insert_after(kept, last, u);
    last = u;
  }
  valence_[at(removed)] = 0;
  added_faces_ -= 2;
  record(PatchChange::Kind::collapse, removed, kept);
  return true;
}

bool PatchTopology::can_collapse_on_boundary(int removed, int kept, int third) const {
  const int n = valence_[at(removed)];
  if (is_corner_[at(removed)] || !can_lose_edge(third)) return false;
  if (n < min_boundary_valence || valence_[at(kept)] < min_boundary_valence) return false;
  if (valence_[at(kept)] + n - 3 > max_valence) return false;
  const std::span around(ring_[at(removed)].begin(), at(n));
  return std::ranges::all_of(
      around, [&](int u) { return is_inside(u) && (u == third || !is_neighbor(kept, u)); });
}

bool PatchTopology::collapse_on_boundary(int removed, int kept) {
  const int c = next_in_ring(removed, kept);
  const int d = previous_in_ring(removed, kept);
  if ((c < 0) == (d < 0)) return false;  // an edge inside
  const int third = c < 0 ? d : c;
  if (!can_collapse_on_boundary(removed, kept, third)) return false;
  remove_from_ring(third, removed);
  remove_from_ring(kept, removed);
  // The other neighbors go to `kept`, from the collapsed face on.
  int last = third;
  for (int u = third;;) {
    u = d < 0 ? next_in_ring(removed, u) : previous_in_ring(removed, u);
    if (u < 0) break;
    replace_in_ring(u, removed, kept);
    insert_at(kept, place_in_ring(kept, last) + (d < 0 ? 1 : 0), u);
    last = u;
  }
  valence_[at(removed)] = 0;
  added_faces_ -= 1;
  record(PatchChange::Kind::collapse, removed, kept);
  return true;
}

bool PatchTopology::split_on_boundary(int a, int b) {
  const int n = added();
  if (previous_in_ring(a, b) >= 0) std::swap(a, b);  // the face is on the left of a-b
  const int c = next_in_ring(a, b);
  if (c < 0 || !is_inside(c) || valence_[at(c)] >= max_valence) return false;
  valence_[at(n)] = 3;
  ring_[at(n)] = {static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(c),
                  static_cast<std::uint8_t>(a)};
  open_[at(n)] = true;
  on_feature_[at(n)] = true;
  goal_[at(n)] = 4;
  replace_in_ring(a, b, n);
  replace_in_ring(b, a, n);
  insert_after(c, a, n);
  added_faces_ += 1;
  record(PatchChange::Kind::split, a, b);
  return true;
}

bool PatchTopology::split(int a, int b) {
  const int n = added();
  if (!is_inside(a) || !is_inside(b) || is_inside(n)) return false;
  const int c = next_in_ring(a, b);
  const int d = previous_in_ring(a, b);
  if ((c < 0) != (d < 0)) return split_on_boundary(a, b);
  if (is_rigid(a, b) || c < 0 || !is_inside(c) || !is_inside(d)) return false;
  if (valence_[at(c)] >= max_valence || valence_[at(d)] >= max_valence) return false;
  valence_[at(n)] = 4;
  ring_[at(n)] = {static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(c),
                  static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(d)};
  replace_in_ring(a, b, n);
  replace_in_ring(b, a, n);
  insert_after(c, a, n);
  insert_after(d, b, n);
  added_faces_ += 2;
  record(PatchChange::Kind::split, a, b);
  return true;
}

int PatchTopology::gain_of_flip(int a, int b, int c, int d) const {
  return 2 * (deviation(a) + deviation(b) - deviation(c) - deviation(d)) - 4;
}

std::optional<PatchTopology::MendingFlip> PatchTopology::mending_flip(
    const std::function<double(int, int)>& squared_distance) const {
  std::optional<MendingFlip> best;
  int best_gain = 0;
  double best_distance = 0.0;
  for (int a = 0; a < inner_; ++a) {
    if (!is_inside(a) || deviation(a) <= 0) continue;
    for (int k = 0; k < valence_[at(a)]; ++k) {
      const int b = ring_[at(a)][at(k)];
      if (!is_inside(b) || is_rigid(a, b) || !can_lose_edge(b)) continue;
      const int c = next_in_ring(a, b);
      const int d = previous_in_ring(a, b);
      if (c < 0 || d < 0 || !is_inside(c) || !is_inside(d) || is_neighbor(c, d)) continue;
      if (valence_[at(c)] >= max_valence || valence_[at(d)] >= max_valence) continue;
      const int gain = gain_of_flip(a, b, c, d);
      if (gain <= 0 || gain < best_gain) continue;
      const double distance = squared_distance(c, d);
      if (gain == best_gain && distance >= best_distance) continue;
      best_gain = gain;
      best_distance = distance;
      best = {a, b};
    }
  }
  return best;
}

std::vector<Eigen::Vector3d> unfolded_positions(const TriMesh& mesh,
                                                const PatchTopology& topology) {
  const auto n = static_cast<std::size_t>(topology.size());
  std::vector<Eigen::Vector3d> positions(n, Eigen::Vector3d::Zero());
  std::vector<char> is_known(n, 0);
  const auto place = [&](int i, const Eigen::Vector3d& beside) {
    const auto k = static_cast<std::size_t>(i);
    if (is_known[k] != 0) return;
    positions[k] = mesh.lattice.near(beside, mesh.point(topology.vertex(i)));
    is_known[k] = 1;
  };
  place(0, mesh.point(topology.vertex(0)));
  for (int i = 0; i < topology.size(); ++i) {
    for (int k = 0; k < topology.valence(i); ++k) {
      place(topology.neighbor(i, k), positions[static_cast<std::size_t>(i)]);
    }
  }
  return positions;
}

bool meets_itself(const TriMesh& mesh, const PatchTopology& topology,
                  const std::vector<Eigen::Vector3d>& positions) {
  if (!mesh.lattice.is_periodic()) return false;
  for (int i = 0; i < topology.size(); ++i) {
    for (int k = 0; k < topology.valence(i); ++k) {
      const auto j = static_cast<std::size_t>(topology.neighbor(i, k));
      if (!mesh.lattice.is_nearest(positions[j] - positions[static_cast<std::size_t>(i)]))
        return true;
    }
  }
  return false;
}

}  // namespace trivalent::remesh
