#include "trivalent/shell/build_shell.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "add_walls.h"
#include "trivalent/dual/energy_summary.h"
#include "trivalent/dual/error.h"
#include "trivalent/potentials/error.h"
#include "trivalent/potentials/rebo.h"
#include "trivalent/potentials/relax.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/tube_ends.h"

namespace trivalent::dual {
namespace {

using remesh::TriMesh;

constexpr int min_atoms = 20;  // of the icosahedron's dual, the smallest fullerene

void check_options(const TriMesh& mesh, const ShellOptions& options) {
  if (mesh.n_faces() == 0) throw InvalidNetwork("build_shell: the mesh has no faces");
  if (!std::isfinite(options.bond) || options.bond <= 0.0) {
    throw InvalidOption(
        concat("build_shell: the bond length must be > 0 and finite, but is ", options.bond));
  }
  check_wall_options(options.walls);
  if (!options.size) return;
  const auto* count = std::get_if<AtomCount>(&*options.size);
  if (count != nullptr && count->atoms < min_atoms) {
    throw InvalidOption(
        concat("build_shell: a shell needs at least ", min_atoms, " atoms, not ", count->atoms));
  }
}

/// @throws InvalidOption  if the surface is to end in tubes that the options have no net for.
void check_tubes(const TriMesh& mesh, const ShellOptions& options) {
  if (!remesh::edge_length_of_tubes(mesh)) return;
  if (!std::holds_alternative<remesh::CrystalOptions>(options.method)) {
    throw InvalidOption(
        "build_shell: only nets of the crystal method end in tubes of given indices");
  }
  if (options.walls.count > 1) {
    throw InvalidOption("build_shell: tubes of given indices are ends of one wall, not of several");
  }
  if (options.size && !std::holds_alternative<Scale>(*options.size)) {
    throw InvalidOption(
        "build_shell: the chiral indices of the arms set the size; leave out the number of atoms "
        "and the length");
  }
}

/// Energy of a net's atoms at rest above that of graphene, under REBO [eV]; infinite if they have
/// none.
double excess_at_rest(TriMesh net, double bond) {
  try {
    remesh::scale(net, scale_for_size(net, MeanBond{bond}));
    const Structure structure = build_dual(net);
    const bool is_periodic = structure.atoms.box.is_periodic();
    constexpr double at_rest = 0.02;  // [eV/Å]
    constexpr int max_steps = 1000;
    potentials::Rebo rebo;
    const double energy =
        potentials::relax(structure.atoms, rebo,
                          {.max_force = at_rest,
                           .max_steps = max_steps,
                           .box = is_periodic ? potentials::BoxPolicy::pressure_free
                                              : potentials::BoxPolicy::fixed,
                           .bonds = structure.bonds})
            .result.energy;
    return energy - graphene_energy * static_cast<double>(structure.atoms.size());
  } catch (const potentials::InvalidAtoms&) {
  } catch (const InvalidNetwork&) {
  }
  return std::numeric_limits<double>::infinity();
}

/// The method, with nets left where carbon is nearly at rest; of several, that of the least energy.
remesh::RemeshMethod method_at_rest(const ShellOptions& options) {
  remesh::RemeshMethod method = options.method;
  auto* crystal = std::get_if<remesh::CrystalOptions>(&method);
  if (crystal != nullptr) {
    crystal->rest = remesh::NetRest::in_space;
    crystal->energy = [bond = options.bond](const TriMesh& net) {
      return excess_at_rest(net, bond);
    };
  }
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

/// The method for the net of a further wall.
remesh::RemeshMethod method_of_wall(remesh::RemeshMethod method) {
  // Graphite's layers hold a vertex, that is two atoms of 2.6 Å² each, with 0.36 eV/Å² (c33 = 36.5
  // GPa over 3.35 Å [Blakslee1970]), and more once they come nearer. On onions of 5,000 atoms, half
  // of that lets walls come within 2.1 Å; three times that leaves scars of pairs on the outer ones.
  constexpr double stiffness = 0.5;  // [eV/Å²]
  auto* crystal = std::get_if<remesh::CrystalOptions>(&method);
  if (crystal != nullptr) {
    crystal->stiffness = stiffness;
    crystal->energy = {};  // which does not know the wall before
  }
  // Facets of the net before are no creases.
  std::visit([](auto& options) { options.feature_angle.reset(); }, method);
  return method;
}

/// Counts the progress of the nets of several walls as one.
remesh::RemeshMethod with_shared_progress(remesh::RemeshMethod method, int wall, int walls) {
  std::visit(
      [&](auto& options) {
        if (!options.on_progress) return;
        options.on_progress = [=, report = options.on_progress](remesh::RemeshProgress state) {
          state.iteration += wall * state.iterations;
          state.iterations *= walls;
          report(state);
        };
      },
      method);
  return method;
}

void fit_scale(const TriMesh& mesh, const ShellOptions& options, Shell& shell) {
  shell.scale = given_scale(mesh, *options.size);
  shell.target_edge_length = edge_length_for_bond(options.bond) / shell.scale;
  shell.surface = remesh::remesh_by(mesh, method_at_rest(options), shell.target_edge_length);
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
      ShellOptions next = options;
      next.method = progress.next();
      surface = remesh::remesh_by(mesh, with_faces(method_at_rest(next), atoms), target);
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

/// How many of the atoms belong to the wall on the given surface.
int atoms_of_given_wall(const TriMesh& mesh, const ShellOptions& options, const AtomCount& all) {
  if (options.walls.count == 1) return all.atoms;
  const double scale = estimate_shell(mesh, options).scale;
  const std::vector<double> areas = areas_of_walls(mesh, scale, options.walls);
  const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
  return std::max(min_atoms, static_cast<int>(std::lround(all.atoms * areas.front() / total)));
}

}  // namespace

ShellSize size_of(const TriMesh& surface, const ShellOptions& options) {
  if (options.size) return *options.size;
  const std::optional<double> edge_length = remesh::edge_length_of_tubes(surface);
  if (edge_length) return Scale{edge_length_for_bond(options.bond) / *edge_length};
  return AtomCount{};
}

ShellEstimate estimate_shell(const TriMesh& mesh, const ShellOptions& options) {
  check_options(mesh, options);
  const ShellSize size = size_of(mesh, options);
  const double area = remesh::surface_area(mesh);
  if (!(area > 0.0) || !std::isfinite(area)) {
    throw InvalidNetwork(concat("estimate_shell: the mesh has the area ", area,
                                "; scale it to ordinary numbers, or remove flat parts"));
  }
  ShellEstimate estimate;
  const double edge_length = edge_length_for_bond(options.bond);
  const double area_per_atom = remesh::unit_triangle_area * edge_length * edge_length;
  if (const auto* count = std::get_if<AtomCount>(&size)) {
    estimate.atoms = count->atoms;
    estimate.scale = scale_for_area(mesh, area_per_atom * count->atoms, options.walls);
  } else {
    estimate.scale = given_scale(mesh, size);
    for (const double each : areas_of_walls(mesh, estimate.scale, options.walls)) {
      estimate.atoms += each / area_per_atom;
    }
  }
  estimate.edge_length = edge_length / estimate.scale;
  return estimate;
}

Shell build_shell(const TriMesh& mesh, const ShellOptions& options) {
  check_options(mesh, options);
  check_tubes(mesh, options);
  const ShellSize size = size_of(mesh, options);
  ShellOptions first = options;
  first.size = size;
  first.walls.count = 1;
  first.method = with_shared_progress(options.method, 0, options.walls.count);
  Shell shell;
  if (const auto* count = std::get_if<AtomCount>(&size)) {
    fit_atom_count(mesh, first, atoms_of_given_wall(mesh, options, *count), shell);
  } else {
    fit_scale(mesh, first, shell);
  }
  remesh::scale(shell.surface.mesh, shell.scale);
  if (options.walls.count > 1) {
    int wall = 0;
    const double edge_length = edge_length_for_bond(options.bond);
    const auto make_net = [&](const TriMesh& surface, const TriMesh& beside, double faces) {
      remesh::RemeshMethod method = with_shared_progress(
          with_faces(method_of_wall(method_at_rest(options)), faces), ++wall, options.walls.count);
      if (auto* crystal = std::get_if<remesh::CrystalOptions>(&method)) crystal->beside = &beside;
      return remesh::remesh_by(surface, method, edge_length);
    };
    TriMesh given = mesh;
    remesh::scale(given, shell.scale);
    add_walls(shell, std::move(given), options.walls,
              {.edge_length = edge_length, .make = make_net});
  }
  shell.structure = build_dual(shell.surface.mesh);
  return shell;
}

}  // namespace trivalent::dual
