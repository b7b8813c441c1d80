#include "program.h"

namespace {

using testing_support::Outcome;
using testing_support::ProgramTest;

class InspectCommand : public ProgramTest {};

TEST_F(InspectCommand, MeasuresARealMesh) {
  const auto result = succeed("inspect " TRIVALENT_MESHES "/bunny00.off --edge 0.01 --json").json();
  EXPECT_EQ(result["quality"]["vertices"], 37706);
  EXPECT_EQ(result["quality"]["faces"], 75408);
  EXPECT_EQ(result["quality"]["euler_characteristic"], 2);
  EXPECT_GT(result["mean_over_target"].get<double>(), 0.0);
}

TEST_F(InspectCommand, MeasuresDistances) {
  succeed("shape sphere fine.off --edge 0.05");
  succeed("shape sphere coarse.off --edge 0.3");
  const auto result = succeed("inspect coarse.off --against fine.off --json").json();
  // Sagitta of a triangle with edge 0.3 on the unit sphere: circumradius² / 2.
  EXPECT_NEAR(result["distance"]["max"].get<double>(), 0.3 * 0.3 / 3.0 / 2.0, 0.005);
}

TEST_F(InspectCommand, EscapesFileNamesInJson) {
  const std::string name = "a\"b\\c\xff.off";
  succeed("shape sphere s.off --edge 0.5");
  std::filesystem::rename(folder() / "s.off", folder() / name);
  const auto result = succeed("inspect '" + name + "' --json").json();
  EXPECT_EQ(result["file"].get<std::string>().substr(0, 5), "a\"b\\c");
}

/// The problem of a kind in a report.
nlohmann::json problem(const nlohmann::json& report, const std::string& name) {
  for (const auto& each : report["problems"]) {
    if (each["problem"] == name) return each;
  }
  return {};
}

const std::string tetrahedron_points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::string tetrahedron =
    "OFF\n4 4 0\n" + tetrahedron_points + "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

TEST_F(InspectCommand, TellsSoundFromMendableFromHopeless) {
  write("sound.off", tetrahedron);
  const Outcome sound = trivalent("inspect sound.off --json --atoms 20");
  EXPECT_EQ(sound.exit_code, 0);
  EXPECT_EQ(sound.json()["verdict"], "sound");
  EXPECT_TRUE(sound.json()["problems"].empty());
  EXPECT_EQ(sound.json()["build"]["atoms"], 20);
  // One face turned over.
  write("turned.off", "OFF\n4 4 0\n" + tetrahedron_points + "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 2 3\n");
  const Outcome turned = trivalent("inspect turned.off --json");
  EXPECT_EQ(turned.exit_code, 1);
  EXPECT_EQ(turned.json()["verdict"], "mendable");
  EXPECT_EQ(turned.json()["repair"][0], "turned 1 disagreeing face");
  const auto edges = problem(turned.json(), "misoriented edge");
  EXPECT_EQ(edges["count"], 3);
  EXPECT_EQ(edges["first"][0]["elements"], (std::vector{0, 2}));
  EXPECT_EQ(edges["first"][2]["position"], (std::vector{0.0, 1.0, 0.0}));
  write("point.off", "OFF\n1 0 0\n7 7 7\n");
  const Outcome point = trivalent("inspect point.off --json");
  EXPECT_EQ(point.exit_code, 3);
  EXPECT_EQ(point.json()["verdict"], "hopeless");
}

TEST_F(InspectCommand, FindsWhereASurfaceCrossesItself) {
  // A triangle through a tetrahedron.
  write("a.off", "OFF\n7 5 0\n" + tetrahedron_points + "-1 .2 .2\n2 .2 .2\n.2 .2 2\n" +
                     "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n3 4 5 6\n");
  const Outcome run = trivalent("inspect a.off --json");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.json()["reason"].get<std::string>().find("wrap"), std::string::npos);
  const auto pairs = problem(run.json(), "pair of crossing faces");
  EXPECT_GE(pairs["count"], 2);
  EXPECT_EQ(pairs["first"][0]["elements"][1], 4);
}

TEST_F(InspectCommand, NamesPointsFarOff) {
  succeed("shape sphere s.off --edge 0.3");
  write("far.off", shell("awk 'NR == 10 { $3 = 1e11 } { print }' s.off").out);
  const Outcome inspected = trivalent("inspect far.off --json --atoms 500");
  EXPECT_EQ(inspected.exit_code, 1);
  const auto far = problem(inspected.json(), "point far off");
  EXPECT_EQ(far["count"], 1);
  EXPECT_EQ(far["first"][0]["elements"], std::vector{7});
  EXPECT_NE(inspected.json()["build"]["obstacles"].dump().find("too narrow"), std::string::npos);
  expect_failure(1, "remove points that lie far off", "build far.off -o out --atoms 500");
}

