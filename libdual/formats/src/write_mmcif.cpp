#include <array>
#include <ostream>

#include "cell_frame.h"
#include "columns_of_text.h"
#include "trivalent/dual/check_atoms.h"
#include "trivalent/formats/cell_angles.h"
#include "trivalent/formats/cif.h"
#include "trivalent/formats/elements.h"
#include "trivalent/formats/text_file.h"

namespace trivalent::dual {
namespace {

void append_cell(std::string& text, const Eigen::Matrix3d& cell) {
  const CellAngles parameters = cell_angles(cell);
  constexpr std::array axes = {"a", "b", "c"};
  constexpr std::array angles = {"alpha", "beta", "gamma"};
  for (std::size_t k = 0; k < 3; ++k) {
    text += concat("_cell.length_", axes[k], ' ');
    append_real(text, parameters.lengths[k], Digits::seventeen_significant);
    text += concat("\n_cell.angle_", angles[k], ' ');
    append_real(text, parameters.angles[k], Digits::seventeen_significant);
    text += '\n';
  }
  text += "_symmetry.space_group_name_H-M 'P 1'\n";
}

}  // namespace

std::vector<std::string> write_mmcif(std::ostream& out, const Structure& structure,
                                     const WriteOptions& options) {
  const potentials::Atoms& atoms = structure.atoms;
  check_atoms("write_mmcif", atoms);
  CellFrame frame = {.positions = atoms.positions, .cell = {}, .notes = {}};
  std::string text = "data_carbon\n";
  if (atoms.box.is_periodic()) {
    frame = cell_frame(atoms, CellKind::triangular);
    append_cell(text, frame.cell);
  }
  if (!structure.bonds.empty()) frame.notes.emplace_back("bonds are left out");
  text +=
      "loop_\n_atom_site.group_PDB\n_atom_site.id\n_atom_site.type_symbol\n"
      "_atom_site.label_atom_id\n_atom_site.label_alt_id\n_atom_site.label_comp_id\n"
      "_atom_site.label_asym_id\n_atom_site.label_entity_id\n_atom_site.label_seq_id\n"
      "_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n_atom_site.occupancy\n"
      "_atom_site.B_iso_or_equiv\n_atom_site.auth_seq_id\n_atom_site.auth_asym_id\n"
      "_atom_site.pdbx_PDB_model_num\n";
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    const std::string_view symbol = symbol_of(atoms.species[i]);
    text += concat("HETATM ", i + 1, ' ', symbol, ' ', symbol, i + 1, " . UNL A 1 .");
    append_vector(text, frame.positions[i], options.digits);
    text += " 1 0 1 A 1\n";
  }
  out << text;
  return std::move(frame.notes);
}

}  // namespace trivalent::dual
