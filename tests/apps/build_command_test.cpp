#include <cmath>

#include "program.h"

namespace {

using testing_support::Outcome;
using testing_support::ProgramTest;

class BuildCommand : public ProgramTest {
 protected:
  [[nodiscard]] nlohmann::json report(const std::string& output) const {
    return nlohmann::json::parse(content(output + "/report.json"));
  }
};

TEST_F(BuildCommand, GoesTheWholeWay) {
  const Outcome run = succeed("build sphere -o out --atoms 1000 --json");
  for (const std::string name :
       {"surface.off", "shell.extxyz", "shell.data", "in.check", "energy.ply", "report.json"}) {
    EXPECT_TRUE(has("out/" + name)) << name;
  }
  const auto result = report("out");
  EXPECT_EQ(run.json(), result);
  EXPECT_NEAR(result["network"]["atoms"].get<double>(), 1000.0, 30.0);
  EXPECT_NEAR(result["network"]["bond_length"]["mean"].get<double>(), 1.42, 1e-9);
  EXPECT_TRUE(result["network"]["is_trivalent"].get<bool>());
  EXPECT_EQ(result["network"]["ring_excess"], 12);
  EXPECT_EQ(result["quality"]["self_intersections"], 0);
  EXPECT_EQ(result["options"]["atoms"], 1000);
  EXPECT_EQ(result["input"], "sphere");
}

TEST_F(BuildCommand, LowersTheEnergyOfARealMesh) {
  succeed("build " TRIVALENT_MESHES "/elephant.off -o out --atoms 20000");
  const auto energy = report("out")["energy"];
  EXPECT_LT(energy["after"]["energy_per_atom"], energy["before"]["energy_per_atom"]);
}

TEST_F(BuildCommand, MeetsALengthOrAScale) {
  succeed("build torus:R=3,r=1.2 -o a --length 40");
  succeed("build torus:R=3,r=1.2 -o b --scale 5 --bond 1.45");
  EXPECT_NEAR(report("a")["scale"].get<double>(), 40.0 / 8.4, 0.05);
  EXPECT_EQ(report("b")["scale"], 5.0);
  EXPECT_NEAR(report("b")["network"]["bond_length"]["mean"].get<double>(), 1.45, 0.03 * 1.45);
}

TEST_F(BuildCommand, KeepsOpenSurfacesOpen) {
  const Outcome run = succeed("build open-tube -o out --atoms 1000");
  EXPECT_NE(run.err.find("open"), std::string::npos);
  EXPECT_EQ(report("out")["quality"]["boundary_loops"], 2);
  EXPECT_GT(report("out")["network"]["coordinations"]["2"].get<int>(), 0);
}

TEST_F(BuildCommand, RefusesWhatMakesNoSense) {
  expect_failure(2, "-o", "build sphere");
  expect_failure(2, "--atoms and --length", "build sphere -o out --atoms 100 --length 20");
  expect_failure(2, "20 atoms", "build sphere -o out --atoms 3");
  expect_failure(2, "bond", "build sphere -o out --bond -1");
  expect_failure(2, "longest side", "build sphere -o out --length 0");
  expect_failure(2, "rings", "build sphere -o out --rings 0");
  expect_failure(1, "missing.off", "build missing.off -o out");
  expect_failure(1, "not a folder", "build sphere -o /dev/null/out");
  EXPECT_FALSE(has("out"));
}

TEST_F(BuildCommand, LeavesNoPartsOnAFullDisk) {
  std::filesystem::create_directories(folder() / "out");
  std::filesystem::create_symlink("/dev/full", folder() / "out/shell.extxyz");
  expect_failure(1, "shell.extxyz", "build sphere -o out --atoms 500 --quiet");
  EXPECT_FALSE(has("out/report.json"));
}

#ifdef TRIVALENT_LMP
TEST_F(BuildCommand, WritesFilesThatLammpsRunsAtFirstTry) {
  for (const std::string style : {"atomic", "molecular"}) {
    succeed("build capsule -o " + style + " --atoms 800 --atom-style " + style);
    const Outcome run = shell("cd " + style + " && " TRIVALENT_LMP " -in in.check");
    EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
    EXPECT_NE(run.out.find("\npassed\n"), std::string::npos) << run.out;
    EXPECT_EQ(run.out.find("WARNING"), std::string::npos) << run.out;

    const std::size_t start = run.out.find("\nenergy ") + 8;
    const double theirs = std::stod(run.out.substr(start));
    const double ours = report(style)["energy"]["after"]["energy"];
    const double n_atoms = report(style)["network"]["atoms"];
    EXPECT_NEAR(theirs / n_atoms, ours / n_atoms, 1e-8);
  }
}

TEST_F(BuildCommand, WritesACheckThatNoticesAnotherEnergy) {
  succeed("build sphere -o out --atoms 300");
  ASSERT_EQ(shell("sed -i 's/^20 1 .*/20 1 0.0 0.0 0.0/' out/shell.data").exit_code, 0);
  EXPECT_EQ(shell("cd out && " TRIVALENT_LMP " -in in.check").exit_code, 1);
}
#endif

#ifdef TRIVALENT_ASE
TEST_F(BuildCommand, WritesFilesThatAseReadsBack) {
  succeed("build torus:R=3,r=1 -o out --atoms 600");
  const Outcome run = shell(TRIVALENT_ASE " out");
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
}
#endif

}  // namespace
