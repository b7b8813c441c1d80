#include <cmath>

#include "program.h"

namespace {

using testing_support::ProgramTest;

class RelaxCommand : public ProgramTest {};

TEST_F(RelaxCommand, BringsTheDualOfAMeshToRest) {
  succeed("shape sphere s.off --edge 0.3");
  const double before = succeed("energy s.off --json").json()["energy"];
  const auto result = succeed("relax s.off -o out.extxyz --json").json();
  EXPECT_LT(result["energy"].get<double>(), before);
  EXPECT_TRUE(result["relaxation"]["converged"].get<bool>());
  EXPECT_LE(result["relaxation"]["largest_force"].get<double>(), 1e-3);
  EXPECT_TRUE(result["relaxation"]["bonds_broken"].empty());
  EXPECT_NE(content("out.extxyz").find("energies:R:1:forces:R:3:displacement:R:3"),
            std::string::npos);
  // What was written has the energy that was reported, to the digits of the file.
  const double written = succeed("energy out.extxyz --json").json()["energy"];
  EXPECT_NEAR(written, result["energy"].get<double>(), 1e-6);
}

TEST_F(RelaxCommand, FindsGrapheneWithAFreeCell) {
  const double bond = 1.45;
  const double a = std::sqrt(3.0) * bond;
  write("g.extxyz", "2\nLattice=\"" + std::to_string(a) + " 0 0 " + std::to_string(a / 2) + " " +
                        std::to_string(1.5 * bond) +
                        " 0 0 0 20\" Properties=species:S:1:pos:R:3 pbc=\"T T F\"\nC 0 0 0\nC 0 " +
                        std::to_string(bond) + " 0\n");
  const auto result =
      succeed("relax g.extxyz -o out.extxyz --relax-box --max-force 1e-5 --json").json();
  EXPECT_NEAR(result["energy_per_atom"].get<double>(), -7.394997, 1e-6);
}

TEST_F(RelaxCommand, SaysWhenItDidNotConverge) {
  succeed("shape sphere s.off --edge 0.3");
  const auto run = succeed("relax s.off -o out.extxyz --max-steps 3 --json");
  EXPECT_FALSE(run.json()["relaxation"]["converged"].get<bool>());
  EXPECT_NE(run.err.find("did not converge"), std::string::npos);
}

TEST_F(RelaxCommand, GoesOnAfterBeingKilled) {
  succeed("shape sphere s.off --edge 0.13");
  const std::string command = "relax s.off --checkpoint-every 10 --every 3 --digits 17 ";
  succeed(command + "-o whole.extxyz --trajectory whole.traj.extxyz");
  for (int moment = 1; moment <= 12; ++moment) {
    const std::string seconds = "0.0" + std::to_string(10 + 7 * moment);
    const auto run = shell("timeout -s KILL " + seconds + " " TRIVALENT_PROGRAM " " + command +
                           "-o killed.extxyz --trajectory killed.traj.extxyz");
    if (has("killed.extxyz")) {
      EXPECT_EQ(content("killed.extxyz"), content("whole.extxyz"));
    }
    if (run.exit_code == 0) break;
  }
  succeed(command + "-o killed.extxyz --trajectory killed.traj.extxyz");
  EXPECT_EQ(content("killed.extxyz"), content("whole.extxyz"));
  EXPECT_EQ(content("killed.traj.extxyz"), content("whole.traj.extxyz"));
  EXPECT_FALSE(has("killed.extxyz.checkpoint"));
  EXPECT_FALSE(has("killed.traj.extxyz.part"));
}

TEST_F(RelaxCommand, TakesNoCheckpointOfAnotherRelaxation) {
  succeed("shape sphere s.off --edge 0.3");
  succeed("relax s.off -o a.extxyz");
  write("b.extxyz.checkpoint", "1\nfingerprint=x1 Properties=species:S:1:pos:R:3\nC 0 0 0\n");
  succeed("relax s.off -o b.extxyz");
  EXPECT_EQ(content("a.extxyz"), content("b.extxyz"));
}

TEST_F(RelaxCommand, KeepsFixedAtoms) {
  succeed("shape sphere s.off --edge 0.3");
  succeed("dual s.off s.extxyz");
  succeed("relax s.off -o out.extxyz --fix ids:1-2,5 --fix sphere:0,0,1000,1");
  const auto line = [&](const std::string& name, int atom) {
    std::istringstream in(content(name));
    std::string text;
    for (int k = 0; k < atom + 2; ++k) std::getline(in, text);
    return text.substr(0, text.find(" 3 "));  // species and position
  };
  for (const int id : {1, 2, 5}) EXPECT_EQ(line("out.extxyz", id), line("s.extxyz", id));
  EXPECT_NE(line("out.extxyz", 3), line("s.extxyz", 3));
}

TEST_F(RelaxCommand, RefusesWhatMakesNoSense) {
  succeed("shape sphere s.off --edge 0.3");
  expect_failure(2, "-o", "relax s.off");
  expect_failure(2, "extension", "relax s.off -o out.txt");
  expect_failure(2, "--minimizer", "relax s.off -o out.extxyz --minimizer newton");
  expect_failure(2, "max_force", "relax s.off -o out.extxyz --max-force 0");
  expect_failure(2, "--fix", "relax s.off -o out.extxyz --fix ids:0");
  expect_failure(2, "--fix", "relax s.off -o out.extxyz --fix corner");
  expect_failure(2, "--every", "relax s.off -o out.extxyz --every 0");
  EXPECT_FALSE(has("out.extxyz"));
}

}  // namespace
