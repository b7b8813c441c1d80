#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trivalent/dual/structure.h"

namespace trivalent::dual {

/// A network as columns of a table of atoms: every bond stands at both of its atoms.
struct BondColumns {
  static constexpr std::string_view atoms_name = "bonded_atoms";
  static constexpr std::string_view images_name = "bonded_images";

  std::size_t width = 0;        ///< bonds that an atom has room for
  std::vector<int> atoms = {};  ///< n · width: bonded atoms, from 0; -1 where there is none
  std::vector<int> images =
      {};  ///< n · 3 · width: their periodic images, in cell vectors; or empty
};

/// @throws InvalidNetwork as bonding_of.
[[nodiscard]] BondColumns bond_columns(const Structure& structure);

/// Takes the bonds of a structure from columns that were read with its atoms. Columns whose atoms
/// do not name each other (another program may have removed or copied atoms) are left out; images
/// that do not fit the positions (it may have wrapped them into the box) give way to the nearest.
/// Both are noted.
void take_bonds(const BondColumns& columns, Structure& structure, std::vector<std::string>& notes);

}  // namespace trivalent::dual
