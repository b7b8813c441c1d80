#pragma once

#include <algorithm>
#include <vector>

#include "crystal/lbfgs.h"
#include "crystal/membrane.h"
#include "crystal/membrane_laplacian.h"
#include "crystal/membrane_preconditioner.h"
#include "crystal/parallel_membrane.h"
#include "crystal/vertex_images.h"

namespace trivalent::remesh {

/// When a membrane counts as relaxed.
struct MembraneLimits {
  int max_steps;
  double tolerance;         ///< [eV] ends once the predicted decrease is less
  bool across_net = false;  ///< steps reach across the whole net, but take longer to prepare
};

/// A membrane's terms in a cell: images of vertices move with them.
struct MembraneInCell {
  const Membrane& membrane;
  const MembraneTerms<double>& terms;
  const VertexImages& images;
  const Lattice& lattice;
};

/// Moves vertices to the minimum of the energy, which is returned without cores and count [eV].
///
/// @param positions  Of the vertices [Å].
/// @param gives_up   (energy, predicted decrease) -> bool; ends early once true
template <typename GivesUp>
double minimize_membrane(Lbfgs<double>& minimizer, const MembraneInCell& cell,
                         std::vector<Eigen::Vector3d>& positions, const MembraneLimits& limits,
                         const GivesUp& gives_up) {
  const std::size_t n = positions.size();
  std::vector<Lanes<double>> lanes(n);
  Lbfgs<double>::Vector x(4 * static_cast<Eigen::Index>(n));
  for (std::size_t i = 0; i < n; ++i) {
    lanes[i] << positions[i], 0.0;
    x.segment<4>(4 * static_cast<Eigen::Index>(i)) = lanes[i];
  }
  cell.images.place(cell.lattice, lanes);
  std::vector<Lanes<double>> slopes(lanes.size());
  ParallelMembrane membrane(cell.membrane, cell.terms, lanes.size());
  const auto evaluate = [&](const Lbfgs<double>::Vector& at, Lbfgs<double>::Vector& gradient) {
    std::copy_n(at.data(), at.size(), lanes[0].data());
    cell.images.place(cell.lattice, lanes);
    const double energy = membrane.evaluate(lanes, slopes);
    cell.images.collect(slopes);
    std::copy_n(slopes[0].data(), at.size(), gradient.data());
    return energy;
  };
  const auto minimize = [&](const auto& inverse) {
    return minimizer.minimize(
        x,
        {.max_steps = limits.max_steps,
         .max_move = 0.3 * cell.membrane.length,
         .tolerance = limits.tolerance,
         .rescales = !limits.across_net},
        evaluate, [&](Lbfgs<double>::Vector& v) { inverse.apply(v); }, gives_up);
  };
  const double energy = limits.across_net
                            ? minimize(MembraneLaplacian(cell.membrane, cell.terms, n, cell.images))
                            : minimize(MembranePreconditioner<double>(cell.membrane, cell.terms,
                                                                      lanes, n, cell.images));
  for (std::size_t i = 0; i < n; ++i) {
    positions[i] = x.segment<3>(4 * static_cast<Eigen::Index>(i));
  }
  return energy;
}

}  // namespace trivalent::remesh
