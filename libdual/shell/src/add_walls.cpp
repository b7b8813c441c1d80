#include "add_walls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "trivalent/dual/error.h"
#include "trivalent/dual/walls.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_components.h"
#include "trivalent/remesh/mesh_quality.h"
#include "trivalent/remesh/offset_surface.h"
#include "trivalent/remesh/surface_shape.h"

namespace trivalent::dual {
namespace {

using remesh::TriMesh;

/// A facet moved inwards shrinks, one moved outwards is joined to the next by a rounded corner:
/// mean radii of faceted cages change by more and by less than the offset. By these factors of it,
/// onions of 5,000 atoms at rest under AIREBO have the spacing.
constexpr double outward_factor = 1.008;
constexpr double inward_factor = 0.95;

double sign_of(WallSide side) { return side == WallSide::outwards ? 1.0 : -1.0; }

/// Components of a surface that are large enough for cages, and how many are not.
struct Kept {
  TriMesh mesh;
  int components = 0;
  int left_out = 0;
};

Kept without_crumbs(const TriMesh& surface) {
  constexpr double radius_of_c60 = 3.55;  // [Å]
  constexpr double min_area = 4.0 * std::numbers::pi * radius_of_c60 * radius_of_c60;
  const remesh::MeshComponents components = remesh::find_components(surface);
  const auto is_large = [&](int part) {
    return components.parts[static_cast<std::size_t>(part)].area >= min_area;
  };
  std::vector<std::array<int, 3>> triangles = remesh::triangles_of(surface);
  std::size_t face = 0;
  std::erase_if(triangles, [&](const auto&) { return !is_large(components.of_face[face++]); });
  std::vector<int> new_index(surface.n_vertices(), -1);
  std::vector<Eigen::Vector3d> points;
  for (auto& triangle : triangles) {
    for (int& corner : triangle) {
      int& number = new_index[static_cast<std::size_t>(corner)];
      if (number < 0) {
        number = static_cast<int>(points.size());
        points.push_back(surface.point(remesh::VertexHandle(corner)));
      }
      corner = number;
    }
  }
  Kept kept{.mesh = remesh::make_mesh(points, triangles)};
  kept.mesh.lattice = surface.lattice;
  for (const remesh::MeshComponent& part : components.parts) {
    ++(part.area >= min_area ? kept.components : kept.left_out);
  }
  return kept;
}

TriMesh joined(const std::vector<TriMesh>& meshes) {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  for (const TriMesh& mesh : meshes) {
    const int first = static_cast<int>(points.size());
    points.insert(points.end(), mesh.points(), mesh.points() + mesh.n_vertices());
    for (std::array<int, 3> triangle : remesh::triangles_of(mesh)) {
      for (int& corner : triangle) corner += first;
      triangles.push_back(triangle);
    }
  }
  TriMesh all = remesh::make_mesh(points, triangles);
  all.lattice = meshes.front().lattice;
  return all;
}

/// Walls of a shell, made one after the other.
class Walls {
 public:
  /// @param given  The surface of the first wall [Å].
  Walls(Shell& shell, TriMesh given, const WallOptions& options)
      : shell_(shell), options_(options), given_(std::move(given)) {
    is_open_ = std::ranges::any_of(given_.edges(), [](const auto e) { return e.is_boundary(); });
    nets_.push_back(std::move(shell.surface.mesh));
  }

  /// The surface of the next wall.
  TriMesh next_surface() {
    const TriMesh& last = nets_.back();
    std::optional<TriMesh> offset;
    try {
      offset = is_open_ ? next_sheet() : beside(last);
    } catch (const remesh::InvalidMesh&) {
      refuse("nothing is left of the surface for another, or it would touch itself");
    }
    Kept kept = without_crumbs(*offset);
    if (kept.components == 0) refuse("what is left of the surface is smaller than C60");
    if (options_.side == WallSide::outwards &&
        euler_characteristic(kept.mesh) != euler_characteristic(last)) {
      refuse("another would merge across a gap or a hole of the shape");
    }
    left_out_.resize(nets_.size() + 1, 0);
    left_out_.back() = kept.left_out;
    return std::move(kept.mesh);
  }

  /// How many faces a net of the next surface needs to be at rest: as many more as the area grows.
  /// A net has more than fit its own area, as it cuts off what is curved between its vertices.
  [[nodiscard]] double faces_on(const TriMesh& surface, double edge_length) const {
    const TriMesh& last = nets_.back();
    const double face_area = remesh::unit_triangle_area * edge_length * edge_length;
    const double growth = remesh::surface_area(surface) - remesh::surface_area(last);
    return static_cast<double>(last.n_faces()) + growth / face_area;
  }

  void add(remesh::RemeshResult net) {
    nets_.push_back(std::move(net.mesh));
    shell_.surface.iterations += net.iterations;
    shell_.surface.stopped = shell_.surface.stopped || net.stopped;
    shell_.remeshings += 1;
  }

  [[nodiscard]] const TriMesh& last() const { return nets_.back(); }

  void stopped() { shell_.surface.stopped = true; }

  [[nodiscard]] bool is_complete() const {
    return nets_.size() == static_cast<std::size_t>(options_.count) || shell_.surface.stopped;
  }

