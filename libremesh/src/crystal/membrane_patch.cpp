#include "crystal/membrane_patch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>
#include <utility>

#include "crystal/membrane_preconditioner.h"

namespace trivalent::remesh {

MembranePatch::MembranePatch(const MembraneNet& net, VertexHandle center, const PointGrid& grid,
                             PatchMarks& marks)
    : membrane_(&net.membrane()),
      lattice_(&net.constrained().mesh.lattice),
      topology_(net.constrained(), center, reach, marks),
      origin_(net.constrained().mesh.point(center)) {
  if (!is_whole()) return;
  const TriMesh& mesh = net.constrained().mesh;
  const std::vector<Eigen::Vector3d> positions = unfolded_positions(mesh, topology_);
  x_.resize(at(topology_.size()), Vector::Zero());
  for (int i = 0; i < topology_.size(); ++i) {
    if (topology_.vertex(i).is_valid()) x_[at(i)] = in_lanes(positions[at(i)] - origin_);
  }
  find_holds(net);
  find_contacts(net, grid, marks);
}

void MembranePatch::find_holds(const MembraneNet& net) {
  const double per_area = membrane_->coarseness() * membrane_->coarseness();
  holds_.resize(at(topology_.inner_count()), {Vector::Zero(), Vector::Zero()});
  for (int i = 0; i < topology_.added(); ++i) {
    const VertexHandle v = topology_.vertex(i);
    const VertexHold& hold = net.hold(v);
    const Vector foot = seen_from(i, hold.foot);
    holds_[at(i)] = {foot, in_lanes(hold.normals[0])};
    for (int k = 0; k < hold.count && hold.count > 1; ++k) {
      feature_tethers_.push_back(
          {i, static_cast<float>(hold.stiffness[at(k)]), foot, in_lanes(hold.normals[at(k)])});
    }
    for (const int s : net.pulls(v)) {
      const MembraneNet::Sample& sample = net.sample(s);
      pulls_.push_back({i, static_cast<float>(membrane_->cover * per_area * sample.weight),
                        seen_from(i, sample.position)});
    }
  }
}

void MembranePatch::find_contacts(const MembraneNet& net, const PointGrid& grid,
                                  const PatchMarks& marks) {
  const TriMesh& mesh = net.constrained().mesh;
  const double radius = contact_skin * membrane_->contact_distance();
  for (int i = 0; i < topology_.added(); ++i) {
    const VertexHandle v = topology_.vertex(i);
    grid.visit(mesh.point(v), radius, [&](int other, const Eigen::Vector3d& away) {
      const VertexHandle w(other);
      int j = marks.number(w);
      Lattice::Image image = {0, 0, 0};
      if (j < 0) {
        j = static_cast<int>(x_.size());
        x_.push_back(lattice_->is_periodic() ? Vector(x_[at(i)] + in_lanes(away))
                                             : in_lanes(mesh.point(w) - origin_));
      } else if (j <= i && j < topology_.inner_count()) {
        return;
      } else if (lattice_->is_periodic()) {
        image = lattice_->image_of(away - separation(i, j));
      }
      near_.push_back({i, j, image});
    });
  }
}

MembranePatch::Vector MembranePatch::beside(int i, const Vector& place) const {
  if (!lattice_->is_periodic()) return place;
  const Eigen::Vector3d here = x_[at(i)].cast<double>().head<3>();
  return in_lanes(lattice_->near(here, place.cast<double>().head<3>()));
}

MembranePatch::Vector MembranePatch::seen_from(int i, const Eigen::Vector3d& place) const {
  const Eigen::Vector3d here = origin_ + x_[at(i)].cast<double>().head<3>();
  return in_lanes(lattice_->near(here, place) - origin_);
}

VertexHold MembranePatch::hold(int i) const {
  VertexHold hold;
  hold.foot = origin_ + holds_[at(i)].foot.cast<double>().head<3>();
  hold.normals[0] = holds_[at(i)].normal.cast<double>().head<3>();
  hold.count = 1;
  return hold;
}

bool MembranePatch::collapse(int removed, int kept) {
  if (!topology_.collapse(removed, kept)) return false;
  if (!topology_.is_on_feature(kept) || topology_.is_on_feature(removed)) {
    x_[at(kept)] = 0.5F * (x_[at(kept)] + beside(kept, x_[at(removed)]));
  }
  for (Pull<float>& pull : pulls_) {
    if (pull.i != removed) continue;
    pull.i = kept;
    pull.point = beside(kept, pull.point);
  }
  return true;
}

bool MembranePatch::split(int a, int b) {
  if (!topology_.split(a, b)) return false;
  const int n = topology_.added();
  x_[at(n)] = 0.5F * (x_[at(a)] + beside(a, x_[at(b)]));
  holds_[at(n)] = {0.5F * (holds_[at(a)].foot + beside(a, holds_[at(b)].foot)),
                   (holds_[at(a)].normal + holds_[at(b)].normal).normalized()};
  if (topology_.is_open(n)) hold_between(n, a, b);
  const std::size_t before = near_.size();
  for (std::size_t k = 0; k < before; ++k) {
    const auto [i, j, image] = near_[k];
    if (i == a) near_.push_back({n, j, image});
    if (j == a) near_.push_back({n, i, {-image[0], -image[1], -image[2]}});
  }
  return true;
}

void MembranePatch::hold_between(int n, int a, int b) {
  const auto of = [&](int i) {
    std::vector<Tether<float>> tethers;
    std::ranges::copy_if(feature_tethers_, std::back_inserter(tethers),
                         [i](const Tether<float>& t) { return t.i == i; });
    return tethers;
  };
  // A corner is held in more directions than the curve beside it.
  std::vector<Tether<float>> tethers = of(a);
  if (std::vector<Tether<float>> others = of(b); others.size() < tethers.size()) {
    tethers = std::move(others);
  }
  for (Tether<float>& t : tethers) {
    t.i = n;
    t.foot = holds_[at(n)].foot;
    feature_tethers_.push_back(t);
  }
}

void MembranePatch::mend_valences() {
  while (const auto edge = topology_.mending_flip([&](int c, int d) {
    return static_cast<double>((x_[at(c)] - beside(c, x_[at(d)])).squaredNorm());
  })) {
    if (!topology_.flip(edge->a, edge->b)) return;
  }
}

Lattice::Image MembranePatch::image_beside(int i, int j) const {
  const Eigen::Vector3d away = separation(i, j);
  return lattice_->image_of(lattice_->nearest(away) - away);
}

float MembranePatch::rest_length(int a, int b) const {
  // Where one-rings are not known, edges stay as they are.
  const auto deviation = [&](int i) {
    return topology_.valence(i) > 0 && !topology_.is_open(i) ? topology_.deviation(i) : 0;
  };
  return static_cast<float>(membrane_->rest_length(deviation(a), deviation(b)));
}

bool MembranePatch::add_hinge(const EdgeCorners& corners, MembraneTerms<float>& terms,
                              VertexImages& images) const {
  const auto [a, b, c, d] = corners;
  const bool is_periodic = lattice_->is_periodic();
  if (c < 0 || d < 0 || topology_.is_rigid(a, b)) {
    terms.edges.push_back({a, is_periodic ? images.number(b, image_beside(a, b)) : b});
    return true;
  }
  if (!is_periodic) {
    terms.hinges.push_back({a, b, c, d, rest_length(a, b)});
    return true;
  }
  const Lattice::Image to_b = image_beside(a, b);
  const Lattice::Image to_c = image_beside(a, c);
  const Lattice::Image to_d = image_beside(a, d);
  // Edges lead to nearest images; else the faces would not close.
  for (const auto& [image, opposite] : {std::pair(to_c, c), std::pair(to_d, d)}) {
    const Eigen::Vector3d side =
        separation(b, opposite) + lattice_->translation(image) - lattice_->translation(to_b);
    if (!lattice_->is_nearest(side)) return false;
  }
  terms.hinges.push_back({a, images.number(b, to_b), images.number(c, to_c), images.number(d, to_d),
                          rest_length(a, b)});
  return true;
}

MembranePatch::EdgeCorners MembranePatch::corners_at(int a, int k) const {
  const int n = topology_.valence(a);
  const bool is_first = topology_.is_open(a) && k == 0;
  const bool is_last = topology_.is_open(a) && k == n - 1;
  return {a, topology_.neighbor(a, k), is_last ? -1 : topology_.neighbor(a, k + 1 == n ? 0 : k + 1),
          is_first ? -1 : topology_.neighbor(a, k == 0 ? n - 1 : k - 1)};
}

bool MembranePatch::add_hinges(MembraneTerms<float>& terms, VertexImages& images) const {
  const auto moves = [&](int i) { return i >= 0 && i < topology_.inner_count(); };
  for (int a = 0; a < topology_.size(); ++a) {
    for (int k = 0; k < topology_.valence(a); ++k) {
      const EdgeCorners corners = corners_at(a, k);
      if (topology_.valence(corners[1]) > 0 && corners[1] < a) continue;  // met from there
      if (std::ranges::any_of(corners, moves) && !add_hinge(corners, terms, images)) return false;
    }
  }
  return true;
}

std::optional<MembraneTerms<float>> MembranePatch::terms(VertexImages& images) const {
  MembraneTerms<float> terms;
  terms.hinges.reserve(400);
  if (!add_hinges(terms, images)) return std::nullopt;
  for (const auto& [i, j, image] : near_) {
    if (!topology_.is_inside(i)) continue;
    if (topology_.is_neighbor(i, j) && (!lattice_->is_periodic() || image == image_beside(i, j))) {
      continue;
    }
    if (j < topology_.inner_count() && !topology_.is_inside(j)) continue;
    if (i != j) terms.contacts.push_back({i, images.number(j, image)});
  }
  std::ranges::copy_if(feature_tethers_, std::back_inserter(terms.tethers),
                       [&](const Tether<float>& t) { return topology_.is_inside(t.i); });
  const double per_area = membrane_->coarseness() * membrane_->coarseness();
  const auto stiffness = static_cast<float>(membrane_->tether * per_area);
  for (int i = 0; i < topology_.inner_count(); ++i) {
    if (!topology_.is_inside(i) || topology_.is_on_feature(i)) continue;
    terms.tethers.push_back({i, stiffness, holds_[at(i)].foot, holds_[at(i)].normal});
  }
  terms.pulls = pulls_;
  return terms;
}

double MembranePatch::core_energy() const {
  double sum = 0.0;
  for (int i = 0; i < topology_.inner_count(); ++i) {
    if (!topology_.is_inside(i)) continue;
    sum += membrane_->vertex_energy(topology_.deviation(i), topology_.is_open(i));
    if (!topology_.is_open(i)) sum += pair_energy(i);
  }
  return sum;
}

double MembranePatch::pair_energy(int i) const {
  double sum = 0.0;
  for (int k = 0; k < topology_.valence(i); ++k) {
    const int j = topology_.ring(i)[at(k)];
    const bool is_counted_there = topology_.is_inside(j) && j < i;
    if (is_counted_there || topology_.valence(j) == 0 || topology_.is_open(j)) continue;
    if (Membrane::is_pair(topology_.deviation(i), topology_.deviation(j))) sum += membrane_->pair;
  }
  return sum;
}

std::optional<double> MembranePatch::relax(const Relaxation& relaxation, Lbfgs<float>& minimizer) {
  const std::size_t own = x_.size();
  VertexImages images(own);
  const std::optional<MembraneTerms<float>> found = terms(images);
  if (!found) return std::nullopt;
  const MembraneTerms<float>& all = *found;
  const double cores = core_energy();
  images.place(*lattice_, x_);
  const MembranePreconditioner<float> inverse(*membrane_, all, x_, at(topology_.inner_count()),
                                              images);
  const Eigen::Index n = 4 * static_cast<Eigen::Index>(topology_.inner_count());
  std::vector<Vector> slopes(x_.size());
  const auto evaluate = [&](const Lbfgs<float>::Vector& from, Lbfgs<float>::Vector& gradient) {
    std::copy_n(from.data(), n, x_[0].data());
    images.place(*lattice_, x_);
    std::ranges::fill(slopes, Vector::Zero());
    const float energy = membrane_energy(*membrane_, all, x_, slopes);
    images.collect(slopes);
    std::copy_n(slopes[0].data(), n, gradient.data());
    return energy;
  };
  const auto precondition = [&](Lbfgs<float>::Vector& v) { inverse.apply(v); };
  bool is_hopeless = false;
  const auto gives_up = [&](float energy, float predicted) {
    // Times the decrease that the quadratic model predicts, which knows stiff directions only at
    // first: with 10 a third of the good moves is lost, with 1000 hopeless ones take all the time.
    constexpr double optimism = 60.0;
    is_hopeless = energy - optimism * predicted + cores > relaxation.limit;
    return is_hopeless;
  };
  Lbfgs<float>::Vector x = Lbfgs<float>::Vector::Map(x_[0].data(), n);
  const float energy = minimizer.minimize(x,
                                          {.max_steps = relaxation.max_steps,
                                           .max_move = static_cast<float>(0.3 * membrane_->length),
                                           .tolerance = static_cast<float>(relaxation.tolerance)},
                                          evaluate, precondition, gives_up);
  std::copy_n(x.data(), n, x_[0].data());
  x_.resize(own);
  if (is_hopeless) return std::nullopt;
  return energy + cores;
}

}  // namespace trivalent::remesh
