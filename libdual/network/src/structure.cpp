#include "trivalent/dual/structure.h"

#include <algorithm>
#include <map>
#include <utility>

namespace trivalent::dual {
namespace {

using Image = std::array<std::int32_t, 3>;

/// Gives each image of an atom one place behind the atoms.
class PlacesOfImages {
 public:
  PlacesOfImages(const potentials::Atoms& atoms, Drawing& drawing)
      : atoms_(atoms), drawing_(drawing) {}

  int operator()(int atom, const Image& image) {
    if (image == Image{0, 0, 0}) return atom;
    const auto [found, is_new] =
        places_.try_emplace({atom, image}, static_cast<int>(drawing_.positions.size()));
    if (is_new) {
      const Eigen::Vector3d& position = atoms_.positions[static_cast<std::size_t>(atom)];
      drawing_.positions.push_back(atoms_.box.shifted(position, image));
      drawing_.images.push_back(atom);
    }
    return found->second;
  }

 private:
  const potentials::Atoms& atoms_;
  Drawing& drawing_;
  std::map<std::pair<int, Image>, int> places_;
};

}  // namespace

int Drawing::atom(int place) const {
  const auto n_atoms = static_cast<int>(positions.size() - images.size());
  return place < n_atoms ? place : images[static_cast<std::size_t>(place - n_atoms)];
}

Drawing drawing_of(const Structure& structure) {
  Drawing drawing = {
      .positions = structure.atoms.positions, .images = {}, .bonds = {}, .rings = {}};
  PlacesOfImages place_of(structure.atoms, drawing);
  drawing.bonds.reserve(structure.bonds.size());
  for (const auto& [first, second, image] : structure.bonds) {
    drawing.bonds.push_back({static_cast<int>(first), place_of(static_cast<int>(second), image)});
  }
  drawing.rings.reserve(structure.rings.size());
  for (const Ring& ring : structure.rings) {
    std::vector<int>& places = drawing.rings.emplace_back(ring.atoms);
    for (std::size_t k = 0; k < ring.images.size(); ++k) {
      places[k] = place_of(places[k], ring.images[k]);
    }
  }
  return drawing;
}

std::vector<std::array<int, 2>> drawable_bonds(const Structure& structure) {
  std::vector<std::array<int, 2>> pairs;
  pairs.reserve(structure.bonds.size());
  for (const potentials::Bond& bond : structure.bonds) {
    if (bond.image != std::array<std::int32_t, 3>{0, 0, 0}) continue;
    pairs.push_back({static_cast<int>(bond.first), static_cast<int>(bond.second)});
  }
  return pairs;
}

std::vector<std::vector<int>> drawable_rings(const Structure& structure) {
  std::vector<std::vector<int>> rings;
  rings.reserve(structure.rings.size());
  for (const Ring& ring : structure.rings) {
    if (ring.images.empty()) rings.push_back(ring.atoms);
  }
  return rings;
}

Structure part_of(const Structure& structure, const std::function<bool(std::size_t)>& is_kept) {
  const potentials::Atoms& atoms = structure.atoms;
  Structure part = {.atoms = {.positions = {}, .species = {}, .box = atoms.box}};
  std::vector<std::uint32_t> places(atoms.size());
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    places[i] = static_cast<std::uint32_t>(part.atoms.size());
    if (!is_kept(i)) continue;
    part.atoms.positions.push_back(atoms.positions[i]);
    part.atoms.species.push_back(atoms.species[i]);
  }
  for (const auto& [first, second, image] : structure.bonds) {
    if (!is_kept(first) || !is_kept(second)) continue;
    part.bonds.push_back({places[first], places[second], image});
  }
  for (Ring ring : structure.rings) {
    if (!std::ranges::all_of(ring.atoms, is_kept)) continue;
    for (int& atom : ring.atoms) atom = static_cast<int>(places[static_cast<std::size_t>(atom)]);
    part.rings.push_back(std::move(ring));
  }
  return part;
}

}  // namespace trivalent::dual
