#pragma once

#include "trivalent/formats/structure_format.h"
#include "trivalent/formats/text_file.h"

namespace trivalent::dual {

/// Refuses options of other formats, for one whose files hold a single structure.
///
/// @throws InvalidOption if the options ask for another frame than the first, or an atom_style.
void require_one_structure(const TextSource& source, const ReadOptions& options);

/// Refuses an atom_style, which belongs to LAMMPS data.
///
/// @throws InvalidOption if the options have one.
void require_no_atom_style(const TextSource& source, const ReadOptions& options);

}  // namespace trivalent::dual
