#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "rebo/candidates.h"
#include "rebo/clean_kernel.h"
#include "rebo/general_atom.h"
#include "rebo/parameters.h"
#include "totals.h"
#include "trivalent/potentials/energy_forces.h"

namespace trivalent::potentials::rebo_detail {

/// REBO for many atoms, many times: finds neighbors again only when atoms have moved, evaluates
/// clean atoms (see clean_kernel_impl.h) several at a time, and all others by GeneralAtom.
///
/// Every atom first takes the derivatives of its own terms with respect to its own links; in a
/// second sweep each collects its force from both directions of its links. Within a sweep atoms are
/// independent, so threads neither wait for each other nor change a bit of the result.
class Evaluator {
 public:
  Evaluator(const Parameters& parameters, double skin, CleanKernel kernel = best_clean_kernel());

  /// @throws InvalidAtoms as NeighborList does.
  [[nodiscard]] const EnergyForces& evaluate(const Atoms& atoms);

  [[nodiscard]] EnergyForces take_result() && { return std::move(result_); }

 private:
  // What is kept of a tile only while it is evaluated.
  struct Scratch {
    std::vector<std::uint32_t> regular;
    std::vector<double> energies;  // per atom, own share
    std::vector<double> slopes;    // four per link
  };

  void start(const Atoms& atoms);
  [[nodiscard]] bool is_same_system(const Atoms& atoms) const;
  [[nodiscard]] double copy_positions(const Atoms& atoms);
  void place_images();

  void classify();
  void classify_tile(std::size_t tile);
  [[nodiscard]] bool is_regular(std::uint32_t atom, const Surroundings& in);
  void count_neighbors(std::uint32_t atom);
  void mark_around(std::uint32_t irregular);
  void mark(std::uint32_t atom, std::uint8_t state);

  [[nodiscard]] Totals evaluate_tile(std::size_t tile);
  [[nodiscard]] Eigen::Matrix3d evaluate_regular(std::size_t tile, Scratch& scratch) const;
  void prefetch_around(std::size_t tile, std::uint32_t offset) const;
  [[nodiscard]] Eigen::Matrix3d evaluate_general(std::size_t tile, Scratch& scratch) const;
  [[nodiscard]] Totals gather(std::size_t tile, const Scratch& scratch);
  void export_crossings(std::size_t tile, const Scratch& scratch);
  void import_crossings(std::size_t tile);
  void add_coordination_slopes_of_neighbors(std::size_t tile);
  [[nodiscard]] Totals add_forces_of_cutoffs(std::size_t tile);

  [[nodiscard]] CleanArguments clean_arguments(std::size_t tile, Scratch& scratch) const;
  [[nodiscard]] Slopes slopes(std::size_t tile, Scratch& scratch) const;
  [[nodiscard]] Surroundings surroundings() const;
  [[nodiscard]] Eigen::Vector3d separation(std::uint32_t atom, std::uint32_t link) const;

  const Parameters& parameters_;
  CleanParameters clean_parameters_;
  CleanKernel clean_kernel_;
  double skin_;
  double moved_ = 0.0;  // upper bound of how far any atom went since neighbors were found [Å]
  Box box_;
  std::optional<Candidates> candidates_;
  std::vector<std::uint32_t> image_homes_;
  std::vector<std::vector<std::uint32_t>> irregular_;  // atoms, per tile

  // Arrays by atom, point or link. Those of general atoms are used only where such atoms are; left
  // without a value elsewhere, they take no memory there.
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
  EnergyForces result_;
};

}  // namespace trivalent::potentials::rebo_detail
