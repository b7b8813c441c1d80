#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trivalent/potentials/bonds.h"
#include "trivalent/potentials/relax.h"
#include "trivalent/shell/json.h"
#include "trivalent/view/table_row.h"

namespace trivalent::shell {

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
[[nodiscard]] std::vector<dual::TableRow> relax_rows(const RelaxReport& report,
                                                     const potentials::RelaxResult& relaxed);

/// Says which bonds were guessed and which pairs were left out.
[[nodiscard]] std::string guess_note(const potentials::GuessedBonds& guess);

/// One sentence for each thing that is not as it should be.
[[nodiscard]] std::vector<std::string> relax_notes(const RelaxReport& report,
                                                   const potentials::RelaxResult& relaxed);

/// What the atoms are relaxed under, for people.
[[nodiscard]] std::string_view name_of(potentials::RelaxStage stage);

}  // namespace trivalent::shell
