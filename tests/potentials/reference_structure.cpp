#include "reference_structure.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "trivalent/potentials/neighbor_list.h"

namespace trivalent::testing_support {

namespace {

// The text between the quotes of key="..." in an extended XYZ header, or the bare word after key=.
[[nodiscard]] std::string value_of(const std::string& header, const std::string& key) {
  const std::size_t at = (" " + header).find(" " + key + "=");
  if (at == std::string::npos) throw std::runtime_error("no " + key + " in: " + header);
  std::size_t begin = at + key.size() + 1;
  const char end = header.at(begin) == '"' ? '"' : ' ';
  if (end == '"') ++begin;
  return header.substr(begin, header.find(end, begin) - begin);
}

[[nodiscard]] potentials::Box read_box(const std::string& header) {
  potentials::Box box;
  std::istringstream periodic(value_of(header, "pbc"));
  for (bool& direction : box.periodic) {
    char letter = 'F';
    periodic >> letter;
    direction = letter == 'T';
  }
  if (!box.is_periodic()) return box;
  std::istringstream lattice(value_of(header, "Lattice"));
  for (int i = 0; i < 9; ++i) lattice >> box.cell.data()[i];  // rows of the file: columns here
  return box;
}

[[nodiscard]] Eigen::Matrix3d read_virial(const std::string& header) {
  std::istringstream in(value_of(header, "virial_xx_yy_zz_xy_xz_yz"));
  Eigen::Matrix3d virial;
  in >> virial(0, 0) >> virial(1, 1) >> virial(2, 2) >> virial(0, 1) >> virial(0, 2) >>
      virial(1, 2);
  return virial.selfadjointView<Eigen::Upper>();
}

[[nodiscard]] double largest(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

[[nodiscard]] double largest_difference(const std::vector<double>& a,
                                        const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

// Of the largest energy of an atom: atoms nearly on top of each other have some 1e11 eV.
[[nodiscard]] double rounding_of(const ReferenceStructure& reference) {
  return std::numeric_limits<double>::epsilon() * largest(reference.expected.energies);
}

// LAMMPS adds up its total on its own: where that is off its atoms, so may ours be off either.
[[nodiscard]] double difference_of_totals(const potentials::EnergyForces& result,
                                          const potentials::EnergyForces& expected) {
  const double sum = std::reduce(expected.energies.begin(), expected.energies.end());
  return std::min(std::abs(result.energy - expected.energy), std::abs(result.energy - sum));
}

// NaN must not pass as the smaller of two numbers.
[[nodiscard]] double in_units_of(double difference, double allowed) {
  return std::isfinite(difference) ? difference / allowed : 1e300;
}

[[nodiscard]] bool has_integer_coordinations(const potentials::Atoms& atoms) {
  const potentials::NeighborList list(atoms, 2.0);
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    for (const potentials::Neighbor& neighbor : list[i]) {
      // Inside the narrowest switching range of the bonds between these two [Brenner2002].
      const bool has_hydrogen = atoms.species[i] == potentials::Species::hydrogen ||
                                atoms.species[neighbor.atom] == potentials::Species::hydrogen;
      if (neighbor.distance > (has_hydrogen ? 1.1 : 1.7)) return false;
    }
  }
  return true;
}

}  // namespace

ReferenceStructure read_reference(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::size_t count = 0;
  std::string header;
  in >> count;
  std::getline(in, header);
  std::getline(in, header);
  ReferenceStructure reference;
  reference.name = path.parent_path().filename().string() + "/" + path.filename().string();
  reference.style = value_of(header, "style");
  reference.atoms.box = read_box(header);
  reference.expected.energy = std::stod(value_of(header, "energy"));
  reference.expected.virial = read_virial(header);
  for (std::size_t i = 0; i < count; ++i) {
    std::string symbol;
    Eigen::Vector3d x;
    Eigen::Vector3d f;
    double energy = 0.0;
    in >> symbol >> x[0] >> x[1] >> x[2] >> energy >> f[0] >> f[1] >> f[2];
    reference.atoms.positions.push_back(x);
    reference.atoms.species.push_back(symbol == "H" ? potentials::Species::hydrogen
                                                    : potentials::Species::carbon);
    reference.expected.energies.push_back(energy);
    reference.expected.forces.push_back(f);
  }
  if (!in) throw std::runtime_error("cannot read " + path.string());
  return reference;
}

std::vector<ReferenceStructure> read_references(const std::filesystem::path& folder,
                                                const std::string& style) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(
           folder, std::filesystem::directory_options::follow_directory_symlink)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(style + ".extxyz")) paths.push_back(entry.path());
  }
  std::ranges::sort(paths);
  std::vector<ReferenceStructure> references;
  for (const auto& path : paths) references.push_back(read_reference(path));
  return references;
}

double Deviation::worst() const { return std::max({energy, energies, forces, virial}); }

Tolerance tolerance_of(const ReferenceStructure& reference) {
  const double energy = std::abs(reference.expected.energy);
  const double scale = std::max(energy, static_cast<double>(reference.atoms.size()));
  const bool exact = has_integer_coordinations(reference.atoms);
  Tolerance tolerance = {.energy = exact ? 1e-12 * energy + 1e-10 : 1e-10 * scale,
                         .atom_energy = std::max(1e-8, 16.0 * rounding_of(reference))};
  // LAMMPS takes dihedral factors |T| <= 1e-9 for zero, their derivatives of 1e-5 eV with them.
  if (reference.name.find("_dropped_terms") != std::string::npos) tolerance.relative_force = 1e-6;
  return tolerance;
}

Deviation deviation(const ReferenceStructure& reference, const potentials::EnergyForces& result,
                    const Tolerance& tolerance) {
  const potentials::EnergyForces& expected = reference.expected;
  double largest_force = 0.0;
  double force_difference = 0.0;
  for (std::size_t i = 0; i < expected.forces.size(); ++i) {
    const Eigen::Vector3d difference = result.forces[i] - expected.forces[i];
    largest_force = std::max(largest_force, expected.forces[i].cwiseAbs().maxCoeff());
    const double off = difference.allFinite() ? difference.cwiseAbs().maxCoeff() : 1e300;
    force_difference = std::max(force_difference, off);
  }
  const double allowed_force = tolerance.relative_force * (1.0 + largest_force);
  // The virial sums force times bond length over all atoms.
  const double allowed_virial =
      allowed_force * std::max(1.0, static_cast<double>(expected.forces.size())) * 2.0;
  return {
      .energy = in_units_of(difference_of_totals(result, expected), tolerance.energy),
      .energies = in_units_of(largest_difference(result.energies, expected.energies),
                              tolerance.atom_energy),
      .forces = in_units_of(force_difference, allowed_force),
      .virial =
          in_units_of((result.virial - expected.virial).cwiseAbs().maxCoeff(), allowed_virial),
  };
}

}  // namespace trivalent::testing_support
