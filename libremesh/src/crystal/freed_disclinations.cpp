#include "crystal/freed_disclinations.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "crystal/cone_net.h"

namespace trivalent::remesh {

namespace {

using Complex = std::complex<double>;
using Vector = Eigen::VectorXd;

constexpr int first_vertex_steps = 400;  // of the vertices
constexpr int vertex_steps_each = 60;    // of the vertices for each of the disclinations
constexpr int max_moves = 100;           // of the disclinations
constexpr double longest_move = 0.3;     // [edges] in one step
constexpr double least_gain = 2e-3;      // [eV]
/// [edges] Disclinations nearer than this are a pair.
constexpr double length_of_pair = 2.5;

/// Twice the area of a triangle.
double doubled_area(const Complex& u, const Complex& v) { return (std::conj(u) * v).imag(); }

/// Minimizer that keeps the whole inverse Hessian: for few variables, each evaluation of which
/// takes long [Nocedal2006].
class Bfgs {
 public:
  explicit Bfgs(Eigen::Index n) : x_(Vector::Zero(n)), gradient_(n), next_gradient_(n) {}

  /// @param evaluate  (x, gradient&) -> energy
  /// @return          The least energy.
  template <typename Evaluate>
  double minimize(const Evaluate& evaluate, const std::function<bool()>& should_stop) {
    double energy = evaluate(x_, gradient_);
    for (int step = 0; step < max_moves; ++step) {
      if (should_stop && should_stop()) break;
      const Vector direction = has_curvature_ ? Vector(-inverse_ * gradient_) : Vector(-gradient_);
      const double slope = direction.dot(gradient_);
      const bool is_at_rest = has_curvature_ && -0.5 * slope < least_gain;
      if (is_at_rest || !search(direction, slope, energy, evaluate)) break;
    }
    return energy;
  }

  [[nodiscard]] const Vector& x() const { return x_; }

 private:
  /// Backtracks until the energy is low enough; false if it cannot be lowered.
  template <typename Evaluate>
  bool search(const Vector& direction, double slope, double& energy, const Evaluate& evaluate) {
    constexpr int max_tries = 6;
    constexpr double sufficient = 1e-4;
    constexpr double shortening = 0.3;
    double size = std::min(1.0, longest_move / direction.cwiseAbs().maxCoeff());
    for (int k = 0; k < max_tries; ++k, size *= shortening) {
      const Vector step = size * direction;
      const double reached = evaluate(x_ + step, next_gradient_);
      if (reached > energy + sufficient * size * slope) continue;
      x_ += step;
      learn(step, next_gradient_ - gradient_);
      gradient_.swap(next_gradient_);
      energy = reached;
      return true;
    }
    return false;
  }

  void learn(const Vector& step, const Vector& change) {
    const double product = step.dot(change);
    if (!(product > 0.0)) return;  // not convex along this step
    if (!has_curvature_) {
      inverse_ = product / change.squaredNorm() * Eigen::MatrixXd::Identity(x_.size(), x_.size());
    }
    has_curvature_ = true;
    const Vector expected = inverse_ * change;
    inverse_ += (product + change.dot(expected)) / (product * product) * step * step.transpose() -
                (expected * step.transpose() + step * expected.transpose()) / product;
  }

  Vector x_;
  Vector gradient_;
  Vector next_gradient_;
  Eigen::MatrixXd inverse_;
  bool has_curvature_ = false;
};

class FreedNet {
 public:
  FreedNet(MembraneNet& net, int wanted_faces)
      : net_(net),
        cones_(triangles_of(net.constrained().mesh), net.constrained().mesh.n_vertices()),
        wanted_faces_(wanted_faces) {
    for (int h = 0; h < cones_.n_halfedges(); ++h) given_.push_back(in_plane(cones_.side(h)));
    sides_ = given_;
    find_moves();
    find_faces();
  }

  FreedDisclinations run(const std::function<bool()>& should_stop) {
    net_.relax_across(first_vertex_steps, should_stop);
    net_.renew();
    net_.relax_across(first_vertex_steps, should_stop);
    Bfgs minimizer(2 * static_cast<Eigen::Index>(moves_.size()));
    FreedDisclinations freed;
    const auto energy_at = [&](const Vector& x, Vector& gradient) { return energy(x, gradient); };
    Vector none(0);
    freed.energy = moves_.empty() ? energy(none, none) : minimizer.minimize(energy_at, should_stop);
    set_sides(minimizer.x());
    net_.set_rest_lengths({});
    for (const Complex& side : sides_) freed.lengths.push_back(std::abs(side));
    return freed;
  }

 private:
  void find_moves() {
    std::vector<bool> is_paired(net_.constrained().mesh.n_vertices(), false);
    for (int h = 0; h < cones_.n_halfedges(); ++h) {
      if (length_of(cones_.side(h)) < length_of_pair) is_paired[index(cones_.from(h))] = true;
    }
    for (int h = 0; h < cones_.n_halfedges(); ++h) {
      if (cones_.opposite(h) < h) continue;
      if (is_paired[index(cones_.from(h))] || is_paired[index(cones_.to(h))]) continue;
      auto changes = cones_.side_changes(h);
      if (!changes.empty()) moves_.push_back(std::move(changes));
    }
  }