  /// Puts all nets into the shell, the innermost first.
  void finish() {
    const int n = static_cast<int>(nets_.size());
    if (n < options_.count) {
      shell_.notes.push_back(concat("stopped: ", n, " of ", options_.count, " walls were made"));
    }
    left_out_.resize(nets_.size(), 0);
    if (options_.side == WallSide::inwards) {
      std::ranges::reverse(nets_);
      std::ranges::reverse(left_out_);
    }
    shell_.given_wall = options_.side == WallSide::inwards ? n - 1 : 0;
    for (int wall = 0; wall < n; ++wall) {
      const std::size_t faces = nets_[static_cast<std::size_t>(wall)].n_faces();
      if (const int parts = left_out_[static_cast<std::size_t>(wall)]; parts > 0) {
        shell_.notes.push_back(concat("wall ", wall + 1, ": ", parts, " part",
                                      parts == 1 ? " is" : "s are", " too narrow, and left out"));
      }
      shell_.wall_of_atom.insert(shell_.wall_of_atom.end(), faces, wall);
    }
    shell_.surface.mesh = joined(nets_);
    const remesh::MeshQuality quality = remesh::measure_quality(shell_.surface.mesh);
    shell_.surface.relative_spread = quality.edge_length.relative();
    shell_.surface.regular_fraction = quality.regular_fraction;
  }

 private:
  /// The surface beside a net.
  [[nodiscard]] TriMesh beside(const TriMesh& last) const {
    const double factor = options_.side == WallSide::outwards ? outward_factor : -inward_factor;
    // Triangles half as long as the net's look smooth to the next net.
    const double edge_length =
        std::min(0.5 * remesh::mean_edge_length(last), 0.5 * options_.spacing);
    return remesh::offset_surface(last, factor * options_.spacing, edge_length);
  }

  /// Nets with an edge lie on their surface, so that all walls are offsets of the given one.
  [[nodiscard]] TriMesh next_sheet() const {
    const double distance = sign_of(options_.side) * options_.spacing;
    return remesh::offset_surface(given_, static_cast<double>(nets_.size()) * distance,
                                  remesh::mean_edge_length(given_));
  }

  [[noreturn]] void refuse(const std::string& reason) const {
    const std::size_t n = nets_.size();
    throw remesh::InvalidMesh(
        concat("build: only ", n, n == 1 ? " wall fits " : " walls fit ", options_.spacing,
               " Å apart ", options_.side == WallSide::inwards ? "inwards" : "outwards", ": ",
               reason, "; ask for --walls ", n, ", another side, or a larger shell"));
  }

  Shell& shell_;
  const WallOptions& options_;
  TriMesh given_;
  bool is_open_ = false;       // whether it has a boundary
  std::vector<TriMesh> nets_;  // in the order of their making [Å]
  std::vector<int> left_out_;  // parts of each surface
};

}  // namespace

void check_wall_options(const WallOptions& walls) {
  if (walls.count < 1 || walls.count > max_walls) {
    throw InvalidOption(concat("build_shell: the number of walls must be 1 to ", max_walls,
                               ", but is ", walls.count));
  }
  if (!std::isfinite(walls.spacing) || walls.spacing <= 0.0) {
    throw InvalidOption(
        concat("build_shell: the spacing of walls must be > 0 and finite, but is ", walls.spacing));
  }
}

std::vector<double> areas_of_walls(const TriMesh& mesh, double scale, const WallOptions& walls) {
  const double area = remesh::surface_area(mesh) * scale * scale;
  if (walls.count == 1) return {area};
  const double bend = remesh::mean_curvature_integral(mesh) * scale;
  const double gauss = remesh::gauss_curvature_integral(mesh);
  const double step = sign_of(walls.side) * walls.spacing;
  std::vector<double> areas;
  for (int wall = 0; wall < walls.count; ++wall) {
    const double distance = wall * step;
    // Past its least the parabola rises again, where a sphere would be turned inside out.
    const bool is_inside_out = bend + gauss * distance < 0.0 && bend > 0.0;
    const double offset = area + 2.0 * bend * distance + gauss * distance * distance;
    areas.push_back(is_inside_out ? 0.0 : std::max(0.0, offset));
  }
  return areas;
}

double scale_for_area(const TriMesh& mesh, double area, const WallOptions& walls) {
  const auto total = [&](double scale) {
    double sum = 0.0;
    for (const double each : areas_of_walls(mesh, scale, walls)) sum += each;
    return sum;
  };
  double high = std::sqrt(area / remesh::surface_area(mesh));
  while (total(high) < area) high *= 2.0;
  double low = 0.0;
  constexpr int halvings = 60;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (total(middle) < area ? low : high) = middle;
  }
  return high;
}

void add_walls(Shell& shell, TriMesh given, const WallOptions& options, const NetMaker& maker) {
  Walls walls(shell, std::move(given), options);
  while (!walls.is_complete()) {
    const TriMesh surface = walls.next_surface();
    try {
      walls.add(maker.make(surface, walls.last(), walls.faces_on(surface, maker.edge_length)));
    } catch (const remesh::Stopped&) {
      walls.stopped();
    }
  }
  walls.finish();
}

}  // namespace trivalent::dual
