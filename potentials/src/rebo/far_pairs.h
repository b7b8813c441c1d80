#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "cell_grid.h"
#include "rebo/parameters.h"
#include "totals.h"
#include "trivalent/potentials/atoms.h"
#include "trivalent/potentials/energy_forces.h"
#include "value_and_slope.h"

namespace trivalent::potentials::rebo_detail {

/// From here on Lennard-Jones energies of AIREBO do not depend on the bond order that the two atoms
/// would have [Å].
constexpr double far_from = 3.816370964;  // 2^(1/6) σ of carbon, the longest of all

[[nodiscard]] const NonbondedParameters& nonbonded(Species a, Species b);

/// 4ε[(σ/r)^12 - (σ/r)^6], switched off smoothly before 3σ; with its slope in r². Without branches,
/// so that loops over pairs are vectorized.
[[nodiscard]] inline ValueAndSlope lennard_jones_energy(double r2, const NonbondedParameters& p) {
  const double inverse = 1.0 / r2;
  const double second = p.sigma * p.sigma * inverse;
  const double sixth = second * second * second;
  const double value = 4.0 * p.epsilon * sixth * (sixth - 1.0);
  const double slope = -12.0 * p.epsilon * sixth * (2.0 * sixth - 1.0) * inverse;
  const double begin = nonbonded_end.begin * p.sigma;
  const double per_width = 1.0 / ((nonbonded_end.end - nonbonded_end.begin) * p.sigma);
  const double r = std::sqrt(r2);
  const double t = std::min(std::max((r - begin) * per_width, 0.0), 1.0);
  const double kept = 1.0 - t * t * (3.0 - 2.0 * t);
  // d/dr² is 1/(2r) d/dr.
  const double fall = 6.0 * t * (1.0 - t) * per_width;
  return {value * kept, slope * kept - value * 0.5 * r * inverse * fall};
}

/// The Lennard-Jones energies of all pairs that are not nearer than far_from, whatever bonds
/// connect them.
///
/// Neighbors are kept until an atom has moved by half a skin, or species or box have changed.
class FarPairs {
 public:
  /// Adds energies, forces and virial.
  void add(const AtomsView& atoms, EnergyForces& result);

 private:
  struct Point {
    std::uint32_t atom;
    std::array<std::int32_t, 3> image;
  };

  [[nodiscard]] static ImagePair pair_of(const Point& from, const Point& to);
  /// From one center to its neighbors within reach.
  struct Separations {
    std::size_t count = 0;
    std::array<std::vector<double>, 3> along = {};  ///< x, y and z
    std::vector<double> squared = {};
    std::vector<Species> species = {};  ///< of the neighbors
    std::vector<double> values = {};    ///< their energies
    std::vector<double> slopes = {};    ///< in the square of the distance

    void make_room(std::size_t n) {
      if (n <= squared.size()) return;
      for (auto& axis : along) axis.resize(n);
      for (auto* numbers : {&squared, &values, &slopes}) numbers->resize(n);
      species.resize(n);
    }
    void evaluate(Species center);
    /// Sets those at `count`.
    void set(const Eigen::Vector3d& separation, double r2, Species other) {
      along[0][count] = separation.x();
      along[1][count] = separation.y();
      along[2][count] = separation.z();
      squared[count] = r2;
      species[count] = other;
    }
  };

  void find_separations(std::size_t center, const AtomsView& atoms, Separations& found) const;
  [[nodiscard]] bool is_current(const AtomsView& atoms) const;
  void find_neighbors(const AtomsView& atoms);
  [[nodiscard]] Totals add_of(std::size_t center, const AtomsView& atoms, Separations& pairs,
                              EnergyForces& result) const;

  Atoms at_ = {};                        // where neighbors were found
  std::vector<Point> points_;            // atoms and images of them, in the order of space
  std::vector<std::uint32_t> centers_;   // points that are atoms
  std::vector<std::size_t> first_;       // center → into others_
  std::vector<std::uint32_t> others_;    // points
  std::vector<Species> species_;         // of the points
  std::vector<Eigen::Vector3d> places_;  // of the points now
};

}  // namespace trivalent::potentials::rebo_detail
