#include "one_structure.h"

namespace trivalent::dual {

void require_no_atom_style(const TextSource& source, const ReadOptions& options) {
  if (!options.atom_style) return;
  throw InvalidOption(concat(source.reader, ": an atom_style belongs to LAMMPS data"));
}

void require_one_structure(const TextSource& source, const ReadOptions& options) {
  require_no_atom_style(source, options);
  if (options.frame.value_or(1) == 1) return;
  throw InvalidOption(concat(source.reader,
                             ": a file of this format holds one structure; there is no number ",
                             *options.frame));
}

std::optional<std::string> note_of_group_left_out(std::string_view name) {
  if (name.empty() || name == "P 1" || name == "P1") return std::nullopt;
  return concat("the space group ", in_quotes(name),
                " is not applied: the atoms of the file are taken as all of the cell's");
}

}  // namespace trivalent::dual
