#pragma once

#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reports.h"
#include "trivalent/potentials/bonds.h"
#include "trivalent/potentials/relax.h"

namespace trivalent::apps {

/// What a relaxation did to atoms and their bonds.
struct RelaxReport {
  potentials::BondChanges bonds;
  double displacement_rms = 0.0;      ///< [Å]
  double displacement_largest = 0.0;  ///< [Å]
};

/// @param before  positions before the relaxation [Å]
[[nodiscard]] RelaxReport report_relaxation(std::span<const Eigen::Vector3d> before,
                                            std::span<const potentials::Bond> bonds,
                                            const potentials::RelaxResult& relaxed);

[[nodiscard]] Json relax_json(const RelaxReport& report, const potentials::RelaxResult& relaxed);
[[nodiscard]] std::vector<TableRow> relax_rows(const RelaxReport& report,
                                               const potentials::RelaxResult& relaxed);

/// Says which bonds were guessed and which pairs were left out.
[[nodiscard]] std::string guess_note(const potentials::GuessedBonds& guess);

/// One sentence for each thing that is not as it should be.
[[nodiscard]] std::vector<std::string> relax_notes(const RelaxReport& report,
                                                   const potentials::RelaxResult& relaxed);

/// Tells the terminal now and then how far a relaxation has come.
class RelaxLine {
 public:
  explicit RelaxLine(const Terminal& terminal) : terminal_(terminal) {}
  void show(const potentials::RelaxProgress& state);

 private:
  using Clock = std::chrono::steady_clock;
  const Terminal& terminal_;
  Clock::time_point begin_ = Clock::now();
  double next_ = 1.0;              // [s]
  std::optional<int> first_step_;  // that this run began with
};

}  // namespace trivalent::apps
