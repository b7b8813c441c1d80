#include "trivalent/remesh/defects.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace trivalent::remesh {

namespace {

/// A maximum matching of the vertices of valence 5 with neighbors of valence 7, by augmenting
/// paths.
class Pairing {
 public:
  explicit Pairing(const TriMesh& mesh)
      : mesh_(mesh),
        partner_(mesh.n_vertices()),
        reached_from_(mesh.n_vertices()),
        reached_for_(mesh.n_vertices()) {}

  /// Finds a partner for a vertex of valence 5; others may change theirs.
  ///
  /// @return  False if there is none.
  bool pair(VertexHandle five) {
    std::vector<VertexHandle> queue = {five};
    for (std::size_t next = 0; next < queue.size(); ++next) {
      for (const auto seven : mesh_.vv_range(queue[next])) {
        if (!has_valence(seven, 7) || reached_for_[index(seven)] == five) continue;
        reached_for_[index(seven)] = five;
        reached_from_[index(seven)] = queue[next];
        if (!partner_[index(seven)].is_valid()) {
          change_partners(five, seven);
          return true;
        }
        queue.push_back(partner_[index(seven)]);
      }
    }
    return false;
  }

  [[nodiscard]] bool has_valence(VertexHandle v, unsigned valence) const {
    return !mesh_.is_boundary(v) && mesh_.valence(v) == valence;
  }

 private:
  /// Along the path that ends at a free vertex of valence 7, everyone takes the next one.
  void change_partners(VertexHandle five, VertexHandle seven) {
    while (true) {
      const VertexHandle from = reached_from_[index(seven)];
      const VertexHandle left = partner_[index(from)];
      partner_[index(seven)] = from;
      partner_[index(from)] = seven;
      if (from == five) return;
      seven = left;
    }
  }

  const TriMesh& mesh_;
  std::vector<VertexHandle> partner_;
  std::vector<VertexHandle> reached_from_;
  std::vector<VertexHandle> reached_for_;  // the search that came here last
};

}  // namespace

Defects find_defects(const TriMesh& mesh) {
  Pairing pairing(mesh);
  Defects defects;
  for (const auto v : mesh.vertices()) {
    if (pairing.has_valence(v, 7)) ++defects.lone_7;
    if (!pairing.has_valence(v, 5)) continue;
    if (pairing.pair(v)) {
      ++defects.pairs;
    } else {
      ++defects.lone_5;
    }
  }
  defects.lone_7 -= defects.pairs;
  return defects;
}

}  // namespace trivalent::remesh
