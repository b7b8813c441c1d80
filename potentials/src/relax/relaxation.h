#pragma once

#include "relax/descent.h"
#include "trivalent/potentials/relax.h"

namespace trivalent::potentials::relax_detail {

/// One relaxation, from its start to its end: see relax().
class Relaxation {
 public:
  Relaxation(Atoms atoms, Potential& potential, const RelaxOptions& options);

  [[nodiscard]] RelaxResult run() &&;

 private:
  [[nodiscard]] bool is_network_known() const { return !options_.bonds.empty(); }
  /// Takes bonds for springs and preconditioner.
  void set_bonds(std::vector<Bond> bonds);

  /// How a rough structure without a network may go down, beside long steps of FIRE.
  enum class Way { short_steps, springs };

  /// Rough structures without a network: takes the way that leads lowest.
  void choose_start();
  [[nodiscard]] bool has_kept_bonds(const RelaxResult& result) const;
  /// Goes down under the potential until it is plain where this leads.
  void try_out(RelaxResult& result, double max_move);
  /// Springs, then the potential with springs.
  void start_gently(RelaxResult& result);
  /// Draws by springs alone; returns whether the relaxation may go on.
  [[nodiscard]] bool draw(RelaxResult& result, const SpringOptions& springs, int max_steps);
  void descend_freely();
  /// Puts springs on bonds that want to tear.
  void hold_bonds();
  /// Energy and forces of atoms that were stopped among springs.
  void measure();
  [[nodiscard]] const BondLaplacian* preconditioner() const {
    return preconditioner_ ? &*preconditioner_ : nullptr;
  }

  Potential& potential_;
  const RelaxOptions& options_;
  std::vector<Bond> bonds_;  // of the network, or guessed
  std::optional<BondLaplacian> preconditioner_;
  RelaxResult result_;
};

}  // namespace trivalent::potentials::relax_detail
