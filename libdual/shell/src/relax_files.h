#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "trivalent/potentials/relax.h"

namespace trivalent::shell {

/// What decides the course of a relaxation, in 64 bits: a checkpoint of another one is of no use.
[[nodiscard]] std::string fingerprint(const potentials::Atoms& atoms,
                                      const potentials::RelaxOptions& options,
                                      const std::string& potential);

/// Structures on the way, one after the other in one file. It has the name with .part added until
/// it is complete.
class Trajectory {
 public:
  Trajectory(std::filesystem::path path, int every);

  /// Appends the atoms at each multiple of `every` steps.
  void add(const potentials::RelaxProgress& state);
  /// How many bytes there are, all of them in the file.
  [[nodiscard]] std::uintmax_t size() const { return size_; }
  /// Goes on after so many bytes; false if they are not there any more.
  [[nodiscard]] bool resume(std::uintmax_t size, int last_step);
  /// Begins anew.
  void start();
  void finish();

 private:
  std::filesystem::path path_;
  std::filesystem::path part_;
  int every_;
  std::optional<int> last_step_;
  std::uintmax_t size_ = 0;
};

/// Where a relaxation was when it was last known to be in order.
struct SavedRelaxation {
  potentials::Atoms atoms;
  int steps = 0;
  int evaluations = 0;
  std::uintmax_t trajectory_size = 0;
};

/// Writes it whole, with every bit of the positions, as extended XYZ.
void save_relaxation(const std::filesystem::path& path, const std::string& fingerprint,
                     const potentials::RelaxCheckpoint& state, std::uintmax_t trajectory_size);

/// Reads what save_relaxation wrote; none if there is no such file, or it is another relaxation's.
[[nodiscard]] std::optional<SavedRelaxation> load_relaxation(const std::filesystem::path& path,
                                                             const std::string& fingerprint);

}  // namespace trivalent::shell
