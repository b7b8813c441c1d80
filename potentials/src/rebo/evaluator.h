#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <memory>
#include <vector>

#include "rebo/atom_arrays.h"
#include "rebo/candidates.h"
#include "rebo/classifier.h"
#include "rebo/force_sums.h"
#include "rebo/irregular_tiles.h"
#include "rebo/parameters.h"
#include "rebo/regular_kernel.h"
#include "rebo/regular_tiles.h"
#include "rebo/tile_flags.h"
#include "rebo/tile_slopes.h"
#include "totals.h"
#include "trivalent/potentials/energy_forces.h"

namespace trivalent::potentials::rebo_detail {

/// REBO for many atoms, many times: finds neighbors again only when atoms have moved, evaluates
/// regular atoms (see regular_kernel_impl.h) several at a time, and all others by IrregularAtom.
///
/// Every atom first takes the derivatives of its own terms with respect to its own links; then it
/// collects its force from both directions of its links. Tiles without irregular atoms around go
/// the short way through RegularTiles; for the others, all atoms near them are looked at first.
/// Within a sweep tiles are independent, so threads neither wait for each other nor change a bit of
/// the result.
class Evaluator {
 public:
  Evaluator(const Parameters& parameters, double skin,
            RegularKernel kernel = best_regular_kernel());
  Evaluator(const Evaluator&) = delete;
  Evaluator& operator=(const Evaluator&) = delete;
  ~Evaluator() = default;

  /// Sets all of `result`, whatever it held.
  ///
  /// @throws InvalidAtoms as NeighborList does.
  void evaluate(const AtomsView& atoms, EnergyForces& result);

  /// Clears the neighbors and what is known of the tiles: the next evaluation is that of a new
  /// object.
  void forget() { known_.reset(); }

 private:
  // What a thread keeps of a tile only while it is evaluated.
  struct Workspace {
    RegularTiles::Workspace tile;
    std::vector<std::uint32_t> regular;
    TileSlopes slopes;
  };

  // What is known of the atoms for as long as they stay near where they were.
  struct Known {
    Known(const Evaluator& evaluator, const AtomsView& atoms_then);

    Candidates candidates;
    RegularTiles regular_tiles;
    AtomArrays atoms;
    Classifier classifier;
    IrregularTiles irregular_tiles;
    ForceSums sums;
  };

  void start(const AtomsView& atoms);
  [[nodiscard]] bool is_same_system(const AtomsView& atoms) const;
  [[nodiscard]] bool evaluate_tiles(const AtomsView& atoms, EnergyForces& result);
  [[nodiscard]] bool evaluate_regular_tiles(const AtomsView& atoms, EnergyForces& result);
  [[nodiscard]] bool evaluate_irregular_tiles(const AtomsView& atoms, EnergyForces& result);
  [[nodiscard]] bool place(const AtomsView& atoms, const TileFlags& tiles);
  [[nodiscard]] TileFlags and_near(const TileFlags& tiles) const;

  const Parameters& parameters_;
  RegularParameters regular_parameters_;
  RegularKernel regular_kernel_;
  double skin_;
  Box box_;
  std::unique_ptr<Known> known_;
  TileFlags is_irregular_;  // tiles that have irregular atoms in them or near them, as far as known
  std::vector<Totals> totals_;  // per tile
  tbb::enumerable_thread_specific<Workspace> workspaces_;
};

}  // namespace trivalent::potentials::rebo_detail
