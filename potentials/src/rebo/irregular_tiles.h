#pragma once

#include <cstdint>
#include <vector>

#include "rebo/atom_arrays.h"
#include "rebo/candidates.h"
#include "rebo/classifier.h"
#include "rebo/parameters.h"
#include "rebo/plain_array.h"
#include "rebo/prefetch.h"
#include "rebo/regular_kernel.h"
#include "rebo/tile_slopes.h"
#include "totals.h"

namespace trivalent::potentials::rebo_detail {

/// Evaluates tiles that have irregular atoms in them or near them, once their atoms are classified:
/// the regular ones by the kernel, all others by IrregularAtom.
class IrregularTiles {
 public:
  /// All must outlive it.
  struct Inputs {
    const Parameters& parameters;
    const RegularParameters& regular_parameters;
    RegularKernel kernel;
    const Candidates& candidates;
    const AtomArrays& atoms;
    const Classifier& classifier;
  };
  explicit IrregularTiles(const Inputs& inputs);

  /// Sets the slopes of a tile.
  ///
  /// @param regular  room for the numbers of atoms
  void evaluate(std::size_t tile, std::vector<std::uint32_t>& regular, TileSlopes& slopes);

  // Derivatives through the coordinations of irregular atoms, which all tiles must have found
  // first. In each of the two sweeps tiles are independent.

  /// Takes up the slopes that neighbors have found.
  void add_coordination_slopes(std::size_t tile);
  /// Adds the forces of bonds within their switching range to the result; returns their virial.
  [[nodiscard]] Totals add_forces_of_cutoffs(std::size_t tile, EnergyForces& result) const;

 private:
  [[nodiscard]] RegularArguments regular_arguments(std::size_t tile, TileSlopes& slopes) const;
  [[nodiscard]] Slopes irregular_slopes(std::size_t tile, TileSlopes& slopes) const;
  void evaluate_regular(std::size_t tile, std::vector<std::uint32_t>& regular,
                        TileSlopes& slopes) const;
  void evaluate_irregular(std::size_t tile, TileSlopes& slopes) const;
  void prefetch_next(std::size_t tile, Part part) const;

  Inputs in_;
  PlainArray<double> cutoff_slopes_;              // per link, dE/df [eV]
  PlainArray<double> other_slopes_;               // per link, dE/dN of the atom at its end [eV]
  PlainArray<Coordination> coordination_slopes_;  // per atom, dE/dN [eV]
};

}  // namespace trivalent::potentials::rebo_detail
