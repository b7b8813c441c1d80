#include "relax_options.h"

#include <algorithm>
#include <optional>

#include "file_options.h"
#include "files.h"
#include "lammps_options.h"
#include "potential_options.h"
#include "structure_options.h"
#include "trivalent/shell/number_text.h"
#include "trivalent/shell/option_names.h"

namespace trivalent::apps {
namespace {

constexpr std::array<std::string_view, 2> trajectory_extensions = {".extxyz", ".xyz"};

/// LAMMPS's part of the options, if it is to do the work.
std::optional<shell::LammpsRelaxation> lammps_relaxation(const Session& session,
                                                         const shell::PotentialChoice& potential) {
  const auto run = engine_options(session, potential);
  if (!run) return std::nullopt;
  for (const std::string name : {"trajectory", "energy-change"}) {
    if (!session.values[name].defaulted() && session.has(name)) {
      throw UsageError("--" + name + " goes with --engine own");
    }
  }
  shell::LammpsRelaxation lammps = {.run = *run};
  lammps.folder = session.get<std::string>("output") + ".lammps";
  lammps.style = session.find<std::string>("minimizer").value_or(lammps.style);
  const auto& styles = shell::lammps_minimizers;
  if (std::ranges::find(styles, lammps.style) == styles.end()) {
    throw UsageError("--minimizer with --engine lammps is cg, fire, hftn, quickmin or sd, not '" +
                     lammps.style + "'");
  }
  lammps.on_progress = [&session, style = lammps.style](const shell::LammpsProgress& state) {
    session.terminal.progress("relaxing (LAMMPS, " + style + "): step " +
                              std::to_string(state.step) + ", energy " +
                              shell::decimals(state.energy, 4) + " eV, largest force component " +
                              shell::significant(state.largest_force_component) + " eV/Å");
  };
  return lammps;
}

std::optional<shell::TrajectoryOptions> trajectory(const Session& session) {
  const int every = session.get<int>("every");
  if (every < 1) throw UsageError("--every must be at least 1");
  const auto path = session.find<std::string>("trajectory");
  if (!path) return std::nullopt;
  check_output(*path, trajectory_extensions);
  return shell::TrajectoryOptions{.path = *path, .every = every};
}

}  // namespace

Grammar grammar_of_relax() {
  Grammar grammar = {.arguments = {"NETWORK"}, .options = po::options_description("Options")};
  grammar.options.add_options()  //
      ("output,o", po::value<std::string>(),
       "the relaxed atoms, .extxyz or another format of atoms; must "
       "be given");
  const shell::RelaxOptions defaults;
  grammar.options.add_options()  //
      ("max-force", with_default(defaults.max_force),
       "done once no atom has a larger force [eV/Å]")  //
      ("energy-change", with_default(defaults.energy_change),
       "or once ten steps together gain less than this [eV per atom]; 0: never")  //
      ("max-steps", with_default(defaults.max_steps), "or after so many steps")   //
      ("minimizer", po::value<std::string>(),
       "lbfgs (default) or fire; with --engine lammps one of its min_styles: cg (default), fire, "
       "...")  //
      ("fix", po::value<std::vector<std::string>>(),
       "atoms that stay: edge (fewer than three bonds), ids:1-9,12, sphere:x,y,z,radius or "
       "box:x0,y0,z0,x1,y1,z1 [Å]; may be given again")                                  //
      ("relax-box", "let the periodic cell vectors relax too, until no stress is left")  //
      ("trajectory", po::value<std::string>(),
       "file for the structures on the way, .extxyz")                     //
      ("every", with_default(10), "steps from one of these to the next")  //
      ("checkpoint-every", with_default(defaults.checkpoint_every),
       "steps from one checkpoint (OUT.extxyz.checkpoint) to the next; a run that was killed goes "
       "on from there when it is started again");
  add_engine_options(grammar.options);
  add_potential_options(grammar.options);
  add_digits_option(grammar.options);
  add_structure_options(grammar.options);
  grammar.epilog =
      "NETWORK is extended XYZ, LAMMPS data, or a mesh, whose dual is meant. A mesh, molecular\n"
      "LAMMPS data and extended XYZ with the column bonded_atoms, as trivalent writes it, say "
      "which\n"
      "atoms are bonded: these bonds are kept. Otherwise bonds are guessed from distances (C-C\n"
      "below 1.85 Å, C-H 1.55 Å, H-H 1.4 Å) and may break and form. Exit code 3: the result is\n"
      "written, but its atoms are not at rest.\n";
  return grammar;
}

shell::RelaxOptions relax_options(const Session& session) {
  shell::RelaxOptions options = {.potential = potential_choice(session),
                                 .max_force = session.get<double>("max-force"),
                                 .energy_change = session.get<double>("energy-change"),
                                 .max_steps = session.get<int>("max-steps"),
                                 .box = session.has("relax-box")
                                            ? potentials::BoxPolicy::pressure_free
                                            : potentials::BoxPolicy::fixed,
                                 .trajectory = trajectory(session),
                                 .checkpoint_every = session.get<int>("checkpoint-every")};
  options.fixed = session.find<std::vector<std::string>>("fix").value_or(options.fixed);
  options.lammps = lammps_relaxation(session, options.potential);
  options.on_note = [&session](const std::string& note) { session.terminal.note(note); };
  if (options.lammps) return options;
  options.checkpoint = session.get<std::string>("output") + ".checkpoint";
  if (session.has("minimizer")) {
    options.minimizer = named_value(session, "minimizer", shell::minimizer_names);
  }
  return options;
}

}  // namespace trivalent::apps
