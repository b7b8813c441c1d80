#pragma once

#include <chrono>
#include <optional>

#include "terminal.h"
#include "trivalent/potentials/relax.h"

namespace trivalent::apps {

/// Tells the terminal once a second how far a relaxation has come.
class RelaxLine {
 public:
  explicit RelaxLine(const Terminal& terminal) : terminal_(terminal) {}
  void show(const potentials::RelaxProgress& state);

 private:
  using Clock = std::chrono::steady_clock;
  const Terminal& terminal_;
  std::optional<Clock::time_point> begin_;  // of the first step shown
  double next_ = 1.0;                       // [s] after it
  int first_step_ = 0;
};

}  // namespace trivalent::apps
