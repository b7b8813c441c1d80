#pragma once

#include <string>

#include "trivalent/shell/lammps_run.h"

namespace trivalent::shell {

/// Understands what LAMMPS says while it works.
class LammpsOutput {
 public:
  /// @param task  must outlive this
  explicit LammpsOutput(const LammpsTask& task) : task_(task) {}

  void hear(const std::string& line);

  [[nodiscard]] int steps() const { return steps_; }
  [[nodiscard]] int evaluations() const;
  /// Why a run failed.
  [[nodiscard]] std::string complaint() const;
  /// Sets the box to what it was in the end.
  ///
  /// @throws dual::Error if LAMMPS did not say it.
  void read_box(potentials::Box& box) const;

 private:
  void hear_thermo(const std::string& line) const;

  const LammpsTask& task_;
  std::string first_error_;
  std::string last_;
  std::string box_;
  int steps_ = 0;
  int evaluations_ = 0;
};

}  // namespace trivalent::shell
