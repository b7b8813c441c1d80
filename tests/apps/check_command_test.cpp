#include "program.h"

namespace {

using testing_support::Outcome;
using testing_support::ProgramTest;

class CheckCommand : public ProgramTest {};

TEST_F(CheckCommand, CertifiesAShellAtRest) {
  succeed("build sphere -o out --atoms 300 --method paper");
  const auto result =
      succeed(
          "check out/shell.extxyz out/shell.data --surface out/surface.off --periodic none "
          "--json")
          .json();
  EXPECT_TRUE(result["sound"].get<bool>());
  ASSERT_EQ(result["files"].size(), 2u);
  const auto file = result["files"][0];
  EXPECT_EQ(file["euler_characteristic"], 2);
  EXPECT_TRUE(file["is_closed"].get<bool>());
  EXPECT_EQ(file["problems"].size(), 0u);
  EXPECT_GT(file["surface_distance"]["rms"].get<double>(), 0.0);
}

TEST_F(CheckCommand, NamesWhatIsWrong) {
  succeed("build sphere -o out --atoms 300 --method paper --no-relax");
  const Outcome raw = trivalent("check out/shell.extxyz");
  EXPECT_EQ(raw.exit_code, 1);
  EXPECT_NE(raw.out.find("not at rest"), std::string::npos) << raw.out;

  // An atom less: three neighbors with two bonds.
  succeed("build sphere -o rest --atoms 300 --method paper");
  write("vacancy.extxyz",
        shell("awk 'NR == 1 {print $1 - 1; next} NR != 7' rest/shell.extxyz").out);
  const Outcome vacancy = trivalent("check vacancy.extxyz --max-force inf");
  EXPECT_EQ(vacancy.exit_code, 1);
  EXPECT_NE(vacancy.out.find("3 atoms do not have three bonds"), std::string::npos) << vacancy.out;
  EXPECT_NE(vacancy.out.find("energies in the file"), std::string::npos) << vacancy.out;
}

TEST_F(CheckCommand, FindsWhatWasChangedInAFile) {
  succeed("build sphere -o out --atoms 300 --method paper");
  const auto expect_problem = [&](const std::string& words, const std::string& script) {
    write("changed.extxyz", shell("awk '" + script + "' out/shell.extxyz").out);
    const Outcome run = trivalent("check changed.extxyz");
    EXPECT_EQ(run.exit_code, 1) << script;
    EXPECT_NE(run.out.find(words), std::string::npos) << run.out;
  };
  expect_problem("the energy in the file", "{sub(/ energy=[-0-9.]+/, \" energy=-600\")} 1");
  // Columns: species, position, coordination, three rings, component, energy, forces, ...
  expect_problem("the energies in the file", "NR == 9 {$10 += 0.1} 1");
  expect_problem("the forces in the file", "NR == 9 {$11 += 0.1} 1");
  expect_problem("bonds of the file are not used", "NR == 9 {$NF = 1 + $NF % 300} 1");
  write("none.xyz", "0\n\n");
  expect_failure(1, "no atoms", "check none.xyz");
}

TEST_F(CheckCommand, AllowsAnEdgeIfItIsMeant) {
  succeed("build open-tube -o out --atoms 300 --method paper");
  EXPECT_EQ(trivalent("check out/shell.extxyz").exit_code, 1);
  const Outcome open = trivalent("check out/shell.extxyz --open");
  EXPECT_EQ(open.out.find("three bonds"), std::string::npos) << open.out;
}

TEST_F(CheckCommand, DoesNotCompareEnergiesOfAnotherPotential) {
  succeed("shape fullerene:N=60 c60.extxyz");
  succeed("energy c60.extxyz --potential lj -o lj.extxyz");
  const Outcome run = trivalent("check lj.extxyz --max-force inf --json");
  EXPECT_EQ(run.exit_code, 0) << run.out;
  EXPECT_NE(run.err.find("energies are of lj"), std::string::npos) << run.err;
  const auto file = run.json()["files"][0];
  EXPECT_EQ(file["potential"], "rebo");
  EXPECT_EQ(file["potential_of_file"], "lj");
}

TEST_F(CheckCommand, RefusesWhatMakesNoSense) {
  expect_failure(2, "FILE", "check");
  write("two.xyz", "2\n\nC 0 0 0\nC 1.4 0 0\n");
  expect_failure(2, "--max-force", "check two.xyz --max-force 0");
  expect_failure(2, "--lammps", "check two.xyz --ranks 2");
  expect_failure(1, "missing.xyz", "check missing.xyz");
}

#ifdef TRIVALENT_LMP
TEST_F(CheckCommand, AgreesWithLammps) {
  succeed("build capsule -o out --atoms 400 --method paper");
  for (const std::string potential : {"rebo", "airebo"}) {
    const Outcome run = trivalent(
        "check out/shell.extxyz --lammps --max-force inf --json --potential " + potential);
    const auto lammps = run.json()["files"][0]["lammps"];
    EXPECT_LT(lammps["energy_difference"].get<double>(), 1e-8);
    EXPECT_LT(lammps["force_difference"].get<double>(), 1e-6);
  }
}
#endif

}  // namespace
