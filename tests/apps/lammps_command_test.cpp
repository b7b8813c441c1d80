#include <cmath>

#include "program.h"

namespace {

using testing_support::Outcome;
using testing_support::ProgramTest;

class LammpsCommand : public ProgramTest {};

TEST_F(LammpsCommand, WritesDecksOfAireboForWalls) {
  succeed("lammps onion:walls=2 -o out --potential airebo --atom-style molecular");
  EXPECT_NE(content("out/in.check").find("airebo 3.0 1 1"), std::string::npos);
  EXPECT_NE(content("out/README.md").find("CH.airebo"), std::string::npos);
#ifdef TRIVALENT_LMP
  EXPECT_EQ(shell("cd out && " TRIVALENT_LMP " -in in.check").exit_code, 0);
#endif
  expect_failure(2, "rebo or airebo", "lammps onion:walls=2 -o other --potential lj");
  const Outcome relaxed = succeed("relax onion:walls=2 -o relaxed.extxyz --max-steps 5000");
  EXPECT_NE(relaxed.err.find("AIREBO does"), std::string::npos);
}

TEST_F(LammpsCommand, WritesTheFilesItNames) {
  succeed("shape sphere s.off --edge 0.3");
  const auto result = succeed("lammps s.off -o out --json").json();
  EXPECT_EQ(result["files"].size(), 5u);
  for (const std::string name : result["files"]) EXPECT_TRUE(has("out/" + name)) << name;
}

TEST_F(LammpsCommand, RefusesWhatMakesNoSense) {
  write("two.xyz", "2\n\nC 0 0 0\nC 1.4 0 0\n");
  expect_failure(2, "-o", "lammps two.xyz");
  expect_failure(2, "--angles", "lammps two.xyz -o out --angles");
  expect_failure(2, "nowhere.rebo", "lammps two.xyz -o out --potential-file nowhere.rebo");
  expect_failure(2, "atoms_per_file", "lammps two.xyz -o out --atoms-per-file 0");
  expect_failure(1, "not a folder", "lammps two.xyz -o two.xyz");
  expect_failure(1, "missing.xyz", "lammps missing.xyz -o out");
}

TEST_F(LammpsCommand, FindsTheBondsThatMolecularDataNeed) {
  write("two.xyz", "2\n\nC 0 0 0\nC 1.4 0 0\n");
  const Outcome run = succeed("lammps two.xyz -o out --atom-style molecular --angles");
  EXPECT_NE(run.err.find("1 are guessed"), std::string::npos) << run.err;
  EXPECT_NE(content("out/shell.data").find("1 bonds"), std::string::npos);
  write("apart.xyz", "2\n\nC 0 0 0\nC 9 0 0\n");
  expect_failure(2, "needs bonds", "lammps apart.xyz -o nothing --atom-style molecular");
  EXPECT_FALSE(has("nothing"));
}

#ifdef TRIVALENT_LMP
// A sheet with an adsorbed hydrogen, periodic along x and y.
std::string hydrogenated_graphene() {
  const double bond = 1.42;
  const double width = std::sqrt(3.0) * bond;
  std::ostringstream text;
  text.precision(17);
  text << "25\nLattice=\"" << 3 * width << " 0 0 0 " << 6 * bond
       << " 0 0 0 30\" Properties=species:S:1:pos:R:3 pbc=\"T T F\"\n";
  for (int x = 0; x < 3; ++x) {
    for (int y = 0; y < 2; ++y) {
      const double left = x * width;
      const double low = 3 * y * bond;
      text << "C " << left << ' ' << low << " 0.02\nC " << left + width / 2 << ' ' << low + bond / 2
           << " 0\nC " << left + width / 2 << ' ' << low + 1.5 * bond << " 0\nC " << left << ' '
           << low + 2 * bond << " 0\n";
    }
  }
  text << "H 0.05 0.02 1.15\n";
  return text.str();
}

class LammpsRuns : public LammpsCommand {
 protected:
  [[nodiscard]] Outcome lmp(const std::string& arguments) const {
    return shell("cd out && timeout 120 " TRIVALENT_LMP " -log none -in " + arguments);
  }
};

TEST_F(LammpsRuns, TheCheckPassesOnEveryKindOfPackage) {
  succeed("shape sphere s.off --edge 0.3");
  write("h.extxyz", hydrogenated_graphene());
  for (const std::string arguments :
       {"s.off", "s.off --gzip", "s.off --atom-style molecular --angles",
        "s.off --atoms-per-file 50", "s.off --gzip --atoms-per-file 99", "h.extxyz",
        "h.extxyz --digits 17 --gzip"}) {
    std::filesystem::remove_all(folder() / "out");
    succeed("lammps " + arguments + " -o out");
    const Outcome run = lmp("in.check");
    EXPECT_EQ(run.exit_code, 0) << arguments << run.out;
    EXPECT_NE(run.out.find("\npassed\n"), std::string::npos) << arguments << run.out;
  }
}

TEST_F(LammpsRuns, TheCheckFailsOnOtherAtoms) {
  succeed("shape sphere s.off --edge 0.3");
  succeed("dual s.off other.data --bond 1.43");
  succeed("lammps s.off -o out");
  const Outcome run = lmp("in.check -var data ../other.data");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.out.find("FAILED"), std::string::npos);
}

#ifdef TRIVALENT_MPIRUN
TEST_F(LammpsRuns, TheCheckPassesOnTwoRanks) {
  succeed("shape sphere s.off --edge 0.3");
  succeed("lammps s.off -o out");
  const Outcome run = shell(
      "cd out && timeout 120 env OMPI_ALLOW_RUN_AS_ROOT=1 "
      "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 " TRIVALENT_MPIRUN " --oversubscribe -np 2 " TRIVALENT_LMP
      " -log none -in in.check");
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_NE(run.out.find("\npassed\n"), std::string::npos) << run.out;
}
#endif

TEST_F(LammpsRuns, RelaxesAndRunsAtConstantEnergy) {
  succeed("shape sphere s.off --edge 0.3");
  succeed("lammps s.off -o out");
  const Outcome relaxed = lmp("in.relax");
  ASSERT_EQ(relaxed.exit_code, 0) << relaxed.out;
  const Outcome run = lmp("in.md -var data relaxed.data -var warm_up 100 -var steps 100");
  ASSERT_EQ(run.exit_code, 0) << run.out;
  EXPECT_NE(run.out.find("\nneighbors of an atom: 3 to 3\n"), std::string::npos) << run.out;
  const std::string words = "\nenergy drift ";
  const double drift = std::stod(run.out.substr(run.out.find(words) + words.size()));
  // A hundred steps of few atoms: what the kinetic energy of 0.04 eV swings by, not a drift.
  EXPECT_LT(std::abs(drift), 1e-2);
  EXPECT_TRUE(has("out/md.restart"));
}
#endif

TEST_F(LammpsCommand, SaysThatScriptsHoldNoAtoms) {
  write("a.vasp",
        "acetylene\n1\n9 0 0\n0 9 0\n0 0 9\nC H\n2 2\nSelective\nCartesian\n"
        "4 4 4 T T T\n5.3 4 4 T T T\n3 4.1 4 F F F\n6.3 4 4 T T T\n");
  EXPECT_NE(succeed("lammps a.vasp -o deck").err.find("selective dynamics"), std::string::npos);
}

}  // namespace
