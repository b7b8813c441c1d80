#include "crystal/net_patch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace trivalent::remesh {

NetPatch::NetPatch(const ConstrainedMesh& constrained, const std::vector<MotionFrame>& frames,
                   VertexHandle center, int rings, PatchMarks& marks)
    : topology_(constrained, center, {.inner = rings, .known = rings}, marks),
      origin_(constrained.mesh.point(center)) {
  if (!is_whole()) return;
  const std::vector<Eigen::Vector3d> positions = unfolded_positions(constrained.mesh, topology_);
  meets_itself_ = meets_itself(constrained.mesh, topology_, positions);
  for (int i = 0; i < topology_.size(); ++i) {
    mobility_[at(i)] = 0;
    place_[at(i)] = Vector::Zero();
    const VertexHandle v = topology_.vertex(i);
    if (!v.is_valid()) continue;
    place_[at(i)] = in_lanes(positions[at(i)] - origin_);
    if (!topology_.is_inside(i)) continue;
    const MotionFrame& frame = frames[index(v)];
    mobility_[at(i)] = static_cast<std::uint8_t>(frame.freedoms);
    normal_[at(i)] = in_lanes(frame.normal);
    first_[at(i)] = in_lanes(frame.first);
    second_[at(i)] = in_lanes(frame.second);
  }
}

bool NetPatch::collapse(int removed, int kept) {
  if (!topology_.collapse(removed, kept)) return false;
  if (topology_.is_on_feature(kept)) return true;
  place_[at(kept)] = 0.5F * (place_[at(kept)] + place_[at(removed)]);
  return true;
}

bool NetPatch::split(int a, int b) {
  if (!topology_.split(a, b)) return false;
  const int n = topology_.added();
  place_[at(n)] = 0.5F * (place_[at(a)] + place_[at(b)]);
  normal_[at(n)] = (normal_[at(a)] + normal_[at(b)]).normalized();
  const Eigen::Vector3d normal = normal_[at(n)].cast<double>().head<3>();
  first_[at(n)] = in_lanes(normal.unitOrthogonal());
  second_[at(n)] = normal_[at(n)].cross3(first_[at(n)]);
  mobility_[at(n)] = 2;
  return true;
}

void NetPatch::mend_valences() {
  while (const auto edge = topology_.mending_flip([&](int c, int d) {
    return static_cast<double>((place_[at(c)] - place_[at(d)]).squaredNorm());
  })) {
    if (!topology_.flip(edge->a, edge->b)) return;
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
  for (int first = 0; first < topology_.valence(i); first += 4) {
    const Spokes d =
        spokes_from(place_[at(i)], topology_.ring(i), topology_.valence(i), first, place_.data());
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
    for (int i = parity; i < topology_.inner_count(); i += 2) {
      if (i >= reach && topology_.vertex(i).is_valid()) continue;
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
  for (int i = 0; i < topology_.inner_count(); ++i) {
    for (int first = 0; first < topology_.valence(i); first += 4) {
      const Spokes d =
          spokes_from(place_[at(i)], topology_.ring(i), topology_.valence(i), first, place_.data());
      const FourLanes stretch = d.squared_length().sqrt() * inverse - 1.0F;
      // An edge between two vertices inside is met from both.
      FourLanes weights = d.counts;
      for (int k = 0; k < 4; ++k) {
        if (topology_.is_inside(topology_.ring(i)[at(first + k)])) weights[k] *= 0.5F;
      }
      sum += (weights * stretch * stretch).sum();
    }
  }
  return sum;
}

int NetPatch::steep_corners() const {
  int steep = 0;
  for (int i = 0; i < topology_.inner_count(); ++i) {
    if (!topology_.is_inside(i) || mobility_[at(i)] == 0) continue;
    const int n = topology_.valence(i);
    for (int k = 0; k < (topology_.is_open(i) ? n - 1 : n); ++k) {
      const Vector b = place_[topology_.ring(i)[at(k)]] - place_[at(i)];
      const Vector c = place_[topology_.ring(i)[at(k + 1 == n ? 0 : k + 1)]] - place_[at(i)];
      const Vector area = b.cross3(c);
      if (area.dot(normal_[at(i)]) <= 0.2F * std::max(b.squaredNorm(), c.squaredNorm())) ++steep;
    }
  }
  return steep;
}

}  // namespace trivalent::remesh
