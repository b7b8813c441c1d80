#pragma once

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "structures.h"

namespace trivalent::bench {

/// Graphene of 100,320 atoms, every atom displaced by 0.05 Å rms.
[[nodiscard]] inline potentials::Atoms graphene_100k() {
  auto atoms = testing_support::graphene(190, 132, 1.42);
  testing_support::displace(atoms, 0.05 / std::sqrt(3.0), 1);
  return atoms;
}

/// A closed shell of 50,000 atoms, displaced in the same way.
[[nodiscard]] inline potentials::Atoms shell_50k() {
  auto atoms = testing_support::geodesic_shell(50, 1.42);
  testing_support::displace(atoms, 0.05 / std::sqrt(3.0), 2);
  return atoms;
}

/// Reads XYZ, plain or extended; columns after the positions are ignored.
[[nodiscard]] inline potentials::Atoms read_xyz(const std::string& path) {
  std::ifstream in(path);
  std::size_t count = 0;
  std::string line;
  in >> count;
  std::getline(in, line);
  std::getline(in, line);
  potentials::Atoms atoms;
  const std::size_t lattice = line.find("Lattice=\"");
  const std::size_t pbc = line.find("pbc=\"");
  if (lattice != std::string::npos && pbc != std::string::npos) {
    std::istringstream cell(line.substr(lattice + 9));
    for (int k = 0; k < 9; ++k) cell >> atoms.box.cell.data()[k];
    for (std::size_t k = 0; k < 3; ++k) atoms.box.periodic[k] = line.at(pbc + 5 + 2 * k) == 'T';
  }
  while (atoms.size() < count && std::getline(in, line)) {
    std::istringstream row(line);
    std::string symbol;
    Eigen::Vector3d x;
    row >> symbol >> x[0] >> x[1] >> x[2];
    if (!row) throw std::runtime_error(path + ": cannot read: " + line);
    atoms.positions.push_back(x);
    atoms.species.push_back(symbol == "H" ? potentials::Species::hydrogen
                                          : potentials::Species::carbon);
  }
  if (atoms.size() != count || count == 0) throw std::runtime_error("cannot read " + path);
  return atoms;
}

/// Graphene of 4 cells² atoms, displaced in the same way.
[[nodiscard]] inline potentials::Atoms graphene_of(int cells) {
  auto atoms = testing_support::graphene(cells, cells, 1.42);
  testing_support::displace(atoms, 0.05 / std::sqrt(3.0), 1);
  return atoms;
}

/// A structure by its name here, or a file.
[[nodiscard]] inline potentials::Atoms structure(const std::string& name) {
  if (name.starts_with("graphene:")) return graphene_of(std::stoi(name.substr(9)));
  if (name == "graphene") return graphene_100k();
  if (name == "shell") return shell_50k();
  return read_xyz(name);
}

}  // namespace trivalent::bench
