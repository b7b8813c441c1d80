#include "potential_options.h"

#include "trivalent/dual/error.h"

namespace trivalent::apps {
namespace {

/// As in "rebo: second-generation REBO; lj: Lennard-Jones".
std::string potentials_help() {
  std::string text;
  for (const shell::KnownPotential& potential : shell::known_potentials()) {
    text += (text.empty() ? "" : "; ") + std::string(potential.name) + ": " +
            std::string(potential.meaning);
  }
  return text;
}

}  // namespace

void add_potential_options(po::options_description& options) {
  const shell::PotentialChoice defaults;
  const potentials::LennardJonesOptions& lj = defaults.lennard_jones;
  options.add_options()                                                        //
      ("potential", with_default(defaults.name), potentials_help().c_str())    //
      ("lj-epsilon", with_default(lj.epsilon), "lj: depth of the well [eV]")   //
      ("lj-sigma", with_default(lj.sigma), "lj: distance of zero energy [Å]")  //
      ("lj-cutoff", with_default(lj.cutoff), "lj: range [Å]")                  //
      ("lj-shift", "lj: shift energies to 0 at the cutoff");
  add_pair_options(options);
}

void add_pair_options(po::options_description& options) {
  options.add_options()  //
      ("pair-style", po::value<std::string>(),
       "any other potential of LAMMPS, as its command pair_style takes it: tersoff, lcbop, "
       "\"airebo "
       "3.0 1 1\", ...")  //
      ("pair-coeff", po::value<std::vector<std::string>>(),
       "arguments of pair_coeff, as in \"* * BNC.tersoff C\"; may be given again");
}

std::optional<dual::PairStyle> pair_style(const Session& session) {
  const auto style = session.find<std::string>("pair-style");
  const auto coefficients = session.find<std::vector<std::string>>("pair-coeff");
  if (style.has_value() != coefficients.has_value()) {
    throw UsageError("--pair-style and --pair-coeff go together");
  }
  if (!style) return std::nullopt;
  return dual::PairStyle{.style = *style, .coefficients = *coefficients};
}

shell::PotentialChoice potential_choice(const Session& session) {
  shell::PotentialChoice choice = {.name = session.get<std::string>("potential"),
                                   .lennard_jones = {.epsilon = session.get<double>("lj-epsilon"),
                                                     .sigma = session.get<double>("lj-sigma"),
                                                     .cutoff = session.get<double>("lj-cutoff"),
                                                     .shift = session.has("lj-shift")},
                                   .pair_style = pair_style(session)};
  for (const char* name : {"lj-epsilon", "lj-sigma", "lj-cutoff", "lj-shift"}) {
    const bool is_given = session.has(name) && !session.values[name].defaulted();
    if (is_given && choice.name != "lj") {
      throw UsageError(std::string("--") + name + " belongs to --potential lj");
    }
  }
  if (choice.pair_style && !session.values["potential"].defaulted()) {
    throw UsageError("--potential and --pair-style name two potentials; give one");
  }
  try {
    static_cast<void>(shell::find_potential(choice));
  } catch (const dual::InvalidOption& error) {
    throw UsageError(std::string("--potential: ") + error.what());
  }
  return choice;
}

}  // namespace trivalent::apps
