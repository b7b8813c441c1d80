#include "interruption.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "program.h"

namespace trivalent::apps {
namespace {

using testing_support::Outcome;
using testing_support::ProgramTest;

class Interruption : public ProgramTest {
 protected:
  /// Starts a build that takes minutes and sends a signal after a second.
  [[nodiscard]] Outcome interrupted_build(const std::string& signal) const {
    return shell("timeout --preserve-status -s " + signal +
                 " 1 " TRIVALENT_PROGRAM
                 " build sphere -o out --atoms 1000000 --method paper --quiet");
  }
};

TEST_F(Interruption, EndsTheProgramAsTheSignalWould) {
  EXPECT_EQ(interrupted_build("INT").exit_code, 128 + SIGINT);
  EXPECT_EQ(interrupted_build("TERM").exit_code, 128 + SIGTERM);
  EXPECT_EQ(interrupted_build("HUP").exit_code, 128 + SIGHUP);
  EXPECT_FALSE(has("out"));
}

TEST_F(Interruption, IsNotHeardUnderNohup) {
  const Outcome run = shell("(trap '' HUP; " TRIVALENT_PROGRAM
                            " build sphere -o out --atoms 5000 --method paper --quiet & pid=$!;"
                            " sleep 0.2; kill -HUP $pid; wait $pid)");
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

TEST_F(Interruption, AFileThatGrowsTooLargeIsAnError) {
  write("a.off", "old");
  const Outcome run =
      shell("(ulimit -f 100; " TRIVALENT_PROGRAM " shape sphere a.off --edge 0.02)");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("File too large"), std::string::npos) << run.err;
  EXPECT_EQ(content("a.off"), "old");
  EXPECT_EQ(shell("ls -A").out, "a.off\n");
}

using StopRequestDeathTest = ProgramTest;

TEST_F(StopRequestDeathTest, TheFirstSignalAsksAndTheSecondEnds) {
  const auto ask_twice = [] {
    handle_interruptions();
    const StopRequest stop;
    if (stop.is_made() || stop.exit_code() != 0) return;
    std::raise(SIGINT);
    if (!stop.is_made() || stop.exit_code() != 128 + SIGINT) return;
    std::raise(SIGINT);
  };
  EXPECT_EXIT(ask_twice(), testing::KilledBySignal(SIGINT), "once more ends");
}

TEST_F(StopRequestDeathTest, WorkThatDoesNotStopEndsInTime) {
  const auto ask_in_vain = [] {
    handle_interruptions();
    const StopRequest stop;
    stop.answer_in_time();
    std::raise(SIGTERM);
    if (stop.is_made()) std::this_thread::sleep_for(std::chrono::seconds(10));
  };
  EXPECT_EXIT(ask_in_vain(), testing::KilledBySignal(SIGTERM), "nothing is kept");
}

TEST_F(StopRequestDeathTest, ResultsMayBeWrittenAtLeisure) {
  const auto write_slowly = [](int signal) {
    handle_interruptions();
    const StopRequest stop;
    stop.answer_in_time();
    std::raise(signal);
    if (signal != SIGINT) stop.keep_results();
    std::this_thread::sleep_for(std::chrono::milliseconds(2500));
    std::_Exit(stop.exit_code());
  };
  EXPECT_EXIT(write_slowly(SIGTERM), testing::ExitedWithCode(128 + SIGTERM), "in 2 s is kept");
  // Who presses Ctrl-C can press it again.
  EXPECT_EXIT(write_slowly(SIGINT), testing::ExitedWithCode(128 + SIGINT), "keeping what there is");
}

TEST_F(StopRequestDeathTest, NobodyIsAskedAfterwards) {
  const auto ask_late = [] {
    handle_interruptions();
    { const StopRequest stop; }
    std::raise(SIGTERM);
  };
  EXPECT_EXIT(ask_late(), testing::KilledBySignal(SIGTERM), "");
}

}  // namespace
}  // namespace trivalent::apps
