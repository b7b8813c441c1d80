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

/// Where buckets end that hold one thing for each key that is visited; the bucket of key k begins
/// where that of k - 1 ends.
///
/// @param visit_keys  Called with a function of a key >= 0, which it calls for every thing.
template <typename VisitKeys>
[[nodiscard]] std::vector<std::size_t> ends_of_buckets(const VisitKeys& visit_keys) {
  std::vector<std::size_t> ends(1, 0);
  visit_keys([&](int key) {
    const std::size_t bucket = static_cast<std::size_t>(key) + 1;
    if (bucket >= ends.size()) ends.resize(std::max(bucket + 1, 2 * ends.size()), 0);
    ++ends[bucket];
  });
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  return ends;
}

/// All uses, those of one edge next to each other and by face. Indices must be >= 0.
[[nodiscard]] inline std::vector<EdgeUse> edge_uses(std::span<const std::array<int, 3>> triangles) {
  const auto for_each_side = [&](const auto& visit) {
    for (std::size_t f = 0; f < triangles.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        const int from = triangles[f][k];
        const int to = triangles[f][(k + 1) % 3];
        visit(EdgeUse{std::min(from, to), std::max(from, to), static_cast<int>(f), from < to});
      }
    }
  };
  // Sorted into a bucket for each low point, each of which is small.
  const std::vector<std::size_t> ends = ends_of_buckets(
      [&](const auto& add) { for_each_side([&](const EdgeUse& use) { add(use.low); }); });
  std::vector<EdgeUse> uses(3 * triangles.size());
  std::vector<std::size_t> next(ends);
  for_each_side([&](const EdgeUse& use) { uses[next[static_cast<std::size_t>(use.low)]++] = use; });
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const auto begin = uses.begin() + static_cast<std::ptrdiff_t>(ends[i - 1]);
    const auto end = uses.begin() + static_cast<std::ptrdiff_t>(ends[i]);
    std::sort(begin, end, [](const EdgeUse& a, const EdgeUse& b) {
      return std::array{a.high, a.face} < std::array{b.high, b.face};
    });
  }
  return uses;
}

/// For every triangle whether an earlier one has the same corners, in whatever order.
[[nodiscard]] inline std::vector<char> repeated_faces(
    std::span<const std::array<int, 3>> triangles) {
  const auto sorted = [](std::array<int, 3> corners) {
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  // Only those in a bucket with the same lowest corner are compared.
  const std::vector<std::size_t> ends = ends_of_buckets([&](const auto& add) {
    for (const auto& triangle : triangles) add(std::ranges::min(triangle));
  });
  std::vector<std::array<int, 3>> uses(triangles.size());  // the other corners, and the face
  std::vector<std::size_t> next(ends);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const auto [low, middle, high] = sorted(triangles[f]);
    uses[next[static_cast<std::size_t>(low)]++] = {middle, high, static_cast<int>(f)};
  }
  std::vector<char> is_repeated(triangles.size(), 0);
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const auto bucket = std::span(uses).subspan(ends[i - 1], ends[i] - ends[i - 1]);
    std::sort(bucket.begin(), bucket.end());
    for (std::size_t k = 1; k < bucket.size(); ++k) {
      if (bucket[k][0] != bucket[k - 1][0] || bucket[k][1] != bucket[k - 1][1]) continue;
      is_repeated[static_cast<std::size_t>(bucket[k][2])] = 1;
    }
  }
  return is_repeated;
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
