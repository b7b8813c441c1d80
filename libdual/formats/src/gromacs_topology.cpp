#include "trivalent/formats/gromacs_topology.h"

#include <algorithm>
#include <array>
#include <ostream>

#include "bond_pairs.h"
#include "trivalent/dual/check_atoms.h"
#include "trivalent/potentials/bonds.h"

namespace trivalent::dual {
namespace {

using potentials::Species;

/// [Jorgensen1996]: types CA and HA, in GROMACS's units (nm, kJ/mol), without charges.
constexpr std::string_view force_field =
    "; OPLS-AA's aromatic carbon and hydrogen, without charges\n"
    "[ defaults ]\n; nbfunc comb-rule gen-pairs fudgeLJ fudgeQQ\n1 3 yes 0.5 0.5\n\n"
    "[ atomtypes ]\n; name number mass charge type sigma epsilon\n"
    "CA 6 12.011 0.0 A 0.355 0.29288\nHA 1 1.008 0.0 A 0.242 0.12552\n\n"
    "[ bondtypes ]\nCA CA 1 0.1400 392459.2\nCA HA 1 0.1080 307105.6\n\n"
    "[ angletypes ]\nCA CA CA 1 120.0 527.184\nCA CA HA 1 120.0 292.880\nHA CA HA 1 117.0 "
    "292.880\n\n"
    "[ dihedraltypes ]\nX CA CA X 3 30.334 0.0 -30.334 0.0 0.0 0.0\n\n"
    "[ moleculetype ]\n; name nrexcl\nUNL 3\n\n";

std::vector<std::vector<int>> neighbors_of(std::size_t n_atoms,
                                           const std::vector<std::array<int, 2>>& pairs) {
  std::vector<std::vector<int>> neighbors(n_atoms);
  for (const auto [a, b] : pairs) {
    neighbors[static_cast<std::size_t>(a)].push_back(b);
    neighbors[static_cast<std::size_t>(b)].push_back(a);
  }
  return neighbors;
}

void write_atoms(std::ostream& out, const potentials::Atoms& atoms) {
  out << "[ atoms ]\n; number type residue name atom group charge mass\n";
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    const bool is_carbon = atoms.species[i] == Species::carbon;
    out << i + 1 << (is_carbon ? " CA 1 UNL C " : " HA 1 UNL H ") << i + 1
        << (is_carbon ? " 0.0 12.011\n" : " 0.0 1.008\n");
  }
}

void write_angles(std::ostream& out, const std::vector<std::vector<int>>& neighbors) {
  out << "\n[ angles ]\n";
  for (std::size_t middle = 0; middle < neighbors.size(); ++middle) {
    const std::vector<int>& ends = neighbors[middle];
    for (std::size_t a = 0; a < ends.size(); ++a) {
      for (std::size_t b = a + 1; b < ends.size(); ++b) {
        out << ends[a] + 1 << ' ' << middle + 1 << ' ' << ends[b] + 1 << " 1\n";
      }
    }
  }
}

/// In a ring of three atoms the ends would be one: left out.
void write_dihedrals(std::ostream& out, const std::vector<std::array<int, 2>>& pairs,
                     const std::vector<std::vector<int>>& neighbors) {
  out << "\n[ dihedrals ]\n";
  for (const auto [b, c] : pairs) {
    for (const int a : neighbors[static_cast<std::size_t>(b)]) {
      for (const int d : neighbors[static_cast<std::size_t>(c)]) {
        if (a == c || d == b || a == d) continue;
        out << a + 1 << ' ' << b + 1 << ' ' << c + 1 << ' ' << d + 1 << " 3\n";
      }
    }
  }
}

}  // namespace

std::vector<std::string> write_gromacs_topology(std::ostream& out, const Structure& structure,
                                                const WriteOptions& /*options*/) {
  check_atoms("write_gromacs_topology", structure.atoms);
  std::vector<std::string> notes;
  Structure bonded = {.atoms = structure.atoms, .bonds = structure.bonds};
  if (bonded.bonds.empty()) {
    bonded.bonds = potentials::guess_bonds(bonded.atoms).bonds;
    notes.emplace_back("the bonds of the topology were found by distance");
  }
  if (bonded.bonds.empty()) {
    throw InvalidNetwork("write_gromacs_topology: no atoms are bonded; there is nothing to write");
  }
  if (bonded.atoms.box.is_periodic()) {
    notes.emplace_back("the .mdp file of a periodic network needs periodic-molecules = yes");
  }
  const std::vector<std::array<int, 2>> pairs = bond_pairs(bonded, notes);
  const auto neighbors = neighbors_of(bonded.atoms.size(), pairs);
  out << force_field;
  write_atoms(out, bonded.atoms);
  out << "\n[ bonds ]\n";
  for (const auto [a, b] : pairs) out << a + 1 << ' ' << b + 1 << " 1\n";
  write_angles(out, neighbors);
  write_dihedrals(out, pairs, neighbors);
  out << "\n[ system ]\ncarbon shell\n\n[ molecules ]\nUNL 1\n";
  return notes;
}

}  // namespace trivalent::dual