  /// Expresses the edges of every face by two sides of the large triangle it is in.
  void find_faces() {
    const TriMesh& mesh = net_.constrained().mesh;
    const ConeNet::Net net = cones_.net();
    std::vector<VertexHandle> vertices;
    for (const ConeNet::Place& place : net.places) {
      const ConeNet::Mean mean = cones_.mean_at(cones_, place);
      std::size_t k = 0;
      while (mean.weights[k] < 0.5) ++k;
      vertices.emplace_back(mean.vertices[k]);
    }
    for (std::size_t f = 0; f < net.triangles.size(); ++f) {
      const auto& [large, edge] = net.first_edges[f];
      Face face;
      face.large = large;
      const LatticeVector u = cones_.side(3 * large);
      const LatticeVector v = cones_.side(3 * large + 1);
      const auto area = static_cast<double>(area_of(u, v));
      for (std::size_t k = 0; k < 3; ++k) {
        const LatticeVector d = turned(edge, 2 * static_cast<int>(k));
        face.of_first[k] = static_cast<double>(area_of(d, v)) / area;
        face.of_second[k] = static_cast<double>(area_of(u, d)) / area;
        const VertexHandle a = vertices[index(net.triangles[f][k])];
        const VertexHandle b = vertices[index(net.triangles[f][(k + 1) % 3])];
        face.edges[k] = mesh.edge_handle(mesh.find_halfedge(a, b));
      }
      faces_.push_back(face);
    }
  }

  /// @param x  By how much each of the moves is made, real and imaginary parts.
  void set_sides(const Vector& x) {
    sides_ = given_;
    for (std::size_t m = 0; m < moves_.size(); ++m) {
      const auto i = 2 * static_cast<Eigen::Index>(m);
      const Complex by(x[i], x[i + 1]);
      for (const auto& [h, factor] : moves_[m]) sides_[index(h)] += factor * by;
    }
  }

  /// With the vertices at rest, so that only rest lengths and the count change with the sides.
  double energy(const Vector& x, Vector& gradient) {
    set_sides(x);
    double area = 0.0;
    for (std::size_t h = 0; h < sides_.size(); h += 3) {
      const double each = doubled_area(sides_[h], sides_[h + 1]);
      if (each <= 0.0) return std::numeric_limits<double>::infinity();
      area += each;
    }
    constexpr double area_of_face = 0.5 * std::numbers::sqrt3;
    const double excess = area / area_of_face - wanted_faces_;
    const double count = net_.membrane().count;
    const std::vector<double> rests = rest_lengths();
    net_.set_rest_lengths(rests);
    net_.relax_across(vertex_steps_each);

    std::vector<Complex> slopes = stretching_slopes(rests);
    const Complex pressure(0.0, 0.5 * count * excess / area_of_face);
    for (std::size_t h = 0; h < sides_.size(); h += 3) {
      slopes[h] -= pressure * sides_[h + 1];
      slopes[h + 1] += pressure * sides_[h];
    }
    for (std::size_t m = 0; m < moves_.size(); ++m) {
      Complex sum = 0.0;
      for (const auto& [h, factor] : moves_[m]) sum += std::conj(factor) * slopes[index(h)];
      gradient[2 * static_cast<Eigen::Index>(m)] = sum.real();
      gradient[2 * static_cast<Eigen::Index>(m) + 1] = sum.imag();
    }
    return net_.elastic_energy() + 0.25 * count * excess * excess;
  }

  /// Of all edges [Å]. An edge is in two faces, whose large triangles may be stretched unequally.
  [[nodiscard]] std::vector<double> rest_lengths() const {
    std::vector<double> rests(net_.constrained().mesh.n_edges(), 0.0);
    for (const Face& face : faces_) {
      for (std::size_t k = 0; k < 3; ++k) {
        rests[index(face.edges[k].idx())] +=
            0.5 * net_.membrane().length * std::abs(edge_of(face, k));
      }
    }
    return rests;
  }

  /// How the energy of stretching changes with the first two sides of each large triangle.
  [[nodiscard]] std::vector<Complex> stretching_slopes(const std::vector<double>& rests) const {
    const Membrane& membrane = net_.membrane();
    std::vector<Complex> slopes(sides_.size());
    for (const Face& face : faces_) {
      const std::size_t first = 3 * index(face.large);
      for (std::size_t k = 0; k < 3; ++k) {
        const double stretch = length_of_edge(face.edges[k]) - rests[index(face.edges[k].idx())];
        const Complex edge = edge_of(face, k);
        const Complex slope =
            -0.5 * membrane.length * membrane.stretching * stretch * edge / std::abs(edge);
        slopes[first] += face.of_first[k] * slope;
        slopes[first + 1] += face.of_second[k] * slope;
      }
    }
    return slopes;
  }

  struct Face {
    int large = 0;
    std::array<EdgeHandle, 3> edges;
    std::array<double, 3> of_first{};   ///< of the large triangle's first side
    std::array<double, 3> of_second{};  ///< of its second side
  };
  [[nodiscard]] Complex edge_of(const Face& face, std::size_t k) const {
    const std::size_t first = 3 * index(face.large);
    return face.of_first[k] * sides_[first] + face.of_second[k] * sides_[first + 1];
  }
  [[nodiscard]] double length_of_edge(EdgeHandle e) const {
    const TriMesh& mesh = net_.constrained().mesh;
    const HalfedgeHandle h = mesh.halfedge_handle(e, 0);
    return (mesh.point(mesh.to_vertex_handle(h)) - mesh.point(mesh.from_vertex_handle(h))).norm();
  }

  MembraneNet& net_;
  ConeNet cones_;
  int wanted_faces_;
  std::vector<Complex> given_;  // sides at all half-edges
  std::vector<Complex> sides_;
  std::vector<std::vector<ConeNet::SideChange>> moves_;
  std::vector<Face> faces_;
};

}  // namespace

FreedDisclinations free_disclinations(MembraneNet& net, int wanted_faces,
                                      const std::function<bool()>& should_stop) {
  FreedDisclinations freed = FreedNet(net, wanted_faces).run(should_stop);
  freed.energy += net.core_energy();
  return freed;
}

}  // namespace trivalent::remesh
