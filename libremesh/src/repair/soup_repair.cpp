#include "repair/soup_repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "mesh/edge_table.h"

namespace trivalent::remesh {

namespace {

using Triangle = std::array<int, 3>;

/// Points with an edge that does not have exactly two faces.
std::vector<char> points_on_open_edges(const TriangleSoup& soup) {
  std::vector<char> is_open(soup.points.size(), 0);
  const std::vector<EdgeUse> uses = edge_uses(soup.triangles);
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 2) is_open[index(edge[0].low)] = is_open[index(edge[0].high)] = 1;
  });
  return is_open;
}

int corner_of(const Triangle& corners, int v) {
  return static_cast<int>(std::find(corners.begin(), corners.end(), v) - corners.begin());
}

/// Two faces that belong together across an edge.
struct FacePair {
  int a = 0;
  int b = 0;
};

/// Pairs the faces around a crowded edge: a face that runs down and the next one upwards,
/// counter-clockwise around the edge, have a wedge of the inside between them.
std::vector<FacePair> pair_around(const TriangleSoup& soup, std::span<const EdgeUse> edge) {
  const Eigen::Vector3d& low = soup.points[index(edge[0].low)];
  const Eigen::Vector3d axis = soup.points[index(edge[0].high)] - low;
  const Eigen::Vector3d x = axis.unitOrthogonal();
  const Eigen::Vector3d y = axis.normalized().cross(x);
  std::vector<std::pair<double, std::size_t>> by_angle;
  for (std::size_t i = 0; i < edge.size(); ++i) {
    const Triangle& corners = soup.triangles[index(edge[i].face)];
    const int apex = corners[0] + corners[1] + corners[2] - edge[i].low - edge[i].high;
    const Eigen::Vector3d to_apex = soup.points[index(apex)] - low;
    by_angle.emplace_back(std::atan2(to_apex.dot(y), to_apex.dot(x)), i);
  }
  std::sort(by_angle.begin(), by_angle.end());
  std::vector<FacePair> pairs;
  std::vector<std::size_t> waiting;
  std::vector<char> is_paired(edge.size(), 0);
  // Twice around, since a wedge may lie across the first angle.
  for (std::size_t k = 0; k < 2 * edge.size(); ++k) {
    const std::size_t i = by_angle[k % edge.size()].second;
    if (is_paired[i] != 0) continue;
    if (!edge[i].upwards) {
      waiting.push_back(i);
      continue;
    }
    while (!waiting.empty() && is_paired[waiting.back()] != 0) waiting.pop_back();
    if (waiting.empty()) continue;
    pairs.push_back({edge[waiting.back()].face, edge[i].face});
    is_paired[i] = is_paired[waiting.back()] = 1;
    waiting.pop_back();
  }
  return pairs;
}

std::vector<FacePair> faces_that_belong_together(const TriangleSoup& soup,
                                                 std::span<const EdgeUse> edge) {
  if (edge.size() > 2) return pair_around(soup, edge);
  if (edge.size() == 1 || edge[0].upwards == edge[1].upwards) return {};
  return {{edge[0].face, edge[1].face}};
}

/// Walks over faces that share an edge of two faces, and finds those that disagree.
class Orientation {
 public:
  explicit Orientation(const std::vector<Triangle>& triangles)
      : neighbors_(triangles.size()), side_(triangles.size(), Side::unknown) {
    const std::vector<EdgeUse> uses = edge_uses(triangles);
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
      if (edge.size() != 2) return;
      const bool agrees = edge[0].upwards != edge[1].upwards;
      neighbors_[index(edge[0].face)].add({edge[1].face, agrees});
      neighbors_[index(edge[1].face)].add({edge[0].face, agrees});
    });
  }

  /// Faces to be turned.
  std::vector<int> find_wrong() {
    std::vector<int> wrong;
    for (std::size_t start = 0; start < side_.size(); ++start) {
      if (side_[start] != Side::unknown) continue;
      const std::vector<int> component = walk_from(static_cast<int>(start));
      std::array<std::vector<int>, 2> faces;
      for (const int face : component)
        faces[side_[index(face)] == Side::turned ? 1 : 0].push_back(face);
      // The majority is right.
      const std::vector<int>& fewer = faces[1].size() <= faces[0].size() ? faces[1] : faces[0];
      wrong.insert(wrong.end(), fewer.begin(), fewer.end());
    }
    return wrong;
  }

 private:
  enum class Side : char { unknown, as_is, turned };
  struct Neighbor {
    int face = 0;
    bool agrees = true;
  };
  struct Neighbors {
    std::array<Neighbor, 3> at;
    std::size_t count = 0;
    void add(Neighbor neighbor) { at[count++] = neighbor; }
  };

  std::vector<int> walk_from(int start) {
    std::vector<int> component = {start};
    side_[index(start)] = Side::as_is;
    for (std::size_t i = 0; i < component.size(); ++i) {
      const Side here = side_[index(component[i])];
      const Side other = here == Side::as_is ? Side::turned : Side::as_is;
      const Neighbors& neighbors = neighbors_[index(component[i])];
      for (std::size_t k = 0; k < neighbors.count; ++k) {
        const Neighbor& next = neighbors.at[k];
        if (side_[index(next.face)] != Side::unknown) continue;
        side_[index(next.face)] = next.agrees ? here : other;
        component.push_back(next.face);
      }
    }
    return component;
  }

  std::vector<Neighbors> neighbors_;
  std::vector<Side> side_;
};

}  // namespace

