#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <sstream>
#include <string>

#include "file_text.h"
#include "small_cells.h"
#include "temporary_folder.h"
#include "trivalent/dual/bonding.h"
#include "trivalent/formats/structure_format.h"
#include "trivalent/potentials/bonds.h"
#include "trivalent/potentials/rebo.h"
#include "trivalent/shell/structure_source.h"

// Formats of other programs: what they read, what they change, what they refuse. That other
// programs read our files is checked by tests/apps/formats.py.
namespace trivalent::dual {
namespace {

using testing_support::acetylene;
using testing_support::graphene;
using testing_support::message_of;
using testing_support::TemporaryFolder;

std::string complaint(const std::string& name, const std::string& text) {
  return message_of<FileError>([&] { static_cast<void>(file_of(name, text)); });
}

std::vector<std::string> names_of_formats() {
  std::vector<std::string> names;
  for (const StructureFormat& format : structure_formats()) {
    if (format.read != nullptr) names.push_back(format.name);
  }
  return names;
}

class EveryFormat : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] std::filesystem::path write(const Structure& structure) {
    const auto path = folder_.path() / ("atoms" + structure_format(GetParam()).extensions.front());
    notes_ = write_structure(
        path, structure,
        {.digits = Digits::seventeen_significant, .atom_style = AtomStyle::molecular});
    return path;
  }

  TemporaryFolder folder_;
  std::vector<std::string> notes_;
};

TEST_P(EveryFormat, KeepsEnergyAndVolumeOfAnyCell) {
  for (const Structure& structure : {graphene(), acetylene()}) {
    const Structure back = shell::read_structure(write(structure)).structure;
    // PDB has three decimals.
    const double precision = GetParam() == "pdb" ? 2e-2 : 1e-7;
    EXPECT_NEAR(potentials::rebo(back.atoms).energy, potentials::rebo(structure.atoms).energy,
                precision);
    EXPECT_NEAR(std::abs(back.atoms.box.cell.determinant()),
                std::abs(structure.atoms.box.cell.determinant()), GetParam() == "pdb" ? 2.0 : 1e-6);
  }
}

TEST_P(EveryFormat, KeepsBondsOrHasNone) {
  const Structure structure = acetylene();
  const Structure back = shell::read_structure(write(structure)).structure;
  if (back.bonds.empty()) return;
  ASSERT_EQ(back.bonds.size(), structure.bonds.size());
  for (const potentials::Bond& bond : back.bonds) {
    EXPECT_LT(potentials::bond_length(back.atoms, bond), 1.3);
  }
}

TEST_P(EveryFormat, RefusesCoordinatesThatAreNotFinite) {
  Structure structure = graphene();
  structure.atoms.positions[1].z() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(static_cast<void>(write(structure)), InvalidNetwork);
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_P(EveryFormat, RefusesAMissingFileAndAnEmptyOne) {
  const StructureFormat& format = structure_format(GetParam());
  EXPECT_THROW(static_cast<void>(format.read(folder_.path() / "missing", {})), FileError);
  EXPECT_THROW(static_cast<void>(format.read(folder_.file("empty", ""), {})), FileError);
}

INSTANTIATE_TEST_SUITE_P(Formats, EveryFormat, testing::ValuesIn(names_of_formats()),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           std::erase(name, '-');
                           return name;
                         });

const std::string poscar =
    "title\n2.0\n1.23 0 0\n0 1 0\n0 0 8\nC H\n1 1\nSelective dynamics\nDirect\n"
    "0 0 0.5 T T F\n0.5 0.5 0.5 F F F\n";

std::vector<std::array<int, 3>> flags_of(const Structure& structure) {
  return std::get<std::vector<std::array<int, 3>>>(structure.columns.at(0).values);
}

TEST(Poscar, ReadsScaleVolumeAndCartesianPositions) {
  const Structure direct = file_of("POSCAR", poscar).structure;
  EXPECT_EQ(direct.atoms.positions[1], Eigen::Vector3d(1.23, 1.0, 8.0));
  EXPECT_EQ(direct.atoms.species[1], potentials::Species::hydrogen);
  EXPECT_EQ(flags_of(direct), (std::vector<std::array<int, 3>>{{1, 1, 0}, {0, 0, 0}}));
  const Structure volume =
      file_of("a.vasp", "t\n-8\n1 0 0\n0 1 0\n0 0 1\nC_pv/abc\n1\nCartesian\n0.5 0 0\n").structure;
  EXPECT_NEAR(volume.atoms.box.cell.determinant(), 8.0, 1e-12);
  EXPECT_NEAR(volume.atoms.positions[0].x(), 1.0, 1e-12);
}

