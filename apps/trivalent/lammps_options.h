#pragma once

#include <optional>
#include <string>

#include "session.h"
#include "trivalent/shell/lammps_run.h"
#include "trivalent/shell/potential_choice.h"

namespace trivalent::apps {

/// --ranks and --potential-file: how LAMMPS is to be run.
void add_lammps_options(po::options_description& options);

/// The same and --engine, for commands whose work LAMMPS can do instead of us.
void add_engine_options(po::options_description& options);

/// How LAMMPS is to be run for the potential; tells the terminal if it will not find its file.
///
/// @throws UsageError if the options make no sense, or the potential is not one of LAMMPS's here.
/// @throws dual::Error if lmp or mpirun is needed and not installed.
[[nodiscard]] shell::LammpsOptions lammps_options(const Session& session,
                                                  const shell::PotentialChoice& potential);

/// The same if --engine says that LAMMPS is to do the work; none if we do.
[[nodiscard]] std::optional<shell::LammpsOptions> engine_options(
    const Session& session, const shell::PotentialChoice& potential);

/// @param condition  as in "--engine lammps"
/// @throws UsageError if --ranks or --potential-file is given.
void refuse_lammps_options(const Session& session, const std::string& condition);

/// The file of --potential-file as input scripts name it; tells the terminal if LAMMPS will not
/// find it.
[[nodiscard]] std::string potential_file(const Session& session,
                                         const shell::LammpsOptions& options);

}  // namespace trivalent::apps
