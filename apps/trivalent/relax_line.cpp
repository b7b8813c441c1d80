#include "relax_line.h"

#include "trivalent/shell/number_text.h"
#include "trivalent/shell/relax_report.h"

namespace trivalent::apps {

using shell::decimals;
using shell::significant;

void RelaxLine::show(const potentials::RelaxProgress& state) {
  if (!begin_) {
    begin_ = Clock::now();
    first_step_ = state.steps;
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - *begin_).count();
  if (seconds < next_) return;
  next_ = seconds + 1.0;
  const double per_second = (state.steps - first_step_) / seconds;
  const std::string forces = state.energy
                                 ? "energy " + decimals(*state.energy, 4) + " eV, largest force " +
                                       significant(*state.largest_force) + " eV/Å, "
                                 : "";
  terminal_.progress("relaxing (" + std::string(shell::name_of(state.stage)) + "): step " +
                     std::to_string(state.steps) + ", " + forces + significant(per_second, 3) +
                     " steps/s");
}

}  // namespace trivalent::apps
