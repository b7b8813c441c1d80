// Reads lines as the arguments of a command with options of every kind: flags, numbers and names.

#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "remesh_options.h"
#include "session.h"

namespace {

using namespace trivalent::apps;  // NOLINT(google-build-using-namespace)

const Command command = {
    .name = "fuzz", .synopsis = "SHAPE", .meaning = "Takes any options", .run = nullptr};

void read_arguments(const std::vector<std::string>& words) {
  Grammar grammar = {.arguments = {"SHAPE"}, .options = po::options_description("All")};
  add_remesh_options(grammar.options);
  const auto session = start(command, words, grammar);
  if (!session) return;
  static_cast<void>(remesh_method(*session));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
  std::vector<std::string> words;
  for (std::string word; std::getline(lines, word);) {
    // Would print the help, or start as many threads.
    if (word.starts_with("--help") || word.starts_with("--threads")) return 0;
    words.push_back(word);
  }
  try {
    read_arguments(words);
  } catch (const UsageError&) {
  } catch (const po::error&) {
  }
  return 0;
}
