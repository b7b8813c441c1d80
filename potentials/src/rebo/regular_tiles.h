#pragma once

#include <cstdint>
#include <vector>

#include "rebo/candidates.h"
#include "rebo/parameters.h"
#include "rebo/patch.h"
#include "rebo/prefetch.h"
#include "rebo/regular_kernel.h"
#include "rebo/tile_slopes.h"

namespace trivalent::potentials::rebo_detail {

/// Evaluates tiles in which all atoms are regular, and so are those linked to them.
///
/// Such a tile is read once: positions, whether atoms moved too far or stopped being regular, and
/// the evaluation itself all happen while it is in the cache. Whoever calls this finds out whether
/// atoms farther away are regular.
class RegularTiles {
 public:
  /// @param atoms  where they were when `candidates` were found
  RegularTiles(const AtomsView& atoms, const Candidates& candidates, const Range& cutoff);

  [[nodiscard]] const Patch& patch(std::size_t tile) const { return patches_[tile]; }

  /// What is kept of a tile only while it is evaluated.
  struct Workspace {
    std::vector<double> positions;       // four per point
    std::vector<std::uint32_t> first;    // per atom of the tile and point of the ring, and the end
    std::vector<std::uint32_t> point;    // per link
    std::vector<std::uint32_t> reverse;  // per link of the tile
    std::vector<std::uint32_t> bonded;   // as first
    std::vector<std::uint8_t> states;    // as first: nothing to tell of regular atoms
    std::vector<std::uint32_t> atoms;    // of the tile: all
  };

  enum class Outcome : std::uint8_t { evaluated, not_regular, moved };

  struct Task {
    const AtomsView& atoms;
    std::size_t tile;
    double max_moved;  ///< [Å] since the candidates were found
    const RegularParameters& parameters;
    RegularKernel kernel;
  };

  /// @return  what became of it; `slopes` only if it was evaluated
  [[nodiscard]] Outcome evaluate(const Task& task, Workspace& workspace, TileSlopes& slopes) const;

  /// Largest distance² of an atom of the tile from where it was [Å²]; infinite if one became
  /// another element or is nowhere.
  [[nodiscard]] double squared_way(const AtomsView& atoms, std::size_t tile) const;

 private:
  void place(const AtomsView& atoms, std::size_t tile, Workspace& workspace) const;
  void unpack(std::size_t tile, Workspace& workspace) const;
  [[nodiscard]] bool find_bonds(Workspace& workspace) const;
  void run_kernel(const Task& task, const Workspace& workspace, TileSlopes& slopes) const;
  void prefetch_next(const Task& task, Part part) const;

  const Candidates& candidates_;
  Range cutoff_;
  Box box_;
  std::vector<Eigen::Vector3d> start_;  // per atom [Å]
  std::vector<Patch> patches_;          // per tile
};

}  // namespace trivalent::potentials::rebo_detail