TEST(Poscar, NeedsElementsWhereVasp4NamesNone) {
  const std::string text = "t\n1\n9 0 0\n0 9 0\n0 0 9\n1\nDirect\n0 0 0\n";
  EXPECT_NE(complaint("POSCAR", text).find("--elements"), std::string::npos);
  EXPECT_EQ(file_of("POSCAR", text, {.elements = {potentials::Species::hydrogen}})
                .structure.atoms.species[0],
            potentials::Species::hydrogen);
}

TEST(Gro, ReadsTheLastFrameOrTheOneThatIsNamed) {
  const auto frame = [](const char* z) {
    return std::string("t\n1\n    1CNT     C1    1   0.100   0.200   ") + z +
           "\n   1.0 1.0 2.0 0 0 0.1 0 0 0\n";
  };
  const std::string text = frame("0.300") + frame("0.400");
  const StructureFile last = file_of("a.gro", text);
  EXPECT_NEAR(last.structure.atoms.positions[0].z(), 4.0, 1e-12);
  EXPECT_NEAR(last.structure.atoms.box.cell(0, 1), 1.0, 1e-12);
  EXPECT_EQ(last.notes.size(), 1u);
  EXPECT_NEAR(file_of("a.gro", text, {.frame = 1}).structure.atoms.positions[0].z(), 3.0, 1e-12);
  EXPECT_THROW(static_cast<void>(file_of("a.gro", text, {.frame = 3})), FileError);
}

TEST(Pdb, NumbersAtomsBeyond99999InHybrid36) {
  Structure many;
  for (int i = 0; i < 100001; ++i) many.atoms.positions.emplace_back(0.01 * i, 0.0, 0.0);
  many.atoms.species.assign(many.atoms.positions.size(), potentials::Species::carbon);
  many.bonds = {{.first = 0, .second = 1}, {.first = 99998, .second = 100000}};
  const TemporaryFolder folder;
  const auto path = folder.path() / "many.pdb";
  const std::vector<std::string> notes = write_structure(path, many);
  EXPECT_NE(notes.back().find("bonds are left out"), std::string::npos);
  const Structure back = shell::read_structure(path).structure;
  ASSERT_EQ(back.atoms.size(), many.atoms.size());
  EXPECT_NEAR(back.atoms.positions[100000].x(), many.atoms.positions[100000].x(), 1e-9);
  std::ostringstream text;
  structure_format("pdb").write(text, many, {});
  EXPECT_NE(text.str().find("HETATMA0001"), std::string::npos);
  EXPECT_EQ(text.str().find("CONECT"), std::string::npos);
}

const std::string pdb_atom =
    "HETATM    1  C   UNL A   1       1.000   2.000   3.000  1.00  0.00           C\n";

TEST(Pdb, ReadsTheLastModelOrTheOneThatIsNamed) {
  const std::string second = "HETATM    1  C   UNL A   1       1.500   2.000   3.000\n";
  const std::string text = "MODEL 1\n" + pdb_atom + "ENDMDL\nMODEL 2\n" + second + "ENDMDL\n";
  EXPECT_EQ(file_of("a.pdb", text).structure.atoms.positions[0].x(), 1.5);
  EXPECT_EQ(file_of("a.pdb", text, {.frame = 1}).structure.atoms.positions[0].x(), 1.0);
  EXPECT_THROW(static_cast<void>(file_of("a.pdb", text, {.frame = 3})), FileError);
}

TEST(Pdb, ForgetsBondsOfAnEarlierModel) {
  const std::string second = "HETATM    2  C   UNL A   1       1.500   2.000   3.000\n";
  const StructureFile file =
      file_of("a.pdb", pdb_atom + second + "CONECT    1    2\nMODEL 2\n" + pdb_atom);
  EXPECT_EQ(file.structure.atoms.size(), 1u);
  EXPECT_TRUE(file.structure.bonds.empty());
}

TEST(Pdb, TakesTheUnitCubeForNoCell) {
  const std::string cube =
      "CRYST1    1.000    1.000    1.000  90.00  90.00  90.00 P 1           1\n";
  EXPECT_FALSE(file_of("a.pdb", cube + pdb_atom).structure.atoms.box.is_periodic());
}

