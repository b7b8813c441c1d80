#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "relax_report.h"
#include "reports.h"
#include "session.h"
#include "trivalent/dual/hydrogen.h"
#include "trivalent/dual/network_checks.h"
#include "trivalent/potentials/energy_forces.h"
#include "trivalent/remesh/mesh_components.h"
#include "trivalent/remesh/mesh_quality.h"
#include "trivalent/shell/build_shell.h"
#include "trivalent/view/shell_page.h"
#include "trivalent/view/shell_state.h"

namespace trivalent::apps {

/// Seconds of every step, in order.
class Stopwatch {
 public:
  void finish(const std::string& step) {
    const auto now = std::chrono::steady_clock::now();
    seconds_[step] = std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }
  [[nodiscard]] const Json& seconds() const { return seconds_; }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  Json seconds_ = Json::object();
};

/// Everything known about a shell that was built; lengths in Å.
struct BuildRecord {
  std::vector<std::string> notes = {};
  double wrap_offset = 0.0;  ///< 0 if the input was not wrapped
  remesh::MeshQuality input_quality = {};
  remesh::TriMesh original = {};  ///< the input surface at the shell's scale
  dual::Shell shell = {};
  remesh::MeshQuality quality = {};
  remesh::MeshComponents components = {};
  remesh::TwoSidedDistance distance = {};
  dual::NetworkReport network = {};  ///< of the carbon atoms, as they are in the end
  dual::HydrogenCaps caps = {};
  potentials::EnergyForces energy = {};
  std::optional<dual::ShellState> before = {};     ///< the dual of the input
  std::optional<dual::ShellState> unrelaxed = {};  ///< the shell, if it was relaxed
  std::optional<potentials::RelaxResult> relaxed = {};
  RelaxReport relaxation = {};
  dual::ShellState after = {};
  Stopwatch stopwatch = {};
  int exit_code = done;  ///< of a build that was stopped early: 128 + the signal
};

/// Everything, as report.json has it.
[[nodiscard]] Json report_json(const BuildRecord& record, const Session& session);

/// What matters of it to people.
[[nodiscard]] std::vector<TableRow> summary_rows(const BuildRecord& record);

/// Takes the record apart: nothing of it is needed afterwards.
[[nodiscard]] dual::ShellPage report_page(BuildRecord& record, const Session& session);

}  // namespace trivalent::apps
