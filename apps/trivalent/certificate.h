#pragma once

#include <optional>
#include <string>
#include <vector>

#include "session.h"
#include "trivalent/dual/energy_summary.h"
#include "trivalent/dual/shell_checks.h"
#include "trivalent/potentials/energy_forces.h"
#include "trivalent/remesh/mesh.h"

namespace trivalent::apps {

/// What was found of the atoms in a file, and what of it is wrong.
struct Certificate {
  std::string file;
  dual::ShellReport shell = {};
  potentials::EnergyForces energy = {};
  dual::EnergySummary summary = {};
  double largest_force = 0.0;
  std::vector<double> surface_distances = {};
  std::optional<double> energy_difference = {};  ///< of an atom, largest, LAMMPS's and ours [eV]
  std::optional<double> force_difference = {};   ///< [eV/Å]
  std::vector<std::string> problems = {};
};

/// Reads a file and looks at its atoms, as --max-force, --open and --lammps want it.
///
/// @param surface  mesh in Å to measure the distances from, if there is one
/// @throws what read_structure, evaluate and run_lammps throw.
[[nodiscard]] Certificate certify(const std::string& file,
                                  const std::optional<remesh::TriMesh>& surface,
                                  const Session& session);

// Lengths and angles with the ids of their atoms.
[[nodiscard]] std::string pair_text(const dual::AtomPair& pair);
[[nodiscard]] std::string angle_text(const dual::BondAngle& angle);

}  // namespace trivalent::apps
