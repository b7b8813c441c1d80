#include "trivalent/dual/build_shell.h"

#include <cmath>

#include "trivalent/dual/error.h"

namespace trivalent::dual {
namespace {

using remesh::TriMesh;

/// Edge length of n equilateral triangles that together have the area of the mesh.
double edge_length_for_faces(const TriMesh& mesh, int n) {
  return std::sqrt(4.0 * remesh::surface_area(mesh) / (std::sqrt(3.0) * n));
}

/// Remeshes to a target edge length in the unit of the mesh.
void remesh_to(const TriMesh& mesh, const ShellOptions& options, double target, Shell& shell) {
  remesh::RemeshOptions remesh_options = options.remesh;
  remesh_options.target_edge_length = target;
  shell.surface = remesh::remesh(mesh, remesh_options);
  shell.target_edge_length = target;
  ++shell.remeshings;
}

void fit_scale(const TriMesh& mesh, const ShellOptions& options, const DualSize& size,
               Shell& shell) {
  shell.scale = scale_for_size(mesh, size);
  remesh_to(mesh, options, edge_length_for_bond(options.bond) / shell.scale, shell);
}

void fit_atom_count(const TriMesh& mesh, const ShellOptions& options, int atoms, Shell& shell) {
  // The icosahedron's dual, C20, is the smallest fullerene.
  constexpr int fewest_atoms = 20;
  if (atoms < fewest_atoms) {
    throw InvalidOption(
        concat("build_shell: a shell needs at least ", fewest_atoms, " atoms, not ", atoms));
  }
  // Edges come out a little off their target, and chords of a curved surface cut its area.
  constexpr int most_remeshings = 3;
  constexpr double tolerance = 0.02;
  double target = edge_length_for_faces(mesh, atoms);
  while (true) {
    remesh_to(mesh, options, target, shell);
    const double ratio = static_cast<double>(shell.surface.mesh.n_faces()) / atoms;
    if (std::abs(ratio - 1.0) <= tolerance || shell.remeshings == most_remeshings) break;
    target *= std::sqrt(ratio);
  }
  shell.scale = scale_for_size(shell.surface.mesh, MeanBond{options.bond});
}

}  // namespace

Shell build_shell(const TriMesh& mesh, const ShellOptions& options) {
  if (!std::isfinite(options.bond) || options.bond <= 0.0) {
    throw InvalidOption(
        concat("build_shell: the bond length must be > 0 and finite, but is ", options.bond));
  }
  if (mesh.n_faces() == 0) throw remesh::InvalidMesh("build_shell: the mesh has no faces");
  Shell shell;
  if (const auto* count = std::get_if<AtomCount>(&options.size)) {
    fit_atom_count(mesh, options, count->atoms, shell);
  } else if (const auto* side = std::get_if<LongestSide>(&options.size)) {
    fit_scale(mesh, options, *side, shell);
  } else {
    fit_scale(mesh, options, std::get<Scale>(options.size), shell);
  }
  remesh::scale(shell.surface.mesh, shell.scale);
  shell.network = build_dual(shell.surface.mesh);
  return shell;
}

}  // namespace trivalent::dual
