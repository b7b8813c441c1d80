#include "program.h"

namespace {

using testing_support::Outcome;
using testing_support::ProgramTest;

class ConvertCommand : public ProgramTest {
 protected:
  void SetUp() override {
    write("ring.xyz", "3\n\nC 0 0 0\nC 1.42 0 0\nH 2.5 0 0\n");
    write("cell.extxyz",
          "2\nLattice=\"2.46 0 0 -1.23 2.13 0 0 0 8\" Properties=species:S:1:pos:R:3\n"
          "C 0 0 4\nC 0 1.42 4\n");
  }
};

TEST_F(ConvertCommand, WritesTheFormatOfTheName) {
  succeed("convert ring.xyz CONTCAR");
  EXPECT_NE(content("CONTCAR").find("Direct"), std::string::npos);
  succeed("convert CONTCAR back.gen");
  EXPECT_EQ(content("back.gen").substr(0, 4), "3 S\n");
  succeed("convert ring.xyz ring.pdb.gz");
  EXPECT_EQ(succeed("convert ring.pdb.gz again.xyz --json").json()["atoms"], 3);
}

TEST_F(ConvertCommand, GuessesBondsWhereAsked) {
  EXPECT_EQ(succeed("convert ring.xyz a.mol2 --json").json()["bonds"], 0);
  const Outcome run = succeed("convert ring.xyz b.mol2 --guess-bonds --json");
  EXPECT_EQ(run.json()["bonds"], 2);
  EXPECT_NE(run.err.find("distance"), std::string::npos) << run.err;
  EXPECT_EQ(succeed("convert b.mol2 c.pdb --json").json()["bonds"], 2);
}

TEST_F(ConvertCommand, SaysWhatChanges) {
  EXPECT_NE(succeed("convert ring.xyz ring.cif").err.find("no free atoms"), std::string::npos);
  EXPECT_NE(succeed("convert cell.extxyz cell.pdb").err.find("3 decimals"), std::string::npos);
}

TEST_F(ConvertCommand, MakesRoomWhereAFreeDirectionHasNoVector) {
  write("sheet.extxyz",
        "2\nLattice=\"2.46 0 0 -1.23 2.13 0 0 0 0\" pbc=\"T T F\" Properties=species:S:1:pos:R:3\n"
        "C 0 0 4\nC 0 1.42 4\n");
  const double energy = succeed("energy sheet.extxyz --json").json()["energy"];
  for (const std::string name : {"s.poscar", "s.cif", "s.gen", "s.pwi", "s.inp"}) {
    succeed("convert sheet.extxyz " + name + " --digits 17");
    EXPECT_NEAR(succeed("energy " + name + " --json").json()["energy"], energy, 1e-9) << name;
  }
}

TEST_F(ConvertCommand, FindsTheSpaceGroup) {
  const auto result = succeed("convert cell.extxyz cell.cif --symmetry 0.02 --json").json();
  EXPECT_NE(result["notes"].back().get<std::string>().find("P 6/m m m"), std::string::npos);
  EXPECT_EQ(succeed("convert cell.cif back.extxyz --json").json()["atoms"], 2);
}

TEST_F(ConvertCommand, RefusesWhatMakesNoSense) {
  expect_failure(2, "missing OUT", "convert ring.xyz");
  expect_failure(2, "extension", "convert ring.xyz a.docx");
  expect_failure(2, ".cif", "convert ring.xyz a.pdb --symmetry 0.1");
  expect_failure(2, "> 0", "convert ring.xyz a.cif --symmetry 0");
  expect_failure(1, "none.pdb", "convert none.pdb a.cif");
  expect_failure(2, "only be written", "convert ring.top a.cif");
  EXPECT_FALSE(has("a.cif"));
}

}  // namespace
