#include "lammps_options.h"

namespace trivalent::apps {
namespace {

enum class Engine { own, lammps };

constexpr shell::Names<Engine, 2> engines = {{{"own", Engine::own}, {"lammps", Engine::lammps}}};

}  // namespace

void add_lammps_options(po::options_description& options) {
  options.add_options()                                            //
      ("ranks", with_default(1), "MPI processes of LAMMPS, >= 1")  //
      ("potential-file", po::value<std::string>(),
       "CH.rebo or CH.airebo for LAMMPS; default: it finds them itself");
}

void add_engine_options(po::options_description& options) {
  options.add_options()("engine", with_default_name(Engine::own, engines),
                        "who computes: own, or lammps (its program lmp)");
  add_lammps_options(options);
}

shell::LammpsOptions lammps_options(const Session& session,
                                    const shell::PotentialChoice& potential) {
  if (!potential.pair_style && !shell::find_potential(potential).lammps) {
    throw UsageError("LAMMPS is asked for the potentials rebo and airebo only, not " +
                     potential.name + "; --pair-style names any of its own");
  }
  shell::LammpsOptions options =
      shell::lammps_options("lammps", potential, {.ranks = session.get<int>("ranks")});
  if (options.ranks < 1) throw UsageError("--ranks must be at least 1");
  if (const auto file = session.find<std::string>("potential-file")) options.potential_file = *file;
  shell::require_lammps(options);
  if (!options.pair_style) static_cast<void>(potential_file(session, options));
  return options;
}

std::optional<shell::LammpsOptions> engine_options(const Session& session,
                                                   const shell::PotentialChoice& potential) {
  if (named_value(session, "engine", engines) == Engine::lammps) {
    return lammps_options(session, potential);
  }
  if (potential.pair_style) throw UsageError("--pair-style goes with --engine lammps");
  refuse_lammps_options(session, "--engine lammps");
  return std::nullopt;
}

void refuse_lammps_options(const Session& session, const std::string& condition) {
  if (session.get<int>("ranks") == 1 && !session.has("potential-file")) return;
  throw UsageError("--ranks and --potential-file go with " + condition);
}

std::string potential_file(const Session& session, const shell::LammpsOptions& options) {
  shell::LammpsPotentialFile file = shell::find_potential_file(options);
  if (file.warning) session.terminal.note(*file.warning);
  return std::move(file.name);
}

}  // namespace trivalent::apps
