#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "trivalent/formats/structure_format.h"

namespace trivalent::dual {

/// Writes a topology of GROMACS for the bonds that are known, or else those that distances suggest:
/// bonds, angles, dihedrals and Lennard-Jones terms of OPLS-AA's aromatic carbon and hydrogen
/// [Jorgensen1996], with their parameters in the file. It goes with the .gro file of the same
/// atoms; periodic networks need "periodic-molecules = yes" in the .mdp file.
///
/// @return  Notes: bonds that were guessed, and what a periodic network needs.
/// @throws InvalidNetwork if a coordinate is not finite or there are no bonds.
std::vector<std::string> write_gromacs_topology(std::ostream& out, const Structure& structure,
                                                const WriteOptions& options = {});

}  // namespace trivalent::dual
