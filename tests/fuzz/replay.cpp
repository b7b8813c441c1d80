// Replays inputs on a fuzz target without libFuzzer: as they are, cut short, and with bytes
// changed.
//
// usage: replay_TARGET FOLDER...
//
// Ends by a signal where the target finds a fault; the last file named is the one it was made of.

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

namespace fs = std::filesystem;

/// Inputs are damaged at this many places at most, evenly spaced.
constexpr std::size_t max_places = 500;
constexpr std::string_view bytes_put = std::string_view("\0\xff-9e\n ", 7);

void run(std::string_view bytes) {
  // On the heap and of that size, so that a sanitizer sees a read past the end.
  const std::string copy(bytes);
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(copy.data()), copy.size());
}

/// Runs an input and its damaged copies; returns how many inputs that were.
std::size_t run_damaged(const std::string& bytes) {
  run(bytes);
  std::size_t n_runs = 1;
  const std::size_t stride = bytes.size() / max_places + 1;
  for (std::size_t place = 0; place < bytes.size(); place += stride) {
    run(std::string_view(bytes).substr(0, place));
    for (const char put : bytes_put) {
      std::string damaged = bytes;
      damaged[place] = put;
      run(damaged);
    }
    n_runs += 1 + bytes_put.size();
  }
  return n_runs;
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t n_files = 0;
  std::size_t n_runs = 0;
  for (int i = 1; i < argc; ++i) {
    for (const fs::directory_entry& entry : fs::directory_iterator(argv[i])) {
      std::printf("%s\n", entry.path().c_str());
      std::fflush(stdout);
      std::ifstream file(entry.path(), std::ios::binary);
      n_runs += run_damaged({std::istreambuf_iterator<char>(file), {}});
      ++n_files;
    }
  }
  std::printf("%zu files, %zu inputs\n", n_files, n_runs);
  return n_files > 0 ? 0 : 1;
}
