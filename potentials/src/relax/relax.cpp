#include "trivalent/potentials/relax.h"

#include "relax/relaxation.h"
#include "trivalent/potentials/error.h"
#include "validation.h"

namespace trivalent::potentials {

namespace {

void check_options(const Atoms& atoms, const RelaxOptions& options) {
  require_positive(options.max_force, "relax", "max_force");
  require_positive(options.max_move, "relax", "max_move");
  if (!(options.energy_change >= 0.0)) throw InvalidOption("relax: energy_change must be >= 0");
  if (options.max_steps < 0) throw InvalidOption("relax: max_steps must be >= 0");
  if (options.checkpoint_every < 1) throw InvalidOption("relax: checkpoint_every must be >= 1");
  const auto require_atom = [&](std::uint32_t atom, std::string_view what) {
    if (atom < atoms.size()) return;
    throw InvalidAtoms(concat("relax: ", what, " names atom ", atom, "; there are ", atoms.size()));
  };
  for (const std::uint32_t atom : options.fixed) require_atom(atom, "fixed");
  for (const Bond& bond : options.bonds) {
    require_atom(bond.first, "a bond");
    require_atom(bond.second, "a bond");
  }
}

}  // namespace

RelaxResult relax(Atoms atoms, Potential& potential, const RelaxOptions& options) {
  require_valid(atoms, "relax");
  check_options(atoms, options);
  return relax_detail::Relaxation(std::move(atoms), potential, options).run();
}

}  // namespace trivalent::potentials
