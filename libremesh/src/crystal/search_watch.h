#pragma once

#include <atomic>
#include <thread>

#include "trivalent/remesh/crystallize.h"

namespace trivalent::remesh {

/// Counts the rounds of a search, reports progress and asks whether to stop. Several threads may
/// search; the functions of the options are called in the one that made this object.
class SearchWatch {
 public:
  explicit SearchWatch(const CrystalOptions& options) : options_(options) {}

  /// Announces rounds to come.
  void expect(int rounds) { rounds_ += rounds; }
  /// To be called after every round.
  ///
  /// @param scale   From the mesh's unit to the user's.
  /// @param length  Of an edge without strain, in the mesh's unit.
  /// @return        Whether the search goes on.
  bool goes_on(const TriMesh& mesh, double length, double scale = 1.0);

  /// Asks whether to stop, within a round.
  bool should_stop() {
    if (is_at_home() && !stopped_ && options_.should_stop && options_.should_stop()) {
      stopped_ = true;
    }
    return stopped_;
  }
  /// should_stop() for others; must not outlive this object.
  [[nodiscard]] std::function<bool()> question() {
    return [this] { return should_stop(); };
  }
  [[nodiscard]] bool stopped() const { return stopped_; }
  [[nodiscard]] int rounds_done() const { return rounds_done_; }

 private:
  [[nodiscard]] bool is_at_home() const { return std::this_thread::get_id() == home_; }

  const CrystalOptions& options_;
  std::thread::id home_ = std::this_thread::get_id();
  int rounds_ = 0;
  int rounds_reported_ = 0;
  std::atomic<int> rounds_done_ = 0;
  std::atomic<bool> stopped_ = false;
};

}  // namespace trivalent::remesh
