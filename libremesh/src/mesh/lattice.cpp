#include "trivalent/remesh/lattice.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

/// Sums of -1, 0 or 1 times each of the vectors, but for zero.
std::vector<Eigen::Vector3d> small_sums(const Lattice::Cell& basis) {
  std::vector<Eigen::Vector3d> sums;
  for (int a = -1; a <= 1; ++a) {
    for (int b = -1; b <= 1; ++b) {
      for (int c = -1; c <= 1; ++c) {
        const Eigen::Vector3d sum = basis * Eigen::Vector3d(a, b, c);
        const bool is_new = std::ranges::none_of(
            sums, [&](const Eigen::Vector3d& other) { return (other - sum).isZero(0.0); });
        if (!sum.isZero(0.0) && is_new) sums.push_back(sum);
      }
    }
  }
  return sums;
}

/// A basis of the same lattice in which no vector gets shorter by adding or subtracting others
/// once [Semaev2001].
Lattice::Cell with_short_vectors(Lattice::Cell basis) {
  constexpr double shorter = 1.0 - 1e-12;
  for (bool changes = true; changes;) {
    changes = false;
    for (int k = 0; k < 3; ++k) {
      if (basis.col(k).isZero(0.0)) continue;
      Lattice::Cell others = basis;
      others.col(k).setZero();
      for (const Eigen::Vector3d& sum : small_sums(others)) {
        const double times = std::round(basis.col(k).dot(sum) / sum.squaredNorm());
        const Eigen::Vector3d reduced = basis.col(k) - times * sum;
        if (reduced.squaredNorm() >= shorter * basis.col(k).squaredNorm()) continue;
        basis.col(k) = reduced;
        changes = true;
      }
    }
  }
  return basis;
}

/// Takes a separation to its multiples of the vectors; those that are zero get none.
Lattice::Cell pseudo_inverse(const Lattice::Cell& vectors) {
  return vectors.completeOrthogonalDecomposition().pseudoInverse();
}

}  // namespace

Lattice::Lattice(const Cell& cell, const Periodic& periodic) : cell_(cell), periodic_(periodic) {
  if (!cell.allFinite()) throw InvalidOption("lattice: a cell vector is not finite");
  Cell vectors = cell;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!periodic[k]) vectors.col(static_cast<Eigen::Index>(k)).setZero();
  }
  const auto count = static_cast<int>(std::ranges::count(periodic, true));
  if (count == 0) return;
  Eigen::Matrix3d directions = vectors;
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (directions.col(k).norm() > 0.0) directions.col(k).normalize();
  }
  constexpr double flat = 1e-6;
  Eigen::ColPivHouseholderQR<Cell> triangular(directions);
  triangular.setThreshold(flat);
  if (triangular.rank() < count) {
    throw InvalidOption(concat("lattice: the ", count, " periodic cell vectors enclose no ",
                               count == 3   ? "volume"
                               : count == 2 ? "area"
                                            : "length",
                               "; give vectors that point in different directions"));
  }
  if (count == 3 && vectors.determinant() < 0.0) {
    throw InvalidOption("lattice: the cell vectors are left-handed; swap two of them");
  }
  inverse_ = pseudo_inverse(vectors);
  short_ = with_short_vectors(vectors);
  inverse_short_ = pseudo_inverse(short_);
  around_ = small_sums(short_);
  shortest_squared_ = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& t : around_) {
    shortest_squared_ = std::min(shortest_squared_, t.squaredNorm());
  }
  // Rounding is exact where the short vectors are at right angles.
  constexpr double right = 1e-12;
  const Eigen::Matrix3d products = short_.transpose() * short_;
  const double largest = products.diagonal().maxCoeff();
  if ((products - Eigen::Matrix3d(products.diagonal().asDiagonal())).cwiseAbs().maxCoeff() <
      right * largest) {
    around_.clear();
  }
}

double Lattice::shortest() const { return std::sqrt(shortest_squared_); }

Eigen::Vector3d Lattice::nearest_image(const Eigen::Vector3d& separation) const {
  const Eigen::Vector3d counts = (inverse_short_ * separation).array().round();
  Eigen::Vector3d best = separation - short_ * counts;
  for (bool changes = true; changes;) {
    changes = false;
    for (const Eigen::Vector3d& t : around_) {
      // The margin lets none of two equally near images win again and again. Numbers that are not
      // finite, or too large for t to change them, end the search too.
      const Eigen::Vector3d other = best - t;
      if (!(other.squaredNorm() < (1.0 - 1e-12) * best.squaredNorm())) continue;
      best = other;
      changes = true;
    }
  }
  return best;
}

Eigen::Vector3d Lattice::translation(const Image& image) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    if (periodic_[k]) sum += image[k] * cell_.col(static_cast<Eigen::Index>(k));
  }
  return sum;
}

Lattice::Image Lattice::image_of(const Eigen::Vector3d& translation) const {
  const Eigen::Vector3d counts = inverse_ * translation;
  Image image = {0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    if (periodic_[k]) {
      image[k] = static_cast<int>(std::lround(counts[static_cast<Eigen::Index>(k)]));
    }
  }
  return image;
}

Eigen::Vector3d Lattice::wrapped(const Eigen::Vector3d& p) const {
  if (!is_periodic()) return p;
  const Eigen::Vector3d counts = inverse_ * p;
  Image image = {0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    if (periodic_[k])
      image[k] = -static_cast<int>(std::floor(counts[static_cast<Eigen::Index>(k)]));
  }
  return p + translation(image);
}

std::vector<Eigen::Vector3d> Lattice::translations_within(double reach) const {
  std::array<int, 3> most = {0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    // Rows of the inverse are as long as one over the cell's heights.
    const double steps = reach * inverse_.row(static_cast<Eigen::Index>(k)).norm();
    most[k] = static_cast<int>(std::ceil(steps));
  }
  std::vector<Eigen::Vector3d> translations;
  for (int a = -most[0]; a <= most[0]; ++a) {
    for (int b = -most[1]; b <= most[1]; ++b) {
      for (int c = -most[2]; c <= most[2]; ++c) {
        if (a != 0 || b != 0 || c != 0) translations.push_back(translation({a, b, c}));
      }
    }
  }
  return translations;
}

double Lattice::covering_radius() const {
  // The half diagonal of a box is that far from its corners; other cells hold none farther.
  return 0.5 * short_.norm();
}

Lattice Lattice::reduced() const {
  Cell cell = short_;
  if (cell.determinant() < 0.0) cell = -cell;
  return {cell, periodic_};
}

Lattice Lattice::scaled(double factor) const { return {factor * cell_, periodic_}; }

}  // namespace trivalent::remesh
