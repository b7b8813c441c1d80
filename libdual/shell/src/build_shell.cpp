#include "trivalent/shell/build_shell.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "trivalent/dual/error.h"
#include "trivalent/remesh/error.h"

namespace trivalent::dual {
namespace {

using remesh::TriMesh;

void check_options(const TriMesh& mesh, const ShellOptions& options) {
  if (mesh.n_faces() == 0) throw InvalidNetwork("build_shell: the mesh has no faces");
  if (!std::isfinite(options.bond) || options.bond <= 0.0) {
    throw InvalidOption(
        concat("build_shell: the bond length must be > 0 and finite, but is ", options.bond));
  }
  // The icosahedron's dual, C20, is the smallest fullerene.
  constexpr int min_atoms = 20;
  const auto* count = std::get_if<AtomCount>(&options.size);
  if (count != nullptr && count->atoms < min_atoms) {
    throw InvalidOption(
        concat("build_shell: a shell needs at least ", min_atoms, " atoms, not ", count->atoms));
  }
}

/// The method, with nets left where carbon is nearly at rest.
remesh::RemeshMethod method_at_rest(remesh::RemeshMethod method) {
  auto* crystal = std::get_if<remesh::CrystalOptions>(&method);
  if (crystal != nullptr) crystal->rest = remesh::NetRest::in_space;
  return method;
}

/// The method for a net with so many faces.
remesh::RemeshMethod with_faces(remesh::RemeshMethod method, double faces) {
  auto* crystal = std::get_if<remesh::CrystalOptions>(&method);
  if (crystal != nullptr) crystal->wanted_faces = faces;
  return method;
}

/// [Å per unit of the mesh], where the size says it.
double given_scale(const TriMesh& mesh, const ShellSize& size) {
  const auto* side = std::get_if<LongestSide>(&size);
  return side != nullptr ? scale_for_size(mesh, *side)
                         : scale_for_size(mesh, std::get<Scale>(size));
}

/// Remeshings that usually meet a number of atoms. The search for a crystal meets it by itself; the
/// paper's loop finds the edge length for a second one.
int usual_remeshings(const remesh::RemeshMethod& method) {
  return std::holds_alternative<remesh::CrystalOptions>(method) ? 1 : 2;
}

/// Counts the progress of several remeshings as one.
class SharedProgress {
 public:
  explicit SharedProgress(const remesh::RemeshMethod& method) : method_(method) {}

  /// The method for the next remeshing. It refers to this object.
  [[nodiscard]] remesh::RemeshMethod next() {
    remesh::RemeshMethod method = method_;
    const auto count = [this, done = done_](remesh::RemeshProgress state) {
      const int per_remeshing = state.iterations;
      state.iteration += done * per_remeshing;
      state.iterations = per_remeshing * std::max(usual_remeshings(method_), done + 1);
      report(state);
    };
    std::visit(
        [&](auto& options) {
          if (options.on_progress) options.on_progress = count;
        },
        method);
    ++done_;
    return method;
  }

  /// Reports the end, if fewer remeshings than usual were enough.
  void finish() {
    if (!last_ || last_->iteration >= last_->iterations) return;
    last_->iterations = last_->iteration;
    report(*last_);
  }

 private:
  void report(const remesh::RemeshProgress& state) {
    last_ = state;
    std::visit([&](const auto& options) { options.on_progress(state); }, method_);
  }

  const remesh::RemeshMethod& method_;
  int done_ = 0;
  std::optional<remesh::RemeshProgress> last_;
};

void fit_scale(const TriMesh& mesh, const ShellOptions& options, Shell& shell) {
  shell.scale = given_scale(mesh, options.size);
  shell.target_edge_length = edge_length_for_bond(options.bond) / shell.scale;
  shell.surface = remesh::remesh_by(mesh, method_at_rest(options.method), shell.target_edge_length);
  shell.remeshings = 1;
}

void fit_atom_count(const TriMesh& mesh, const ShellOptions& options, int atoms, Shell& shell) {
  // Edges come out a little off their target, and chords of a curved surface cut its area.
  constexpr int max_remeshings = 3;
  double target = std::sqrt(remesh::surface_area(mesh) / (remesh::unit_triangle_area * atoms));
  SharedProgress progress(options.method);
  double smallest_miss = std::numeric_limits<double>::infinity();
  while (true) {
    remesh::RemeshResult surface;
    try {
      surface = remesh::remesh_by(mesh, with_faces(method_at_rest(progress.next()), atoms), target);
    } catch (const remesh::InvalidOption&) {
      if (shell.remeshings == 0) throw;
      break;  // the corrected length is more than a part can hold
    }
    ++shell.remeshings;
    const bool stopped = surface.stopped;
    const double ratio = static_cast<double>(surface.mesh.n_faces()) / atoms;
    const double miss = std::abs(ratio - 1.0);
    // Where a part of the surface is lost at one length and kept at the next, the last is not best.
    if (miss < smallest_miss) {
      smallest_miss = miss;
      shell.surface = std::move(surface);
      shell.target_edge_length = target;
    }
    shell.surface.stopped = stopped;
    if (miss <= atom_count_tolerance || shell.remeshings == max_remeshings || stopped) break;
    target *= std::sqrt(ratio);
  }
  progress.finish();
  shell.scale = scale_for_size(shell.surface.mesh, MeanBond{options.bond});
}

}  // namespace

ShellEstimate estimate_shell(const TriMesh& mesh, const ShellOptions& options) {
  check_options(mesh, options);
  const double area = remesh::surface_area(mesh);
  if (!(area > 0.0) || !std::isfinite(area)) {
    throw InvalidNetwork(concat("estimate_shell: the mesh has the area ", area,
                                "; scale it to ordinary numbers, or remove flat parts"));
  }
  ShellEstimate estimate;
  if (const auto* count = std::get_if<AtomCount>(&options.size)) {
    estimate.atoms = count->atoms;
    estimate.edge_length = std::sqrt(area / (remesh::unit_triangle_area * estimate.atoms));
    estimate.scale = edge_length_for_bond(options.bond) / estimate.edge_length;
  } else {
    estimate.scale = given_scale(mesh, options.size);
    estimate.edge_length = edge_length_for_bond(options.bond) / estimate.scale;
    estimate.atoms =
        area / (remesh::unit_triangle_area * estimate.edge_length * estimate.edge_length);
  }
  return estimate;
}

Shell build_shell(const TriMesh& mesh, const ShellOptions& options) {
  check_options(mesh, options);
  Shell shell;
  if (const auto* count = std::get_if<AtomCount>(&options.size)) {
    fit_atom_count(mesh, options, count->atoms, shell);
  } else {
    fit_scale(mesh, options, shell);
  }
  remesh::scale(shell.surface.mesh, shell.scale);
  shell.structure = build_dual(shell.surface.mesh);
  return shell;
}

}  // namespace trivalent::dual
