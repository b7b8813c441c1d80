#include "trivalent/shell/relax.h"

#include <limits>
#include <memory>

#include "json.h"
#include "module.h"
#include "options.h"
#include "trivalent/formats/lammps_package.h"
#include "trivalent/potentials/bonds.h"
#include "trivalent/potentials/rebo.h"
#include "trivalent/remesh/mesh.h"
#include "trivalent/shell/certify.h"
#include "trivalent/shell/evaluate.h"
#include "trivalent/shell/option_names.h"
#include "trivalent/shell/surface_source.h"
#include "watch.h"

namespace trivalent::python {
namespace {

using StructurePointer = std::shared_ptr<dual::Structure>;

/// LAMMPS's part of the options, if `name` asks for it.
std::optional<shell::LammpsOptions> lammps_options(const Options& options, bool is_asked) {
  if (!is_asked) {
    options.refuse({"ranks", "potential_file"}, "goes with LAMMPS");
    return std::nullopt;
  }
  shell::LammpsOptions lammps;
  options.set("ranks", lammps.ranks);
  lammps.potential_file = options.find<std::filesystem::path>("potential_file");
  return lammps;
}

bool asks_for_lammps(const Options& options) {
  const std::string engine = options.find<std::string>("engine").value_or("own");
  if (engine != "own" && engine != "lammps") {
    throw WrongOption("engine is own or lammps, not '" + engine + "'");
  }
  return engine == "lammps";
}

std::optional<shell::LammpsRelaxation> lammps_relaxation(const Options& options) {
  const auto run = lammps_options(options, asks_for_lammps(options));
  if (!run) return std::nullopt;
  options.refuse({"trajectory", "energy_change"}, "goes with engine='own'");
  shell::require_lammps(*run);
  shell::LammpsRelaxation lammps = {.run = *run};
  options.set("minimizer", lammps.style);
  return lammps;
}

std::optional<shell::TrajectoryOptions> trajectory(const Options& options) {
  const auto path = options.find<std::filesystem::path>("trajectory");
  if (!path) return std::nullopt;
  shell::TrajectoryOptions trajectory = {.path = *path};
  options.set("every", trajectory.every);
  return trajectory;
}

shell::RelaxOptions relax_options(const Options& options) {
  shell::RelaxOptions relax = {.potential = potential_choice(options),
                               .lammps = lammps_relaxation(options),
                               .trajectory = trajectory(options)};
  if (!relax.lammps) options.set("minimizer", relax.minimizer, shell::minimizer_names);
  options.set("max_force", relax.max_force);
  options.set("energy_change", relax.energy_change);
  options.set("max_steps", relax.max_steps);
  options.set("fix", relax.fixed);
  bool relax_box = false;
  options.set("relax_box", relax_box);
  if (relax_box) relax.box = potentials::BoxPolicy::pressure_free;
  return relax;
}

py::tuple relax(const StructurePointer& structure, const py::dict& values, Watch& watch) {
  shell::RelaxOptions options = relax_options(Options(values));
  std::vector<std::string> notes;
  options.on_note = [&](const std::string& note) { notes.push_back(note); };
  options.on_progress = [&](const potentials::RelaxProgress& state) {
    watch.report(state);
    return !watch.should_stop();
  };
  shell::RelaxedStructure result;
  StructurePointer relaxed;
  {
    const py::gil_scoped_release released;
    result = shell::relax(*structure, options);
    relaxed = std::make_shared<dual::Structure>(std::move(result.structure));
    notes.insert(notes.end(), result.notes.begin(), result.notes.end());
  }
  return py::make_tuple(std::move(relaxed), to_python(result.json()), notes);
}

py::tuple energy(const StructurePointer& structure, const py::dict& values) {
  const Options given(values);
  shell::EvaluateOptions options = {.potential = potential_choice(given),
                                    .lammps = lammps_options(given, asks_for_lammps(given))};
  if (options.lammps) shell::require_lammps(*options.lammps);
  given.set("worst", options.n_worst);
  shell::Json json;
  StructurePointer evaluated;
  {
    const py::gil_scoped_release released;
    shell::Evaluation result = shell::evaluate(*structure, options);
    json = result.json();  // without the forces, which are in the structure
    result.forces = shell::ForceReport::all;
    evaluated = std::make_shared<dual::Structure>(result.structure());
  }
  return py::make_tuple(std::move(evaluated), to_python(json));
}

py::object check(const StructurePointer& structure, const std::optional<shell::Surface>& surface,
                 const py::dict& values) {
  const Options given(values);
  bool asks_lammps = false;
  given.set("lammps", asks_lammps);
  const auto named = shell::named_potential(*structure);
  const bool is_given = given.find<std::string>("potential").has_value();
  const shell::PotentialChoice chosen = potential_choice(given);
  shell::CertifyOptions options = {.potential = is_given || !named ? chosen : *named,
                                   .lammps = lammps_options(given, asks_lammps)};
  if (options.lammps) shell::require_lammps(*options.lammps);
  given.set("max_force", options.max_force);
  bool is_open = false;
  given.set("open", is_open);
  if (is_open) options.edge = shell::ShellEdge::allowed;
  given.set("notes", options.notes);
  if (surface) options.surface = surface->mesh;
  shell::Json json;
  {
    const py::gil_scoped_release released;
    json = shell::certify(*structure, options).json();
  }
  return to_python(json);
}

std::vector<std::string> lammps_package(const StructurePointer& structure,
                                        const std::filesystem::path& folder,
                                        const py::dict& values) {
  const Options given(values);
  dual::LammpsPackageOptions options;
  given.set("atom_style", options.data.style, shell::atom_style_names);
  given.set("angles", options.data.angles);
  given.set("digits", options.data.digits, shell::digits_names);
  given.set("atoms_per_file", options.atoms_per_file);
  bool is_packed = false;
  given.set("gzip", is_packed);
  if (is_packed) options.compression = dual::Compression::gzip;
  const shell::LammpsOptions lammps = {.potential_file =
                                           given.find<std::filesystem::path>("potential_file")};
  options.potential_file = shell::find_potential_file(lammps).name;
  const py::gil_scoped_release released;
  dual::Structure written = *structure;
  if (written.bonds.empty() && options.data.style == dual::AtomStyle::molecular) {
    written.bonds = potentials::guess_bonds(written.atoms).bonds;
  }
  const double energy = potentials::rebo(written.atoms).energy;
  std::filesystem::create_directories(folder);
  return dual::write_lammps_package(folder, written, energy, options).files;
}

}  // namespace

void add_relax(py::module_& module) {
  module.def("relax", &relax, py::arg("structure"), py::arg("options"), py::arg("watch"));
  module.def("energy", &energy, py::arg("structure"), py::arg("options"));
  module.def("check", &check, py::arg("structure"), py::arg("surface"), py::arg("options"));
  module.def("lammps_package", &lammps_package, py::arg("structure"), py::arg("folder"),
             py::arg("options"));
}

}  // namespace trivalent::python
