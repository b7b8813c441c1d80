#include "rebo/patch.h"

#include <algorithm>
#include <limits>
#include <map>
#include <span>
#include <utility>

namespace trivalent::potentials::rebo_detail {

class Patch::Builder {
 public:
  Builder(const Candidates& candidates, std::size_t tile)
      : candidates_(candidates), begin_(candidates.tiles[tile]), end_(candidates.tiles[tile + 1]) {}

  void build(Patch& patch) {
    number_links_of_tile();
    const std::size_t ring = outside_.size();
    for (std::size_t k = 0; k < ring; ++k) number_links_of_ring(outside_[k]);
    patch.near = near_tiles();
    patch.is_usable = is_carbon() && is_countable();
    if (!patch.is_usable) return;
    for (const Place& place : outside_) patch.outside.push_back(as_given(place));
    for (std::size_t k = 0; k < ring; ++k) {
      patch.ring.push_back(static_cast<std::uint16_t>(link_count(outside_[k].home)));
    }
    patch.point.assign(points_.begin(), points_.end());
    patch.reverse = reverse_directions(ring);
  }

 private:
  struct Place {
    std::uint32_t home;
    Shift shift;
    auto operator<=>(const Place&) const = default;
  };

  [[nodiscard]] std::uint32_t link_count(std::uint32_t atom) const {
    return candidates_.first[atom + 1] - candidates_.first[atom];
  }
  [[nodiscard]] bool is_inside(const Place& place) const {
    return begin_ <= place.home && place.home < end_ && place.shift == Shift{};
  }

  // Where a link from an image of an atom ends, as seen from the tile.
  [[nodiscard]] Place end_of(std::uint32_t link, const Shift& shift) const {
    const std::uint32_t point = candidates_.point[link];
    Place place = {candidates_.home(point), shift};
    if (point < candidates_.count()) return place;
    const Shift& step = candidates_.images[point - candidates_.count()].shift;
    for (std::size_t k = 0; k < 3; ++k) {
      place.shift[k] = static_cast<std::int16_t>(place.shift[k] + step[k]);
    }
    return place;
  }

  [[nodiscard]] std::uint32_t number(const Place& place) {
    if (is_inside(place)) return place.home - begin_;
    const auto next = static_cast<std::uint32_t>(end_ - begin_ + outside_.size());
    const auto [known, is_new] = numbers_.try_emplace(place, next);
    if (is_new) outside_.push_back(place);
    return known->second;
  }

  void number_links_of_tile() {
    for (std::uint32_t link = candidates_.first[begin_]; link < candidates_.first[end_]; ++link) {
      points_.push_back(number(end_of(link, Shift{})));
    }
  }

  void number_links_of_ring(const Place from) {
    for (std::uint32_t link = candidates_.first[from.home]; link < candidates_.first[from.home + 1];
         ++link) {
      points_.push_back(number(end_of(link, from.shift)));
    }
  }

  [[nodiscard]] std::vector<std::uint32_t> near_tiles() const {
    const auto tile_of = [&](std::uint32_t atom) {
      return static_cast<std::uint32_t>(candidates_.tile_of(atom));
    };
    std::vector<std::uint32_t> near = {tile_of(begin_)};
    for (const Place& place : outside_) near.push_back(tile_of(place.home));
    std::ranges::sort(near);
    const auto repeated = std::ranges::unique(near);
    near.erase(repeated.begin(), repeated.end());
    near.shrink_to_fit();
    return near;
  }

  [[nodiscard]] bool is_carbon() const {
    const auto carbon = [&](std::uint32_t atom) {
      return candidates_.species[atom] == Species::carbon;
    };
    for (std::uint32_t i = begin_; i < end_; ++i) {
      if (!carbon(i)) return false;
    }
    return std::ranges::all_of(outside_, [&](const Place& place) { return carbon(place.home); });
  }

  [[nodiscard]] bool is_countable() const {
    constexpr std::size_t most = std::numeric_limits<std::uint16_t>::max();
    return points_.size() < most && end_ - begin_ + outside_.size() < most;
  }

  [[nodiscard]] Outside as_given(const Place& place) const {
    Outside outside = {candidates_.order[place.home], place.shift};
    if (candidates_.wraps.empty()) return outside;
    for (std::size_t k = 0; k < 3; ++k) {
      outside.shift[k] =
          static_cast<std::int16_t>(outside.shift[k] + candidates_.wraps[place.home][k]);
    }
    return outside;
  }

  [[nodiscard]] std::vector<std::uint16_t> reverse_directions(std::size_t ring) const {
    std::vector<std::uint32_t> first_of_ring = {candidates_.first[end_] -
                                                candidates_.first[begin_]};
    for (std::size_t k = 0; k < ring; ++k) {
      first_of_ring.push_back(first_of_ring.back() + link_count(outside_[k].home));
    }
    std::vector<std::uint16_t> reverse;
    reverse.reserve(first_of_ring.front());
    for (std::uint32_t k = 0; k < first_of_ring.front(); ++k) {
      const std::uint32_t back = candidates_.reverse[candidates_.first[begin_] + k];
      const std::uint32_t end = points_[k];
      const bool ends_inside = end < end_ - begin_;
      const std::uint32_t local = ends_inside
                                      ? back - candidates_.first[begin_]
                                      : first_of_ring[end - (end_ - begin_)] + back -
                                            candidates_.first[outside_[end - (end_ - begin_)].home];
      reverse.push_back(static_cast<std::uint16_t>(local));
    }
    return reverse;
  }

  const Candidates& candidates_;
  std::uint32_t begin_;
  std::uint32_t end_;
  std::vector<Place> outside_;
  std::map<Place, std::uint32_t> numbers_;  // of outside points
  std::vector<std::uint32_t> points_;       // per link
};

Patch::Patch(const Candidates& candidates, std::size_t tile) {
  Builder(candidates, tile).build(*this);
}

}  // namespace trivalent::potentials::rebo_detail
