#include "trivalent/potentials/lennard_jones.h"

#include <cmath>

#include "cell_grid.h"
#include "parallel.h"
#include "totals.h"
#include "trivalent/potentials/error.h"
#include "validation.h"
#include "value_and_slope.h"

namespace trivalent::potentials {

namespace {

[[nodiscard]] ValueAndSlope pair_energy(double r, const LennardJonesOptions& options) {
  const double inverse = options.sigma / r;
  const double sixth = inverse * inverse * inverse * inverse * inverse * inverse;
  return {4.0 * options.epsilon * sixth * (sixth - 1.0),
          -24.0 * options.epsilon * sixth * (2.0 * sixth - 1.0) / r};
}

void require_valid_options(const LennardJonesOptions& options) {
  require_positive(options.sigma, "lennard_jones", "sigma");
  require_positive(options.cutoff, "lennard_jones", "cutoff");
  if (!std::isfinite(options.epsilon)) {
    throw InvalidOption("lennard_jones: epsilon is not finite");
  }
}

}  // namespace

EnergyForces lennard_jones(const AtomsView& atoms, const LennardJonesOptions& options) {
  return LennardJones(options).evaluate(atoms);
}

LennardJones::LennardJones(const LennardJonesOptions& options) : options_(options) {
  require_valid_options(options);
}

void LennardJones::compute(const AtomsView& atoms, EnergyForces& result) {
  require_valid(atoms, "lennard_jones");
  const LennardJonesOptions& options = options_;
  const CellGrid grid(atoms, options.cutoff);
  const double energy_at_cutoff = options.shift ? pair_energy(options.cutoff, options).value : 0.0;

  set_zero(result, atoms.size());
  // Each pair is met from both ends: half of its energy and virial, and the whole force, go to
  // each.
  const auto sum_chunk = [&](std::size_t begin, std::size_t end) {
    Totals totals;
    grid.for_each_neighbor(
        begin, end,
        [&](std::size_t p, std::size_t q, const Eigen::Vector3d& separation, double r2) {
          const std::uint32_t atom = grid.points()[p].atom;
          if (r2 <= 0.0) throw_coincident("lennard_jones", atom, grid.points()[q].atom);
          const double r = std::sqrt(r2);
          const ValueAndSlope pair = pair_energy(r, options);
          const Eigen::Vector3d force = pair.slope / r * separation;
          const double energy = 0.5 * (pair.value - energy_at_cutoff);
          result.energies[atom] += energy;
          result.forces[atom] += force;
          totals.energy += energy;
          totals.virial -= 0.5 * force * separation.transpose();
        });
    return totals;
  };
  const auto totals = sum_over_chunks<Totals>(grid.points().size(), sum_chunk);
  result.energy = totals.energy;
  result.virial = totals.virial;
}

}  // namespace trivalent::potentials
