#include "trivalent/shell/build.h"

#include <memory>

#include "json.h"
#include "module.h"
#include "options.h"
#include "surface.h"
#include "trivalent/shell/build_files.h"
#include "trivalent/shell/option_names.h"
#include "trivalent/shell/plan.h"
#include "watch.h"

namespace trivalent::python {
namespace {

shell::BuildOptions build_options(const Options& options) {
  shell::BuildOptions build = {.shell = shell_options(options)};
  options.set("cap", build.cap, shell::cap_names);
  if (options.has("potential")) {
    build.potential = shell::PotentialChoice{.name = *options.find<std::string>("potential")};
    if (!options.has("bond")) build.shell.bond = shell::usual_bond_length(*build.potential);
  }
  bool is_relaxed = true;
  options.set("relax", is_relaxed);
  bool is_box_fixed = false;
  options.set("fix_box", is_box_fixed);
  if (is_box_fixed) build.box = potentials::BoxPolicy::fixed;
  build.relaxation = is_relaxed ? shell::Relaxation::at_rest : shell::Relaxation::none;
  return build;
}

void observe(shell::BuildOptions& options, Watch& watch) {
  watch.observe(options.shell.method);
  options.on_step = [&watch](shell::BuildStep) { static_cast<void>(watch.should_stop()); };
  options.on_relax = [&watch](const potentials::RelaxProgress& state) {
    watch.report(state);
    return !watch.should_stop();
  };
}

/// The shell, its surface, and the report.
py::tuple build(const py::object& object, const py::dict& values, Watch& watch) {
  const Options given(values);
  shell::BuildOptions options = build_options(given);
  const remesh::RepairOptions repair = repair_options(given);
  const shell::CellOptions cell = cell_options(given);
  const SurfaceSource source = surface_source(object);
  observe(options, watch);
  std::shared_ptr<dual::Structure> structure;
  std::shared_ptr<shell::Surface> surface;
  shell::Json json;
  {
    const py::gil_scoped_release released;
    shell::BuildResult result =
        shell::build(make_surface(source, options.shell, repair, cell), options);
    json = result.json();
    structure = std::make_shared<dual::Structure>(result.structure());
    surface = std::make_shared<shell::Surface>(
        shell::Surface{.mesh = std::move(result.shell.surface.mesh)});
  }
  return py::make_tuple(std::move(structure), std::move(surface), to_python(json));
}

py::object plan(const py::object& object, const py::dict& values) {
  const Options given(values);
  const dual::ShellOptions options = shell_options(given);
  const remesh::RepairOptions repair = repair_options(given);
  const shell::CellOptions cell = cell_options(given);
  const SurfaceSource source = surface_source(object);
  shell::Json json;
  {
    const py::gil_scoped_release released;
    json = shell::plan(make_surface(source, options, repair, cell).mesh, options).json();
  }
  return to_python(json);
}

}  // namespace

void add_build(py::module_& module) {
  py::class_<Watch>(module, "Watch", "What a call tells on its way, and whether it is to end")
      .def(py::init([](py::object progress, const std::string& name) {
             return std::make_unique<Watch>(std::move(progress), on_interrupt(name));
           }),
           py::arg("progress"), py::arg("on_interrupt"));
  module.def("build", &build, py::arg("source"), py::arg("options"), py::arg("watch"),
             "Structure, surface and report of a shell");
  module.def("plan", &plan, py::arg("source"), py::arg("options"), "What a build would come to");
}

}  // namespace trivalent::python
