#include "relax/bond_laplacian.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "cell_grid.h"

namespace trivalent::potentials::relax_detail {

namespace {

// [eV/Å²]; needs the fewest steps on shells of 10,000 atoms, hardly more at half or twice as much.
constexpr double bond_stiffness = 20.0;
// Holds pieces that no bond holds; small against the softest mode of a shell.
constexpr double anchor_stiffness = 0.01;
// Between an atom and the nearest of another piece, about as between the layers of graphite. An
// onion of 5,000 atoms needs 130 evaluations of AIREBO with it, and 835 without.
constexpr double contact_stiffness = 0.4;
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

/// From every atom that has one within reach, the nearest atom of another piece.
std::vector<std::array<std::uint32_t, 2>> contacts_of(const Atoms& atoms,
                                                      std::span<const std::uint32_t> pieces) {
  const CellGrid grid(atoms, contact_distance);
  const auto points = grid.points();
  std::vector<std::array<std::uint32_t, 2>> contacts;
  std::size_t center = points.size();
  double nearest = 0.0;
  grid.for_each_neighbor(
      0, points.size(), [&](std::size_t p, std::size_t q, const Eigen::Vector3d&, double r2) {
        const std::array<std::uint32_t, 2> pair = {points[p].atom, points[q].atom};
        if (pieces[pair[0]] == pieces[pair[1]]) return;
        if (p == center && r2 >= nearest) return;
        if (p == center) {
          contacts.back() = pair;
        } else {
          contacts.push_back(pair);
        }
        center = p;
        nearest = r2;
      });
  return contacts;
}

}  // namespace

BondLaplacian::BondLaplacian(const Atoms& atoms, std::span<const Bond> bonds,
                             std::span<const std::uint32_t> fixed) {
  const std::size_t n_atoms = atoms.size();
  std::vector<double> diagonal(n_atoms, anchor_stiffness);
  std::vector<bool> is_fixed(n_atoms, false);
  for (const std::uint32_t atom : fixed) is_fixed[atom] = true;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(n_atoms + bonds.size());
  const auto add_spring = [&](std::uint32_t first, std::uint32_t second, double stiffness) {
    if (first == second) return;  // an atom and its own image move together
    diagonal[first] += stiffness;
    diagonal[second] += stiffness;
    if (is_fixed[first] || is_fixed[second]) return;
    entries.emplace_back(std::max(first, second), std::min(first, second), -stiffness);
  };
  for (const Bond& bond : bonds) add_spring(bond.first, bond.second, bond_stiffness);
  const std::vector<std::uint32_t> pieces = pieces_of(n_atoms, bonds);
  has_pieces_ = std::ranges::adjacent_find(pieces, std::ranges::not_equal_to()) != pieces.end();
  if (has_pieces_) {
    for (const auto& [atom, other] : contacts_of(atoms, pieces)) {
      add_spring(atom, other, contact_stiffness);
    }
  }
  for (std::size_t i = 0; i < n_atoms; ++i) {
    entries.emplace_back(static_cast<int>(i), static_cast<int>(i), diagonal[i]);
  }
  const auto n = static_cast<Eigen::Index>(n_atoms);
  using Matrix = Eigen::SparseMatrix<double>;
  Matrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>> factorization(matrix);
  factor_ = Matrix(factorization.matrixL()).cast<float>();
  const auto& places = factorization.permutationP().indices();
  place_.assign(places.begin(), places.end());
}

void BondLaplacian::solve(Vector& forces) const {
  const Eigen::Index n = factor_.rows();
  auto of_atoms = forces.head(3 * n).reshaped(3, n);
  // All three directions at once: the factor is read once, not three times.
  using Column = Eigen::SparseMatrix<float>::InnerIterator;
  Eigen::Matrix<float, 4, Eigen::Dynamic> x(4, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    x.col(place_[static_cast<std::size_t>(i)]) << of_atoms.col(i).cast<float>(), 0.0F;
  }
  for (Eigen::Index j = 0; j < n; ++j) {
    Column entry(factor_, j);
    x.col(j) /= entry.value();
    while (++entry) x.col(entry.row()) -= entry.value() * x.col(j);
  }
  for (Eigen::Index j = n; j-- > 0;) {
    Column entry(factor_, j);
    const float diagonal = entry.value();
    while (++entry) x.col(j) -= entry.value() * x.col(entry.row());
    x.col(j) /= diagonal;
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    of_atoms.col(i) = x.col(place_[static_cast<std::size_t>(i)]).head<3>().cast<double>();
  }
  forces.tail(forces.size() - 3 * n) /= bond_stiffness;  // the cell
}

}  // namespace trivalent::potentials::relax_detail
