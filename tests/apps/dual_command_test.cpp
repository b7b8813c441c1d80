#include "program.h"

namespace {

using testing_support::ProgramTest;

class DualCommand : public ProgramTest {
 protected:
  void SetUp() override { succeed("shape torus torus.off --edge 0.2"); }
};

TEST_F(DualCommand, ScalesToTheBond) {
  const auto result = succeed("dual torus.off torus.extxyz --bond 1.5 --json").json();
  EXPECT_NEAR(result["network"]["bond_length"]["mean"].get<double>(), 1.5, 1e-12);
  EXPECT_TRUE(result["network"]["is_trivalent"].get<bool>());
  EXPECT_EQ(result["network"]["ring_excess"], 0);
  const std::string text = content("torus.extxyz");
  EXPECT_NE(text.find("Properties=species:S:1:pos:R:3:coordination:I:1:rings:I:3"),
            std::string::npos);
}

TEST_F(DualCommand, ScalesToALengthOrByAFactor) {
  EXPECT_NEAR(succeed("dual torus.off a.data --length 28 --json").json()["scale"].get<double>(),
              10.0, 0.1);
  EXPECT_EQ(succeed("dual torus.off a.data --scale 3 --json").json()["scale"], 3.0);
}

TEST_F(DualCommand, WritesBondsOnRequest) {
  const auto result = succeed("dual torus.off a.data --atom-style molecular --json").json();
  const std::string text = content("a.data");
  EXPECT_NE(text.find("Atoms # molecular"), std::string::npos);
  EXPECT_NE(text.find(std::to_string(result["network"]["bonds"].get<int>()) + " bonds\n"),
            std::string::npos);
}

TEST_F(DualCommand, WritesAllDigitsOnRequest) {
  succeed("dual torus.off a.extxyz --digits 17");
  succeed("dual torus.off b.extxyz");
  EXPECT_GT(content("a.extxyz").size(), content("b.extxyz").size());
}

TEST_F(DualCommand, RefusesWhatMakesNoSense) {
  expect_failure(2, "--bond and --length", "dual torus.off a.data --bond 1.4 --length 20");
  expect_failure(2, "bond", "dual torus.off a.data --bond 0");
  expect_failure(2, "--digits", "dual torus.off a.data --digits 6");
  expect_failure(2, "--atom-style", "dual torus.off a.data --atom-style full");
  expect_failure(2, "extension", "dual torus.off a.docx");
  expect_failure(1, "missing.off", "dual missing.off a.data");
  write("empty.off", "OFF\n0 0 0\n");
  expect_failure(1, "empty", "dual empty.off a.data");
  EXPECT_FALSE(has("a.data"));
}

}  // namespace
