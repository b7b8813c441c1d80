#include "crystal/membrane_net.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "crystal/membrane_minimizer.h"
#include "mesh/geometry.h"

namespace trivalent::remesh {

namespace {

/// Points spread over a surface evenly, each for the same area.
std::vector<MembraneNet::Sample> samples_of(const TriMesh& surface, const SurfaceProjector& on,
                                            double area_each, double weight) {
  // Fractions of multiples of these fill a triangle evenly [Roberts2018].
  constexpr double first_step = 0.7548776662466927;
  constexpr double second_step = 0.5698402909980532;
  std::vector<MembraneNet::Sample> samples;
  double waiting = 0.5;
  for (const auto f : surface.faces()) {
    const std::array<Eigen::Vector3d, 3> corner = corners_of(surface, f);
    waiting += face_area(surface, f) / area_each;
    while (waiting >= 1.0) {
      waiting -= 1.0;
      const auto n = static_cast<double>(samples.size());
      double s = n * first_step - std::floor(n * first_step);
      double t = n * second_step - std::floor(n * second_step);
      if (s + t > 1.0) {
        s = 1.0 - s;
        t = 1.0 - t;
      }
      const Eigen::Vector3d p =
          corner[0] + s * (corner[1] - corner[0]) + t * (corner[2] - corner[0]);
      samples.push_back({p, on.normal({p, f.idx()}), weight});
    }
  }
  return samples;
}

Lanes<double> in_lanes(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z(), 0.0}; }

constexpr double samples_per_vertex = 2.0;

/// [edges] within which a sample's vertex is looked for, one after the other: a tip that has drawn
/// back farther than the last is given up.
constexpr std::array<double, 5> owner_radii = {1.0, 2.0, 3.0, 4.0, 5.0};

}  // namespace

MembraneNet::MembraneNet(ConstrainedMesh& constrained, const TriMesh& surface,
                         const Membrane& membrane)
    : constrained_(constrained), membrane_(membrane) {
  const double vertex_area = 2.0 * unit_triangle_area * membrane.length * membrane.length;
  samples_ = samples_of(surface, constrained.surface(), vertex_area / samples_per_vertex,
                        1.0 / samples_per_vertex);
  renew();
}

VertexHold MembraneNet::hold_at(const Eigen::Vector3d& position, Anchor& anchor,
                                bool is_boundary) const {
  VertexHold hold;
  hold.stiffness.fill(membrane_.stretching);
  if (anchor.kind == FeatureKind::corner) {
    hold.foot = position;
    hold.normals = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
    hold.count = 3;
    return hold;
  }
  hold.foot = constrained_.project(position, anchor);
  hold.normals[0] = constrained_.surface().normal({hold.foot, anchor.face});
  hold.count = 1;
  if (anchor.kind == FeatureKind::none) {
    hold.stiffness[0] = membrane_.tether * membrane_.coarseness() * membrane_.coarseness();
    return hold;
  }
  const Eigen::Vector3d tangent = constrained_.curves().tangent(anchor.on_curve);
  hold.count = 2;
  if (is_boundary) {
    hold.normals[1] = tangent.cross(hold.normals[0]).normalized();
    hold.stiffness[0] = membrane_.tether * membrane_.coarseness() * membrane_.coarseness();
    hold.stiffness[1] = membrane_.boundary_tether * membrane_.coarseness();
  } else {
    hold.normals[0] = tangent.unitOrthogonal();
    hold.normals[1] = tangent.cross(hold.normals[0]);
  }
  return hold;
}

void MembraneNet::set_hold(VertexHandle v, const VertexHold& hold) {
  if (holds_.size() <= index(v)) holds_.resize(index(v) + 1);
  holds_[index(v)] = hold;
}

void MembraneNet::set_anchor_on_boundary(VertexHandle v, Anchor anchor) {
  const Eigen::Vector3d& position = constrained_.mesh.point(v);
  anchor.kind = FeatureKind::curve;
  for (const auto e : constrained_.mesh.ve_range(v)) {
    if (const auto curve = constrained_.curve_of(e)) {
      anchor.on_curve = constrained_.curves().nearest(position, *curve);
    }
  }
  set_hold(v, hold_at(position, anchor, true));
  constrained_.set_anchor(v, anchor);
}

