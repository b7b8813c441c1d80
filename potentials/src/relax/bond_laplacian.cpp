#include "relax/bond_laplacian.h"

#include <vector>

namespace trivalent::potentials::relax_detail {

namespace {

// [eV/Å²]; needs the fewest steps on shells of 10,000 atoms, hardly more at half or twice as much.
constexpr double bond_stiffness = 20.0;
// Holds pieces that no bond holds; small against the softest mode of a shell.
constexpr double anchor_stiffness = 0.01;

}  // namespace

BondLaplacian::BondLaplacian(std::size_t n_atoms, std::span<const Bond> bonds,
                             std::span<const std::uint32_t> fixed) {
  std::vector<double> diagonal(n_atoms, anchor_stiffness);
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
