#include <cmath>

#include "program.h"

namespace {

using testing_support::Outcome;
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

TEST_F(RelaxCommand, BringsIdealStructuresToTheirKnownEnergies) {
  const auto energy = [this](const std::string& arguments) {
    const auto result = succeed("relax " + arguments + " -o out.extxyz --json").json();
    EXPECT_TRUE(result["relaxation"]["bonds_broken"].empty());
    return result["energy_per_atom"].get<double>();
  };
  // Minima of LAMMPS under the same REBO [eV/atom].
  EXPECT_NEAR(energy("fullerene:N=60"), -6.84206, 1e-5);
  EXPECT_NEAR(energy("fullerene:N=240"), -7.20509, 1e-5);
  EXPECT_NEAR(energy("fullerene:N=540"), -7.29465, 1e-5);
  EXPECT_NEAR(energy("nanotube:n=5,m=5 --relax-box"), -7.24617, 1e-5);
  EXPECT_NEAR(energy("nanotube:n=10,m=0 --relax-box"), -7.28131, 1e-5);
  EXPECT_NEAR(energy("graphene:nx=1,ny=1 --relax-box"), -7.39500, 1e-5);
  // The shortest capsule of a (10,10) tube is C240.
  EXPECT_NEAR(energy("nanotube:n=10,m=10,caps=2"), -7.20509, 1e-5);
}

TEST_F(RelaxCommand, BindsTheWallsOfAnOnion) {
  const auto energy = [this](const std::string& arguments) {
    return succeed("relax " + arguments + " -o out.extxyz --potential airebo --json")
        .json()["energy"]
        .get<double>();
  };
  const double binding =
      energy("onion:walls=2") - energy("fullerene:N=60") - energy("fullerene:N=240");
  EXPECT_NEAR(binding, -5.225, 2e-3);  // C60@C240 by LAMMPS's AIREBO
}

// Bent benzene: springs between any atoms within 2 Å used to hold it at -51.3 eV, "at rest".
TEST_F(RelaxCommand, ClaimsTheForceThatEnergyFinds) {
  write("benzene.xyz",
        "12\n\nC 1.43 0.03 -0.06\nC 0.75 1.16 0.09\nC -0.62 1.28 0.05\nC -1.33 -0.07 0.02\n"
        "C -0.74 -1.27 -0.08\nC 0.66 -1.13 0.1\nH 2.43 0.08 0.1\nH 1.31 2.05 -0.05\n"
        "H -1.16 2.22 0.07\nH -2.55 0.05 -0.1\nH -1.29 -2.09 0.04\nH 1.17 -2.24 -0.06\n");
  const auto run = succeed("relax benzene.xyz -o out.extxyz --digits 17 --json");
  const auto result = run.json();
  EXPECT_NEAR(result["energy"].get<double>(), -59.3096, 1e-4);
  EXPECT_TRUE(result["relaxation"]["converged"].get<bool>());
  EXPECT_NE(run.err.find("12 are guessed"), std::string::npos) << run.err;
  const double found = succeed("energy out.extxyz --forces --json").json()["largest_force"];
  EXPECT_NEAR(result["relaxation"]["largest_force"].get<double>(), found, 1e-8);
}

TEST_F(RelaxCommand, SaysWhenItDidNotConverge) {
  succeed("shape sphere s.off --edge 0.3");
  const auto run = trivalent("relax s.off -o out.extxyz --max-steps 3 --json");
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_TRUE(has("out.extxyz"));
  EXPECT_FALSE(run.json()["relaxation"]["converged"].get<bool>());
  EXPECT_NE(run.err.find("did not converge"), std::string::npos);
}

TEST_F(RelaxCommand, GivesTheSameForAMeshAndItsDualInAFile) {
  succeed("shape torus s.off --edge 0.25");
  succeed("dual s.off raw.extxyz --digits 17");
  const auto mesh = succeed("relax s.off -o a.extxyz --digits 17 --json").json();
  const auto file = succeed("relax raw.extxyz -o b.extxyz --digits 17 --json").json();
  EXPECT_NEAR(mesh["energy"].get<double>(), file["energy"].get<double>(), 1e-8);
  EXPECT_EQ(mesh["relaxation"]["steps"], file["relaxation"]["steps"]);
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
  succeed("relax s.off -o out.extxyz --fix ids:1-2 --fix ids:2,5");
  const auto line = [&](const std::string& name, int atom) {
    std::istringstream in(content(name));
    std::string text;
    for (int k = 0; k < atom + 2; ++k) std::getline(in, text);
    return text.substr(0, text.find(" 3 "));  // species and position
  };
  for (const int id : {1, 2, 5}) EXPECT_EQ(line("out.extxyz", id), line("s.extxyz", id));
  EXPECT_NE(line("out.extxyz", 3), line("s.extxyz", 3));
}

TEST_F(RelaxCommand, SaysThatFixedAtomsMoveWithTheCell) {
  const Outcome run = succeed("relax graphene:nx=1,ny=1 -o a.extxyz --relax-box --fix ids:1");
  EXPECT_NE(run.err.find("move as it changes"), std::string::npos) << run.err;
}

TEST_F(RelaxCommand, ObeysSelectiveDynamics) {
  write("a.vasp",
        "acetylene\n1\n9 0 0\n0 9 0\n0 0 9\nC H\n2 2\nSelective\nCartesian\n"
        "4 4 4 T T T\n5.3 4 4 T T T\n3 4.1 4 F F F\n6.3 4 4 T F T\n");
  const Outcome run = trivalent("relax a.vasp -o b.xyz");
  EXPECT_NE(run.err.find("1 atoms stay"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("1 atoms move along all axes"), std::string::npos) << run.err;
  EXPECT_NE(content("b.xyz").find("H 3.0000000000 4.1000000000 4.0000000000"), std::string::npos)
      << content("b.xyz");
}

#ifdef TRIVALENT_LMP
TEST_F(RelaxCommand, LetsLammpsDoTheWork) {
  succeed("shape sphere s.off --edge 0.3");
  const auto ours = succeed("relax s.off -o ours.extxyz --json").json();
  const auto theirs = succeed("relax s.off -o theirs.extxyz --engine lammps --json").json();
  EXPECT_TRUE(theirs["relaxation"]["converged"].get<bool>());
  EXPECT_NEAR(theirs["energy"], ours["energy"], 1e-5 * theirs["atoms"].get<double>());
  EXPECT_NEAR(succeed("energy theirs.extxyz --json").json()["energy"], theirs["energy"], 1e-5);
  EXPECT_EQ(shell("ls -d theirs.extxyz.lammps* 2> /dev/null").out, "");
}

TEST_F(RelaxCommand, LetsLammpsFixAtomsAndRelaxTheCell) {
  succeed("shape sphere s.off --edge 0.3");
  succeed("dual s.off s.extxyz");
  succeed("relax s.extxyz -o out.extxyz --engine lammps --fix ids:1-2,5");
  const auto line = [&](const std::string& name, int atom) {
    std::istringstream in(content(name));
    std::string text;
    for (int k = 0; k < atom + 2; ++k) std::getline(in, text);
    return text.substr(0, text.find(" 3 "));
  };
  for (const int id : {1, 2, 5}) EXPECT_EQ(line("out.extxyz", id), line("s.extxyz", id));
  EXPECT_NE(line("out.extxyz", 3), line("s.extxyz", 3));

  // 6 x 6 cells, in which LAMMPS can look for neighbors.
  const double a = 2.48;
  std::ostringstream text;
  text.precision(17);
  text << "72\nLattice=\"" << 6 * a << " 0 0 " << 3 * a << ' ' << 6 * a * std::sqrt(0.75)
       << " 0 0 0 20\" Properties=species:S:1:pos:R:3 pbc=\"T T F\"\n";
  for (int k = 0; k < 36; ++k) {
    const double x = a * (k % 6 + k / 6 / 2.0);
    const double y = a * std::sqrt(0.75) * (k / 6);
    text << "C " << x << ' ' << y << " 0\nC " << x << ' ' << y + a / std::sqrt(3.0) << " 0\n";
  }
  write("g.extxyz", text.str());
  const auto result =
      succeed("relax g.extxyz -o g2.extxyz --engine lammps --relax-box --json").json();
  EXPECT_NEAR(result["energy_per_atom"].get<double>(), -7.394997, 1e-5);
}

TEST_F(RelaxCommand, TakesAnyPairStyleOfLammps) {
  write("g.extxyz",
        "4\nLattice=\"2.46 0 0 0 4.26084 0 0 0 20\" pbc=\"T T F\" Properties=species:S:1:pos:R:3\n"
        "C 0 0 10\nC 0 1.42028 10\nC 1.23 2.13042 10\nC 1.23 3.5507 10\n");
  const std::string style = " --pair-style tersoff --pair-coeff '* * BNC.tersoff C'";
  const auto relaxed = succeed(
                           "relax g.extxyz -o out.extxyz --engine lammps --relax-box "
                           "--max-force 1e-4 --json" +
                           style)
                           .json();
  EXPECT_NEAR(relaxed["energy_per_atom"].get<double>(), -7.97770, 1e-4);  // published value
  EXPECT_EQ(relaxed["potential"], "pair_style tersoff");
  EXPECT_FALSE(relaxed.contains("excess_per_atom"));
  EXPECT_NEAR(succeed("energy out.extxyz --engine lammps --json" + style).json()["energy_per_atom"],
              relaxed["energy_per_atom"].get<double>(), 1e-8);
  EXPECT_EQ(succeed("check out.extxyz --lammps --json" + style).json()["sound"], true);
  expect_failure(2, "--engine lammps", "energy g.extxyz" + style);
  expect_failure(2, "--lammps", "check g.extxyz" + style);
  expect_failure(2, "two potentials", "energy g.extxyz --engine lammps --potential airebo" + style);
  expect_failure(2, "go together", "energy g.extxyz --engine lammps --pair-style tersoff");
  expect_failure(1, "lmp -help",
                 "energy g.extxyz --engine lammps --pair-style no --pair-coeff '* *'");
  expect_failure(1, "LAMMPS_POTENTIALS",
                 "energy g.extxyz --engine lammps --pair-style tersoff --pair-coeff '* * none C'");
  EXPECT_NE(succeed("lammps g.extxyz -o package --pair-style nonsense --pair-coeff '* *'")
                .err.find("no pair_style nonsense"),
            std::string::npos);
  EXPECT_TRUE(has("package/in.md"));
}

TEST_F(RelaxCommand, TellsWhatLammpsComplainsAbout) {
  succeed("shape sphere s.off --edge 0.3");
  write("broken.rebo", "nothing\n");
  const std::string command = "relax s.off -o out.extxyz --engine lammps ";
  expect_failure(1, "LAMMPS failed", command + "--potential-file broken.rebo");
  expect_failure(2, "--minimizer", command + "--minimizer lbfgs");
  expect_failure(2, "--trajectory", command + "--trajectory t.extxyz");
  expect_failure(2, "lj", command + "--potential lj");
  expect_failure(2, "--ranks", command + "--ranks 0");
  expect_failure(2, "--ranks", "relax s.off -o out.extxyz --ranks 2");
  EXPECT_FALSE(has("out.extxyz"));
  const Outcome run = shell("PATH=/nonexistent " TRIVALENT_PROGRAM " " + command);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("apt install lammps"), std::string::npos) << run.err;
}
#endif

#ifdef TRIVALENT_MPIRUN
TEST_F(RelaxCommand, LetsLammpsWorkInSeveralProcesses) {
  succeed("shape torus s.off --edge 0.2");
  const auto one = succeed("energy s.off --engine lammps --json").json();
  const auto two = succeed("energy s.off --engine lammps --ranks 2 --json").json();
  EXPECT_NEAR(one["energy"], two["energy"], 1e-9 * std::abs(one["energy"].get<double>()));
  EXPECT_NEAR(one["energy"], succeed("energy s.off --json").json()["energy"],
              1e-9 * std::abs(one["energy"].get<double>()));
}
#endif

TEST_F(RelaxCommand, RefusesWhatMakesNoSense) {
  succeed("shape sphere s.off --edge 0.3");
  expect_failure(2, "-o", "relax s.off");
  expect_failure(2, "extension", "relax s.off -o out.txt");
  expect_failure(2, "--minimizer", "relax s.off -o out.extxyz --minimizer newton");
  expect_failure(2, "max_force", "relax s.off -o out.extxyz --max-force 0");
  expect_failure(2, "--fix", "relax s.off -o out.extxyz --fix ids:0");
  expect_failure(2, "--fix", "relax s.off -o out.extxyz --fix corner");
  expect_failure(2, "no such atom", "relax s.off -o out.extxyz --fix sphere:0,0,1000,1");
  expect_failure(2, "no such atom", "relax s.off -o out.extxyz --fix edge");
  expect_failure(2, "no periodic cell", "relax s.off -o out.extxyz --relax-box");
  expect_failure(2, "--every", "relax s.off -o out.extxyz --every 0");
  EXPECT_FALSE(has("out.extxyz"));
}

}  // namespace