void MembraneNet::renew() {
  TriMesh& mesh = constrained_.mesh;
  mesh.garbage_collection();
  holds_.resize(mesh.n_vertices());
  tbb::parallel_for(std::size_t{0}, holds_.size(), [&](std::size_t i) {
    const VertexHandle v(static_cast<int>(i));
    Anchor anchor = constrained_.anchor(v);
    holds_[i] = hold_at(mesh.point(v), anchor, mesh.is_boundary(v));
    constrained_.set_anchor(v, anchor);
  });
  find_pulls();
}

std::optional<VertexHandle> MembraneNet::owner_of(const Sample& sample,
                                                  const PointGrid& grid) const {
  for (const double radius : owner_radii) {
    VertexHandle nearest;
    double least = std::numeric_limits<double>::infinity();
    const double reach = radius * membrane_.length;
    grid.visit(sample.position, reach, [&](int i, const Eigen::Vector3d& separation) {
      const VertexHandle v(i);
      const VertexHold& held = holds_[index(v)];
      const double squared = separation.squaredNorm();
      if (squared >= least) return;
      if (held.count == 1 && held.normals[0].dot(sample.normal) <= 0.0) return;  // another sheet
      least = squared;
      nearest = v;
    });
    if (nearest.is_valid()) {
      const double free = membrane_.cover_distance();
      return least > free * free ? std::optional(nearest) : std::nullopt;
    }
  }
  return std::nullopt;
}

void MembraneNet::find_pulls() {
  const TriMesh& mesh = constrained_.mesh;
  pull_begin_.assign(mesh.n_vertices() + 1, 0);
  pulled_.clear();
  if (membrane_.cover == 0.0) return;
  // Of larger cells fewer must be looked up, of smaller ones there are fewer vertices too far.
  const PointGrid grid(mesh, 2.0 * membrane_.length, owner_radii.back() * membrane_.length);
  std::vector<std::optional<VertexHandle>> owners(samples_.size());
  tbb::parallel_for(std::size_t{0}, samples_.size(),
                    [&](std::size_t i) { owners[i] = owner_of(samples_[i], grid); });
  for (const auto& owner : owners) {
    if (owner) ++pull_begin_[index(*owner) + 1];
  }
  for (std::size_t i = 1; i < pull_begin_.size(); ++i) pull_begin_[i] += pull_begin_[i - 1];
  pulled_.resize(static_cast<std::size_t>(pull_begin_.back()));
  std::vector<int> next(pull_begin_.begin(), pull_begin_.end() - 1);
  for (std::size_t i = 0; i < owners.size(); ++i) {
    if (!owners[i]) continue;
    pulled_[static_cast<std::size_t>(next[index(*owners[i])]++)] = static_cast<int>(i);
  }
}

std::span<const int> MembraneNet::pulls(VertexHandle v) const {
  if (index(v) + 1 >= pull_begin_.size()) return {};
  const auto begin = static_cast<std::size_t>(pull_begin_[index(v)]);
  const auto end = static_cast<std::size_t>(pull_begin_[index(v) + 1]);
  return std::span(pulled_).subspan(begin, end - begin);
}

MembraneTerms<double> MembraneNet::terms(VertexImages& images) const {
  const TriMesh& mesh = constrained_.mesh;
  const Lattice& lattice = mesh.lattice;
  // The image of a vertex that is beside another one.
  const auto beside = [&](VertexHandle a, VertexHandle b) {
    if (!lattice.is_periodic()) return b.idx();
    return images.number(b.idx(), lattice.image_of(position_beside(mesh, a, b) - mesh.point(b)));
  };
  const auto deviation_of = [&](VertexHandle v) {
    return mesh.is_boundary(v) ? 0 : static_cast<int>(mesh.valence(v)) - 6;
  };
  MembraneTerms<double> terms;
  const double per_area = membrane_.coarseness() * membrane_.coarseness();
  for (const auto e : mesh.edges()) {
    const auto h = e.h0();
    const VertexHandle a = h.from();
    const int b = beside(a, h.to());
    if (e.is_boundary() || constrained_.curve_of(e)) {
      terms.edges.push_back({a.idx(), b});
    } else {
      const double rest = rest_lengths_.empty()
                              ? membrane_.rest_length(deviation_of(a), deviation_of(h.to()))
                              : rest_lengths_[index(e.idx())];
      terms.hinges.push_back({a.idx(), b, beside(a, h.next().to()), beside(a, h.opp().next().to()),
                              static_cast<float>(rest)});
    }
  }
  for (const auto v : mesh.vertices()) {
    const VertexHold& held = holds_[index(v)];
    for (std::size_t k = 0; k < static_cast<std::size_t>(held.count); ++k) {
      if (held.stiffness[k] == 0.0) continue;
      terms.tethers.push_back({v.idx(), held.stiffness[k],
                               in_lanes(lattice.near(mesh.point(v), held.foot)),
                               in_lanes(held.normals[k])});
    }
    for (const int i : pulls(v)) {
      const Sample& s = sample(i);
      terms.pulls.push_back({v.idx(), membrane_.cover * per_area * s.weight,
                             in_lanes(lattice.near(mesh.point(v), s.position))});
    }
  }
  add_contacts(terms, images);
  return terms;
}

