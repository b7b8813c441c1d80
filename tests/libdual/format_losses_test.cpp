#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "file_text.h"
#include "trivalent/dual/columns.h"
#include "trivalent/formats/structure_format.h"

// What a format cannot hold, or a reader does not apply, is said.
namespace trivalent::dual {
namespace {

using testing_support::TemporaryFolder;

auto mentions(std::string words) {
  return [words](const std::string& note) { return note.find(words) != std::string::npos; };
}

TEST(SelectiveDynamics, AreKeptOrSaidToBeLost) {
  const std::string text =
      "title\n1\n3 0 0\n0 3 0\n0 0 9\nC H\n1 1\nSelective dynamics\nDirect\n"
      "0 0 0.5 T T F\n0.5 0.5 0.5 F F F\n";
  const Structure structure = file_of("POSCAR", text).structure;
  const TemporaryFolder folder;
  for (const char* name : {"b.poscar", "b.pwi", "b.extxyz"}) {
    EXPECT_TRUE(write_structure(folder.path() / name, structure).empty()) << name;
    const Structure back = shell::read_structure(folder.path() / name).structure;
    const auto* flags = find_column<std::array<int, 3>>(back, selective_dynamics);
    ASSERT_NE(flags, nullptr) << name;
    EXPECT_EQ(*flags, (std::vector<std::array<int, 3>>{{1, 1, 0}, {0, 0, 0}})) << name;
  }
  const auto notes = write_structure(folder.path() / "b.inp", structure);
  EXPECT_EQ(std::ranges::count_if(notes, mentions("selective dynamics")), 1);
  const std::string constraint = "&CONSTRAINT\n &FIXED_ATOMS\n  LIST 1\n";
  EXPECT_EQ(file_of("a.inp", constraint + "&COORD\n C 2 0 0\n").notes.size(), 1u);
}

TEST(Mmcif, SaysThatASpaceGroupIsNotApplied) {
  const std::string atom_sites =
      "loop_\n_atom_site.type_symbol\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n"
      "_atom_site.Cartn_z\nC 0 0 0\n";
  const std::string name = "data_x\n_symmetry.space_group_name_H-M ";
  const auto about = mentions("space group 'P 21'");
  EXPECT_EQ(std::ranges::count_if(file_of("a.mmcif", name + "'P 21'\n" + atom_sites).notes, about),
            1);
  EXPECT_EQ(file_of("a.mmcif", name + "'P 1'\n" + atom_sites).notes.size(), 0u);
}

TEST(Pdb, SaysThatItAppliesNoSpaceGroup) {
  const std::string cell =
      "CRYST1    9.000    9.000    9.000  90.00  90.00  90.00 P 21/c        4\n";
  const std::string atom = "HETATM    1  C   UNL A   1       1.000   2.000   3.000  1.00  0.00\n";
  const StructureFile file = file_of("a.pdb", cell + atom);
  ASSERT_EQ(file.notes.size(), 1u);
  EXPECT_NE(file.notes[0].find("P 21/c"), std::string::npos);
}

}  // namespace
}  // namespace trivalent::dual
