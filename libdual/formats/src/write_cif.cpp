#include <spglib.h>

#include <Eigen/LU>
#include <algorithm>
#include <gemmi/symmetry.hpp>
#include <memory>
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

using Eigen::Vector3d;
using potentials::Species;

/// What a CIF says of a structure.
struct CifContent {
  Eigen::Matrix3d cell;
  std::string space_group = "P 1";  ///< Hermann-Mauguin
  int number = 1;                   ///< of the space group
  std::vector<std::string> operations = {"x,y,z"};
  std::vector<Vector3d> fractions = {};  ///< of the sites
  std::vector<Species> species = {};
  std::vector<potentials::Bond> bonds = {};
};

std::string label_of(Species species, std::size_t index) {
  return concat(symbol_of(species), index + 1);
}

void write_content(std::ostream& out, const CifContent& content) {
  const CellAngles parameters = cell_angles(content.cell);
  constexpr std::array axes = {"a", "b", "c"};
  constexpr std::array angles = {"alpha", "beta", "gamma"};
  std::string text = "data_carbon\n";
  for (std::size_t k = 0; k < 3; ++k) {
    text += concat("_cell_length_", axes[k], ' ');
    append_real(text, parameters.lengths[k], Digits::seventeen_significant);
    text += concat("\n_cell_angle_", angles[k], ' ');
    append_real(text, parameters.angles[k], Digits::seventeen_significant);
    text += '\n';
  }
  text += concat("_space_group_name_H-M_alt '", content.space_group, "'\n_space_group_IT_number ",
                 content.number, "\nloop_\n_space_group_symop_operation_xyz\n");
  for (const std::string& operation : content.operations) text += concat('\'', operation, "'\n");
  text +=
      "loop_\n_atom_site_label\n_atom_site_type_symbol\n_atom_site_fract_x\n_atom_site_fract_y\n"
      "_atom_site_fract_z\n_atom_site_occupancy\n";
  for (std::size_t i = 0; i < content.fractions.size(); ++i) {
    text += concat(label_of(content.species[i], i), ' ', symbol_of(content.species[i]));
    append_vector(text, content.fractions[i], Digits::seventeen_significant);
    text += " 1\n";
  }
  if (!content.bonds.empty()) {
    text +=
        "loop_\n_geom_bond_atom_site_label_1\n_geom_bond_atom_site_label_2\n"
        "_geom_bond_site_symmetry_2\n";
  }
  for (const potentials::Bond& bond : content.bonds) {
    text += concat(label_of(content.species[bond.first], bond.first), ' ',
                   label_of(content.species[bond.second], bond.second), " 1_");
    for (const std::int32_t count : bond.image) text += std::to_string(5 + count);
    text += '\n';
  }
  out << text;
}

/// Bonds whose images the codes of a CIF can name: up to four cells away.
std::vector<potentials::Bond> bonds_of(const Structure& structure, bool is_c_reversed,
                                       std::vector<std::string>& notes) {
  std::vector<potentials::Bond> bonds = structure.bonds;
  for (potentials::Bond& bond : bonds) bond.image[2] *= is_c_reversed ? -1 : 1;
  const auto is_far = [](const potentials::Bond& bond) {
    return std::ranges::any_of(bond.image, [](std::int32_t n) { return n < -4 || n > 4; });
  };
  if (std::ranges::any_of(bonds, is_far)) {
    notes.emplace_back("the bonds are left out: some lead further than four cells");
    bonds.clear();
  }
  return bonds;
}

struct FreeDataset {
  void operator()(SpglibDataset* dataset) const { spg_free_dataset(dataset); }
};
using Dataset = std::unique_ptr<SpglibDataset, FreeDataset>;

Dataset find_symmetry(const CellFrame& frame, const std::vector<Species>& species,
                      double tolerance) {
  double lattice[3][3];  // NOLINT(*-avoid-c-arrays): spglib's own
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) lattice[row][column] = frame.cell(row, column);
  }
  const Eigen::Matrix3d inverse = frame.cell.inverse();
  std::vector<std::array<double, 3>> positions;
  for (const Vector3d& x : frame.positions) {
    const Vector3d fractions = inverse * x;
    positions.push_back({fractions[0], fractions[1], fractions[2]});
  }
  std::vector<int> types;
  for (const Species element : species) types.push_back(static_cast<int>(element));
  const auto n_atoms = static_cast<int>(positions.size());
  // NOLINTNEXTLINE(*-reinterpret-cast): rows of three numbers are what spglib takes
  auto* rows = reinterpret_cast<double(*)[3]>(positions.data());
  return Dataset(spg_get_dataset(lattice, rows, types.data(), n_atoms, tolerance));
}

