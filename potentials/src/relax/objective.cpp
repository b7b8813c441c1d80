#include "relax/objective.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace trivalent::potentials::relax_detail {

namespace {

Eigen::Matrix3d projector_on_periodic(const Box& box) {
  Eigen::Matrix3d basis = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) {
    if (!box.periodic[static_cast<std::size_t>(k)]) continue;
    Eigen::Vector3d rest = box.cell.col(k);
    for (int j = 0; j < k; ++j) rest -= basis.col(j).dot(rest) * basis.col(j);
    basis.col(k) = rest.normalized();
  }
  return basis * basis.transpose();
}

}  // namespace

Objective::Objective(Atoms atoms, const DescentOptions& descent,
                     std::span<const std::uint32_t> fixed)
    : atoms_(std::move(atoms)),
      potential_(descent.potential),
      springs_(descent.springs),
      guard_(atoms_, {descent.guarded.begin(), descent.guarded.end()}),
      is_fixed_(atoms_.size(), false),
      has_cell_(descent.box == BoxPolicy::pressure_free && atoms_.box.is_periodic()),
      first_cell_(atoms_.box.cell),
      free_directions_(projector_on_periodic(atoms_.box)),
      // A strain then is about as stiff as the displacement of one atom.
      cell_length_(std::sqrt(static_cast<double>(atoms_.size()))) {
  for (const std::uint32_t atom : fixed) is_fixed_[atom] = true;
}

Point Objective::start() const {
  const auto n = static_cast<Eigen::Index>(3 * atoms_.size());
  Point point;
  point.coordinates.setZero(n + (has_cell_ ? 9 : 0));
  point.gradient.setZero(point.coordinates.size());
  for (std::size_t i = 0; i < atoms_.size(); ++i) {
    point.coordinates.segment<3>(static_cast<Eigen::Index>(3 * i)) = atoms_.positions[i];
  }
  return point;
}

bool Objective::evaluate(Point& point) {
  place_atoms(point.coordinates);
  if (!guard_.allows(atoms_)) return false;
  ++evaluations_;
  double energy = 0.0;
  if (potential_ != nullptr) {
    result_ = potential_->evaluate(atoms_, std::move(result_));
    energy += result_.energy;
  }
  if (springs_ != nullptr) {
    spring_forces_ = springs_->evaluate(atoms_, std::move(spring_forces_));
    energy += spring_forces_.energy;
  }
  if (!std::isfinite(energy)) return false;
  point.energy = energy;
  set_gradient(point.gradient);
  return true;
}

double Objective::largest_force() const {
  double square = 0.0;
  for (std::size_t i = 0; i < atoms_.size(); ++i) {
    if (!is_fixed_[i]) square = std::max(square, result_.forces[i].squaredNorm());
  }
  return std::sqrt(square);
}

Eigen::Vector3d Objective::force(std::size_t atom) const {
  if (is_fixed_[atom]) return Eigen::Vector3d::Zero();
  if (springs_ == nullptr) return result_.forces[atom];
  if (potential_ == nullptr) return spring_forces_.forces[atom];
  return result_.forces[atom] + spring_forces_.forces[atom];
}

void Objective::place_atoms(const Vector& coordinates) {
  if (has_cell_) {
    const Eigen::Matrix3d strain = Eigen::Matrix3d::Map(coordinates.data() + 3 * atoms_.size());
    deformation_ =
        Eigen::Matrix3d::Identity() + free_directions_ * strain * free_directions_ / cell_length_;
    atoms_.box.cell = deformation_ * first_cell_;
  }
  for_each_chunk(atoms_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto x = coordinates.segment<3>(static_cast<Eigen::Index>(3 * i));
      atoms_.positions[i] = has_cell_ ? Eigen::Vector3d(deformation_ * x) : Eigen::Vector3d(x);
    }
  });
}

void Objective::set_gradient(Vector& gradient) const {
  for_each_chunk(atoms_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d f = force(i);
      gradient.segment<3>(static_cast<Eigen::Index>(3 * i)) =
          has_cell_ ? Eigen::Vector3d(-deformation_.transpose() * f) : Eigen::Vector3d(-f);
    }
  });
  if (!has_cell_) return;
  const Eigen::Matrix3d slope = -result_.virial * deformation_.inverse().transpose();
  const Eigen::Matrix3d symmetric = 0.5 * (slope + slope.transpose());
  Eigen::Matrix3d::Map(gradient.data() + 3 * atoms_.size()) =
      free_directions_ * symmetric * free_directions_ / cell_length_;
}

}  // namespace trivalent::potentials::relax_detail
