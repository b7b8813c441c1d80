#include "trivalent/shell/build.h"

#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <iterator>
#include <memory>
#include <span>

#include "build_notes.h"
#include "trivalent/dual/columns.h"
#include "trivalent/dual/energy_summary.h"
#include "trivalent/dual/error.h"
#include "trivalent/potentials/error.h"
#include "trivalent/shell/names.h"
#include "trivalent/shell/plan.h"
#include "trivalent/shell/wall_energies.h"

namespace trivalent::shell {
namespace {

constexpr Names<BuildStep, 4> step_names = {{{"remesh_and_dual", BuildStep::remesh_and_dual},
                                             {"measure", BuildStep::measure},
                                             {"energies", BuildStep::energies},
                                             {"relax", BuildStep::relax}}};

/// The net whose vertices have moved as the atoms around them did on average.
///
/// @param before, after  Positions of the atoms, one per face of the net first.
remesh::TriMesh carried_along(remesh::TriMesh net, std::span<const Eigen::Vector3d> before,
                              std::span<const Eigen::Vector3d> after) {
  for (const auto v : net.vertices()) {
    if (net.is_isolated(v)) continue;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto f : v.faces()) {
      const auto atom = static_cast<std::size_t>(f.idx());
      sum += after[atom] - before[atom];
    }
    net.point(v) += sum / static_cast<double>(net.valence(v) - (v.is_boundary() ? 1U : 0U));
  }
  return net;
}

std::vector<Eigen::Vector3d> deformed(std::vector<Eigen::Vector3d> points,
                                      const Eigen::Matrix3d& deformation) {
  for (Eigen::Vector3d& p : points) p = deformation * p;
  return points;
}

remesh::TriMesh deformed(remesh::TriMesh mesh, const Eigen::Matrix3d& deformation) {
  for (const auto v : mesh.vertices()) mesh.point(v) = deformation * mesh.point(v);
  mesh.lattice = remesh::Lattice(deformation * mesh.lattice.cell(), mesh.lattice.periodic());
  return mesh;
}

/// One build on its way.
class Build {
 public:
  Build(Surface surface, const BuildOptions& options);

  void remesh();
  void measure();
  void evaluate();
  void relax();

  BuildResult result;

 private:
  using Clock = std::chrono::steady_clock;

  void begin(BuildStep step);
  void end(BuildStep step);
  void cap_edges();
  [[nodiscard]] remesh::TriMesh given_wall_of(const remesh::TriMesh& net) const;
  [[nodiscard]] double excess_energy() const;
  [[nodiscard]] std::vector<Eigen::Vector3d> positions_on_original() const;
  void evaluate_input();
  void measure_walls();
  void set_budget(const remesh::TriMesh& net);
  void evaluate_shell();
  [[nodiscard]] dual::ShellState state_of_shell(std::string name) const;