const std::string cell_of_cif =
    "data_a\n_cell_length_a 4\n_cell_length_b 4\n_cell_length_c 4\n_cell_angle_alpha 90\n"
    "_cell_angle_beta 90\n_cell_angle_gamma 90\n";
const std::string sites =
    "loop_\n_atom_site_label\n_atom_site_fract_x\n_atom_site_fract_y\n_atom_site_fract_z\n";

TEST(Cif, RepeatsSitesByTheSpaceGroup) {
  const std::string text = cell_of_cif + "_symmetry_space_group_name_H-M 'P m -3 m'\n" + sites;
  EXPECT_EQ(file_of("a.cif", text + "C1 0 0 0\n").structure.atoms.size(), 1u);
  EXPECT_EQ(file_of("a.cif", text + "C1 0.3(2) 0 0\n").structure.atoms.size(), 6u);
  EXPECT_EQ(file_of("a.cif", text + "C1 0.1 0.2 0.3\n").structure.atoms.size(), 48u);
}

TEST(Cif, TakesTheOperationsOfTheFileFirst) {
  const std::string text = cell_of_cif +
                           "_symmetry_space_group_name_H-M 'P m -3 m'\nloop_\n"
                           "_symmetry_equiv_pos_as_xyz\nx,y,z\n-x,-y,-z\n" +
                           sites + "C1 0.1 0.2 0.3\n";
  EXPECT_EQ(file_of("a.cif", text).structure.atoms.size(), 2u);
}

TEST(Cif, WritesASpaceGroupAndReadsAllAtomsBack) {
  // Diamond: 8 atoms, one site of F d -3 m.
  Structure diamond;
  for (const Eigen::Vector3d& x : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 2, 2),
                                   Eigen::Vector3d(2, 0, 2), Eigen::Vector3d(2, 2, 0)}) {
    diamond.atoms.positions.push_back(0.89175 * x);
    diamond.atoms.positions.push_back(0.89175 * (x + Eigen::Vector3d::Ones()));
  }
  diamond.atoms.species.assign(8, potentials::Species::carbon);
  diamond.atoms.box.cell = 3.567 * Eigen::Matrix3d::Identity();
  diamond.atoms.box.periodic = {true, true, true};
  const TemporaryFolder folder;
  const auto path = folder.path() / "diamond.cif";
  const auto notes = write_structure(path, diamond, {.symmetry_tolerance = 1e-3});
  EXPECT_NE(notes.back().find("1 sites for 8 atoms"), std::string::npos);
  std::ifstream written(path);
  const std::string text(std::istreambuf_iterator<char>(written), {});
  EXPECT_NE(text.find("_space_group_IT_number 227"), std::string::npos);
  const Structure back = shell::read_structure(path).structure;
  EXPECT_EQ(back.atoms.size(), 8u);
  EXPECT_NEAR(potentials::rebo(back.atoms).energy, potentials::rebo(diamond.atoms).energy, 1e-8);
}

TEST(Cif, KeepsTheImagesOfBonds) {
  const Structure cell = graphene();
  const TemporaryFolder folder;
  write_structure(folder.path() / "a.cif", cell);
  const Structure back = shell::read_structure(folder.path() / "a.cif").structure;
  ASSERT_EQ(back.bonds.size(), 3u);
  for (const potentials::Bond& bond : back.bonds) {
    EXPECT_NEAR(potentials::bond_length(back.atoms, bond), 1.42, 1e-3);
  }
}

TEST(Espresso, ReadsUnitsOfLength) {
  const std::string head = "&system\n ibrav=0, celldm(1) = 2.0, nat=1\n/\n";
  const std::string text = head +
                           "CELL_PARAMETERS bohr\n10 0 0\n0 10 0\n0 0 10\n"
                           "ATOMIC_POSITIONS (crystal)\nC1 0.5 0 0 ! free\n";
  EXPECT_NEAR(file_of("a.pwi", text).structure.atoms.positions[0].x(), 5.0 * 0.529177210903, 1e-9);
  const std::string alat = head +
                           "CELL_PARAMETERS {alat}\n5 0 0\n0 5 0\n0 0 5\nATOMIC_POSITIONS alat\n"
                           "C 1.0 0 0\n";
  EXPECT_NEAR(file_of("a.pwi", alat).structure.atoms.positions[0].x(), 2.0 * 0.529177210903, 1e-9);
}

