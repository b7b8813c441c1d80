#include "lammps_output.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <sstream>

#include "trivalent/dual/error.h"

namespace trivalent::shell {

void LammpsOutput::hear(const std::string& line) {
  if (first_error_.empty() && line.find("ERROR") != std::string::npos) first_error_ = line;
  const bool is_crash_report = line.starts_with('[');  // by Open MPI
  if (!line.empty() && !is_crash_report) last_ = line;
  if (line.starts_with("box ")) box_ = line.substr(4);
  std::sscanf(line.c_str(), " Iterations, force evaluations = %d %d", &steps_, &evaluations_);
  if (task_.max_steps > 0 && task_.on_progress) hear_thermo(line);
}

int LammpsOutput::evaluations() const { return std::max(evaluations_, 1); }

std::string LammpsOutput::complaint() const {
  return first_error_.empty() ? "it ended after '" + last_ + "'" : first_error_;
}

void LammpsOutput::read_box(potentials::Box& box) const {
  std::istringstream in(box_);
  Eigen::Vector3d low;
  Eigen::Vector3d high;
  std::array<double, 3> tilts{};
  for (double* value : {&low[0], &low[1], &low[2], &high[0], &high[1], &high[2]}) in >> *value;
  for (double& tilt : tilts) in >> tilt;
  if (!in) throw dual::Error("LAMMPS said nothing about its box");
  box.origin = low;
  box.cell = (high - low).asDiagonal();
  box.cell(0, 1) = tilts[0];
  box.cell(0, 2) = tilts[1];
  box.cell(1, 2) = tilts[2];
}

void LammpsOutput::hear_thermo(const std::string& line) const {
  std::istringstream in(line);
  LammpsProgress progress;
  in >> progress.step >> progress.energy >> progress.largest_force_component;
  if (in && (in >> std::ws).eof()) task_.on_progress(progress);
}

}  // namespace trivalent::shell
