#include "relax/bond_laplacian.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "cell_grid.h"

namespace trivalent::potentials::relax_detail {

namespace {

// [eV/Å²]; needs the fewest steps on shells of 10,000 atoms, hardly more at half or twice as much.
constexpr double bond_stiffness = 20.0;
// Holds pieces that no bond holds; small against the softest mode of a shell.
constexpr double anchor_stiffness = 0.01;
// Of an atom beside another piece, about as between the layers of graphite. An onion of 5,000 atoms
// needs 132 evaluations of AIREBO with it, and 835 with the anchor alone.
constexpr double contact_stiffness = 0.2;
constexpr double contact_distance = 4.0;  // [Å]

/// The piece of every atom, by the number of one of its atoms.
std::vector<std::uint32_t> pieces_of(std::size_t n_atoms, std::span<const Bond> bonds) {
  std::vector<std::uint32_t> parent(n_atoms);
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t atom) {
    while (parent[atom] != atom) atom = parent[atom] = parent[parent[atom]];
    return atom;
  };
  for (const Bond& bond : bonds) parent[root(bond.first)] = root(bond.second);
  for (std::uint32_t atom = 0; atom < n_atoms; ++atom) parent[atom] = root(atom);
  return parent;
}

std::vector<double> anchors_of(const Atoms& atoms, std::span<const Bond> bonds) {
  std::vector<double> anchors(atoms.size(), anchor_stiffness);
  const std::vector<std::uint32_t> pieces = pieces_of(atoms.size(), bonds);
  if (std::ranges::adjacent_find(pieces, std::ranges::not_equal_to()) == pieces.end()) {
    return anchors;
  }
  const CellGrid grid(atoms, contact_distance);
  const auto points = grid.points();
  grid.for_each_neighbor(0, points.size(),
                         [&](std::size_t p, std::size_t q, const Eigen::Vector3d&, double) {
                           const std::uint32_t atom = points[p].atom;
                           if (pieces[atom] != pieces[points[q].atom]) {
                             anchors[atom] = contact_stiffness;
                           }
                         });
  return anchors;
}

}  // namespace

BondLaplacian::BondLaplacian(const Atoms& atoms, std::span<const Bond> bonds,
                             std::span<const std::uint32_t> fixed) {
  const std::size_t n_atoms = atoms.size();
  std::vector<double> diagonal = anchors_of(atoms, bonds);
  std::vector<bool> is_fixed(n_atoms, false);
  for (const std::uint32_t atom : fixed) is_fixed[atom] = true;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(n_atoms + bonds.size());
  for (const auto& [first, second, image] : bonds) {
    if (first == second) continue;  // an atom and its own image move together
    diagonal[first] += bond_stiffness;
    diagonal[second] += bond_stiffness;
    if (is_fixed[first] || is_fixed[second]) continue;
    entries.emplace_back(std::max(first, second), std::min(first, second), -bond_stiffness);
  }
  for (std::size_t i = 0; i < n_atoms; ++i) {
    entries.emplace_back(static_cast<int>(i), static_cast<int>(i), diagonal[i]);
  }
  const auto n = static_cast<Eigen::Index>(n_atoms);
  Matrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  factor_.compute(matrix);
}

void BondLaplacian::solve(Vector& forces) const {
  const Eigen::Index n = factor_.rows();
  auto of_atoms = forces.head(3 * n).reshaped(3, n).transpose();
  const Eigen::Matrix<double, Eigen::Dynamic, 3> displacements =
      factor_.solve(Eigen::Matrix<double, Eigen::Dynamic, 3>(of_atoms));
  of_atoms = displacements;
  forces.tail(forces.size() - 3 * n) /= bond_stiffness;  // the cell
}

}  // namespace trivalent::potentials::relax_detail
