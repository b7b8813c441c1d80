#include <algorithm>
#include <functional>

#include "command.h"
#include "files.h"
#include "fixed_atoms.h"
#include "interruption.h"
#include "lammps_engine.h"
#include "potential_options.h"
#include "relax_files.h"
#include "relax_report.h"
#include "reports.h"
#include "session.h"
#include "shell_files.h"
#include "structure.h"
#include "trivalent/dual/columns.h"
#include "trivalent/dual/energy_summary.h"
#include "trivalent/formats/xyz.h"
#include "trivalent/potentials/error.h"
#include "trivalent/potentials/relax.h"

namespace trivalent::apps {
namespace {

constexpr std::array<std::string_view, 2> relax_extensions = {".extxyz", ".xyz"};

Grammar grammar_of_relax() {
  Grammar grammar = {.arguments = {"NETWORK"}, .options = po::options_description("Options")};
  grammar.options.add_options()  //
      ("output,o", po::value<std::string>(), "the relaxed atoms, .extxyz; must be given");
  const potentials::RelaxOptions defaults;
  grammar.options.add_options()  //
      ("max-force", with_default(defaults.max_force),
       "done once no atom has a larger force [eV/Å]")  //
      ("energy-change", with_default(defaults.energy_change),
       "or once ten steps together gain less than this [eV per atom]; 0: never")  //
      ("max-steps", with_default(defaults.max_steps), "or after so many steps")   //
      ("minimizer", po::value<std::string>(),
       "lbfgs (default) or fire; with --engine lammps one of its min_styles: cg (default), fire, "
       "...")                                                                            //
      ("fix", po::value<std::vector<std::string>>(), fix_meaning)                        //
      ("relax-box", "let the periodic cell vectors relax too, until no stress is left")  //
      ("trajectory", po::value<std::string>(),
       "file for the structures on the way, .extxyz")                     //
      ("every", with_default(10), "steps from one of these to the next")  //
      ("checkpoint-every", with_default(defaults.checkpoint_every),
       "steps from one checkpoint (OUT.extxyz.checkpoint) to the next; a run that was killed goes "
       "on from there when it is started again");
  add_engine_options(grammar.options);
  add_potential_options(grammar.options);
  grammar.options.add_options()  //
      ("digits", with_default(std::string("decimals")), "of the output: decimals or 17");
  add_structure_options(grammar.options);
  grammar.epilog =
      "NETWORK is extended XYZ, LAMMPS data, or a mesh, whose dual is meant. A mesh and molecular\n"
      "LAMMPS data say which atoms are bonded: these bonds are kept. Otherwise bonds are guessed\n"
      "from distances (C-C below 1.85 Å, C-H 1.55 Å, H-H 1.4 Å) and may break and form.\n";
  return grammar;
}

potentials::Minimizer minimizer(const Session& session) {
  const std::string name = session.find<std::string>("minimizer").value_or("lbfgs");
  if (name == "lbfgs") return potentials::Minimizer::lbfgs;
  if (name == "fire") return potentials::Minimizer::fire;
  throw UsageError("--minimizer is lbfgs or fire, not '" + name + "'");
}

/// Bonds as the input has them, or else guessed.
std::vector<potentials::Bond> network_bonds(const dual::Structure& structure,
                                            const Session& session) {
  if (!structure.bonds.empty()) return structure.bonds;
  potentials::GuessedBonds guess = potentials::guess_bonds(structure.atoms);
  session.terminal.note(guess_note(guess));
  return std::move(guess.bonds);
}

potentials::RelaxOptions relax_options(const dual::Structure& structure,
                                       const std::vector<potentials::Bond>& bonds,
                                       const Session& session) {
  potentials::RelaxOptions options = {.minimizer = minimizer(session),
                                      .max_force = session.get<double>("max-force"),
                                      .energy_change = session.get<double>("energy-change"),
                                      .max_steps = session.get<int>("max-steps"),
                                      .box = session.has("relax-box")
                                                 ? potentials::BoxPolicy::pressure_free
                                                 : potentials::BoxPolicy::fixed,
                                      .checkpoint_every = session.get<int>("checkpoint-every")};
  // Guessed bonds may break and form.
  if (!structure.bonds.empty()) options.bonds = bonds;
  if (const auto groups = session.find<std::vector<std::string>>("fix")) {
    options.fixed = atoms_in_groups(*groups, structure.atoms, bonds);
  }
  return options;
}

std::filesystem::path checkpoint_path(const Session& session) {
  return session.get<std::string>("output") + ".checkpoint";
}

/// Takes up what an interrupted run has left; returns the atoms to begin with.
potentials::Atoms resume_or_start(const dual::Structure& structure, const std::string& mark,
                                  Trajectory* trajectory, potentials::RelaxOptions& options,
                                  const Session& session) {
  auto saved = load_relaxation(checkpoint_path(session), mark);
  if (saved && trajectory != nullptr && !trajectory->resume(saved->trajectory_size, saved->steps)) {
    saved.reset();
  }
  if (!saved) {
    if (trajectory != nullptr) trajectory->start();
    return structure.atoms;
  }
  session.terminal.note("going on from " + checkpoint_path(session).string() + ", step " +
                        std::to_string(saved->steps));
  options.start = potentials::RelaxStart::direct;
  options.first_step = saved->steps;
  options.first_evaluation = saved->evaluations;
  // A box that only frames a cluster comes back padded.
  if (!saved->atoms.box.is_periodic()) saved->atoms.box = structure.atoms.box;
  return std::move(saved->atoms);
}

/// Relaxes the atoms, with checkpoint, trajectory and progress as the options want them. The exit
/// code tells of a stop on the way.
potentials::RelaxResult relax_here(const dual::Structure& structure,
                                   const std::vector<potentials::Bond>& bonds, int& exit_code,
                                   const Session& session) {
  const StopRequest stop;
  potentials::RelaxOptions options = relax_options(structure, bonds, session);
  const std::string mark = fingerprint(structure.atoms, options, potential_text(session));
  std::optional<Trajectory> trajectory;
  if (session.has("trajectory")) {
    trajectory.emplace(session.get<std::string>("trajectory"), session.get<int>("every"));
  }
  potentials::Atoms atoms =
      resume_or_start(structure, mark, trajectory ? &*trajectory : nullptr, options, session);
  const auto potential = make_potential(session);
  options.on_checkpoint = [&](const potentials::RelaxCheckpoint& state) {
    save_relaxation(checkpoint_path(session), mark, state, trajectory ? trajectory->size() : 0);
  };
  RelaxLine line(session.terminal);
  options.on_progress = [&](const potentials::RelaxProgress& state) {
    if (trajectory) trajectory->add(state);
    line.show(state);
    return !stop.is_made();
  };
  auto relaxed = potentials::relax(std::move(atoms), *potential, options);
  if (trajectory && !stop.is_made()) trajectory->finish();
  exit_code = stop.exit_code();
  return relaxed;
}

/// The same by LAMMPS, which has no gentle start: bonds may break.
potentials::RelaxResult relax_with_lammps(const dual::Structure& structure,
                                          const std::vector<potentials::Bond>& bonds,
                                          const Session& session) {
  LammpsTask task = {.style = session.find<std::string>("minimizer").value_or("cg"),
                     .max_force = session.get<double>("max-force"),
                     .max_steps = session.get<int>("max-steps"),
                     .relax_box = session.has("relax-box")};
  if (const auto groups = session.find<std::vector<std::string>>("fix")) {
    task.fixed = atoms_in_groups(*groups, structure.atoms, bonds);
  }
  return run_lammps(structure.atoms, task, session.get<std::string>("output") + ".lammps", session);
}

Result describe(const RelaxReport& report, const potentials::RelaxResult& relaxed,
                const Session& session) {
  const auto summary = dual::summarize_energies(relaxed.result.energies, 0);
  Result result = {.table = {{"potential", session.get<std::string>("potential")},
                             {"atoms", std::to_string(relaxed.atoms.size())},
                             {"energy", decimals(summary.total, 8) + " eV"},
                             {"per atom", decimals(summary.mean, 8) + " eV"}},
                   .json = {{"network", session.get<std::string>("NETWORK")},
                            {"potential", session.get<std::string>("potential")},
                            {"unit", "eV"},
                            {"atoms", relaxed.atoms.size()},
                            {"energy", relaxed.result.energy},
                            {"energy_per_atom", summary.mean}}};
  if (is_rebo(session)) {
    result.table.push_back(
        {"above graphene", decimals(1000.0 * summary.excess(), 3) + " meV/atom"});
    result.json["excess_per_atom"] = summary.excess();
  }
  append(result.table, relax_rows(report, relaxed));
  result.json["relaxation"] = relax_json(report, relaxed);
  return result;
}

void write_result(const dual::Structure& structure, const potentials::RelaxResult& relaxed,
                  const Session& session) {
  dual::Structure result = structure;
  result.atoms = relaxed.atoms;
  dual::add_energies(result, relaxed.result);
  dual::add_displacements(result, structure.atoms.positions);
  dual::write_xyz(session.get<std::string>("output"), result, digits(session));
}

void check_minimization_by_lammps(const Session& session) {
  constexpr std::array<std::string_view, 5> styles = {"cg", "fire", "hftn", "quickmin", "sd"};
  const auto style = session.find<std::string>("minimizer");
  if (style && std::ranges::find(styles, *style) == styles.end()) {
    throw UsageError("--minimizer with --engine lammps is cg, fire, hftn, quickmin or sd, not '" +
                     *style + "'");
  }
  for (const std::string name : {"trajectory", "energy-change"}) {
    if (!session.values[name].defaulted() && session.has(name)) {
      throw UsageError("--" + name + " goes with --engine own");
    }
  }
  if (!(session.get<double>("max-force") > 0.0)) throw UsageError("--max-force must be > 0");
  if (session.get<int>("max-steps") < 1) throw UsageError("--max-steps must be at least 1");
}

void check_options(const Session& session) {
  if (!session.has("output")) throw UsageError("-o must say into which file the result goes");
  check_output(session.get<std::string>("output"), relax_extensions);
  static_cast<void>(digits(session));
  check_structure_options(session);
  check_potential(session);
  check_engine(session);
  if (uses_lammps(session)) {
    check_minimization_by_lammps(session);
  } else {
    static_cast<void>(minimizer(session));
  }
  if (session.get<int>("every") < 1) throw UsageError("--every must be at least 1");
  if (session.has("trajectory")) {
    check_output(session.get<std::string>("trajectory"), relax_extensions);
  }
}

int run(const Command& self, std::span<const std::string> arguments) {
  const auto session = start(self, arguments, grammar_of_relax());
  if (!session) return done;
  check_options(*session);
  const dual::Structure structure = read_structure(session->get<std::string>("NETWORK"), *session);
  const auto bonds = network_bonds(structure, *session);
  int exit_code = done;
  const potentials::RelaxResult relaxed = uses_lammps(*session)
                                              ? relax_with_lammps(structure, bonds, *session)
                                              : relax_here(structure, bonds, exit_code, *session);
  write_result(structure, relaxed, *session);
  // A run that was stopped can be taken up again.
  if (exit_code == done) std::filesystem::remove(checkpoint_path(*session));
  const RelaxReport report = report_relaxation(structure.atoms.positions, bonds, relaxed);
  session->terminal.notes(relax_notes(report, relaxed));
  session->terminal.print(describe(report, relaxed, *session));
  return exit_code;
}

}  // namespace

const Command relax_command = {
    .name = "relax",
    .synopsis = "NETWORK -o OUT.extxyz [--max-force F] [--minimizer lbfgs|fire] [options]",
    .meaning = "Brings atoms, or the dual of a mesh, to rest",
    .run = run};

}  // namespace trivalent::apps
