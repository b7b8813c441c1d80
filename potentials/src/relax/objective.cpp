#include "relax/objective.h"

#include <Eigen/LU>
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

Objective::Objective(Atoms atoms, Potential& potential, const RelaxOptions& options)
    : atoms_(std::move(atoms)),
      potential_(potential),
      guard_(atoms_, options.bonds, options.bond_limit),
      fixed_(options.fixed),
      has_cell_(options.box == BoxPolicy::pressure_free && atoms_.box.is_periodic()),
      first_cell_(atoms_.box.cell),
      free_directions_(projector_on_periodic(atoms_.box)),
      // A strain then is about as stiff as the way of one atom.
      cell_length_(std::sqrt(static_cast<double>(atoms_.size()))) {}

Point Objective::start() {
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
  result_ = potential_.evaluate(atoms_, std::move(result_));
  ++evaluations_;
  if (!std::isfinite(result_.energy)) return false;
  point.energy = result_.energy;
  set_gradient(point.gradient);
  return true;
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
      const Eigen::Vector3d& f = result_.forces[i];
      gradient.segment<3>(static_cast<Eigen::Index>(3 * i)) =
          has_cell_ ? Eigen::Vector3d(-deformation_.transpose() * f) : Eigen::Vector3d(-f);
    }
  });
  for (const std::uint32_t atom : fixed_) {
    gradient.segment<3>(static_cast<Eigen::Index>(std::size_t{3} * atom)).setZero();
  }
  if (!has_cell_) return;
  const Eigen::Matrix3d slope = -result_.virial * deformation_.inverse().transpose();
  const Eigen::Matrix3d symmetric = 0.5 * (slope + slope.transpose());
  Eigen::Matrix3d::Map(gradient.data() + 3 * atoms_.size()) =
      free_directions_ * symmetric * free_directions_ / cell_length_;
}

}  // namespace trivalent::potentials::relax_detail