TEST(Cp2k, ReadsCellsOfEveryKind) {
  const std::string coordinates = "&COORD\n UNIT bohr\n C 2 0 0\n&END COORD\n";
  const Structure angles =
      file_of("a.inp",
              "&CELL\n ABC [bohr] 10 10 10\n ALPHA_BETA_GAMMA 90 90 120\n PERIODIC XY\n"
              "&END CELL\n" +
                  coordinates)
          .structure;
  EXPECT_NEAR(angles.atoms.box.cell(0, 1), -5.0 * 0.529177210903, 1e-9);
  EXPECT_EQ(angles.atoms.box.periodic, (std::array{true, true, false}));
  EXPECT_NEAR(angles.atoms.positions[0].x(), 2.0 * 0.529177210903, 1e-12);
  EXPECT_FALSE(file_of("a.inp", coordinates).structure.atoms.box.is_periodic());
}

TEST(GromacsTopology, HasEveryAngleAndDihedralOnce) {
  // Benzene: 6 · 3 angles, 4 dihedrals around each of 6 bonds.
  Structure benzene;
  for (int k = 0; k < 6; ++k) {
    const double angle = k * std::numbers::pi / 3.0;
    for (const double radius : {1.40, 2.48}) {
      benzene.atoms.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    }
    benzene.atoms.species.push_back(potentials::Species::carbon);
    benzene.atoms.species.push_back(potentials::Species::hydrogen);
  }
  std::ostringstream text;
  const auto notes = structure_format("gromacs-topology").write(text, benzene, {});
  EXPECT_EQ(notes.size(), 1u);  // bonds by distance
  const std::string topology = text.str();
  const auto lines = [&](const std::string& section, const std::string& next) {
    const std::size_t begin = topology.find("[ " + section + " ]");
    const std::string part = topology.substr(begin, topology.find("[ " + next + " ]") - begin);
    return std::ranges::count(part, '\n') - 2;
  };
  EXPECT_EQ(lines("bonds", "angles"), 12);
  EXPECT_EQ(lines("angles", "dihedrals"), 18);
  EXPECT_EQ(lines("dihedrals", "system"), 24);
  Structure apart = benzene;
  for (Eigen::Vector3d& x : apart.atoms.positions) x *= 10.0;
  EXPECT_THROW(static_cast<void>(structure_format("gromacs-topology").write(text, apart, {})),
               InvalidNetwork);
}

struct Fault {
  std::string name;
  std::string text;
  std::string message;
};

