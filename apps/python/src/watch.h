#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <string>

#include "trivalent/potentials/relax.h"
#include "trivalent/remesh/crystallize.h"

namespace trivalent::python {

/// What Ctrl-C does to a call.
enum class OnInterrupt {
  raise,  ///< KeyboardInterrupt
  keep    ///< the call returns the best it has so far
};

/// @throws WrongOption if it is neither "raise" nor "keep".
[[nodiscard]] OnInterrupt on_interrupt(const std::string& name);

/// What a long call tells Python on its way, and whether it is to end. The callbacks are called
/// without the GIL and take it.
class Watch {
 public:
  /// @param progress  called with (stage, done, total or None, text); returning False ends the
  ///   call. Or None.
  Watch(pybind11::object progress, OnInterrupt on_interrupt);

  /// Has a method report to this object, and stop early if it can.
  void observe(remesh::RemeshMethod& method);
  /// Reports a step of a relaxation, at most ten times a second.
  void report(const potentials::RelaxProgress& state);

  /// Whether the call is to end.
  ///
  /// @throws pybind11::error_already_set with KeyboardInterrupt, or what a handler of a signal
  ///   raised
  [[nodiscard]] bool should_stop();

 private:
  void report(const char* stage, int done, int total, const std::string& text);
  void report(const remesh::RemeshProgress& state);

  using Clock = std::chrono::steady_clock;
  pybind11::object progress_;
  OnInterrupt on_interrupt_;
  bool stopped_ = false;
  Clock::time_point last_ = {};
};

}  // namespace trivalent::python
