#include "potential_options.h"

#include "trivalent/potentials/lennard_jones.h"
#include "trivalent/potentials/rebo.h"

namespace trivalent::apps {
namespace {

constexpr const char* rebo_name = "rebo";
constexpr const char* lennard_jones_name = "lj";

potentials::LennardJonesOptions lennard_jones_options(const Session& session) {
  return {.epsilon = session.get<double>("lj-epsilon"),
          .sigma = session.get<double>("lj-sigma"),
          .cutoff = session.get<double>("lj-cutoff"),
          .shift = session.has("lj-shift")};
}

}  // namespace

void add_potential_options(po::options_description& options) {
  const potentials::LennardJonesOptions defaults;
  options.add_options()  //
      ("potential", with_default(std::string(rebo_name)),
       "rebo: second-generation REBO; lj: Lennard-Jones")                        //
      ("lj-epsilon", with_default(defaults.epsilon), "depth of the well [eV]")   //
      ("lj-sigma", with_default(defaults.sigma), "distance of zero energy [Å]")  //
      ("lj-cutoff", with_default(defaults.cutoff), "range [Å]")                  //
      ("lj-shift", "shift energies to 0 at the cutoff");
}

void check_potential(const Session& session) {
  const auto& name = session.get<std::string>("potential");
  if (name == rebo_name || name == lennard_jones_name) return;
  throw UsageError("--potential is rebo or lj, not '" + name + "'");
}

potentials::EnergyForces evaluate(const potentials::Atoms& atoms, const Session& session) {
  check_potential(session);
  if (is_rebo(session)) return potentials::rebo(atoms);
  return potentials::lennard_jones(atoms, lennard_jones_options(session));
}

bool is_rebo(const Session& session) { return session.get<std::string>("potential") == rebo_name; }

}  // namespace trivalent::apps
