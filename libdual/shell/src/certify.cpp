#include "trivalent/shell/certify.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "pair_text.h"
#include "trivalent/dual/bonding.h"
#include "trivalent/dual/columns.h"
#include "trivalent/dual/error.h"
#include "trivalent/formats/structure_file.h"
#include "trivalent/potentials/bonds.h"
#include "trivalent/remesh/mesh_quality.h"
#include "trivalent/shell/number_text.h"

namespace trivalent::shell {
namespace {

// What bonds of a carbon net at rest stay well within.
constexpr double shortest_sound_bond = 1.25;   // [Å]
constexpr double longest_sound_bond = 1.75;    // [Å]
constexpr double smallest_sound_angle = 85.0;  // [degree]
constexpr double largest_sound_angle = 155.0;  // [degree]
// Where REBO ends: two atoms that are nearer pull at each other without a bond.
constexpr double closest_sound_pair = 2.0;  // [Å]

constexpr int n_worst = 5;

std::string ids_text(const std::vector<int>& atoms) {
  constexpr std::size_t max_atoms = 10;
  return first_of(atoms, max_atoms, [](int atom) { return std::to_string(atom + 1); });
}

/// Atoms whose number of bonds nothing explains.
std::vector<int> wrong_atoms(const potentials::Atoms& atoms, const dual::Bonding& bonding,
                             const dual::ShellReport& shell, ShellEdge edge) {
  std::vector<int> wrong = shell.odd_atoms;
  if (edge == ShellEdge::none) return wrong;
  std::erase_if(wrong, [&](int atom) {
    const auto i = static_cast<std::size_t>(atom);
    return atoms.species[i] == potentials::Species::carbon && bonding[i].size() == 2;
  });
  return wrong;
}

void find_wrong_geometry(Certificate& certificate) {
  const dual::ShellReport& shell = certificate.shell;
  auto& problems = certificate.problems;
  if (shell.longest_bond && shell.longest_bond->distance > longest_sound_bond) {
    problems.push_back("the bond of " + pair_text(shell.longest_bond) + " Å is too long");
  }
  if (shell.shortest_bond && shell.shortest_bond->distance < shortest_sound_bond) {
    problems.push_back("the bond of " + pair_text(shell.shortest_bond) + " Å is too short");
  }
  if (shell.smallest_angle && shell.smallest_angle->angle < smallest_sound_angle) {
    problems.push_back("the angle of " + angle_text(shell.smallest_angle) + " is too small");
  }
  if (shell.largest_angle && shell.largest_angle->angle > largest_sound_angle) {
    problems.push_back("the angle of " + angle_text(shell.largest_angle) + " is too large");
  }
  const std::optional<dual::AtomPair>& closest = shell.closest_non_bonded;
  if (closest && closest->distance < closest_sound_pair) {
    problems.push_back("two atoms without a bond are only " + pair_text(closest) + " Å apart");
  }
}

/// Walls are networks of their own.
void check_walls(const dual::Structure& structure, const dual::Bonding& bonding,
                 Certificate& certificate) {
  const std::vector<int> walls = dual::walls_of(structure);
  if (walls.empty()) return;
  dual::Structure bonded = structure;
  bonded.bonds = dual::find_bonds(structure.atoms);
  bonded.rings = dual::find_rings(bonding);
  if (const int across = dual::bonds_between_walls(bonded); across > 0) {
    certificate.problems.push_back(std::to_string(across) + " bonds go from one wall to another");
  }
  certificate.walls = dual::check_walls(bonded);
}

void check_topology(const dual::Structure& structure, ShellEdge edge, Certificate& certificate) {
  const potentials::Atoms& atoms = structure.atoms;
  const dual::Bonding bonding = dual::bonding_of(atoms, dual::find_bonds(atoms));
  certificate.shell = dual::check_shell(atoms, bonding, dual::find_rings(bonding));
  const dual::ShellReport& shell = certificate.shell;
  auto& problems = certificate.problems;
  const auto wrong = wrong_atoms(atoms, bonding, shell, edge);
  if (!wrong.empty()) {
    problems.push_back(std::to_string(wrong.size()) +
                       " atoms do not have three bonds (hydrogen: one): " + ids_text(wrong));
  }
  if (shell.odd_atoms.empty() && shell.coordinations.size() == 1 && !shell.is_closed()) {
    problems.push_back(std::to_string(shell.angles_without_ring) +
                       " pairs of bonds lie in no ring of up to 12 atoms");
  }
  find_wrong_geometry(certificate);
  check_walls(structure, bonding, certificate);
  if (structure.bonds.empty()) return;
  const auto changes = potentials::bond_changes(atoms, structure.bonds);
  if (!changes.broken.empty() || !changes.formed.empty()) {
    problems.push_back(
        std::to_string(changes.broken.size()) + " bonds of the file are longer than 2 Å, and " +
        std::to_string(changes.formed.size()) + " pairs without a bond in the file are nearer");
  }
}

/// The total energy of a file with energies of its atoms [eV]. Others may be of any method.
void compare_total_energy(const dual::Structure& structure, Certificate& certificate) {
  const auto entry = std::ranges::find(structure.header, "energy", &dual::HeaderEntry::key);
  if (entry == structure.header.end()) return;
  const auto* claimed = std::get_if<double>(&entry->value);
  const auto n_atoms = static_cast<double>(structure.atoms.size());
  if (claimed != nullptr && std::abs(*claimed - certificate.energy.energy) > 1e-5 * n_atoms) {
    certificate.problems.push_back("the energy in the file, " + decimals(*claimed, 8) +
                                   " eV, is not that of its atoms");
  }
}

/// Energies and forces that the file claims.
void compare_with_file(const dual::Structure& structure, Certificate& certificate) {
  const auto* energies = dual::find_column<double>(structure, "energies");
  if (certificate.other_potential || energies == nullptr) return;
  double largest = 0.0;
  for (std::size_t i = 0; i < energies->size(); ++i) {
    const double difference = std::abs((*energies)[i] - certificate.energy.energies[i]);
    largest = std::max(largest, difference / (1.0 + std::abs((*energies)[i])));
  }
  if (largest > 1e-5) {
    certificate.problems.push_back("the energies in the file are not those of its atoms");
  }
  compare_total_energy(structure, certificate);
  const auto* forces = dual::find_column<Eigen::Vector3d>(structure, "forces");
  if (forces == nullptr) return;
  largest = 0.0;
  for (std::size_t i = 0; i < forces->size(); ++i) {
    const Eigen::Vector3d& force = certificate.energy.forces[i];
    largest = std::max(largest, ((*forces)[i] - force).norm() / (1.0 + force.norm()));
  }
  if (largest > 1e-3) {
    certificate.problems.push_back("the forces in the file are not those of its atoms");
  }
}

/// By LAMMPS where nobody else knows the potential.
potentials::EnergyForces evaluate(const potentials::Atoms& atoms, const CertifyOptions& options) {
  if (!options.potential.pair_style || !options.lammps) {
    return make_potential(options.potential)->evaluate(atoms);
  }
  return run_lammps(atoms, {}, lammps_options("certify", options.potential, *options.lammps))
      .result;
}

void check_energies(const dual::Structure& structure, const CertifyOptions& options,
                    Certificate& certificate) {
  certificate.energy = evaluate(structure.atoms, options);
  certificate.summary = dual::summarize_energies(certificate.energy.energies, n_worst);
  for (const Eigen::Vector3d& force : certificate.energy.forces) {
    certificate.largest_force = std::max(certificate.largest_force, force.norm());
  }
  if (!(certificate.largest_force <= options.max_force)) {
    certificate.problems.push_back("the atoms are not at rest: the largest force is " +
                                   significant(certificate.largest_force) +
                                   " eV/Å (trivalent relax brings them there)");
  }
  compare_with_file(structure, certificate);
}

void compare_with_lammps(const potentials::Atoms& atoms, const CertifyOptions& options,
                         Certificate& certificate) {
  const LammpsOptions lammps = lammps_options("certify", options.potential, *options.lammps);
  const potentials::EnergyForces theirs = run_lammps(atoms, {}, lammps).result;
  const potentials::EnergyForces& ours = certificate.energy;
  LammpsDifference largest;
  double scale = 0.0;
  for (std::size_t i = 0; i < ours.energies.size(); ++i) {
    largest.energy = std::max(largest.energy, std::abs(theirs.energies[i] - ours.energies[i]));
    largest.force = std::max(largest.force, (theirs.forces[i] - ours.forces[i]).norm());
    scale = std::max(scale, std::abs(ours.energies[i]));
  }
  certificate.lammps = largest;
  if (largest.energy > 1e-8 + 1e-9 * scale ||
      largest.force > 1e-7 * (1.0 + certificate.largest_force)) {
    certificate.problems.push_back("LAMMPS finds other energies or forces: up to " +
                                   significant(largest.energy, 3) + " eV and " +
                                   significant(largest.force, 3) + " eV/Å");
  }
}

DistanceSummary summarize(const std::vector<double>& distances) {
  DistanceSummary summary;
  for (const double distance : distances) {
    summary.rms += distance * distance;
    summary.largest = std::max(summary.largest, distance);
  }
  summary.rms = std::sqrt(summary.rms / static_cast<double>(distances.size()));
  return summary;
}

void check_options(const CertifyOptions& options) {
  if (!(options.max_force > 0.0)) throw dual::InvalidOption("certify: max_force must be > 0");
  static_cast<void>(find_potential(options.potential));
  if (options.lammps)
    static_cast<void>(lammps_options("certify", options.potential, *options.lammps));
}

}  // namespace

Certificate certify(const dual::Structure& structure, const CertifyOptions& options) {
  check_options(options);
  if (structure.atoms.size() == 0) throw dual::InvalidNetwork("certify: there are no atoms");
  Certificate certificate;
  certificate.potential = options.potential.title();
  certificate.other_potential = potential_title(structure);
  if (certificate.other_potential == certificate.potential) certificate.other_potential.reset();
  certificate.bonds = structure.bonds.empty() ? BondSource::distance : BondSource::file;
  check_topology(structure, options.edge, certificate);
  std::ranges::copy_if(
      options.notes, std::back_inserter(certificate.problems),
      [](const std::string& note) { return note.starts_with(dual::unused_bonds); });
  check_energies(structure, options, certificate);
  if (options.surface) {
    certificate.surface_distance =
        summarize(remesh::distances_to_surface(structure.atoms.positions, *options.surface));
  }
  if (options.lammps && !options.potential.pair_style)
    compare_with_lammps(structure.atoms, options, certificate);
  return certificate;
}

}  // namespace trivalent::shell
