#include "potential_options.h"

#include <array>
#include <string_view>

#include "trivalent/dual/energy_summary.h"
#include "trivalent/dual/graphene.h"
#include "trivalent/potentials/airebo.h"
#include "trivalent/potentials/lennard_jones.h"
#include "trivalent/potentials/rebo.h"

namespace trivalent::apps {
namespace {

potentials::LennardJonesOptions lennard_jones_options(const Session& session) {
  return {.epsilon = session.get<double>("lj-epsilon"),
          .sigma = session.get<double>("lj-sigma"),
          .cutoff = session.get<double>("lj-cutoff"),
          .shift = session.has("lj-shift")};
}

using PotentialPointer = std::unique_ptr<potentials::Potential>;

/// A potential as the command line knows it.
struct Potential {
  std::string_view name;
  PotentialPointer (*make)(const Session&);
};

constexpr std::array potentials_by_name = {
    Potential{
        "rebo",
        [](const Session&) -> PotentialPointer { return std::make_unique<potentials::Rebo>(); }},
    Potential{
        "airebo",
        [](const Session&) -> PotentialPointer { return std::make_unique<potentials::Airebo>(); }},
    Potential{"lj",
              [](const Session& session) -> PotentialPointer {
                return std::make_unique<potentials::LennardJones>(lennard_jones_options(session));
              }},
};

const Potential& chosen_potential(const Session& session) {
  const auto& name = session.get<std::string>("potential");
  for (const Potential& potential : potentials_by_name) {
    if (potential.name == name) return potential;
  }
  throw UsageError("--potential is rebo, airebo or lj, not '" + name + "'");
}

}  // namespace

void add_potential_options(po::options_description& options) {
  const potentials::LennardJonesOptions defaults;
  options.add_options()  //
      ("potential", with_default(std::string(potentials_by_name.front().name)),
       "rebo: second-generation REBO; airebo: AIREBO with all its terms; lj: Lennard-Jones")  //
      ("lj-epsilon", with_default(defaults.epsilon), "depth of the well [eV]")                //
      ("lj-sigma", with_default(defaults.sigma), "distance of zero energy [Å]")               //
      ("lj-cutoff", with_default(defaults.cutoff), "range [Å]")                               //
      ("lj-shift", "shift energies to 0 at the cutoff");
}

void check_potential(const Session& session) { static_cast<void>(chosen_potential(session)); }

std::unique_ptr<potentials::Potential> make_potential(const Session& session) {
  return chosen_potential(session).make(session);
}

potentials::EnergyForces evaluate(const potentials::Atoms& atoms, const Session& session) {
  return make_potential(session)->evaluate(atoms);
}

std::string potential_text(const Session& session) {
  const auto lj = lennard_jones_options(session);
  std::ostringstream text;
  text.precision(17);
  text << chosen_potential(session).name << ' ' << lj.epsilon << ' ' << lj.sigma << ' ' << lj.cutoff
       << ' ' << lj.shift;
  return text.str();
}

double graphene_reference(const Session& session) {
  if (is_rebo(session)) return dual::graphene_energy;
  const potentials::Atoms cell = dual::graphene_cell();
  return evaluate(cell, session).energy / static_cast<double>(cell.size());
}

bool is_rebo(const Session& session) { return chosen_potential(session).name == "rebo"; }

}  // namespace trivalent::apps
