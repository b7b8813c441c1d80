#include "program.h"

namespace {

using testing_support::ProgramTest;

class ShapeCommand : public ProgramTest {};

TEST_F(ShapeCommand, WritesEveryShapeInEveryFormat) {
  for (const std::string shape : {"sphere", "ellipsoid", "torus", "double-torus", "capsule", "tube",
                                  "open-tube", "wavy-sheet"}) {
    for (const std::string extension : {".off", ".obj", ".ply", ".stl"}) {
      const std::string file = shape + extension;
      const auto made = succeed("shape " + shape + " " + file + " --edge 0.2 --json").json();
      const auto read = succeed("inspect " + file + " --json").json();
      EXPECT_EQ(made["faces"], read["quality"]["faces"]) << file;
    }
  }
}

TEST_F(ShapeCommand, HasParameters) {
  const auto large = succeed("shape sphere:radius=10 a.off --edge 2 --json").json();
  EXPECT_NEAR(large["area"].get<double>(), 1256.6, 0.03 * 1256.6);
}

TEST_F(ShapeCommand, SaysHowToReadACell) {
  for (const std::string shape : {"schwarz-p", "schwarz-d", "plane", "periodic-tube"}) {
    const std::string said = succeed("shape " + shape + " cell.off --edge 0.04").err;
    const std::size_t at = said.find("--cell");
    ASSERT_NE(at, std::string::npos) << said;
    const std::string options = said.substr(at, said.find('\n', at) - at);
    const auto net =
        succeed("remesh cell.off net.off --edge 0.1 --method paper --json " + options).json();
    EXPECT_EQ(net["quality"]["boundary_loops"], 0) << shape << ' ' << options;
  }
  EXPECT_EQ(succeed("shape sphere s.off --edge 0.3").err, "");
}

TEST_F(ShapeCommand, SaysThatAFileHoldsNoTubes) {
  const auto said = succeed("shape y-junction:open=1,n=5,m=5 y.off --edge 0.3").err;
  EXPECT_NE(said.find("nanotubes"), std::string::npos) << said;
  EXPECT_EQ(succeed("shape y-junction:open=1 y.off --edge 0.3").err, "");
}

TEST_F(ShapeCommand, RefusesWhatItCannotMake) {
  expect_failure(2, "cube", "shape cube a.off");
  expect_failure(2, "list of numbers", "shape junction:arm=1 a.off");
  expect_failure(2, "one number", "shape 'sphere:radius=1 2' a.off");
  expect_failure(2, "several numbers", "shape 'nanotube:n=5,m=5 3' a.xyz");
  expect_failure(2, "R", "shape sphere:R=3 a.off");
  expect_failure(2, "name=number", "shape sphere:radius a.off");
  expect_failure(2, "name=number", "shape sphere:radius=x a.off");
  expect_failure(2, "radius", "shape sphere:radius=-1 a.off");
  expect_failure(2, "edge", "shape sphere a.off --edge 0");
  expect_failure(2, "edge", "shape sphere a.off --edge nan");
  expect_failure(2, "extension", "shape sphere a.xyz");
  EXPECT_FALSE(has("a.off"));
}

TEST_F(ShapeCommand, FailsWhereItCannotWrite) {
  expect_failure(1, "no folder", "shape sphere nowhere/a.off");
  expect_failure(1, "no folder", "shape sphere /dev/null/a.off");
  expect_failure(1, "no folder", "shape sphere /dev/null/a.off");
  std::filesystem::create_symlink("/dev/full", folder() / "full.off");
  expect_failure(1, "full.off", "shape sphere full.off");
}

TEST_F(ShapeCommand, WritesIdealStructuresAsAtoms) {
  const auto shape = succeed("shape nanotube:n=6,m=3,cells=2 tube.data --json").json();
  EXPECT_EQ(shape["atoms"], 168);
  const auto energy = [this](const std::string& tube) {
    return succeed("energy " + tube + " --json").json()["energy_per_atom"].get<double>();
  };
  EXPECT_NEAR(energy("tube.data --periodic z"), energy("nanotube:n=6,m=3,cells=2"), 1e-8);
  expect_failure(2, "extxyz", "shape fullerene:N=60 cage.off");
  expect_failure(2, "80 and 140", "shape fullerene:N=100 cage.xyz");
  expect_failure(2, "whole number", "shape nanotube:n=1.5 tube.xyz");
  expect_failure(2, "--edge", "shape fullerene:N=60 cage.xyz --edge 0.1");
  expect_failure(2, "atoms already", "build fullerene:N=60 -o out");
}

}  // namespace
