#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "session.h"
#include "trivalent/potentials/relax.h"

namespace trivalent::apps {

/// --ranks and --potential-file: how LAMMPS is to be run.
void add_lammps_options(po::options_description& options);

/// The same and --engine, for commands whose work LAMMPS can do instead of us.
void add_engine_options(po::options_description& options);

/// Whether LAMMPS is to do the work.
[[nodiscard]] bool uses_lammps(const Session& session);

/// Refuses, before any work, what LAMMPS could not do.
///
/// @throws UsageError if the options make no sense, or the potential is not one of LAMMPS's here.
/// @throws std::runtime_error if lmp or mpirun is needed and not installed.
void check_lammps(const Session& session);

/// The same if LAMMPS is to do the work, else that nothing is said about LAMMPS.
void check_engine(const Session& session);

/// --potential-file as input scripts name it: an absolute path, or the bare name of the file that
/// comes with LAMMPS; tells the terminal if that cannot be found.
[[nodiscard]] std::string potential_file(const Session& session, const std::string& usual_name);

/// What LAMMPS is to do.
struct LammpsTask {
  std::string style = "cg";               ///< LAMMPS's min_style
  double max_force = 1e-3;                ///< [eV/Å]
  int max_steps = 0;                      ///< 0: only energies and forces
  std::vector<std::uint32_t> fixed = {};  ///< atoms that stay, ascending
  bool relax_box = false;
};

/// Has the installed `lmp` do it, under `mpirun` if there are several ranks, and reads the result
/// back. There is no virial in it.
///
/// @param name  how the name of the folder begins in which LAMMPS works; the folder is gone
///              afterwards, unless something went wrong
/// @throws std::runtime_error with LAMMPS's own message if it fails.
[[nodiscard]] potentials::RelaxResult run_lammps(const potentials::Atoms& atoms,
                                                 const LammpsTask& task,
                                                 const std::filesystem::path& name,
                                                 const Session& session);

}  // namespace trivalent::apps
