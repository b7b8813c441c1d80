#include "rebo/screening.h"

namespace trivalent::potentials::rebo_detail {

void Paths::start_from(std::uint32_t atom) {
  paths_.clear();
  extend({.atom = atom, .image = {0, 0, 0}, .strength = 1.0, .bonds = {}, .length = 0});
}

// Walks that turn back are weaker than those that do not: left out.
void Paths::extend(const Path& path) {
  for (const std::size_t b : bonds_.from(path.atom)) {
    if (path.length > 0 && bonds_[b].reverse == path.bonds[path.length - 1]) continue;
    Path longer = path;
    longer.atom = bonds_[b].to;
    for (std::size_t k = 0; k < 3; ++k) longer.image[k] += bonds_[b].image[k];
    longer.strength *= bonds_[b].cutoff.value;
    longer.bonds[longer.length++] = b;
    offer(longer);
    if (longer.length < longer.bonds.size()) extend(longer);
  }
}

void Paths::offer(const Path& path) {
  for (Path& known : paths_) {
    if (known.atom != path.atom || known.image != path.image) continue;
    if (path.strength > known.strength) known = path;
    return;
  }
  paths_.push_back(path);
}

const Path* Paths::to(std::uint32_t atom, const std::array<std::int32_t, 3>& image) const {
  for (const Path& path : paths_) {
    if (path.atom == atom && path.image == image) return &path;
  }
  return nullptr;
}

}  // namespace trivalent::potentials::rebo_detail