TEST(AtomFormats, NameTheLineOfEveryFault) {
  const std::string mol2 = "@<TRIPOS>MOLECULE\nm\n1 0\nSMALL\nNO_CHARGES\n@<TRIPOS>ATOM\n";
  for (const auto& [name, text, message] : std::vector<Fault>{
           {"POSCAR", "t\n0\n1 0 0\n0 1 0\n0 0 1\nC\n1\nDirect\n0 0 0\n", "line 2: a scale"},
           {"POSCAR", "t\n1\n1 0 0\n0 1 0\n1 1 0\nC\n1\nDirect\n0 0 0\n",
            "line 5: the cell vectors"},
           {"POSCAR", "t\n1\n1 0 0\n0 1 0\n0 0 1\nSi\n1\nDirect\n0 0 0\n", "line 6: element 'Si'"},
           {"POSCAR", "t\n1\n1 0 0\n0 1 0\n0 0 1\nC\n1 2\nDirect\n0 0 0\n", "line 7: 1 elements"},
           {"POSCAR", "t\n1\n1 0 0\n0 1 0\n0 0 1\nC\n1\nWhat\n0 0 0\n", "line 8: expected Direct"},
           {"POSCAR", "t\n1\n1 0 0\n0 1 0\n0 0 1\nC\n2\nDirect\n0 0 0\n", "atom 2 of 2"},
           {"POSCAR", "t\n1\n1 0 0\n0 1 0\n0 0 1\nC\n1\nS\nDirect\n0 0 0 T T Q\n",
            "line 10: expected T"},
           {"a.gen", "1 H\nC\n1 1 0 0 0\n", "line 1: helical"},
           {"a.gen", "1 X\nC\n1 1 0 0 0\n", "line 1: the kind"},
           {"a.gen", "1 C\nSi\n1 1 0 0 0\n", "line 2: element"},
           {"a.gen", "1 C\nC\n1 2 0 0 0\n", "line 3"},
           {"a.gen", "1 S\nC\n1 1 0 0 0\n0 0 0\n1 0 0\n", "a cell vector"},
           {"a.gro", "t\n2\n    1CNT     C1    1   0.100   0.200   0.300\n", "atom 2 of 2"},
           {"a.gro", "t\n1\n    1CNT    SI1    1   0.100   0.200   0.300\n1 1 1\n", "line 3: atom"},
           {"a.gro", "t\n1\n    1CNT     CL    1   0.100   0.200   0.300\n1 1 1\n", "line 3: atom"},
           {"a.pdb", "HETATM    1 CL   UNL A   1       1.000   2.000   3.000\n", "line 1: element"},
           {"a.gro", "t\n1\n    1CNT     C1    1   0.100   0.200   0.300\n1 1\n", "line 4: a box"},
           {"a.gro", "t\n1\n    1CNT     C1    1   0.100   0.200\n1 1 1\n", "line 3"},
           {"a.pdb",
            "HETATM    1 SI   UNL A   1       1.000   2.000   3.000  1.00  0.00          SI\n",
            "line 1: element"},
           {"a.pdb", "HETATM    1  C   UNL A   1       1.000   2.0x0   3.000\n", "line 1"},
           {"a.pdb", pdb_atom + "CONECT    1    2\n", "line 2: there is no atom"},
           {"a.pdb", pdb_atom + pdb_atom + "CONECT    1    1\n", "line 3: several atoms"},
           {"a.pdb", "CRYST1    9.000    9.000    9.000  10.00  10.00 170.00 P 1\n" + pdb_atom,
            "line 1: no cell"},
           {"a.pdb", "HETATM    1  C  BUNL A   1       1.000   2.000   3.000\n",
            "line 1: the atom has another place"},
           {"a.mol2", mol2 + "1 C 0 0 0\n", "line 7: expected id"},
           {"a.mol2", mol2 + "1 C 0 0 0 Si\n", "line 7: type"},
           {"a.mol2", mol2 + "1 C 0 0 0 C.ar\n@<TRIPOS>BOND\n1 1 2 ar\n",
            "line 9: there is no atom"},
           {"a.mol2", "1 C 0 0 0 C.ar\n", "MOLECULE"},
           {"a.pwi", "ATOMIC_POSITIONS angstrom\nC 0 0 0\n", "line 1: nat"},
           {"a.pwi", "&system\nibrav=1\n/\n", "line 2: ibrav"},
           {"a.pwi",
            "nat = 1\nATOMIC_POSITIONS furlong\nC 0 0 0\nCELL_PARAMETERS bohr\n1 0 0\n0 1 0\n0 0 "
            "1\n",
            "line 2: the unit"},
           {"a.pwi",
            "nat = 1\nATOMIC_POSITIONS bohr\nC 0 0 0\nCELL_PARAMETERS alat\n1 0 0\n0 1 0\n0 0 1\n",
            "line 4: alat"},
           {"a.pwi", "nat = 1\nATOMIC_POSITIONS bohr\nC 0 0 0\n", "CELL_PARAMETERS"},
           {"a.inp", "@INCLUDE other\n", "line 1: @INCLUDE"},
           {"a.inp", "&CELL\nMULTIPLE_UNIT_CELL 2 1 1\n&END\n", "line 2: MULTIPLE_UNIT_CELL"},
           {"a.inp", "&COORD\nSi 0 0 0\n&END\n", "line 2: element"},
           {"a.inp", "&COORD\nUNIT furlong\nC 0 0 0\n&END\n", "line 2: the unit"},
           {"a.cif", cell_of_cif + sites + "Si1 0 0 0\n", "site Si1: element"},
           {"a.cif", cell_of_cif + sites + "C1 ? 0 0\n", "coordinate of C1"},
           {"a.cif", "data_a\n" + sites + "C1 0 0 0\n", "no cell"},
           {"a.cif", cell_of_cif, "no block has sites"},
           {"a.cif", cell_of_cif + "_space_group_name_H-M_alt 'Q 7'\n" + sites + "C1 0 0 0\n",
            "'Q 7'"},
           {"a.cif",
            cell_of_cif + "loop_\n_atom_site_label\n_atom_site_fract_x\n_atom_site_fract_y\n"
                          "_atom_site_fract_z\n_atom_site_occupancy\nC1 0 0 0 0.5\n",
            "C1 is occupied by 0.5"},
           {"a.cif", "data_a\nloop_\n_x\n_y\n1 2 3\n", "a.cif"}}) {
    EXPECT_NE(complaint(name, text).find(message), std::string::npos) << message << "\n"
                                                                      << complaint(name, text);
  }
}

}  // namespace
}  // namespace trivalent::dual
