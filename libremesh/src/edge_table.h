#pragma once

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace trivalent::remesh {

/// One face's use of an edge, in any set of triangles.
struct EdgeUse {
  int low = 0;   ///< the smaller of its two points
  int high = 0;  ///< the larger
  int face = 0;
  bool upwards = false;  ///< whether the face runs from low to high
};

/// All uses, those of one edge next to each other and by face.
[[nodiscard]] inline std::vector<EdgeUse> edge_uses(std::span<const std::array<int, 3>> triangles) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = triangles[f][k];
      const int to = triangles[f][(k + 1) % 3];
      uses.push_back({std::min(from, to), std::max(from, to), static_cast<int>(f), from < to});
    }
  }
  const auto key = [](const EdgeUse& use) { return std::array{use.low, use.high, use.face}; };
  std::sort(uses.begin(), uses.end(),
            [&](const EdgeUse& a, const EdgeUse& b) { return key(a) < key(b); });
  return uses;
}

/// Calls visit(span of uses) for every edge.
template <typename Visit>
void for_each_edge(std::span<const EdgeUse> uses, const Visit& visit) {
  for (std::size_t begin = 0; begin < uses.size();) {
    std::size_t end = begin + 1;
    while (end < uses.size() && uses[end].low == uses[begin].low &&
           uses[end].high == uses[begin].high) {
      ++end;
    }
    visit(uses.subspan(begin, end - begin));
    begin = end;
  }
}

/// Sets that can be joined; each is known by its smallest member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace trivalent::remesh