/// The operations of a space group in the setting that spglib found.
std::vector<gemmi::Op> operations_of(int hall_number) {
  constexpr int max_operations = 192;
  int rotations[max_operations][3][3];     // NOLINT(*-avoid-c-arrays): spglib's own
  double translations[max_operations][3];  // NOLINT(*-avoid-c-arrays)
  const int n = spg_get_symmetry_from_database(rotations, translations, hall_number);
  std::vector<gemmi::Op> operations;
  for (int i = 0; i < n; ++i) {
    gemmi::Op operation = {};
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t k = 0; k < 3; ++k) {
        operation.rot[row][k] = gemmi::Op::DEN * rotations[i][row][k];
      }
      operation.tran[row] = static_cast<int>(std::lround(gemmi::Op::DEN * translations[i][row]));
    }
    operations.push_back(operation);
  }
  return operations;
}

/// The first atom of every orbit.
void add_sites(const SpglibDataset& dataset, const std::vector<gemmi::Op>& operations,
               double tolerance, CifContent& content) {
  const auto n_atoms = static_cast<std::size_t>(dataset.n_std_atoms);
  std::vector<Vector3d> fractions;
  for (std::size_t i = 0; i < n_atoms; ++i) {
    const double* x = dataset.std_positions[i];
    fractions.emplace_back(x[0], x[1], x[2]);
  }
  std::vector<char> is_copy(n_atoms, 0);
  for (std::size_t i = 0; i < n_atoms; ++i) {
    if (is_copy[i] != 0) continue;
    content.fractions.push_back(fractions[i]);
    content.species.push_back(static_cast<Species>(dataset.std_types[i]));
    for (const gemmi::Op& operation : operations) {
      const auto image =
          operation.apply_to_xyz({fractions[i][0], fractions[i][1], fractions[i][2]});
      const Vector3d copy(image[0], image[1], image[2]);
      for (std::size_t j = i + 1; j < n_atoms; ++j) {
        const Vector3d apart = copy - fractions[j];
        const Vector3d nearest = apart.array() - apart.array().round();
        if ((content.cell * nearest).norm() < tolerance) is_copy[j] = 1;
      }
    }
  }
}

CifContent symmetric_content(const CellFrame& frame, const potentials::Atoms& atoms,
                             double tolerance) {
  const Dataset dataset = find_symmetry(frame, atoms.species, tolerance);
  if (!dataset) {
    throw InvalidNetwork(
        "write_cif: spglib finds no space group; atoms may lie on each other, or the symmetry "
        "tolerance be too large");
  }
  CifContent content = {};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      content.cell(row, column) = dataset->std_lattice[row][column];
    }
  }
  const std::vector<gemmi::Op> operations = operations_of(dataset->hall_number);
  gemmi::GroupOps group = gemmi::split_centering_vectors(operations);
  const gemmi::SpaceGroup* known = gemmi::find_spacegroup_by_ops(group);
  content.space_group = known != nullptr ? known->xhm() : dataset->international_symbol;
  content.number = dataset->spacegroup_number;
  content.operations.clear();
  for (const gemmi::Op& operation : operations) content.operations.push_back(operation.triplet());
  add_sites(*dataset, operations, tolerance, content);
  return content;
}

}  // namespace

std::vector<std::string> write_cif(std::ostream& out, const Structure& structure,
                                   const WriteOptions& options) {
  const potentials::Atoms& atoms = structure.atoms;
  check_atoms("write_cif", atoms);
  CellFrame frame = cell_frame(atoms, CellKind::general);
  CifContent content = {.cell = frame.cell};
  if (options.symmetry_tolerance) {
    content = symmetric_content(frame, atoms, *options.symmetry_tolerance);
    frame.notes.push_back(concat("the conventional cell of ", content.space_group,
                                 " is written, with ", content.fractions.size(), " sites for ",
                                 atoms.size(), " atoms; bonds are left out"));
  } else {
    const Eigen::Matrix3d inverse = frame.cell.inverse();
    for (const Vector3d& x : frame.positions) content.fractions.emplace_back(inverse * x);
    content.species = atoms.species;
    const bool is_c_reversed = atoms.box.is_periodic() && atoms.box.cell.determinant() < 0.0;
    content.bonds = bonds_of(structure, is_c_reversed, frame.notes);
  }
  write_content(out, content);
  return std::move(frame.notes);
}

}  // namespace trivalent::dual
