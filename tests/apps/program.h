#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace testing_support {

inline std::string content_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream content;
  content << in.rdbuf();
  return content.str();
}

/// What a program said and how it ended.
struct Outcome {
  int exit_code = -1;  ///< -1 if it crashed
  std::string out;
  std::string err;
  [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(out); }
};

/// A test with a folder of its own, in which programs run.
class ProgramTest : public testing::Test {
 protected:
  ProgramTest() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("trivalent_") + test->test_suite_name() + "_" + test->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~ProgramTest() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] bool has(const std::string& name) const {
    return std::filesystem::exists(folder_ / name);
  }
  [[nodiscard]] std::string content(const std::string& name) const {
    return content_of(folder_ / name);
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  /// Runs a shell command in the folder.
  [[nodiscard]] Outcome shell(const std::string& command) const {
    const auto out = folder_.string() + ".out";
    const auto err = folder_.string() + ".err";
    const std::string line = "cd '" + folder_.string() + "' && " + command + " > '" + out +
                             "' 2> '" + err + "' < /dev/null";
    const int status = std::system(line.c_str());
    Outcome run;
    if (WIFEXITED(status)) run.exit_code = WEXITSTATUS(status);
    run.out = content_of(out);
    run.err = content_of(err);
    std::filesystem::remove(out);
    std::filesystem::remove(err);
    return run;
  }
  /// Runs the program with these arguments; if it hangs, the exit code is 124.
  [[nodiscard]] Outcome trivalent(const std::string& arguments) const {
    return shell("timeout 120 " TRIVALENT_PROGRAM " " + arguments);
  }
  /// The same, which must succeed.
  Outcome succeed(const std::string& arguments) const {
    Outcome run = trivalent(arguments);
    EXPECT_EQ(run.exit_code, 0) << arguments << '\n' << run.err;
    return run;
  }
  /// The same, which must end with this code, say why (naming a part), and print no result.
  void expect_failure(int exit_code, const std::string& part, const std::string& arguments) const {
    const Outcome run = trivalent(arguments);
    EXPECT_EQ(run.exit_code, exit_code) << arguments << '\n' << run.err;
    EXPECT_NE(run.err.find(part), std::string::npos) << arguments << '\n' << run.err;
    EXPECT_EQ(run.out, "") << arguments;
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace testing_support
