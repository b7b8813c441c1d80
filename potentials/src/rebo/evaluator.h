#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "rebo/candidates.h"
#include "rebo/irregular_atom.h"
#include "rebo/parameters.h"
#include "rebo/regular_kernel.h"
#include "rebo/regular_tiles.h"
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

  /// Sets all of `result`, whatever it held.
  ///
  /// @throws InvalidAtoms as NeighborList does.
  void evaluate(const Atoms& atoms, EnergyForces& result);

  /// Clears the neighbors and what is known of the tiles: the next evaluation is that of a new
  /// object.
  void forget() { candidates_.reset(); }

 private:
  // One value per tile; bytes, as several threads write to them.
  using TileFlags = std::vector<std::uint8_t>;

  // What a thread keeps of a tile only while it is evaluated.
  struct Workspace {
    RegularTiles::Workspace tile;
    std::vector<std::uint32_t> regular;
    TileSlopes slopes;
  };

  void start(const Atoms& atoms);
  [[nodiscard]] bool is_same_system(const Atoms& atoms) const;
  [[nodiscard]] bool evaluate_tiles(const Atoms& atoms);
  [[nodiscard]] bool evaluate_regular_tiles(const Atoms& atoms);
  [[nodiscard]] bool evaluate_irregular_tiles(const Atoms& atoms);

  [[nodiscard]] TileFlags and_near(const TileFlags& tiles) const;
  [[nodiscard]] bool place(const Atoms& atoms, const TileFlags& tiles);
  void place_images(const TileFlags& tiles);
  [[nodiscard]] TileFlags irregular_tiles() const;

  void classify(const TileFlags& tiles);
  void classify_tile(std::size_t tile);
  [[nodiscard]] bool is_regular(std::uint32_t atom, const Surroundings& in);
  void count_neighbors(std::uint32_t atom);
  void mark_around(std::uint32_t irregular);
  void mark(std::uint32_t atom, std::uint8_t state);

  [[nodiscard]] Totals evaluate_tile(std::size_t tile);
  void evaluate_regular(std::size_t tile, Workspace& workspace) const;
  void prefetch_next(std::size_t tile, Part part) const;
  void prefetch_result(std::size_t atom) const;
  void evaluate_irregular(std::size_t tile, TileSlopes& slopes) const;
  [[nodiscard]] Totals gather(std::size_t tile, const TileSlopes& slopes);
  void export_crossings(std::size_t tile, const TileSlopes& slopes);
  void import_crossings(std::size_t tile);
  void add_coordination_slopes_of_neighbors(std::size_t tile);
  [[nodiscard]] Totals add_forces_of_cutoffs(std::size_t tile);

  [[nodiscard]] RegularArguments regular_arguments(std::size_t tile, TileSlopes& slopes) const;
  [[nodiscard]] Slopes irregular_slopes(std::size_t tile, TileSlopes& slopes) const;
  [[nodiscard]] Surroundings surroundings() const;
  [[nodiscard]] Eigen::Vector3d separation(std::uint32_t atom, std::uint32_t link) const;

  const Parameters& parameters_;
  RegularParameters regular_parameters_;
  RegularKernel regular_kernel_;
  double skin_;
  Box box_;
  std::optional<Candidates> candidates_;
  std::optional<RegularTiles> regular_tiles_;
  TileFlags
      is_irregular_;  // whether a tile has irregular atoms in it or near it, as far as is known
  std::vector<Totals> totals_;  // per tile
  tbb::enumerable_thread_specific<Workspace> workspaces_;
  std::vector<std::uint32_t> image_homes_;
  std::vector<std::vector<std::uint32_t>> irregular_;  // atoms, per tile

  // Arrays by atom, point or link. Those of irregular atoms are used only where such atoms are;
  // left without a value elsewhere, they take no memory there.
  template <typename T>
  using Array = std::unique_ptr<T[]>;
  Array<double> positions_;
  Array<std::uint8_t> states_;
  Array<std::uint32_t> bonded_;
  Array<Coordination> coordinations_;
  Array<Eigen::Vector4d> exports_;  // per crossing: slope of its link and energy for the other end
  Array<double> cutoff_slopes_;
  Array<double> other_slopes_;
  Array<Coordination> coordination_slopes_;
  EnergyForces* result_ = nullptr;  // of the evaluation under way
};

}  // namespace trivalent::potentials::rebo_detail
