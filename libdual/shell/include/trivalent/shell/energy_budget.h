#pragma once

#include <optional>
#include <vector>

#include "trivalent/remesh/defects.h"
#include "trivalent/remesh/mesh.h"
#include "trivalent/shell/json.h"
#include "trivalent/view/table_row.h"

namespace trivalent::shell {

/// Where the energy of a shell above graphene sits, and how far it is from the least its shape
/// allows. All energies in eV.
struct EnergyBudget {
  int atoms = 0;
  double total = 0.0;       ///< above graphene
  double bending = 0.0;     ///< ½ κ ∫ (2H)² dA of the shell as it is, κ = 1.4 eV
  remesh::Defects defects;  ///< rings of 5 and 7: alone as curvature asks for them, and in pairs
  double pairs = 0.0;       ///< of the 5-7 pairs that are left over, at about 3 eV each
  /// Of the best known shell of as many atoms around a sphere, icosahedral: 9.844 ln N - 7.52. For
  /// closed surfaces of genus 0 only.
  std::optional<double> sphere = std::nullopt;

  [[nodiscard]] Json json() const;
  [[nodiscard]] std::vector<dual::TableRow> rows() const;
};

/// @param net    The shell's dual, one vertex per ring [Å].
/// @param total  Energy of the shell above graphene [eV].
[[nodiscard]] EnergyBudget energy_budget(const remesh::TriMesh& net, double total);

}  // namespace trivalent::shell
