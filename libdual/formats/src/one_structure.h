#pragma once

#include <optional>
#include <string>
#include <string_view>

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

/// What to say where a file of a molecule in a crystal names a space group: only its own atoms are
/// read. Nothing for P 1, or no name.
[[nodiscard]] std::optional<std::string> note_of_group_left_out(std::string_view name);

}  // namespace trivalent::dual
