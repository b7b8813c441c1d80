#include "program.h"

namespace {

using testing_support::ProgramTest;

class RemeshCommand : public ProgramTest {
 protected:
  void SetUp() override { succeed("shape torus torus.off --edge 0.2"); }
};

TEST_F(RemeshCommand, BringsEdgesToOneLength) {
  const auto result = succeed("remesh torus.off out.off --edge 0.15 --method paper --json").json();
  EXPECT_NEAR(result["quality"]["edge_length"]["mean"].get<double>(), 0.15, 0.02 * 0.15);
  EXPECT_EQ(result["quality"]["euler_characteristic"], 0);
  EXPECT_EQ(result["iterations"], 20);
  EXPECT_TRUE(has("out.off"));
}

TEST_F(RemeshCommand, MakesCrystalNetsUnlessToldOtherwise) {
  const auto result = succeed("remesh torus.off out.off --edge 0.15 --effort quick --json").json();
  EXPECT_NEAR(result["quality"]["edge_length"]["mean"].get<double>(), 0.15, 0.01 * 0.15);
  EXPECT_GT(result["quality"]["regular_fraction"].get<double>(), 0.92);
  EXPECT_EQ(result["stopped"], false);
  EXPECT_EQ(result["net"]["coarse_start"], true);
  EXPECT_EQ(result["net"]["too_fine"]["vertices"], 0);
  EXPECT_TRUE(has("out.off"));
}

TEST_F(RemeshCommand, TellsAtWhichEdgeLengthASurfaceIsNotTooFine) {
  // A tube of radius 0.4 bends like a sphere of radius 0.8; C60 of these edges has 0.87.
  const std::string options = " --method paper --json --edge ";
  const auto coarse =
      succeed("remesh torus.off out.off" + options + "0.6").json()["net"]["too_fine"];
  EXPECT_GT(coarse["vertices"], 0);
  EXPECT_GT(coarse["growth"], 1.0);
  const double edge = coarse["edge_length"];
  const auto fine =
      succeed("remesh torus.off out.off" + options + std::to_string(edge / 2.0)).json();
  EXPECT_EQ(fine["net"]["too_fine"]["growth"], 1.0);
}

TEST_F(RemeshCommand, JoinsAMeshOfOneCell) {
  succeed("shape schwarz-p p.off --edge 0.05");
  const auto remeshed =
      succeed("remesh p.off net.off --edge 0.08 --cell 1 --effort quick --json").json()["quality"];
  EXPECT_EQ(remeshed["euler_characteristic"], -4);
  EXPECT_EQ(remeshed["boundary_loops"], 0);
  // What it writes is a mesh of one cell again.
  const auto inspected = trivalent("inspect net.off --cell 1 --json").json()["quality"];
  EXPECT_EQ(inspected["euler_characteristic"], -4);
  EXPECT_NEAR(inspected["edge_length"]["mean"].get<double>(),
              remeshed["edge_length"]["mean"].get<double>(), 1e-9);
  expect_failure(1, "no partner", "remesh p.off net.off --edge 0.08 --cell 1.1");
  expect_failure(2, "--periodic belongs to --cell",
                 "remesh p.off net.off --edge 0.08 --periodic x");
  expect_failure(2, "--periodic none", "remesh p.off net.off --edge 0.08 --cell 1 --periodic none");
}

TEST_F(RemeshCommand, RefusesOptionsOfTheOtherMethod) {
  expect_failure(2, "--rings has no effect", "remesh torus.off out.off --edge 0.2 --rings 3");
  expect_failure(2, "--seed has no effect",
                 "remesh torus.off out.off --edge 0.2 --method paper --seed 3");
  expect_failure(2, "--effort", "remesh torus.off out.off --edge 0.2 --effort great");
  expect_failure(2, "--seed", "remesh torus.off out.off --edge 0.2 --seed -1");
}

TEST_F(RemeshCommand, KnowsTheParametersOfThePaper) {
  const auto result =
      succeed(
          "remesh torus.off out.obj --edge 0.2 --method paper --iterations 3 --rings 1 --sigma 0.1 "
          "--restriction least-squares --feature-angle 60 --json")
          .json();
  EXPECT_EQ(result["iterations"], 3);
}

TEST_F(RemeshCommand, GivesTheSameBytesForAnyNumberOfThreads) {
  succeed("remesh torus.off one.off --edge 0.15 --method paper --iterations 5 --threads 1");
  succeed("remesh torus.off three.off --edge 0.15 --method paper --iterations 5 --threads 3");
  EXPECT_EQ(content("one.off"), content("three.off"));
}

TEST_F(RemeshCommand, TellsItsProgressUnlessQuiet) {
  const auto loud = succeed("remesh torus.off out.off --edge 0.2 --method paper --iterations 2");
  EXPECT_NE(loud.err.find("remeshing 2/2"), std::string::npos);
  const auto quiet =
      succeed("remesh torus.off out.off --edge 0.2 --method paper --iterations 2 --quiet");
  EXPECT_EQ(quiet.err, "");
  EXPECT_EQ(quiet.out, loud.out);
}

TEST_F(RemeshCommand, RefusesParametersOutOfRange) {
  expect_failure(2, "--edge", "remesh torus.off out.off");
  for (const std::string edge : {"0", "-1", "nan", "inf"}) {
    expect_failure(2, "target edge length", "remesh torus.off out.off --edge " + edge);
  }
  expect_failure(2, "target edge length", "remesh torus.off out.off --edge 100");
  expect_failure(2, "iterations",
                 "remesh torus.off out.off --edge 0.2 --method paper --iterations 0");
  expect_failure(2, "rings", "remesh torus.off out.off --edge 0.2 --method paper --rings 9");
  expect_failure(2, "tolerance", "remesh torus.off out.off --edge 0.2 --method paper --sigma 1");
  expect_failure(2, "--restriction",
                 "remesh torus.off out.off --edge 0.2 --method paper --restriction soft");
  expect_failure(2, "--method", "remesh torus.off out.off --edge 0.2 --method cvt");
  expect_failure(2, "extension", "remesh torus.off out.xyz --edge 0.2");
  expect_failure(1, "missing.off", "remesh missing.off out.off --edge 0.2");
  EXPECT_FALSE(has("out.off"));
}

}  // namespace
