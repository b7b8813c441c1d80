#pragma once

#include <memory>
#include <string>

#include "session.h"
#include "trivalent/potentials/atoms.h"
#include "trivalent/potentials/energy_forces.h"
#include "trivalent/potentials/potential.h"

namespace trivalent::apps {

/// --potential, and --lj-epsilon, --lj-sigma, --lj-cutoff, --lj-shift.
void add_potential_options(po::options_description& options);

/// @throws UsageError if there is no such potential.
void check_potential(const Session& session);

/// The potential that the options choose.
[[nodiscard]] std::unique_ptr<potentials::Potential> make_potential(const Session& session);

/// Evaluates it once.
[[nodiscard]] potentials::EnergyForces evaluate(const potentials::Atoms& atoms,
                                                const Session& session);

/// The potential and its parameters in words.
[[nodiscard]] std::string potential_text(const Session& session);

/// What an atom of graphene has under that potential [eV], at REBO's bond length.
[[nodiscard]] double graphene_reference(const Session& session);

/// Whether energies may be compared with those of graphene under REBO.
[[nodiscard]] bool is_rebo(const Session& session);

}  // namespace trivalent::apps
