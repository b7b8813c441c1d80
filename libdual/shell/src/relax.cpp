#include "trivalent/shell/relax.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "relax_files.h"
#include "trivalent/dual/bonding.h"
#include "trivalent/dual/columns.h"
#include "trivalent/dual/energy_summary.h"
#include "trivalent/dual/error.h"
#include "trivalent/dual/walls.h"
#include "trivalent/formats/poscar.h"
#include "trivalent/shell/atom_groups.h"
#include "trivalent/shell/number_text.h"
#include "trivalent/shell/reports.h"

namespace trivalent::shell {
namespace {

void note(const RelaxOptions& options, const std::string& sentence) {
  if (options.on_note) options.on_note(sentence);
}

void check_lammps_options(const RelaxOptions& options) {
  const auto& styles = lammps_minimizers;
  if (std::ranges::find(styles, options.lammps->style) == styles.end()) {
    throw dual::InvalidOption("relax: LAMMPS has no min_style '" + options.lammps->style + "'");
  }
  static_cast<void>(lammps_options("relax", options.potential, options.lammps->run));
  if (options.trajectory) throw dual::InvalidOption("relax: LAMMPS writes no trajectory");
}

void check_options(const RelaxOptions& options) {
  static_cast<void>(find_potential(options.potential));
  if (!(options.max_force > 0.0)) throw dual::InvalidOption("relax: max_force must be > 0");
  if (options.max_steps < 1) throw dual::InvalidOption("relax: max_steps must be at least 1");
  if (options.trajectory && options.trajectory->every < 1) {
    throw dual::InvalidOption("relax: a trajectory needs at least 1 step between structures");
  }
  if (options.lammps) check_lammps_options(options);
}

/// Bonds as the structure has them, or else guessed.
std::vector<potentials::Bond> bonds_of(const dual::Structure& structure,
                                       const RelaxOptions& options) {
  if (!structure.bonds.empty()) return structure.bonds;
  potentials::GuessedBonds guess = potentials::guess_bonds(structure.atoms);
  note(options, guess_note(guess));
  return std::move(guess.bonds);
}

/// The atoms that stay: those of the options' groups, and those that no axis of the file's
/// selective dynamics lets move.
std::vector<std::uint32_t> fixed_atoms(const dual::Structure& structure,
                                       const std::vector<potentials::Bond>& bonds,
                                       const RelaxOptions& options) {
  std::vector<std::uint32_t> fixed = atoms_in_groups(options.fixed, structure.atoms, bonds);
  const auto* moves = dual::find_column<std::array<int, 3>>(structure, dual::selective_dynamics);
  if (moves == nullptr) return fixed;
  int n_held = 0;
  int n_partly = 0;
  for (std::uint32_t i = 0; i < moves->size(); ++i) {
    const auto n_axes = std::ranges::count_if((*moves)[i], [](int flag) { return flag != 0; });
    if (n_axes == 0) {
      fixed.push_back(i);
      ++n_held;
    } else if (n_axes < 3) {
      ++n_partly;
    }
  }
  std::ranges::sort(fixed);
  fixed.erase(std::unique(fixed.begin(), fixed.end()), fixed.end());
  if (n_held > 0) {
    note(options, std::to_string(n_held) + " atoms stay, as the file's selective dynamics say");
  }
  if (n_partly > 0) {
    note(options, std::to_string(n_partly) +
                      " atoms move along all axes, though the file's selective dynamics hold some");
  }
  return fixed;
}

/// A relaxation by our own minimizers, with what it leaves on disk.
class OwnRelaxation {
 public:
  OwnRelaxation(const dual::Structure& structure, std::vector<std::uint32_t> fixed,
                const RelaxOptions& options)
      : options_(options), potential_(make_potential(options.potential)) {
    own_ = {.minimizer = options.minimizer,
            .max_force = options.max_force,
            .energy_change = options.energy_change,
            .max_steps = options.max_steps,
            .box = options.box,
            .fixed = std::move(fixed),
            .bonds = structure.bonds,  // guessed ones may break and form
            .checkpoint_every = options.checkpoint_every};
    fingerprint_ = fingerprint(structure.atoms, own_, exact_text(options.potential));
    if (options.trajectory)
      trajectory_.emplace(options.trajectory->path, options.trajectory->every);
    set_callbacks();
  }

  [[nodiscard]] potentials::RelaxResult run(const potentials::Atoms& atoms) {
    auto relaxed = potentials::relax(resume_or_start(atoms), *potential_, own_);
    if (stopped_) return relaxed;
    if (trajectory_) trajectory_->finish();
    return relaxed;
  }

  [[nodiscard]] bool stopped() const { return stopped_; }

 private:
  void set_callbacks() {
    own_.on_checkpoint = [this](const potentials::RelaxCheckpoint& state) {
      if (options_.checkpoint) {
        save_relaxation(*options_.checkpoint, fingerprint_, state,
                        trajectory_ ? trajectory_->size() : 0);
      }
    };
    own_.on_progress = [this](const potentials::RelaxProgress& state) {
      if (trajectory_) trajectory_->add(state);
      stopped_ = options_.on_progress && !options_.on_progress(state);
      return !stopped_;
    };
  }