TEST_F(InspectCommand, TakesPoints) {
  write("a.xyz", tetrahedron_points);
  const Outcome run = trivalent("inspect a.xyz --json");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.json()["reason"].get<std::string>().find("wrap"), std::string::npos);
  EXPECT_EQ(run.json()["points"], 4);
  EXPECT_EQ(trivalent("inspect a.xyz --repair wrap").exit_code, 1);
}

#ifdef TRIVALENT_VTK_WRITER
TEST_F(InspectCommand, ReadsWhatVtkWrites) {
  succeed("shape torus t.ply --edge 0.3");
  auto expected = succeed("inspect t.ply --json").json();
  ASSERT_EQ(shell("mkdir vtp && " TRIVALENT_VTK_WRITER " t.ply vtp").exit_code, 0);
  int files = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder() / "vtp")) {
    const std::string name = "vtp/" + file.path().filename().string();
    auto found = succeed("inspect " + name + " --json").json();
    for (const char* part : {"points", "faces", "components", "boundary", "problems"}) {
      EXPECT_EQ(found[part], expected[part]) << name << ' ' << part;
    }
    // VTK keeps 32 bits of every coordinate.
    EXPECT_NEAR(found["parts"][0]["volume"].get<double>(),
                expected["parts"][0]["volume"].get<double>(), 1e-5)
        << name;
    ++files;
  }
  EXPECT_EQ(files, 96 + 12 + 4);
}
#endif

TEST_F(InspectCommand, ReadsStandardInput) {
  write("a.off", tetrahedron);
  const Outcome run = shell("(cat a.off | " TRIVALENT_PROGRAM " inspect - --atoms 20)");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("sound"), std::string::npos);
}

TEST_F(InspectCommand, TellsNestedShellsApart) {
  succeed("shape sphere in.off --edge 0.3");
  succeed("shape sphere:radius=3 out.off --edge 0.9");
  // Two files in one, by OBJ's relative indices.
  succeed("remesh in.off in.obj --edge 0.3 --iterations 1 --method paper");
  succeed("remesh out.off out.obj --edge 0.9 --iterations 1 --method paper");
  const auto counted = succeed("inspect in.obj --json").json();
  const int first = counted["points"];
  const Outcome joined =
      shell("(cat in.obj; awk -v n=" + std::to_string(first) +
            " '/^f/ {print \"f\", $2 + n, $3 + n, $4 + n; next} {print}' out.obj)");
  write("onion.obj", joined.out);
  const auto parts = succeed("inspect onion.obj --json").json()["parts"];
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0]["inside_of"], 1);
  EXPECT_TRUE(parts[1]["inside_of"].is_null());
}

TEST_F(InspectCommand, CallsWhatIsNoMeshHopeless) {
  const auto expect_hopeless = [&](const std::string& file, const std::string& part) {
    const Outcome run = trivalent("inspect " + file + " --json");
    EXPECT_EQ(run.exit_code, 3) << file;
    const std::string reason = run.json()["reason"];
    EXPECT_NE(reason.find(part), std::string::npos) << reason;
  };
  expect_hopeless("missing.off", "missing.off");
  write("text.off", "hello\n");
  expect_hopeless("text.off", "text.off: line 1");
  write("a.unknown", "PK\n");
  expect_hopeless("a.unknown", "unknown");
  write("nan.off", "OFF\n3 1 0\n0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n");
  expect_hopeless("nan.off", "line 3");
  write("bomb.off", "OFF\n2000000000 2000000000 0\n");
  expect_hopeless("bomb.off", "declares 2000000000 vertices");
}

TEST_F(InspectCommand, RefusesWhatMakesNoSense) {
  expect_failure(2, "--edge", "inspect " TRIVALENT_MESHES "/cube.off --edge 0");
  expect_failure(2, "--repair", "inspect " TRIVALENT_MESHES "/cube.off --repair magic");
  expect_failure(2, "--holes", "inspect " TRIVALENT_MESHES "/cube.off --holes dig");
  expect_failure(2, "--components", "inspect " TRIVALENT_MESHES "/cube.off --components 2");
}

}  // namespace