void MembraneNet::add_contacts(MembraneTerms<double>& terms, VertexImages& images) const {
  const TriMesh& mesh = constrained_.mesh;
  const double reach = contact_skin * membrane_.contact_distance();
  const PointGrid grid(mesh, reach, reach);
  struct Partner {
    int vertex;
    Eigen::Vector3d separation;
  };
  std::vector<std::vector<Partner>> partners(mesh.n_vertices());
  tbb::parallel_for(std::size_t{0}, partners.size(), [&](std::size_t i) {
    const VertexHandle v(static_cast<int>(i));
    if (mesh.status(v).deleted()) return;
    grid.visit(mesh.point(v), reach, [&](int other, const Eigen::Vector3d& separation) {
      const VertexHandle w(other);
      if (other <= v.idx()) return;
      // Another image of a neighbor may come too near.
      if (mesh.lattice.is_nearest(separation) && mesh.find_halfedge(v, w).is_valid()) return;
      partners[i].push_back({other, separation});
    });
  });
  for (std::size_t i = 0; i < partners.size(); ++i) {
    const VertexHandle v(static_cast<int>(i));
    for (const auto& [other, separation] : partners[i]) {
      const Eigen::Vector3d translation =
          mesh.point(v) + separation - mesh.point(VertexHandle(other));
      terms.contacts.push_back({v.idx(), images.number(other, mesh.lattice.image_of(translation))});
    }
  }
}

void MembraneNet::relax(int steps, const std::function<bool()>& should_stop) {
  minimize(steps, false, should_stop);
}

void MembraneNet::relax_across(int steps, const std::function<bool()>& should_stop) {
  minimize(steps, true, should_stop);
}

void MembraneNet::minimize(int steps, bool across_net, const std::function<bool()>& should_stop) {
  TriMesh& mesh = constrained_.mesh;
  VertexImages images(mesh.n_vertices());
  const MembraneTerms<double> all = terms(images);
  std::vector<Eigen::Vector3d> positions(mesh.points(), mesh.points() + mesh.n_vertices());
  const double tolerance = 1e-6 * static_cast<double>(positions.size());
  minimize_membrane(minimizer_, {membrane_, all, images, mesh.lattice}, positions,
                    {.max_steps = steps, .tolerance = tolerance, .across_net = across_net},
                    [&](double, double) { return should_stop && should_stop(); });
  for (const auto v : mesh.vertices()) mesh.point(v) = positions[index(v)];
}

double MembraneNet::elastic_energy() {
  const TriMesh& mesh = constrained_.mesh;
  VertexImages images(mesh.n_vertices());
  const MembraneTerms<double> all = terms(images);
  std::vector<Lanes<double>> positions(mesh.n_vertices());
  for (const auto v : mesh.vertices()) positions[index(v)] = in_lanes(mesh.point(v));
  images.place(mesh.lattice, positions);
  std::vector<Lanes<double>> slopes(positions.size(), Lanes<double>::Zero());
  return membrane_energy(membrane_, all, positions, slopes);
}

double MembraneNet::core_energy() const {
  const auto deviation = [](const auto& v) {
    return static_cast<int>(v.valence()) - (v.is_boundary() ? 4 : 6);
  };
  double sum = 0.0;
  for (const auto v : constrained_.mesh.vertices()) {
    sum += membrane_.vertex_energy(deviation(v), v.is_boundary());
  }
  for (const auto e : constrained_.mesh.edges()) {
    if (e.v0().is_boundary() || e.v1().is_boundary()) continue;
    if (Membrane::is_pair(deviation(e.v0()), deviation(e.v1()))) sum += membrane_.pair;
  }
  return sum;
}

}  // namespace trivalent::remesh