  std::optional<SavedRelaxation> load() {
    if (!options_.checkpoint) return std::nullopt;
    auto saved = load_relaxation(*options_.checkpoint, fingerprint_);
    if (saved && trajectory_ && !trajectory_->resume(saved->trajectory_size, saved->steps)) {
      return std::nullopt;
    }
    return saved;
  }

  /// Takes up what an interrupted run has left; returns the atoms to begin with.
  potentials::Atoms resume_or_start(const potentials::Atoms& atoms) {
    auto saved = load();
    if (!saved) {
      if (trajectory_) trajectory_->start();
      return atoms;
    }
    note(options_, "going on from " + options_.checkpoint->string() + ", step " +
                       std::to_string(saved->steps));
    own_.start = potentials::RelaxStart::direct;
    own_.first_step = saved->steps;
    own_.first_evaluation = saved->evaluations;
    // A box that only frames a cluster comes back padded.
    if (!saved->atoms.box.is_periodic()) saved->atoms.box = atoms.box;
    return std::move(saved->atoms);
  }

  const RelaxOptions& options_;
  std::unique_ptr<potentials::Potential> potential_;
  potentials::RelaxOptions own_;
  std::string fingerprint_;
  std::optional<Trajectory> trajectory_;
  bool stopped_ = false;
};

potentials::RelaxResult relax_with_lammps(const potentials::Atoms& atoms,
                                          const std::vector<std::uint32_t>& fixed,
                                          const RelaxOptions& options) {
  const LammpsOptions run = lammps_options("relax", options.potential, options.lammps->run);
  return run_lammps(atoms,
                    {.style = options.lammps->style,
                     .max_force = options.max_force,
                     .max_steps = options.max_steps,
                     .fixed = fixed,
                     .relax_box = options.box == potentials::BoxPolicy::pressure_free,
                     .folder = options.lammps->folder,
                     .on_progress = options.lammps->on_progress},
                    run);
}

/// Coordinations and rings as they are now; of a file without bonds, those of a former geometry.
void update_network_columns(dual::Structure& structure) {
  dual::Structure network = {
      .atoms = structure.atoms, .bonds = structure.bonds, .rings = std::move(structure.rings)};
  dual::add_missing_network(network);
  dual::replace_columns(structure, dual::network_columns(network));
  structure.rings = std::move(network.rings);
}

}  // namespace

RelaxedStructure relax(dual::Structure structure, const RelaxOptions& options) {
  check_options(options);
  if (options.box == potentials::BoxPolicy::pressure_free && !structure.atoms.box.is_periodic()) {
    throw dual::InvalidOption("relax: the structure has no periodic cell that could relax");
  }
  if (is_rebo(options.potential) && !dual::walls_of(structure).empty()) {
    note(options, "the structure has several walls, which REBO does not hold apart; AIREBO does");
  }
  const auto bonds = bonds_of(structure, options);
  const std::vector<std::uint32_t> fixed = fixed_atoms(structure, bonds, options);
  if (!fixed.empty() && options.box == potentials::BoxPolicy::pressure_free) {
    note(options, "atoms that stay keep their places in the cell, and move as it changes");
  }
  RelaxedStructure result;
  result.potential = options.potential.title();
  if (options.lammps) {
    result.relaxed = relax_with_lammps(structure.atoms, fixed, options);
  } else {
    OwnRelaxation relaxation(structure, fixed, options);
    result.relaxed = relaxation.run(structure.atoms);
    result.stopped = relaxation.stopped();
  }
  result.report = report_relaxation(structure.atoms.positions, bonds, result.relaxed);
  result.notes = relax_notes(result.report, result.relaxed);
  const std::vector<Eigen::Vector3d> before = std::move(structure.atoms.positions);
  structure.atoms = result.relaxed.atoms;
  update_network_columns(structure);
  dual::add_energies(structure, result.relaxed.result);
  set_potential(structure, result.potential);
  dual::add_displacements(structure, before);
  result.structure = std::move(structure);
  return result;
}

Json RelaxedStructure::json() const {
  const auto summary = dual::summarize_energies(relaxed.result.energies, 0);
  Json json = {{"potential", potential},
               {"unit", "eV"},
               {"atoms", relaxed.atoms.size()},
               {"energy", relaxed.result.energy},
               {"energy_per_atom", summary.mean}};
  if (is_rebo({.name = potential})) json["excess_per_atom"] = summary.excess();
  json["relaxation"] = relax_json(report, relaxed);
  return json;
}

std::vector<dual::TableRow> RelaxedStructure::rows() const {
  const auto summary = dual::summarize_energies(relaxed.result.energies, 0);
  std::vector<dual::TableRow> rows = {{"potential", potential},
                                      {"atoms", std::to_string(relaxed.atoms.size())},
                                      {"energy", decimals(summary.total, 8) + " eV"},
                                      {"per atom", decimals(summary.mean, 8) + " eV"}};
  if (is_rebo({.name = potential})) {
    rows.push_back({"above graphene", decimals(1000.0 * summary.excess(), 3) + " meV/atom"});
  }
  append(rows, relax_rows(report, relaxed));
  return rows;
}

}  // namespace trivalent::shell
