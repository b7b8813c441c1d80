#include "program.h"

namespace {

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

TEST_F(InspectCommand, FailsOnWhatIsNoMesh) {
  expect_failure(1, "missing.off", "inspect missing.off");
  write("text.off", "hello\n");
  expect_failure(1, "text.off", "inspect text.off");
  write("a.unknown", "OFF\n");
  expect_failure(1, "unknown", "inspect a.unknown");
  write("nan.off", "OFF\n3 1 0\n0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n");
  expect_failure(1, "nan", "inspect nan.off");
  // The third triangle at an edge, and one turned around.
  write("fan.off", "OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 1 0 3\n3 0 1 4\n");
  expect_failure(1, "edge", "inspect fan.off");
  write("turned.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n3 0 1 2\n3 0 1 3\n");
  expect_failure(1, "edge", "inspect turned.off");
  expect_failure(2, "--edge", "inspect " TRIVALENT_MESHES "/cube.off --edge 0");
}

}  // namespace
