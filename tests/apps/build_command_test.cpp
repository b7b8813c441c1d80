#include <algorithm>
#include <cmath>
#include <sstream>

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
  const Outcome run = succeed("build sphere -o out --atoms 1000 --effort quick --json");
  for (const std::string name :
       {"surface.off", "shell.extxyz", "shell.data", "in.check", "energy.ply", "report.json"}) {
    EXPECT_TRUE(has("out/" + name)) << name;
  }
  const auto result = report("out");
  EXPECT_EQ(run.json(), result);
  EXPECT_NEAR(result["network"]["atoms"].get<double>(), 1000.0, 30.0);
  EXPECT_NEAR(result["network"]["bond_length"]["mean"].get<double>(), 1.42, 0.03);
  EXPECT_TRUE(result["network"]["is_trivalent"].get<bool>());
  EXPECT_EQ(result["network"]["ring_excess"], 12);
  EXPECT_EQ(result["quality"]["self_intersections"], 0);
  EXPECT_EQ(result["quality"]["self_intersections_are_all"], true);
  EXPECT_EQ(result["options"]["atoms"], 1000);
  EXPECT_EQ(result["input"], "sphere");
}

/// The values of Schwarz' P on 24 points of each axis, as a Gaussian cube file in Å.
std::string schwarz_p_cube() {
  constexpr int n = 24;
  const double step = 2.0 * 3.14159265358979 / n;
  std::ostringstream text;
  text << "P\nsurface\n0 0 0 0\n"
       << -n << ' ' << step << " 0 0\n"
       << -n << " 0 " << step << " 0\n"
       << -n << " 0 0 " << step << '\n';
  for (int i = 0; i < n * n * n; ++i) {
    text << std::cos(i / (n * n) * step) + std::cos(i / n % n * step) + std::cos(i % n * step)
         << '\n';
  }
  return text.str();
}

TEST_F(BuildCommand, TakesVolumes) {
  write("p.cube", schwarz_p_cube());
  succeed("build p.cube --periodic xyz --atoms 432 --effort quick -o out");
  EXPECT_EQ(report("out")["network"]["ring_excess"], -24);
  EXPECT_EQ(report("out")["cell"]["periodic"], (std::vector<bool>{true, true, true}));
  expect_failure(1, "axis is periodic", "build p.cube -o free");
  expect_failure(1, "between them", "build p.cube --periodic xyz --level 7 -o none");
  expect_failure(2, "has a cell of its own", "build p.cube --cell 5 -o other");
  expect_failure(2, "neither a volume",
                 "build " TRIVALENT_MESHES "/elephant.off --periodic xyz -o mesh");
  expect_failure(2, "--level belongs to", "build sphere --level 1 -o sphere");
  expect_failure(2, "layout", "build p.cube --raw 4,4,uint8 -o raw");
  expect_failure(2, "neither a volume", "build sphere --periodic z -o sphere");
  expect_failure(2, "no volume", "build sphere --raw 4,4,4,uint8 -o sphere");
}

TEST_F(BuildCommand, LowersTheEnergyOfARealMesh) {
  succeed("build " TRIVALENT_MESHES "/elephant.off -o out --atoms 20000 --effort quick");
  const auto energy = report("out")["energy"];
  EXPECT_LT(energy["after"]["energy_per_atom"], energy["before"]["energy_per_atom"]);
}

TEST_F(BuildCommand, RelaxesTheShellUnlessToldNotTo) {
  succeed("build sphere -o out --atoms 500 --effort quick");
  const auto energy = report("out")["energy"];
  EXPECT_LT(energy["after"]["energy"], energy["unrelaxed"]["energy"]);
  EXPECT_TRUE(report("out")["relaxation"]["converged"].get<bool>());
  EXPECT_NE(content("out/shell.extxyz").find("displacement:R:3"), std::string::npos);

  succeed("build sphere -o raw --atoms 500 --effort quick --no-relax");
  EXPECT_FALSE(report("raw").contains("relaxation"));
  EXPECT_EQ(report("raw")["energy"]["after"], energy["unrelaxed"]);
  EXPECT_NEAR(report("raw")["network"]["bond_length"]["mean"].get<double>(), 1.42, 1e-9);
}