std::size_t drop_vanishing_coordinates(TriangleSoup& soup) {
  if (soup.triangles.empty()) return 0;
  // Isolated points may lie anywhere and say nothing of the size.
  const Eigen::Vector3d& first = soup.points[index(soup.triangles[0][0])];
  BoundingBox box{first, first};
  for (const Triangle& t : soup.triangles) {
    for (const int v : t) {
      box.low = box.low.cwiseMin(soup.points[index(v)]);
      box.high = box.high.cwiseMax(soup.points[index(v)]);
    }
  }
  const double vanishing = 1e-60 * box.diagonal();
  std::size_t count = 0;
  for (const Triangle& t : soup.triangles) {
    for (const int v : t) {
      for (double& x : soup.points[index(v)]) {
        if (x == 0.0 || std::abs(x) >= vanishing) continue;
        x = 0.0;
        ++count;
      }
    }
  }
  return count;
}

std::size_t join_coincident_points(TriangleSoup& soup) {
  const std::vector<char> is_open = points_on_open_edges(soup);
  std::vector<int> order;
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    if (is_open[v] != 0) order.push_back(static_cast<int>(v));
  }
  const auto key = [&](int v) {
    const Eigen::Vector3d& p = soup.points[index(v)];
    return std::array{p.x(), p.y(), p.z()};
  };
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return std::pair(key(a), a) < std::pair(key(b), b); });
  std::vector<int> leader(soup.points.size());
  std::iota(leader.begin(), leader.end(), 0);
  std::size_t joined = 0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (soup.points[index(order[i])] != soup.points[index(order[i - 1])]) continue;
    leader[index(order[i])] = leader[index(order[i - 1])];
    ++joined;
  }
  for (Triangle& triangle : soup.triangles) {
    for (int& v : triangle) v = leader[index(v)];
  }
  std::erase_if(soup.triangles,
                [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  return joined;
}

std::size_t drop_repeated_faces(TriangleSoup& soup) {
  const std::vector<char> is_repeated = repeated_faces(soup.triangles);
  std::size_t face = 0;
  return std::erase_if(soup.triangles, [&](const Triangle&) { return is_repeated[face++] != 0; });
}

std::size_t orient_faces(TriangleSoup& soup) {
  const std::vector<int> wrong = Orientation(soup.triangles).find_wrong();
  for (const int face : wrong)
    std::swap(soup.triangles[index(face)][1], soup.triangles[index(face)][2]);
  return wrong.size();
}

std::size_t count_disagreeing_edges(const TriangleSoup& soup) {
  std::size_t count = 0;
  const std::vector<EdgeUse> uses = edge_uses(soup.triangles);
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() == 2 && edge[0].upwards == edge[1].upwards) ++count;
  });
  return count;
}

std::size_t separate_fans(TriangleSoup& soup) {
  DisjointSets fans(3 * soup.triangles.size());
  const std::vector<EdgeUse> uses = edge_uses(soup.triangles);
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    for (const auto& [a, b] : faces_that_belong_together(soup, edge)) {
      for (const int v : {edge[0].low, edge[0].high}) {
        fans.join(index(3 * a + corner_of(soup.triangles[index(a)], v)),
                  index(3 * b + corner_of(soup.triangles[index(b)], v)));
      }
    }
  });
  // The first fan at a point keeps it.
  const std::size_t points_before = soup.points.size();
  std::vector<char> is_taken(points_before, 0);
  std::vector<int> point_of_fan(3 * soup.triangles.size(), 0);
  for (std::size_t corner = 0; corner < point_of_fan.size(); ++corner) {
    int& v = soup.triangles[corner / 3][corner % 3];
    const std::size_t fan = fans.find(corner);
    if (fan == corner) {
      point_of_fan[fan] = v;
      if (std::exchange(is_taken[index(v)], 1) != 0) {
        point_of_fan[fan] = static_cast<int>(soup.points.size());
        soup.points.push_back(Eigen::Vector3d(soup.points[index(v)]));
      }
    }
    v = point_of_fan[fan];
  }
  return soup.points.size() - points_before;
}

std::size_t drop_isolated_points(TriangleSoup& soup) {
  std::vector<int> new_index(soup.points.size(), -1);
  for (const Triangle& triangle : soup.triangles) {
    for (const int v : triangle) new_index[index(v)] = 0;
  }
  int used = 0;
  for (std::size_t v = 0; v < new_index.size(); ++v) {
    if (new_index[v] < 0) continue;
    soup.points[index(used)] = soup.points[v];
    new_index[v] = used++;
  }
  const std::size_t dropped = soup.points.size() - index(used);
  soup.points.resize(index(used));
  for (Triangle& triangle : soup.triangles) {
    for (int& v : triangle) v = new_index[index(v)];
  }
  return dropped;
}

}  // namespace trivalent::remesh
