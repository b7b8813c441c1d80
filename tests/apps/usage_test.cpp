#include <regex>

#include "program.h"

namespace {

using testing_support::Outcome;
using testing_support::ProgramTest;

class Usage : public ProgramTest {};

TEST_F(Usage, ExplainsEveryCommand) {
  const std::string overview = succeed("--help").out;
  for (const std::string command : {"build", "remesh", "dual", "energy", "inspect", "shape"}) {
    EXPECT_NE(overview.find("trivalent " + command + " "), std::string::npos) << command;
    const std::string help = succeed(command + " --help").out;
    EXPECT_NE(help.find("Usage: trivalent " + command), std::string::npos);
    EXPECT_NE(help.find("--threads"), std::string::npos);
  }
}

TEST_F(Usage, ShowsUnitsAndDefaults) {
  const std::string help = succeed("build --help").out;
  for (const std::string part :
       {"default: 1.42", "--sigma arg (=0.2)", "--rings arg (=2)", "--iterations arg (=20)", "[Å]",
        "10000", "sphere", "radius [1]"}) {
    EXPECT_NE(help.find(part), std::string::npos) << part;
  }
}

TEST_F(Usage, TellsItsVersionAndItsCommit) {
  const std::regex version(R"(trivalent 0\.1\.0( \([0-9a-f]{10,40}(-dirty)?\))?\n)");
  EXPECT_TRUE(std::regex_match(succeed("--version").out, version));
}

TEST_F(Usage, EndsWithTwoOnACommandLineThatMakesNoSense) {
  expect_failure(2, "no command", "");
  expect_failure(2, "'smooth'", "smooth a.off");
  expect_failure(2, "missing OUT", "shape sphere");
  expect_failure(2, "many", "shape sphere a.off b.off");
  expect_failure(2, "'--egde'", "shape sphere a.off --egde 1");
  expect_failure(2, "'--ed", "shape sphere a.off --ed 1");
  expect_failure(2, "'long'", "shape sphere a.off --edge long");
  expect_failure(2, "--threads", "shape sphere a.off --threads 0");
  EXPECT_FALSE(has("a.off"));
}

TEST_F(Usage, FailsIfStandardOutputIsFull) {
  const Outcome run =
      shell("( " TRIVALENT_PROGRAM " shape sphere a.off --edge 0.3 --json > /dev/full )");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("standard output"), std::string::npos);
}

}  // namespace
