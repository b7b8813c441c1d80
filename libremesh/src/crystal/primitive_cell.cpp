#include "crystal/primitive_cell.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/geometry.h"
#include "mesh/surface_projector.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_components.h"
#include "trivalent/remesh/offset_surface.h"

namespace trivalent::remesh {

namespace {

/// Tells whether translations map a surface onto itself.
class Repetition {
 public:
  Repetition(const TriMesh& surface, double tolerance)
      : lattice_(surface.lattice), projector_(surface), tolerance_(tolerance) {
    constexpr std::size_t max_samples = 300;
    const std::size_t step = std::max<std::size_t>(1, surface.n_faces() / max_samples);
    for (std::size_t f = 0; f < surface.n_faces(); f += step) {
      const FaceHandle face(static_cast<int>(f));
      samples_.push_back({face_centroid(surface, face), face_normal(surface, face)});
    }
  }

  [[nodiscard]] bool at(const Eigen::Vector3d& translation) const {
    return std::ranges::all_of(samples_, [&](const Sample& sample) {
      const Eigen::Vector3d moved = sample.position + translation;
      const SurfacePoint foot = projector_.nearest(moved);
      constexpr double same_side = 0.7;  // cosine
      return lattice_.nearest(foot.position - moved).norm() <= tolerance_ &&
             projector_.normal(foot).dot(sample.normal) >= same_side;
    });
  }

 private:
  struct Sample {
    Eigen::Vector3d position;
    Eigen::Vector3d normal;
  };
  Lattice lattice_;
  SurfaceProjector projector_;
  double tolerance_;
  std::vector<Sample> samples_;
};

/// Multiples of cell vectors, of which the last that is not zero is 1.
std::vector<Eigen::Vector3i> small_multiples() {
  std::vector<Eigen::Vector3i> all;
  constexpr int n_choices = 27;
  for (int i = 0; i < n_choices; ++i) {
    const Eigen::Vector3i multiples(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    const int last = multiples[2] != 0   ? multiples[2]
                     : multiples[1] != 0 ? multiples[1]
                                         : multiples[0];
    if (last == 1) all.push_back(multiples);
  }
  return all;
}

/// Replaces a cell vector by a half or third of a sum of cell vectors that maps the surface onto
/// itself. The cell stays right-handed.
///
/// @return  False, with nothing done, if there is none.
bool take_translation(Lattice::Cell& cell, const Repetition& repeats) {
  for (const int part : {2, 3}) {
    for (const Eigen::Vector3i& multiples : small_multiples()) {
      const Eigen::Vector3d translation = cell * multiples.cast<double>() / part;
      if (!repeats.at(translation)) continue;
      cell.col(multiples[2] != 0 ? 2 : multiples[1] != 0 ? 1 : 0) = translation;
      return true;
    }
  }
  return false;
}

}  // namespace

Lattice primitive_lattice(const TriMesh& surface, double tolerance) {
  const Repetition repeats(surface, tolerance);
  Lattice::Cell cell = surface.lattice.cell();
  const double smallest = 8.0 * tolerance;  // what repeats itself at less is no crystal
  while (Lattice(cell, surface.lattice.periodic()).shortest() > smallest) {
    if (!take_translation(cell, repeats)) break;
  }
  return Lattice(cell, surface.lattice.periodic()).reduced();
}

std::optional<PrimitiveCell> primitive_cell(const TriMesh& surface, double m) {
  constexpr double tolerance = 0.1;  // [m]
  constexpr double smallest = 5.0;   // [m] shortest translation; patches of a net need some room
  const bool is_crystal = surface.lattice.periodic() == Lattice::Periodic{true, true, true};
  const int euler = euler_characteristic(surface);
  if (!is_crystal || euler >= 0) return std::nullopt;
  const Lattice lattice = primitive_lattice(surface, tolerance * m);
  const auto copies = static_cast<int>(
      std::lround(surface.lattice.cell().determinant() / lattice.cell().determinant()));
  if (copies == 1 || lattice.shortest() < smallest * m) return std::nullopt;
  try {
    PrimitiveCell cell = {surface_in_lattice(surface, lattice), copies};
    // Whoever lost a handle, or is in several parts, is not the same surface.
    if (copies * euler_characteristic(cell.surface) != euler) return std::nullopt;
    return cell;
  } catch (const InvalidMesh&) {
    return std::nullopt;
  }
}

}  // namespace trivalent::remesh
