#pragma once

#include <span>
#include <vector>

#include "trivalent/dual/structure.h"
#include "trivalent/dual/walls.h"
#include "trivalent/potentials/potential.h"
#include "trivalent/shell/json.h"
#include "trivalent/view/table_row.h"

namespace trivalent::shell {

/// What each atom's energy is lower for by the other walls [eV]: its energy in the structure less
/// the one that it has in its wall alone. Empty if there is one wall.
///
/// @param energies  of the atoms of the structure under the potential [eV]
/// @throws potentials::InvalidAtoms if the potential has no energy for a wall
[[nodiscard]] std::vector<double> wall_energies(const dual::Structure& structure,
                                                std::span<const double> energies,
                                                potentials::Potential& potential);

/// @param energies  as wall_energies() gives them; may be empty
[[nodiscard]] Json walls_json(std::span<const dual::WallReport> walls,
                              std::span<const double> energies);
[[nodiscard]] std::vector<dual::TableRow> walls_rows(std::span<const dual::WallReport> walls,
                                                     std::span<const double> energies);

}  // namespace trivalent::shell
