#include "validation.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "trivalent/potentials/error.h"

namespace trivalent::potentials {

namespace {

void require_valid_box(const Box& box, std::string_view function) {
  double edges = 1.0;
  for (int k = 0; k < 3; ++k) {
    if (!box.periodic[static_cast<std::size_t>(k)]) continue;
    const double length = box.cell.col(k).norm();
    if (!(length > 0.0) || !std::isfinite(length)) {
      throw InvalidAtoms(concat(function, ": the box is periodic along direction ", k,
                                " but has no finite cell vector there; set Box::cell"));
    }
    edges *= length;
  }
  // Relative to a box with the same edges at right angles: the shape matters, not the size.
  constexpr double flattest = 1e-9;
  if (!(std::abs(completed_cell(box).determinant()) > flattest * edges)) {
    throw InvalidAtoms(concat(function,
                              ": the periodic cell vectors are linearly dependent; "
                              "set Box::cell to vectors that span the box"));
  }
}

}  // namespace

void require_valid(const AtomsView& atoms, std::string_view function) {
  if (atoms.positions.size() != atoms.species.size()) {
    throw InvalidAtoms(concat(function, ": ", atoms.positions.size(), " positions but ",
                              atoms.species.size(), " species; give one species per position"));
  }
  if (atoms.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw InvalidAtoms(
        concat(function, ": ", atoms.size(), " atoms are more than 32-bit ids count"));
  }
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    if (!atoms.positions[i].allFinite()) {
      throw InvalidAtoms(concat(function, ": atom ", i, " has a position that is not finite (",
                                atoms.positions[i].transpose(), ")"));
    }
  }
  if (atoms.box.is_periodic()) require_valid_box(atoms.box, function);
}

void require_positive(double value, std::string_view function, std::string_view option) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw InvalidOption(concat(function, ": ", option, " is ", value, "; it must be > 0"));
  }
}

void throw_coincident(std::string_view function, std::uint32_t a, std::uint32_t b) {
  throw InvalidAtoms(concat(function, ": atoms ", std::min(a, b), " and ", std::max(a, b),
                            " are on top of each other; remove one of them"));
}

Eigen::Matrix3d completed_cell(const Box& box) {
  Eigen::Matrix3d cell = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) {
    if (box.periodic[static_cast<std::size_t>(k)]) cell.col(k) = box.cell.col(k);
  }
  for (int k = 0; k < 3; ++k) {
    if (box.periodic[static_cast<std::size_t>(k)]) continue;
    const Eigen::Vector3d a = cell.col((k + 1) % 3);
    const Eigen::Vector3d b = cell.col((k + 2) % 3);
    Eigen::Vector3d normal = a.cross(b);
    // With fewer than two vectors in place, anything perpendicular to the one there is will do.
    if (normal.isZero(0.0))
      normal = a.isZero(0.0) && b.isZero(0.0) ? Eigen::Vector3d::Unit(k) : (a + b).unitOrthogonal();
    cell.col(k) = normal.normalized();
  }
  return cell;
}

}  // namespace trivalent::potentials
