#include "even_out.h"

#include <algorithm>

#include "trivalent/dual/graphene.h"

namespace trivalent::dual {

void even_out(Structure& structure,
              const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& project) {
  constexpr int steps = 100;
  constexpr double part = 0.2;  // of a bond's excess length that each of its atoms takes up
  std::vector<Eigen::Vector3d>& positions = structure.atoms.positions;
  std::vector<Eigen::Vector3d> moves(positions.size());
  for (int step = 0; step < steps; ++step) {
    std::ranges::fill(moves, Eigen::Vector3d::Zero());
    for (const potentials::Bond& bond : structure.bonds) {
      const Eigen::Vector3d along = positions[bond.second] - positions[bond.first];
      const Eigen::Vector3d pull = part * (1.0 - graphene_bond / along.norm()) * along;
      moves[bond.first] += pull;
      moves[bond.second] -= pull;
    }
    for (std::size_t i = 0; i < positions.size(); ++i) {
      positions[i] = project(positions[i] + moves[i]);
    }
  }
}

}  // namespace trivalent::dual