  const BuildOptions& options_;
  std::unique_ptr<potentials::Potential> potential_;
  Surface surface_;
  Eigen::Matrix3d deformation_ = Eigen::Matrix3d::Identity();  // of the cell, by its relaxation
  Clock::time_point last_ = Clock::now();
};

Build::Build(Surface surface, const BuildOptions& options)
    : options_(options), surface_(std::move(surface)) {
  result.potential = options.used_potential();
  if (result.potential.pair_style || !find_potential(result.potential).lammps) {
    throw dual::InvalidOption("build: the potential of a shell is rebo or airebo, not " +
                              result.potential.title());
  }
  potential_ = make_potential(result.potential);
  result.graphene = graphene_reference(result.potential);
  plan(surface_.mesh, options.shell).require_feasible();
  result.notes = std::move(surface_.notes);
  result.input_quality = remesh::measure_quality(surface_.mesh);
}

void Build::begin(BuildStep step) {
  if (options_.on_step) options_.on_step(step);
  last_ = Clock::now();
}

void Build::end(BuildStep step) {
  const double seconds = std::chrono::duration<double>(Clock::now() - last_).count();
  result.seconds.emplace_back(name_of(step, step_names), seconds);
}

void Build::remesh() {
  begin(BuildStep::remesh_and_dual);
  result.shell = dual::build_shell(surface_.mesh, options_.shell);
  std::ranges::move(result.shell.notes, std::back_inserter(result.notes));
  if (result.shell.surface.stopped) {
    result.notes.push_back(stopped_note(result.shell.surface));
    result.stopped = true;
  }
  end(BuildStep::remesh_and_dual);
}

/// Hydrogen belongs to the component of its carbon atom.
void Build::cap_edges() {
  dual::Structure& structure = result.shell.structure;
  result.caps = dual::cap_with_hydrogen(structure);
  auto& component = result.components.of_face;
  component.resize(structure.atoms.size());
  for (const potentials::Bond& bond : structure.bonds) {
    component[bond.second] = component[bond.first];
  }
  result.notes.push_back("capped the edge with " + std::to_string(result.caps.hydrogens) +
                         " hydrogen atoms");
  if (result.caps.bare_atoms > 0) {
    result.notes.push_back(std::to_string(result.caps.bare_atoms) +
                           " atoms without any bond are not capped");
  }
}

/// Of several walls, the one on the given surface.
remesh::TriMesh Build::given_wall_of(const remesh::TriMesh& net) const {
  const std::vector<int>& walls = result.shell.wall_of_atom;
  if (walls.empty()) return net;
  std::vector<std::array<int, 3>> triangles = remesh::triangles_of(net);
  std::size_t face = 0;
  std::erase_if(triangles, [&](const auto&) { return walls[face++] != result.shell.given_wall; });
  remesh::TriMesh wall = remesh::make_mesh({net.points(), net.n_vertices()}, triangles);
  wall.lattice = net.lattice;
  return wall;
}

void Build::measure() {
  begin(BuildStep::measure);
  result.wrap_offset = surface_.wrap_offset * result.shell.scale;
  result.components = remesh::find_components(result.shell.surface.mesh);
  result.original = std::move(surface_.mesh);
  remesh::scale(result.original, result.shell.scale);
  result.quality = remesh::measure_quality(result.shell.surface.mesh);
  result.distance =
      remesh::measure_distance(given_wall_of(result.shell.surface.mesh), result.original);
  result.network = dual::check_network(result.shell.structure);
  result.tube_ends = remesh::find_tube_ends(result.shell.surface.mesh);
  if (options_.cap == EdgeCap::hydrogen) cap_edges();
  end(BuildStep::measure);
}

/// The atoms' positions in the cell of the surface as it came.
std::vector<Eigen::Vector3d> Build::positions_on_original() const {
  const potentials::Atoms& atoms = result.shell.structure.atoms;
  return atoms.box.is_periodic() ? deformed(atoms.positions, deformation_.inverse())
                                 : atoms.positions;
}

dual::ShellState Build::state_of_shell(std::string name) const {
  dual::Structure structure = result.shell.structure;
  if (!result.shell.wall_of_atom.empty()) {
    structure.columns.push_back({.name = dual::wall_column, .values = result.shell.wall_of_atom});
  }
  dual::ShellState state = dual::shell_state(std::move(name), std::move(structure));
  dual::add_energies(state, result.energy.energies, result.graphene);
  if (!result.wall_energies.empty()) {
    state.maps.push_back(dual::wall_energy_map(result.wall_energies));
  }
  state.maps.push_back(
      dual::distance_map("surface_distance", "distance to the input surface",
                         remesh::distances_to_surface(positions_on_original(), result.original)));
  return state;
}

/// Of the carbon atoms above graphene, without what they gain by other walls [eV].
double Build::excess_energy() const {
  const auto& atoms = result.shell.structure.atoms;
  double sum = 0.0;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    if (atoms.species[i] == potentials::Species::carbon) {
      sum += result.energy.energies[i] - result.graphene;
      if (!result.wall_energies.empty()) sum -= result.wall_energies[i];
    }
  }
  return sum;
}

void Build::set_budget(const remesh::TriMesh& net) {
  result.budget = energy_budget(net, excess_energy());
  if (!is_rebo(result.potential)) result.budget.sphere.reset();  // the law is REBO's
}

/// What several walls are like, and what binds them.
void Build::measure_walls() {
  if (result.shell.wall_of_atom.empty()) return;
  dual::Structure structure = result.shell.structure;
  structure.columns = {{.name = dual::wall_column, .values = result.shell.wall_of_atom}};
  result.walls = dual::check_walls(structure);
  result.wall_energies = wall_energies(structure, result.energy.energies, *potential_);
}

void Build::evaluate_shell() {
  try {
    result.energy = potential_->evaluate(result.shell.structure.atoms);
  } catch (const potentials::InvalidAtoms& error) {
    throw potentials::InvalidAtoms(potentials::concat(
        "build: the shell meets itself (", error.what(),
        "); repair the mesh there, or put a new surface around it: --repair wrap"));
  }
  measure_walls();
  result.after = state_of_shell("shell");
  set_budget(result.shell.surface.mesh);
}