TEST_F(BuildCommand, MakesTheSameOnAnyNumberOfThreads) {
  // The report tells the threads and the seconds, and so does its page.
  const auto build_on = [this](const std::string& threads, const std::string& options) {
    succeed("build torus -o " + threads + " --atoms 2000 --threads " + threads + options);
    auto result = report(threads);
    for (const char* of_the_run : {"options", "seconds"}) result.erase(of_the_run);
    return result;
  };
  for (const std::string options : {" --effort quick", " --method paper"}) {
    const auto one = build_on("1", options);
    for (const std::string threads : {"2", "7"}) {
      EXPECT_EQ(build_on(threads, options), one) << threads << options;
      EXPECT_EQ(shell("diff -r -x report.json -x report.html 1 " + threads).out, "");
    }
    ASSERT_EQ(shell("rm -r 1 2 7").exit_code, 0);
  }
}

TEST_F(BuildCommand, MakesSeveralWalls) {
  succeed("build sphere -o out --walls 3 --atoms 900 --effort quick --atom-style molecular");
  const auto result = report("out");
  EXPECT_NEAR(result["network"]["atoms"].get<double>(), 900.0, 30.0);
  EXPECT_EQ(result["energy"]["potential"], "airebo");
  EXPECT_EQ(result["quality"]["components"], 3);
  ASSERT_EQ(result["walls"]["walls"].size(), 3U);
  EXPECT_LT(result["walls"]["energy"], -10.0);
  EXPECT_NE(content("out/shell.extxyz").find(":wall:I:1"), std::string::npos);
  EXPECT_NE(content("out/in.check").find("airebo 3.0 1 1"), std::string::npos);
  EXPECT_NE(content("out/report.html").find("\"wall\""), std::string::npos);
  EXPECT_NE(content("out/shell.extxyz").find(" potential=\"airebo\""), std::string::npos);
  const auto check = succeed("check out/shell.extxyz --json").json();
  EXPECT_EQ(check["files"][0]["potential"], "airebo");
  EXPECT_EQ(check["files"][0]["walls"]["count"], 3);
  EXPECT_EQ(check["sound"], true);
}

TEST_F(BuildCommand, SaysWhyWallsDoNotFit) {
  expect_failure(1, "fit", "build sphere -o out --walls 5 --inwards --atoms 200 --effort quick");
  EXPECT_FALSE(has("out"));
  for (const std::string options : {"--inwards --outwards", "--walls 0", "--walls 3 --spacing -1",
                                    "--potential lj", "--follow -0.1", "--follow often"}) {
    EXPECT_NE(trivalent("build sphere -o out --atoms 200 --effort quick " + options).exit_code, 0)
        << options;
    EXPECT_FALSE(has("out")) << options;
  }
}

TEST_F(BuildCommand, RelaxesCappedEdgesToo) {
  succeed("build wavy-sheet -o out --atoms 300 --cap hydrogen");
  EXPECT_TRUE(report("out")["relaxation"]["converged"].get<bool>());
  EXPECT_TRUE(report("out")["relaxation"]["bonds_broken"].empty());
}

TEST_F(BuildCommand, SaysHowToMendAShellThatCrossesItself) {
  const auto notes = [this](const std::string& arguments) {
    succeed("build " TRIVALENT_MESHES "/" + arguments + " -o out --method paper --no-relax");
    return report("out")["notes"].dump();
  };
  EXPECT_NE(notes("turbine.off --atoms 500").find("--feature-angle"), std::string::npos);
  EXPECT_NE(notes("mask_cone.off --atoms 2000").find("--repair wrap"), std::string::npos);
}

TEST_F(BuildCommand, SaysWhereTheShellIsNotWhatWasAskedFor) {
  const auto notes = [this](const std::string& arguments) {
    succeed("build " + arguments + " -o out --method paper --no-relax");
    return report("out")["notes"].dump();
  };
  // The net shrinks along a needle thinner than its edges.
  const std::string lost = notes("capsule:radius=0.1,length=6 --atoms 160");
  EXPECT_NE(lost.find("not the 160 asked for"), std::string::npos);
  EXPECT_NE(lost.find("left out"), std::string::npos);
  const std::string met = notes("sphere --atoms 500");
  EXPECT_EQ(met.find("asked for"), std::string::npos);
  EXPECT_EQ(met.find("left out"), std::string::npos);
}

