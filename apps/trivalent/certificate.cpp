#include "certificate.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "lammps_engine.h"
#include "potential_options.h"
#include "structure.h"
#include "trivalent/remesh/mesh_quality.h"

namespace trivalent::apps {
namespace {

// What bonds of a carbon net at rest stay well within.
constexpr double shortest_sound_bond = 1.25;   // [Å]
constexpr double longest_sound_bond = 1.75;    // [Å]
constexpr double smallest_sound_angle = 85.0;  // [degree]
constexpr double largest_sound_angle = 155.0;  // [degree]
// Where REBO ends: two atoms that are nearer pull at each other without a bond.
constexpr double closest_sound_pair = 2.0;  // [Å]

constexpr int n_worst = 5;
constexpr std::size_t most_ids = 10;

std::string ids_text(const std::vector<int>& atoms) {
  std::string text;
  for (std::size_t k = 0; k < std::min(most_ids, atoms.size()); ++k) {
    text += (k > 0 ? ", " : "") + std::to_string(atoms[k] + 1);
  }
  return text + (atoms.size() > most_ids ? ", ..." : "");
}

/// Atoms whose number of bonds nothing explains.
std::vector<int> wrong_atoms(const dual::Structure& structure, const dual::Bonding& bonding,
                             const dual::ShellReport& shell, const Session& session) {
  std::vector<int> wrong = shell.odd_atoms;
  if (session.has("open")) {
    std::erase_if(wrong, [&](int atom) {
      const auto i = static_cast<std::size_t>(atom);
      return structure.atoms.species[i] == potentials::Species::carbon && bonding[i].size() == 2;
    });
  }
  return wrong;
}

void find_wrong_geometry(Certificate& certificate) {
  const dual::ShellReport& shell = certificate.shell;
  auto& problems = certificate.problems;
  const bool has_bonds = shell.longest_bond.atoms[0] >= 0;
  if (has_bonds && shell.longest_bond.distance > longest_sound_bond) {
    problems.push_back("the bond of " + pair_text(shell.longest_bond) + " Å is too long");
  }
  if (has_bonds && shell.shortest_bond.distance < shortest_sound_bond) {
    problems.push_back("the bond of " + pair_text(shell.shortest_bond) + " Å is too short");
  }
  if (shell.smallest_angle.atom >= 0 && shell.smallest_angle.angle < smallest_sound_angle) {
    problems.push_back("the angle of " + angle_text(shell.smallest_angle) + " is too small");
  }
  if (shell.largest_angle.angle > largest_sound_angle) {
    problems.push_back("the angle of " + angle_text(shell.largest_angle) + " is too large");
  }
  const dual::AtomPair& closest = shell.closest_non_bonded;
  if (closest.atoms[0] >= 0 && closest.distance < closest_sound_pair) {
    problems.push_back("two atoms without a bond are only " + pair_text(closest) + " Å apart");
  }
}

void check_topology(const dual::Structure& structure, const Session& session,
                    Certificate& certificate) {
  const potentials::Atoms& atoms = structure.atoms;
  const dual::Bonding bonding = dual::bonding_of(atoms, dual::find_bonds(atoms));
  certificate.shell = dual::check_shell(atoms, bonding, dual::find_rings(bonding));
  const dual::ShellReport& shell = certificate.shell;
  auto& problems = certificate.problems;
  const auto wrong = wrong_atoms(structure, bonding, shell, session);
  if (!wrong.empty()) {
    problems.push_back(std::to_string(wrong.size()) +
                       " atoms do not have three bonds (hydrogen: one): " + ids_text(wrong));
  }
  if (shell.odd_atoms.empty() && shell.coordinations.size() == 1 && !shell.is_closed()) {
    problems.push_back(std::to_string(shell.angles_without_ring) +
                       " pairs of bonds lie in no ring of up to 12 atoms");
  }
  find_wrong_geometry(certificate);
  if (structure.bonds.empty()) return;
  const auto changes = potentials::bond_changes(atoms, structure.bonds);
  if (!changes.broken.empty() || !changes.formed.empty()) {
    problems.push_back(
        std::to_string(changes.broken.size()) + " bonds of the file are longer than 2 Å, and " +
        std::to_string(changes.formed.size()) + " pairs without a bond in the file are nearer");
  }
}

/// Energies that the file claims.
void compare_with_file(const dual::Structure& structure, Certificate& certificate) {
  for (const dual::Column& column : structure.columns) {
    const auto* claimed = std::get_if<std::vector<double>>(&column.values);
    if (column.name != "energies" || claimed == nullptr) continue;
    double largest = 0.0;
    for (std::size_t i = 0; i < claimed->size(); ++i) {
      const double difference = std::abs((*claimed)[i] - certificate.energy.energies[i]);
      largest = std::max(largest, difference / (1.0 + std::abs((*claimed)[i])));
    }
    if (largest > 1e-5) {
      certificate.problems.push_back("the energies in the file are not those of its atoms");
    }
  }
}

void check_energies(const dual::Structure& structure, const Session& session,
                    Certificate& certificate) {
  certificate.energy = evaluate(structure.atoms, session);
  certificate.summary = dual::summarize_energies(certificate.energy.energies, n_worst);
  for (const Eigen::Vector3d& force : certificate.energy.forces) {
    certificate.largest_force = std::max(certificate.largest_force, force.norm());
  }
  if (!(certificate.largest_force <= session.get<double>("max-force"))) {
    certificate.problems.push_back("the atoms are not at rest: the largest force is " +
                                   significant(certificate.largest_force) +
                                   " eV/Å (trivalent relax brings them there)");
  }
  compare_with_file(structure, certificate);
}

void compare_with_lammps(const dual::Structure& structure, const Session& session,
                         Certificate& certificate) {
  const auto folder = std::filesystem::temp_directory_path() / "trivalent-lammps";
  const potentials::EnergyForces theirs = run_lammps(structure.atoms, {}, folder, session).result;
  const potentials::EnergyForces& ours = certificate.energy;
  double energy = 0.0;
  double force = 0.0;
  double scale = 0.0;
  for (std::size_t i = 0; i < ours.energies.size(); ++i) {
    energy = std::max(energy, std::abs(theirs.energies[i] - ours.energies[i]));
    force = std::max(force, (theirs.forces[i] - ours.forces[i]).norm());
    scale = std::max(scale, std::abs(ours.energies[i]));
  }
  certificate.energy_difference = energy;
  certificate.force_difference = force;
  if (energy > 1e-8 + 1e-9 * scale || force > 1e-7 * (1.0 + certificate.largest_force)) {
    certificate.problems.push_back("LAMMPS finds other energies or forces: up to " +
                                   significant(energy, 3) + " eV and " + significant(force, 3) +
                                   " eV/Å");
  }
}

}  // namespace

Certificate certify(const std::string& file, const std::optional<remesh::TriMesh>& surface,
                    const Session& session) {
  const dual::Structure structure = read_structure(file, session);
  Certificate certificate;
  certificate.file = file;
  check_topology(structure, session, certificate);
  check_energies(structure, session, certificate);
  if (surface) {
    certificate.surface_distances =
        remesh::distances_to_surface(structure.atoms.positions, *surface);
  }
  if (session.has("lammps")) compare_with_lammps(structure, session, certificate);
  return certificate;
}

std::string pair_text(const dual::AtomPair& pair) {
  if (pair.atoms[0] < 0) return "none";
  return decimals(pair.distance, 3) + " (" + std::to_string(pair.atoms[0] + 1) + '-' +
         std::to_string(pair.atoms[1] + 1) + ')';
}

std::string angle_text(const dual::BondAngle& angle) {
  if (angle.atom < 0) return "none";
  return decimals(angle.angle, 1) + "° (" + std::to_string(angle.atom + 1) + ')';
}

}  // namespace trivalent::apps
