#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trivalent/dual/energy_summary.h"
#include "trivalent/dual/shell_checks.h"
#include "trivalent/dual/structure.h"
#include "trivalent/dual/walls.h"
#include "trivalent/potentials/energy_forces.h"
#include "trivalent/remesh/mesh.h"
#include "trivalent/shell/json.h"
#include "trivalent/shell/lammps_run.h"
#include "trivalent/shell/potential_choice.h"
#include "trivalent/shell/reports.h"
#include "trivalent/view/table_row.h"

namespace trivalent::shell {

/// What a shell may have.
enum class ShellEdge {
  none,     ///< it must be closed
  allowed,  ///< carbon atoms at its edge may have two bonds
};

struct CertifyOptions {
  PotentialChoice potential = {};
  double max_force = 0.01;  ///< [eV/Å], > 0: at rest if no atom has more; infinity: not checked
  ShellEdge edge = ShellEdge::none;
  /// Mesh in Å to measure the distances of the atoms from.
  std::optional<remesh::TriMesh> surface = {};
  /// Have LAMMPS compute energies and forces too, and compare them atom by atom; its potential is
  /// set by certify().
  std::optional<LammpsOptions> lammps = {};
  /// Notes of the file that the structure comes from: bonds that cannot be right are a problem.
  std::vector<std::string> notes = {};
};

/// Largest differences of an atom between LAMMPS and us.
struct LammpsDifference {
  double energy = 0.0;  ///< [eV]
  double force = 0.0;   ///< [eV/Å]
};

/// Root mean square and maximum of distances [Å].
struct DistanceSummary {
  double rms = 0.0;
  double largest = 0.0;
};

/// What was found of the atoms, and what of it is wrong.
struct Certificate {
  std::string potential = {};
  /// Potential that the file names, if it is another one: its energies are not compared then.
  std::optional<std::string> other_potential = {};
  BondSource bonds = BondSource::file;  ///< file: its bonds were compared with those by distance
  dual::ShellReport shell = {};
  std::vector<dual::WallReport> walls = {};  ///< if there are several
  potentials::EnergyForces energy = {};
  dual::EnergySummary summary = {};
  double largest_force = 0.0;  ///< [eV/Å]
  std::optional<DistanceSummary> surface_distance = {};
  std::optional<LammpsDifference> lammps = {};
  std::vector<std::string> problems = {};  ///< empty if the shell is sound

  [[nodiscard]] bool is_sound() const { return problems.empty(); }
  [[nodiscard]] Json json() const;
  [[nodiscard]] std::vector<dual::TableRow> rows() const;
};

/// Checks a structure's topology, bonds, angles, energies and forces, and those that its file
/// claims.
///
/// @throws dual::InvalidOption if an option is out of its range
/// @throws potentials::InvalidAtoms if the potential has no energy for the atoms
/// @throws what run_lammps throws
[[nodiscard]] Certificate certify(const dual::Structure& structure,
                                  const CertifyOptions& options = {});

}  // namespace trivalent::shell
