#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "ideal_edges.h"
#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/error.h"
#include "trivalent/dual/graphene.h"
#include "trivalent/dual/ideal_structures.h"
#include "trivalent/remesh/shapes.h"

namespace trivalent::dual {
namespace {

/// The vector from one vertex of a triangulated icosahedron's face to the next, h steps along the
/// lattice of triangles and k after a turn by 60°.
struct FaceVector {
  int h;
  int k;
  /// Triangles of a face: T = h² + hk + k².
  [[nodiscard]] int triangulation_number() const { return h * h + h * k + k * k; }
};

std::optional<FaceVector> face_vector_of(int triangulation_number) {
  const int most = static_cast<int>(std::lround(std::sqrt(triangulation_number))) + 1;
  for (int k = 0; k <= most; ++k) {
    for (int h = most; h >= k; --h) {
      const FaceVector vector = {h, k};
      if (vector.triangulation_number() == triangulation_number) return vector;
    }
  }
  return std::nullopt;
}

using Face = std::array<int, 3>;  // counter-clockwise, seen from outside

/// The coarsest triangulation of the unit sphere.
remesh::TriMesh icosahedron() {
  constexpr double edge_length = 1.2;  // as long as its own
  return remesh::make_shape("sphere", {}, edge_length);
}

std::vector<Face> faces_of(const remesh::TriMesh& mesh) {
  std::vector<Face> faces;
  for (const auto f : mesh.faces()) {
    Face face = {};
    std::ranges::transform(f.vertices(), face.begin(), [](auto v) { return v.idx(); });
    faces.push_back(face);
  }
  return faces;
}

/// A point of a face: how much of T each of its corners has. All three are whole numbers at the
/// vertices of the triangulation.
struct FacePoint {
  Face face;
  std::array<int, 3> parts;
};

/// The triangulation of the icosahedron's faces by a lattice that goes on over their edges.
class Triangulation {
 public:
  explicit Triangulation(const FaceVector& vector)
      : vector_(vector),
        t_(vector.triangulation_number()),
        icosahedron_(icosahedron()),
        faces_(faces_of(icosahedron_)) {
    for (const Face& face : faces_) divide(face);
  }

  [[nodiscard]] remesh::TriMesh mesh(double radius) const {
    std::vector<Eigen::Vector3d> points;
    for (const Eigen::Vector3d& point : points_) points.push_back(radius * point.normalized());
    return remesh::make_mesh(points, triangles_);
  }

 private:
  /// Lattice triangles whose middle lies on the face, one of those whose middle is on an edge.
  void divide(const Face& face) {
    const int reach = vector_.h + vector_.k;
    for (int i = -reach; i <= reach; ++i) {
      for (int j = -reach; j <= reach; ++j) {
        add(face, {{{i, j}, {i + 1, j}, {i, j + 1}}});
        add(face, {{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}});
      }
    }
  }

  /// Where i steps along the lattice and j after a turn by 60° lead from the face's first corner.
  [[nodiscard]] std::array<int, 3> parts_of(int i, int j) const {
    const auto [h, k] = vector_;
    // The second corner lies at (h, k), the third, turned by 60°, at (-k, h + k).
    const int second = (h + k) * i + k * j;
    const int third = h * j - k * i;
    return {t_ - second - third, second, third};
  }

  void add(const Face& face, const std::array<std::array<int, 2>, 3>& triangle) {
    std::array<int, 3> middle = {0, 0, 0};
    for (const auto& [i, j] : triangle) {
      const std::array<int, 3> parts = parts_of(i, j);
      for (std::size_t c = 0; c < 3; ++c) middle[c] += parts[c];
    }
    if (std::ranges::min(middle) < 0) return;
    std::array<int, 3> vertices = {};
    for (std::size_t c = 0; c < 3; ++c) {
      vertices[c] = vertex({face, parts_of(triangle[c][0], triangle[c][1])});
    }
    // The face beyond the edge has the same triangle.
    std::array<int, 3> key = vertices;
    std::ranges::sort(key);
    if (!known_.insert(key).second) return;
    triangles_.push_back(vertices);
  }

  /// The number of a vertex: the same from all faces that have it.
  int vertex(FacePoint p) {
    unfold(p);
    std::vector<std::pair<int, int>> key;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    for (std::size_t c = 0; c < 3; ++c) {
      if (p.parts[c] == 0) continue;
      key.emplace_back(p.face[c], p.parts[c]);
      position += p.parts[c] * icosahedron_.point(remesh::VertexHandle(p.face[c]));
    }
    std::ranges::sort(key);
    const auto [found, is_new] = vertices_.try_emplace(key, static_cast<int>(points_.size()));
    if (is_new) points_.push_back(position);
    return found->second;
  }