TEST_F(BuildCommand, RefusesAShellWithAtomsOnTopOfEachOther) {
  const std::string octahedron =
      "v 1 0 0\nv 0 1 0\nv 0 0 1\nv -1 0 0\nv 0 -1 0\nv 0 0 -1\n"
      "f -6 -5 -4\nf -5 -3 -4\nf -3 -2 -4\nf -2 -6 -4\n"
      "f -5 -6 -1\nf -3 -5 -1\nf -2 -3 -1\nf -6 -2 -1\n";
  write("twice.obj", octahedron + octahedron);
  expect_failure(1, "--repair wrap",
                 "build twice.obj -o out --atoms 100 --repair none --method paper --iterations 1");
  EXPECT_FALSE(has("out"));
}

TEST_F(BuildCommand, MeetsALengthOrAScale) {
  succeed("build torus:R=3,r=1.2 -o a --length 40 --effort quick");
  succeed("build torus:R=3,r=1.2 -o b --scale 5 --bond 1.45 --effort quick");
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

TEST_F(BuildCommand, CapsOpenEdgesWithHydrogen) {
  succeed("build open-tube -o out --atoms 600 --method paper --cap hydrogen");
  const auto result = report("out");
  const int hydrogens = result["hydrogens"];
  EXPECT_GT(hydrogens, 0);
  const std::string frame = content("out/shell.extxyz");
  EXPECT_EQ(std::count(frame.begin(), frame.end(), '\n'),
            2 + result["network"]["atoms"].get<int>() + hydrogens);
  EXPECT_NE(content("out/shell.data").find("2 atom types"), std::string::npos);
  succeed("build sphere -o closed --atoms 300 --method paper --cap hydrogen");
  EXPECT_EQ(report("closed")["hydrogens"], 0);
}

TEST_F(BuildCommand, MendsWhatItReadsAndSaysSo) {
  // A torus of faces without common points, some turned over.
  succeed("shape torus a.stl --edge 0.3");
  succeed("build a.stl -o out --atoms 500 --method paper");
  EXPECT_TRUE(report("out")["network"]["is_trivalent"].get<bool>());
  write("turned.off",
        "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 2 3\n");
  const Outcome run = succeed("build turned.off -o turned --atoms 300 --method paper");
  EXPECT_NE(run.err.find("turned 1 disagreeing face"), std::string::npos) << run.err;
  EXPECT_EQ(report("turned")["notes"][0], "turned 1 disagreeing face");
  expect_failure(1, "faces 0 and 3", "build turned.off -o none --repair none");
}

TEST_F(BuildCommand, WrapsPointsAndReportsTheOffset) {
  succeed("shape sphere a.off --edge 0.1");
  write("points.xyz", shell("awk 'NF == 3 && NR > 2' a.off").out);
  expect_failure(1, "wrap", "build points.xyz -o none");
  succeed(
      "build points.xyz -o out --atoms 500 --method paper --repair wrap --wrap-alpha 0.4 "
      "--wrap-offset 0.05");
  const auto result = report("out");
  EXPECT_NEAR(result["wrap_offset"].get<double>(), 0.05 * result["scale"].get<double>(), 1e-9);
  EXPECT_TRUE(result["network"]["is_trivalent"].get<bool>());
  EXPECT_EQ(result["network"]["ring_excess"], 12);
}

TEST_F(BuildCommand, WrapsAnOpenSurfaceSoThatItsSidesDoNotCross) {
  const std::string build = "build " TRIVALENT_MESHES
                            "/blob.off -o out --atoms 600 --method paper --no-relax --repair wrap";
  succeed(build);
  const auto result = report("out");
  EXPECT_EQ(result["quality"]["self_intersections"], 0);
  EXPECT_EQ(result["quality"]["boundary_loops"], 0);
  EXPECT_NE(result["notes"].dump().find("one edge"), std::string::npos);
}

TEST_F(BuildCommand, KeepsSeveralComponentsWithTheirIds) {
  write("two.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
        "v 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf -4 -2 -3\nf -4 -3 -1\nf -3 -2 -1\nf -4 -1 -2\n");
  succeed("build two.obj -o out --atoms 400 --method paper");
  const auto result = report("out");
  ASSERT_EQ(result["components"].size(), 2u);
  EXPECT_EQ(result["components"][0]["euler_characteristic"], 2);
  EXPECT_EQ(result["network"]["ring_excess"], 24);
  EXPECT_NE(content("out/shell.extxyz").find("component:I:1"), std::string::npos);
  succeed("build two.obj -o one --atoms 400 --method paper --components largest");
  EXPECT_EQ(report("one")["components"].size(), 1u);
}

TEST_F(BuildCommand, ForetellsWhatItWouldDo) {
  const Outcome run = succeed("build torus:R=3,r=1 --dry-run --atoms 50000 --json");
  EXPECT_EQ(run.json()["atoms"], 50000);
  EXPECT_TRUE(run.json()["obstacles"].empty());
  EXPECT_GT(run.json()["memory_bytes"], 0.0);
  EXPECT_EQ(shell("ls -A").out, "");
}

TEST_F(BuildCommand, RefusesAtOnceWhatCannotFit) {
  expect_failure(1, "atoms would be needed", "build sphere -o out --atoms 2000000000");
  expect_failure(1, "atoms would be needed", "build torus -o out --scale 1e9");
  const Outcome run =
      shell("ulimit -v 800000; " TRIVALENT_PROGRAM " build sphere -o out --atoms 10000000");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("memory"), std::string::npos) << run.err;
  // A tetrahedron beside one a hundred times as large.
  write("two.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
        "v 500 0 0\nv 600 0 0\nv 500 100 0\nv 500 0 100\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 5 8 7\n");
  expect_failure(1, "1 of the 2 components", "build two.obj -o out --atoms 400");
  expect_failure(1, "too small", "build " TRIVALENT_MESHES "/cube.off -o out --length 2");
  EXPECT_FALSE(has("out"));
}

