#include <algorithm>
#include <optional>

#include "trivalent/dual/bonding.h"

namespace trivalent::dual {
namespace {

constexpr std::size_t largest_ring = 12;

/// An atom, or a periodic copy of it.
struct Site {
  int atom = 0;
  std::array<int, 3> image = {0, 0, 0};
  [[nodiscard]] bool operator==(const Site&) const = default;
  [[nodiscard]] auto operator<=>(const Site&) const = default;
};

Site step(const Site& from, const BondEnd& end) {
  Site to = {.atom = end.atom, .image = from.image};
  for (int axis = 0; axis < 3; ++axis) to.image[axis] += end.image[axis];
  return to;
}

bool can_lie_in_rings(const std::vector<BondEnd>& ends) {
  return ends.size() == 2 || ends.size() == 3;
}

/// A breadth-first search that remembers where it came from. Small, hence a plain list.
class RingSearch {
 public:
  explicit RingSearch(const Bonding& bonding) : bonding_(bonding) {}

  /// The shortest ring through ends a and b of the atom, past its other neighbors.
  std::optional<std::vector<Site>> shortest(int atom, std::size_t a, std::size_t b) {
    visited_.clear();
    const Site home = {.atom = atom};
    visit(home, 0);
    const auto& ends = bonding_[atom];
    for (std::size_t other = 0; other < ends.size(); ++other) {
      if (other != a && other != b) visit(step(home, ends[other]), 0);
    }
    std::size_t next = visited_.size();
    const Site start = step(home, ends[a]);
    const Site goal = step(home, ends[b]);
    if (is_visited(start) || is_visited(goal) || start == goal) return std::nullopt;
    if (!can_lie_in_rings(bonding_[start.atom])) return std::nullopt;
    visit(start, 0);
    // A path of n sites closes a ring of n + 1 atoms.
    for (; next < visited_.size(); ++next) {
      if (visited_[next].length >= largest_ring - 1) break;
      for (const BondEnd& end : bonding_[visited_[next].site.atom]) {
        const Site site = step(visited_[next].site, end);
        if (!can_lie_in_rings(bonding_[site.atom]) || is_visited(site)) continue;
        visit(site, next);
        if (site == goal) return ring_back_from_last();
      }
    }
    return std::nullopt;
  }

 private:
  struct Visit {
    Site site;
    std::size_t from;
    std::size_t length;  ///< sites of the path from the start
  };

  void visit(const Site& site, std::size_t from) {
    const std::size_t length = visited_.empty() ? 0 : visited_[from].length + 1;
    visited_.push_back({.site = site, .from = from, .length = length});
  }

  [[nodiscard]] bool is_visited(const Site& site) const {
    return std::any_of(visited_.begin(), visited_.end(),
                       [&](const Visit& visit) { return visit.site == site; });
  }

  [[nodiscard]] std::vector<Site> ring_back_from_last() const {
    std::vector<Site> ring;
    for (std::size_t i = visited_.size() - 1; i != 0; i = visited_[i].from) {
      ring.push_back(visited_[i].site);
    }
    ring.push_back(visited_.front().site);
    return ring;
  }

  const Bonding& bonding_;
  std::vector<Visit> visited_;
};

/// The same ring always in the same words: from its lowest atom, towards the lower neighbor, with
/// that atom in the home cell.
std::vector<Site> canonical(std::vector<Site> ring) {
  const auto by_atom = [](const Site& a, const Site& b) { return a < b; };
  std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end(), by_atom), ring.end());
  const std::array<int, 3> shift = ring.front().image;
  for (Site& site : ring) {
    for (int axis = 0; axis < 3; ++axis) site.image[axis] -= shift[axis];
  }
  if (ring.back() < ring[1]) std::reverse(ring.begin() + 1, ring.end());
  return ring;
}

bool crosses_boundary(const std::vector<Site>& ring) {
  return std::ranges::any_of(ring,
                             [&](const Site& site) { return site.image != ring.front().image; });
}

/// How many rings each angle of each atom lies in.
class FreeAngles {
 public:
  explicit FreeAngles(const Bonding& bonding) : bonding_(bonding), uses_(bonding.size()) {}

  /// Takes all angles of the ring, or none if one of them is taken.
  bool take(const std::vector<Site>& ring) {
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
      int& uses = uses_of(ring, i);
      if (uses < room(ring[i].atom)) {
        ++uses;
        continue;
      }
      while (i > 0) --uses_of(ring, --i);
      return false;
    }
    return true;
  }

 private:
  /// An atom of two bonds has a ring on each side of them.
  [[nodiscard]] int room(int atom) const { return bonding_[atom].size() == 2 ? 2 : 1; }

  int& uses_of(const std::vector<Site>& ring, std::size_t i) {
    const std::size_t n = ring.size();
    return uses_[ring[i].atom][unused_end(ring[i], ring[(i + n - 1) % n], ring[(i + 1) % n])];
  }

  /// The end that the angle leaves out names it; an atom of two bonds has only one angle.
  [[nodiscard]] unsigned unused_end(const Site& site, const Site& before, const Site& after) const {
    const auto& ends = bonding_[site.atom];
    if (ends.size() == 2) return 0;
    for (unsigned i = 0; i < 3; ++i) {
      const Site other = step(site, ends[i]);
      if (other != before && other != after) return i;
    }
    return 0;
  }

  const Bonding& bonding_;
  std::vector<std::array<int, 3>> uses_;
};

/// The shortest rings through every two bonds of an atom, each once, the smallest first.
std::vector<std::vector<Site>> shortest_rings(const Bonding& bonding) {
  std::vector<std::vector<Site>> found;
  RingSearch search(bonding);
  for (std::size_t atom = 0; atom < bonding.size(); ++atom) {
    const std::size_t n_ends = bonding[atom].size();
    if (!can_lie_in_rings(bonding[atom])) continue;
    for (std::size_t a = 0; a < n_ends; ++a) {
      for (std::size_t b = a + 1; b < n_ends; ++b) {
        auto ring = search.shortest(static_cast<int>(atom), a, b);
        if (ring) found.push_back(canonical(std::move(*ring)));
      }
    }
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.size() != b.size() ? a.size() < b.size() : a < b;
  });
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

Ring ring_of(const std::vector<Site>& sites) {
  Ring ring;
  for (const Site& site : sites) {
    ring.atoms.push_back(site.atom);
    ring.images.push_back(site.image);
  }
  if (!crosses_boundary(sites)) ring.images.clear();
  return ring;
}

}  // namespace

std::vector<Ring> find_rings(const Bonding& bonding) {
  std::vector<Ring> rings;
  FreeAngles angles(bonding);
  for (const std::vector<Site>& sites : shortest_rings(bonding)) {
    if (angles.take(sites)) rings.push_back(ring_of(sites));
  }
  return rings;
}

}  // namespace trivalent::dual