  /// Goes on to the face beyond an edge, for as long as the point is outside.
  void unfold(FacePoint& p) const {
    while (std::ranges::min(p.parts) < 0) {
      const auto outside =
          static_cast<std::size_t>(std::ranges::min_element(p.parts) - p.parts.begin());
      const std::size_t next = (outside + 1) % 3;
      const std::size_t last = (outside + 2) % 3;
      const int part = p.parts[outside];
      // In the plane, the corner beyond the edge is the sum of its ends less the corner here.
      p.parts[next] += part;
      p.parts[last] += part;
      p.parts[outside] = -part;
      p.face[outside] = corner_beyond(p.face, outside);
      std::swap(p.face[next], p.face[last]);
      std::swap(p.parts[next], p.parts[last]);
    }
  }

  [[nodiscard]] int corner_beyond(const Face& face, std::size_t corner) const {
    const int a = face[(corner + 1) % 3];
    const int b = face[(corner + 2) % 3];
    for (const Face& other : faces_) {
      if (std::ranges::count(other, a) == 0 || std::ranges::count(other, b) == 0) continue;
      if (std::ranges::count(other, face[corner]) > 0) continue;
      for (const int c : other) {
        if (c != a && c != b) return c;
      }
    }
    return -1;  // never: every edge has two faces
  }

  FaceVector vector_;
  int t_;
  remesh::TriMesh icosahedron_;
  std::vector<Face> faces_;
  std::map<std::vector<std::pair<int, int>>, int> vertices_;
  std::set<std::array<int, 3>> known_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<int, 3>> triangles_;
};

constexpr int atoms_per_triangulation_number = 20;

[[noreturn]] void refuse(int n_atoms) {
  const int wanted =
      std::max(n_atoms, atoms_per_triangulation_number) / atoms_per_triangulation_number;
  int below = wanted;
  while (!face_vector_of(below)) --below;
  int above = wanted + 1;
  while (!face_vector_of(above)) ++above;
  throw InvalidOption(concat("fullerene: there is no icosahedral fullerene of ", n_atoms,
                             " atoms; the nearest have ", atoms_per_triangulation_number * below,
                             " and ", atoms_per_triangulation_number * above,
                             " (build sphere --atoms N makes cages of any number)"));
}

/// Lets the bonds pull atoms along the sphere towards their own length: the projection of flat
/// faces shortens those of pentagons, until atoms that have no bond come within reach.
void even_out(Structure& cage, double radius) {
  constexpr int steps = 100;
  constexpr double part = 0.2;  // of a bond's excess length that each of its atoms takes up
  std::vector<Eigen::Vector3d>& positions = cage.atoms.positions;
  std::vector<Eigen::Vector3d> moves(positions.size());
  for (int step = 0; step < steps; ++step) {
    std::ranges::fill(moves, Eigen::Vector3d::Zero());
    for (const potentials::Bond& bond : cage.bonds) {
      const Eigen::Vector3d along = positions[bond.second] - positions[bond.first];
      const Eigen::Vector3d pull = part * (1.0 - graphene_bond / along.norm()) * along;
      moves[bond.first] += pull;
      moves[bond.second] -= pull;
    }
    for (std::size_t i = 0; i < positions.size(); ++i) {
      positions[i] = radius * (positions[i] + moves[i]).normalized();
    }
  }
}

}  // namespace

Structure icosahedral_fullerene(int n_atoms) {
  require_few_atoms("fullerene", n_atoms);
  if (n_atoms < atoms_per_triangulation_number || n_atoms % atoms_per_triangulation_number != 0) {
    refuse(n_atoms);
  }
  const auto vector = face_vector_of(n_atoms / atoms_per_triangulation_number);
  if (!vector) refuse(n_atoms);
  const double area_per_atom = 0.75 * std::numbers::sqrt3 * graphene_bond * graphene_bond;
  const double radius = std::sqrt(n_atoms * area_per_atom / (4.0 * std::numbers::pi));
  Structure structure = build_dual(Triangulation(*vector).mesh(radius));
  even_out(structure, radius);
  return structure;
}

Structure icosahedral_onion(int n_walls) {
  constexpr int max_walls = 30;
  constexpr int innermost = 60;
  if (n_walls < 1 || n_walls > max_walls) {
    throw InvalidOption(concat("onion: ", n_walls, " walls; 1 to ", max_walls, " can be made"));
  }
  Structure onion;
  std::vector<int> walls;
  for (int wall = 0; wall < n_walls; ++wall) {
    const Structure cage = icosahedral_fullerene(innermost * (wall + 1) * (wall + 1));
    const auto first = static_cast<std::uint32_t>(onion.atoms.size());
    std::ranges::copy(cage.atoms.positions, std::back_inserter(onion.atoms.positions));
    for (const potentials::Bond& bond : cage.bonds) {
      onion.bonds.push_back({.first = bond.first + first, .second = bond.second + first});
    }
    for (Ring ring : cage.rings) {
      for (int& atom : ring.atoms) atom += static_cast<int>(first);
      onion.rings.push_back(std::move(ring));
    }
    walls.resize(onion.atoms.size(), wall);
  }
  onion.atoms.species.assign(onion.atoms.size(), potentials::Species::carbon);
  onion.columns.push_back({.name = "wall", .values = std::move(walls)});
  return onion;
}

}  // namespace trivalent::dual
