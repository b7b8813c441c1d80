#include "trivalent/shell/plan.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "free_memory.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/tube_ends.h"
#include "trivalent/shell/number_text.h"

namespace trivalent::shell {
namespace {

/// Peak resident memory of whole builds, fitted to 50,000 to 1,000,000 atoms and inputs of 5,000 to
/// 300,000 faces.
double memory_of(double atoms, double input_faces, const dual::WallOptions& walls) {
  constexpr double bytes_of_program = 50e6;
  // AIREBO, under which several walls relax, keeps all neighbors within 11 Å.
  const double bytes_per_atom = walls.count > 1 ? 6000.0 : 2000.0;
  constexpr double bytes_per_input_face = 1500.0;
  return bytes_of_program + bytes_per_atom * atoms + bytes_per_input_face * input_faces;
}

/// How long the search for a net takes [s], of processors of about 3 GHz.
double seconds_of_net(double atoms, const remesh::RemeshMethod& method) {
  constexpr double per_atom_and_iteration = 8e-6;
  if (const auto* paper = std::get_if<remesh::RemeshOptions>(&method)) {
    return atoms * paper->iterations * per_atom_and_iteration;
  }
  const auto& crystal = std::get<remesh::CrystalOptions>(method);
  constexpr double per_vertex_and_round = 5e-6;
  constexpr double per_atom = 2e-4;  // the nets to start from, and the last relaxation
  return per_atom * atoms +
         per_vertex_and_round * remesh::annealing_work(0.5 * atoms, crystal.effort);
}

/// Processor time of whole builds; scripts/bench_forecast.py compares it with what they take.
double seconds_of(double atoms, double input_faces, const remesh::RemeshMethod& method) {
  constexpr double start = 0.8;  // and the distance between the surfaces
  constexpr double per_input_face = 3e-5;
  constexpr double per_atom_and_step = 1e-6;  // of the relaxation
  constexpr double steps_of_crystal = 150.0;
  constexpr double steps_of_paper = 700.0;
  const bool is_paper = std::holds_alternative<remesh::RemeshOptions>(method);
  return start + per_input_face * input_faces + seconds_of_net(atoms, method) +
         per_atom_and_step * (is_paper ? steps_of_paper : steps_of_crystal) * atoms;
}

constexpr double max_atoms = remesh::max_faces;  // an atom per face

/// The smallest supercell of equal multiples that edges fit into.
void find_lattice_obstacles(const remesh::TriMesh& mesh, Plan& plan) {
  const double longest = remesh::longest_edge_in(mesh.lattice);
  if (plan.shell.edge_length <= longest) return;
  const int multiple = static_cast<int>(std::ceil(plan.shell.edge_length / longest));
  const auto times = [&](std::size_t k) {
    return std::to_string(mesh.lattice.periodic()[k] ? multiple : 1);
  };
  plan.obstacles.push_back(
      "the cell is too small for a net of this edge length, which needs four "
      "edges across; build a supercell: --supercell " +
      times(0) + ' ' + times(1) + ' ' + times(2) + " would do");
}

void find_obstacles(const remesh::TriMesh& mesh, const remesh::MeshComponents& components,
                    Plan& plan) {
  if (plan.shell.atoms > max_atoms) {
    plan.obstacles.push_back("about " + significant(plan.shell.atoms) +
                             " atoms would be needed, more than " + significant(max_atoms) +
                             "; make the shell smaller by --atoms, --length or --scale");
  }
  if (plan.free_memory && plan.memory > *plan.free_memory) {
    plan.obstacles.push_back("about " + bytes_text(plan.memory) +
                             " of memory would be needed, but only " +
                             bytes_text(*plan.free_memory) + " are free; ask for fewer atoms");
  }
  if (mesh.lattice.is_periodic()) return find_lattice_obstacles(mesh, plan);
  int too_small = 0;
  const remesh::MeshComponent* narrow = nullptr;
  double longest_of_narrow = plan.shell.edge_length;
  for (const remesh::MeshComponent& part : components.parts) {
    if (remesh::longest_edge_for(part.area, part.is_closed()) < plan.shell.edge_length) {
      ++too_small;
    } else if (const double longest =
                   remesh::longest_edge_along(part.area, part.box.longest_side(), part.is_closed());
               longest < longest_of_narrow) {
      longest_of_narrow = longest;
      narrow = &part;
    }
  }
  if (narrow != nullptr) {
    const double atoms = plan.shell.atoms * std::pow(plan.shell.edge_length / longest_of_narrow, 2);
    plan.obstacles.push_back(
        "a component is " + significant(narrow->box.longest_side()) +
        " long and too narrow for edges of " + significant(plan.shell.edge_length) +
        "; remove points that lie far off, or make the shell larger: " +
        std::to_string(std::llround(std::ceil(atoms))) + " atoms or more would do");
  }
  if (too_small == 0) return;
  if (plan.components == 1) {
    plan.obstacles.push_back(
        "the surface is too small for so few atoms or so long bonds; make the shell larger by "
        "--atoms, --length or --scale");
    return;
  }
  plan.obstacles.push_back(std::to_string(too_small) + " of the " +
                           std::to_string(plan.components) +
                           " components are too small for triangles of that edge length; keep "
                           "--components largest, make the shell larger, or --repair wrap");
}

}  // namespace

Plan plan(const remesh::TriMesh& mesh, const dual::ShellOptions& options) {
  return plan(mesh, remesh::find_components(mesh), options);
}

Plan plan(const remesh::TriMesh& mesh, const remesh::MeshComponents& components,
          const dual::ShellOptions& options) {
  Plan plan;
  plan.shell = dual::estimate_shell(mesh, options);
  plan.memory = memory_of(plan.shell.atoms, static_cast<double>(mesh.n_faces()), options.walls);
  plan.free_memory = shell::free_memory();
  plan.seconds = seconds_of(plan.shell.atoms, static_cast<double>(mesh.n_faces()), options.method);
  constexpr double times_of_tubes = 4.0;  // nets that end in given tubes are ordered more often
  if (remesh::edge_length_of_tubes(mesh)) plan.seconds *= times_of_tubes;
  constexpr double per_atom_of_walls = 4e-3;  // relaxed under AIREBO
  if (options.walls.count > 1) plan.seconds += per_atom_of_walls * plan.shell.atoms;
  plan.components = static_cast<int>(components.parts.size());
  find_obstacles(mesh, components, plan);
  return plan;
}

void Plan::require_feasible() const {
  if (!obstacles.empty()) throw remesh::InvalidMesh("build: " + obstacles.front());
}

Json Plan::json() const {
  return {{"atoms", shell.atoms},
          {"edge_length", shell.edge_length},
          {"scale", shell.scale},
          {"components", components},
          {"memory_bytes", memory},
          {"free_memory_bytes", free_memory ? Json(*free_memory) : Json(nullptr)},
          {"seconds", seconds},
          {"obstacles", obstacles}};
}

std::vector<dual::TableRow> Plan::rows() const {
  std::vector<dual::TableRow> rows = {
      {"a build would make"},
      {"atoms", "about " + decimals(shell.atoms, 0) + " in " + std::to_string(components) +
                    (components == 1 ? " component" : " components")},
      {"triangle edge", significant(shell.edge_length) + " units of the input"},
      {"scale", significant(shell.scale) + " Å per unit"},
      {"memory", "about " + bytes_text(memory) +
                     (free_memory ? " of " + bytes_text(*free_memory) + " free" : "")},
      {"time", "about " + significant(seconds, 1) + " s of processor time"}};
  for (const std::string& obstacle : obstacles) rows.push_back({"cannot be made", obstacle});
  return rows;
}

}  // namespace trivalent::shell