TEST_F(BuildCommand, RefusesWhatMakesNoSense) {
  expect_failure(2, "--cap", "build sphere -o out --cap helium");
  expect_failure(2, "--repair", "build sphere -o out --repair magic");
  expect_failure(2, "-o", "build sphere");
  expect_failure(2, "--atoms and --length", "build sphere -o out --atoms 100 --length 20");
  expect_failure(2, "20 atoms", "build sphere -o out --atoms 3");
  expect_failure(2, "bond", "build sphere -o out --bond -1");
  expect_failure(2, "longest side", "build sphere -o out --length 0");
  expect_failure(2, "rings", "build sphere -o out --method paper --rings 0");
  expect_failure(1, "missing.off", "build missing.off -o out");
  expect_failure(1, "not a folder", "build sphere -o /dev/null/out");
  EXPECT_FALSE(has("out"));
}

TEST_F(BuildCommand, LeavesNoPartsOnAFullDisk) {
  std::filesystem::create_directories(folder() / "out");
  std::filesystem::create_symlink("/dev/full", folder() / "out/shell.extxyz");
  expect_failure(1, "shell.extxyz", "build sphere -o out --atoms 500 --effort quick --quiet");
  EXPECT_FALSE(has("out/report.json"));
}

#ifdef TRIVALENT_LMP
TEST_F(BuildCommand, WritesFilesThatLammpsRunsAtFirstTry) {
  for (const std::string style : {"atomic", "molecular"}) {
    succeed("build capsule -o " + style + " --atoms 800 --effort quick --atom-style " + style);
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
  succeed("build sphere -o out --atoms 300 --effort quick");
  ASSERT_EQ(shell("sed -i 's/^20 1 .*/20 1 0.0 0.0 0.0/' out/shell.data").exit_code, 0);
  EXPECT_EQ(shell("cd out && " TRIVALENT_LMP " -in in.check").exit_code, 1);
}
#endif

#ifdef TRIVALENT_ASE
TEST_F(BuildCommand, WritesFilesThatAseReadsBack) {
  succeed("build torus:R=3,r=1 -o out --atoms 600 --effort quick");
  const Outcome run = shell(TRIVALENT_ASE " out");
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
}
#endif

}  // namespace
