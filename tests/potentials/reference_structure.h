#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trivalent/potentials/atoms.h"
#include "trivalent/potentials/energy_forces.h"

namespace trivalent::testing_support {

/// A structure and what LAMMPS says about it.
struct ReferenceStructure {
  std::string name;   ///< folder and file name
  std::string style;  ///< rebo, airebo11, ljcut, ...
  potentials::Atoms atoms;
  potentials::EnergyForces expected;
};

/// Reads one file written by scripts/make_references.sh; throws std::runtime_error if it cannot.
[[nodiscard]] ReferenceStructure read_reference(const std::filesystem::path& path);

/// All references under a folder whose style is `style`, in alphabetical order.
[[nodiscard]] std::vector<ReferenceStructure> read_references(const std::filesystem::path& folder,
                                                              const std::string& style);

/// Largest differences from a reference, each in units of what is allowed: 1 is just within.
struct Deviation {
  double energy = 0.0;
  double energies = 0.0;
  double forces = 0.0;
  double virial = 0.0;
  [[nodiscard]] double worst() const;
};

/// How far a result may be from LAMMPS.
struct Tolerance {
  double energy = 0.0;           ///< total [eV]
  double atom_energy = 1e-8;     ///< [eV]
  double relative_force = 1e-7;  ///< of 1 eV/Å + the largest force
};

/// Total energy: 1e-12 |E| + 1e-10 eV where all coordinations are integers; else LAMMPS itself
/// loses digits in its splines and 1e-10 of max(|E|, 1 eV an atom) is allowed. Atoms: 1e-8 eV, or
/// the last digits of the largest energy. Forces: 1e-7 (1 eV/Å + the largest), but for one named
/// structure.
[[nodiscard]] Tolerance tolerance_of(const ReferenceStructure& reference);

[[nodiscard]] Deviation deviation(const ReferenceStructure& reference,
                                  const potentials::EnergyForces& result,
                                  const Tolerance& tolerance);

}  // namespace trivalent::testing_support
