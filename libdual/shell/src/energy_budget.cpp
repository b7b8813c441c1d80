#include "trivalent/shell/energy_budget.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "trivalent/remesh/surface_shape.h"
#include "trivalent/shell/number_text.h"

namespace trivalent::shell {
namespace {

constexpr double bending_rigidity = 1.4;  // [eV] of graphene under REBO
constexpr double energy_of_pair = 3.0;    // [eV] of a 5-7 pair at rest

bool is_like_a_sphere(const remesh::TriMesh& net) {
  return remesh::euler_characteristic(net) == 2 && 3 * net.n_faces() == 2 * net.n_edges();
}

}  // namespace

EnergyBudget energy_budget(const remesh::TriMesh& net, double total) {
  EnergyBudget budget;
  budget.atoms = static_cast<int>(net.n_faces());
  budget.total = total;
  budget.bending = 0.5 * bending_rigidity * remesh::bending_integral(net);
  budget.defects = remesh::find_defects(net);
  budget.pairs = energy_of_pair * budget.defects.pairs;
  if (is_like_a_sphere(net)) budget.sphere = 9.844 * std::log(budget.atoms) - 7.52;
  return budget;
}

Json EnergyBudget::json() const {
  return {{"unit", "eV"},
          {"total", total},
          {"bending", bending},
          {"lone_pentagons", defects.lone_5},
          {"lone_heptagons", defects.lone_7},
          {"pentagon_heptagon_pairs", defects.pairs},
          {"pairs", pairs},
          {"best_sphere_of_as_many_atoms", sphere ? Json(*sphere) : Json(nullptr)}};
}

std::vector<dual::TableRow> EnergyBudget::rows() const {
  const auto text = [&](double energy) {
    return decimals(energy, 1) + " eV, " + decimals(1000.0 * energy / atoms, 1) + " meV/atom";
  };
  std::vector<dual::TableRow> rows = {
      {"total", text(total)},
      {"bending of the shape", text(bending)},
      {"rings as curvature asks", std::to_string(defects.lone_5) + " pentagons, " +
                                      std::to_string(defects.lone_7) + " heptagons"},
      {"pairs left over", std::to_string(defects.pairs) + " of 5-7, about " + text(pairs)}};
  if (sphere) rows.push_back({"best sphere", text(*sphere) + " for as many atoms"});
  return rows;
}

}  // namespace trivalent::shell