/// The dual of the surface as it came, at the same mean bond. Such a dual may be beyond any
/// potential (atoms on top of each other); that is a finding, not a failure of the build.
void Build::evaluate_input() {
  try {
    remesh::TriMesh original = result.original;
    remesh::scale(original,
                  dual::scale_for_size(original, dual::MeanBond{result.network.bond_mean}));
    dual::ShellState state = dual::shell_state("dual of the input", dual::build_dual(original));
    dual::add_energies(state, potential_->evaluate(state.structure.atoms).energies,
                       result.graphene);
    result.before = std::move(state);
  } catch (const dual::InvalidNetwork& error) {
    result.notes.push_back(std::string("the input has no dual to compare with: ") + error.what());
  } catch (const potentials::InvalidAtoms& error) {
    result.notes.push_back(std::string("the input's dual has no energy: ") + error.what());
  }
}

void Build::evaluate() {
  begin(BuildStep::energies);
  evaluate_shell();
  if (result.stopped) {
    result.notes.emplace_back("stopped: the dual of the input was not evaluated");
  } else if (result.walls.empty()) {
    evaluate_input();
  }
  end(BuildStep::energies);
  note_misses(dual::size_of(result.original, options_.shell), result);
  note_findings(result);
}

/// Brings the atoms of the shell to rest under the potential. A stop keeps them where they have
/// come.
void Build::relax() {
  begin(BuildStep::relax);
  dual::Structure& structure = result.shell.structure;
  const auto on_progress = [&](const potentials::RelaxProgress& state) {
    const bool goes_on = !options_.on_relax || options_.on_relax(state);
    result.stopped = result.stopped || !goes_on;
    return goes_on;
  };
  result.relaxed = potentials::relax(structure.atoms, *potential_,
                                     {.max_steps = options_.max_relaxation_steps,
                                      .box = options_.box,
                                      .bonds = structure.bonds,
                                      .on_progress = on_progress});
  const potentials::Box& box = result.relaxed->atoms.box;
  if (box.is_periodic()) deformation_ = box.cell * structure.atoms.box.cell.inverse();
  // What the cell does is no displacement.
  const std::vector<Eigen::Vector3d> before =
      box.is_periodic() ? deformed(structure.atoms.positions, deformation_)
                        : structure.atoms.positions;
  result.unrelaxed = std::move(result.after);
  result.unrelaxed->name = "dual, not relaxed";
  result.relaxation = report_relaxation(before, structure.bonds, *result.relaxed);
  for (std::string& note : relax_notes(result.relaxation, *result.relaxed)) {
    result.notes.push_back(std::move(note));
  }
  structure.atoms = result.relaxed->atoms;
  result.network = dual::check_network(dual::without_hydrogen(structure));
  result.energy = result.relaxed->result;
  measure_walls();
  result.after = state_of_shell("relaxed shell");
  result.after.maps.push_back(dual::displacement_map(before, structure.atoms.positions));
  const remesh::TriMesh start = box.is_periodic()
                                    ? deformed(result.shell.surface.mesh, deformation_)
                                    : result.shell.surface.mesh;
  const remesh::TriMesh net = carried_along(start, before, structure.atoms.positions);
  if (!result.stopped) {
    const remesh::TriMesh surface =
        box.is_periodic() ? deformed(result.original, deformation_) : result.original;
    result.distance_at_rest = remesh::measure_distance(given_wall_of(net), surface);
  }
  set_budget(net);
  end(BuildStep::relax);
}

}  // namespace

BuildResult build(Surface surface, const BuildOptions& options) {
  Build build(std::move(surface), options);
  build.remesh();
  build.measure();
  build.evaluate();
  if (options.relaxation == Relaxation::at_rest) build.relax();
  return std::move(build.result);
}

std::string stopped_note(const remesh::RemeshResult& net) {
  return "stopped after " + std::to_string(net.iterations) +
         " rounds, as asked; this is the best net so far";
}

dual::Structure BuildResult::structure() const {
  dual::Structure structure = shell.structure;
  structure.columns = dual::network_columns(structure);
  if (!shell.wall_of_atom.empty()) {
    structure.columns.push_back({.name = dual::wall_column, .values = shell.wall_of_atom});
  }
  structure.columns.push_back({.name = "component", .values = components.of_face});
  dual::add_energies(structure, energy);
  set_potential(structure, potential.title());
  if (unrelaxed) dual::add_displacements(structure, unrelaxed->structure.atoms.positions);
  return structure;
}

}  // namespace trivalent::shell
