#include "trivalent/shell/plan.h"

#include <nlohmann/json.hpp>

#include "free_memory.h"
#include "trivalent/remesh/error.h"
#include "trivalent/shell/number_text.h"

namespace trivalent::shell {
namespace {

/// Peak resident memory of whole builds, fitted to 50,000 to 1,000,000 atoms and inputs of 5,000 to
/// 300,000 faces.
double memory_of(double atoms, double input_faces) {
  constexpr double bytes_of_program = 50e6;
  constexpr double bytes_per_atom = 2000.0;
  constexpr double bytes_per_input_face = 1500.0;
  return bytes_of_program + bytes_per_atom * atoms + bytes_per_input_face * input_faces;
}

/// Wall time on two processors of about 3 GHz.
double seconds_of(double atoms, const remesh::RemeshMethod& method) {
  constexpr double seconds_per_atom_and_iteration = 4e-6;
  if (const auto* paper = std::get_if<remesh::RemeshOptions>(&method)) {
    return atoms * paper->iterations * seconds_per_atom_and_iteration;
  }
  constexpr double seconds_per_atom = 1e-3;
  return atoms * seconds_per_atom *
         remesh::effort_factor(std::get<remesh::CrystalOptions>(method).effort);
}

/// An atom more would not have an index.
constexpr double max_atoms = 2e7;

void find_obstacles(const remesh::MeshComponents& components, Plan& plan) {
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
  int too_small = 0;
  const remesh::MeshComponent* too_narrow = nullptr;
  for (const remesh::MeshComponent& part : components.parts) {
    if (remesh::longest_edge_for(part.area, part.is_closed()) < plan.shell.edge_length) {
      ++too_small;
    } else if (remesh::longest_edge_along(part.area, part.box.longest_side()) <
               plan.shell.edge_length) {
      too_narrow = too_narrow == nullptr ? &part : too_narrow;
    }
  }
  if (too_narrow != nullptr) {
    plan.obstacles.push_back("a component is " + significant(too_narrow->box.longest_side()) +
                             " long and too narrow for edges of " +
                             significant(plan.shell.edge_length) +
                             "; remove points that lie far off, or make the shell larger");
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
  plan.memory = memory_of(plan.shell.atoms, static_cast<double>(mesh.n_faces()));
  plan.free_memory = shell::free_memory();
  plan.seconds = seconds_of(plan.shell.atoms, options.method);
  plan.components = static_cast<int>(components.parts.size());
  find_obstacles(components, plan);
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
      {"time", "about " + significant(seconds, 1) + " s"}};
  for (const std::string& obstacle : obstacles) rows.push_back({"cannot be made", obstacle});
  return rows;
}

}  // namespace trivalent::shell
