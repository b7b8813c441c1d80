#include "watch.h"

#include "errors.h"
#include "trivalent/shell/names.h"
#include "trivalent/shell/number_text.h"
#include "trivalent/shell/relax_report.h"

namespace trivalent::python {

namespace py = pybind11;

OnInterrupt on_interrupt(const std::string& name) {
  constexpr shell::Names<OnInterrupt, 2> names = {
      {{"raise", OnInterrupt::raise}, {"keep", OnInterrupt::keep}}};
  if (const auto value = shell::value_named(name, names)) return *value;
  throw WrongOption("on_interrupt is " + shell::list_of(names) + ", not '" + name + "'");
}

Watch::Watch(py::object progress, OnInterrupt on_interrupt)
    : progress_(std::move(progress)), on_interrupt_(on_interrupt) {}

bool Watch::should_stop() {
  const py::gil_scoped_acquire gil;
  // In other threads than Python's main one there is never a signal.
  if (PyErr_CheckSignals() == 0) return stopped_;
  if (on_interrupt_ == OnInterrupt::raise || PyErr_ExceptionMatches(PyExc_KeyboardInterrupt) == 0) {
    throw py::error_already_set();
  }
  PyErr_Clear();
  stopped_ = true;
  return stopped_;
}

void Watch::report(const char* stage, int done, int total, const std::string& text) {
  const py::gil_scoped_acquire gil;
  if (progress_.is_none()) return;
  const py::object of = total > 0 ? py::object(py::int_(total)) : py::object(py::none());
  if (progress_(stage, done, of, text).is(py::bool_(false))) stopped_ = true;
}

void Watch::report(const remesh::RemeshProgress& state) {
  report("remesh", state.iteration, state.iterations,
         std::to_string(state.vertices) + " vertices, CV " + shell::percent(state.relative_spread) +
             ", valence 6 " + shell::percent(state.regular_fraction));
}

void Watch::report(const potentials::RelaxProgress& state) {
  constexpr std::chrono::milliseconds pause(100);
  if (Clock::now() - last_ < pause) return;
  last_ = Clock::now();
  std::string text(shell::name_of(state.stage));
  if (state.energy) text += ", energy " + shell::decimals(*state.energy, 4) + " eV";
  if (state.largest_force) {
    text += ", largest force " + shell::significant(*state.largest_force) + " eV/Å";
  }
  report("relax", state.steps, 0, text);
}

void Watch::observe(remesh::RemeshMethod& method) {
  if (auto* crystal = std::get_if<remesh::CrystalOptions>(&method)) {
    crystal->should_stop = [this] { return should_stop(); };
    crystal->on_progress = [this](const remesh::RemeshProgress& state) { report(state); };
    return;
  }
  // It cannot stop early: only an exception ends it.
  std::get<remesh::RemeshOptions>(method).on_progress = [this](const auto& state) {
    report(state);
    static_cast<void>(should_stop());
  };
}

}  // namespace trivalent::python
