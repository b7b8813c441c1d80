#include "bond_columns.h"
#include "trivalent/formats/structure_file.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "trivalent/dual/bonding.h"
#include "trivalent/dual/error.h"
#include "trivalent/potentials/bonds.h"

namespace trivalent::dual {
namespace {

using potentials::Bond;

/// One entry of the columns: an atom, the atom it is bonded to, and the image of that.
using Entry = std::array<std::int32_t, 5>;

Entry reversed(const Entry& entry) { return {entry[1], entry[0], -entry[2], -entry[3], -entry[4]}; }

/// The entries, ordered; or what is wrong with them.
struct Entries {
  std::multiset<Entry> all;
  std::optional<std::string> fault;
};

Entries read_entries(const BondColumns& columns, std::size_t n_atoms) {
  Entries entries;
  for (std::size_t k = 0; k < columns.atoms.size(); ++k) {
    const int other = columns.atoms[k];
    if (other == -1) continue;
    const auto atom = static_cast<int>(k / columns.width);
    if (other < 0 || static_cast<std::size_t>(other) >= n_atoms) {
      entries.fault = concat("atom ", atom + 1, " names atom ", std::int64_t{other} + 1,
                             ", which does not exist");
      return entries;
    }
    Entry entry = {atom, other, 0, 0, 0};
    for (std::size_t i = 0; i < 3 && !columns.images.empty(); ++i) {
      constexpr int max_image = 1'000'000;  // can be negated, and is far beyond any bond
      entry[2 + i] = columns.images[3 * k + i];
      if (entry[2 + i] > max_image || entry[2 + i] < -max_image) {
        entries.fault = concat("atom ", atom + 1, " names an image ", entry[2 + i], " cells away");
        return entries;
      }
    }
    entries.all.insert(entry);
  }
  return entries;
}

std::optional<std::string> find_asymmetry(const std::multiset<Entry>& entries) {
  for (const Entry& entry : entries) {
    const Entry back = reversed(entry);
    if (entry != back && entries.count(entry) == entries.count(back)) continue;
    return concat("atom ", entry[0] + 1, " names atom ", entry[1] + 1,
                  entry == back ? ", which it is itself" : ", which does not name it");
  }
  return std::nullopt;
}

/// Replaces images that lead much farther than the nearest one.
int mend_images(const potentials::Atoms& atoms, std::vector<Bond>& bonds) {
  std::vector<std::array<int, 2>> pairs;
  pairs.reserve(bonds.size());
  for (const Bond& bond : bonds) {
    pairs.push_back({static_cast<int>(bond.first), static_cast<int>(bond.second)});
  }
  const std::vector<Bond> nearest = potentials::bonds_between(atoms, pairs);
  int n_mended = 0;
  for (std::size_t i = 0; i < bonds.size(); ++i) {
    // Bonds to two images of one atom differ in length by less than this.
    constexpr double factor = 1.5;
    const double length = potentials::bond_length(atoms, bonds[i]);
    if (length <= factor * potentials::bond_length(atoms, nearest[i])) continue;
    bonds[i] = nearest[i];
    ++n_mended;
  }
  return n_mended;
}

}  // namespace

BondColumns bond_columns(const Structure& structure) {
  const Bonding bonding = bonding_of(structure);
  BondColumns columns = {.width = 1};
  for (const auto& ends : bonding) columns.width = std::max(columns.width, ends.size());
  columns.atoms.assign(bonding.size() * columns.width, -1);
  const bool has_images = structure.atoms.box.is_periodic();
  if (has_images) columns.images.assign(3 * columns.atoms.size(), 0);
  for (std::size_t atom = 0; atom < bonding.size(); ++atom) {
    for (std::size_t k = 0; k < bonding[atom].size(); ++k) {
      const std::size_t at = atom * columns.width + k;
      columns.atoms[at] = bonding[atom][k].atom;
      for (std::size_t i = 0; i < 3 && has_images; ++i) {
        columns.images[3 * at + i] = bonding[atom][k].image[i];
      }
    }
  }
  return columns;
}

void take_bonds(const BondColumns& columns, Structure& structure, std::vector<std::string>& notes) {
  Entries entries = read_entries(columns, structure.atoms.size());
  if (!entries.fault) entries.fault = find_asymmetry(entries.all);
  if (entries.fault) {
    notes.push_back(concat(unused_bonds, *entries.fault));
    return;
  }
  std::vector<Bond> bonds;
  for (const Entry& entry : entries.all) {
    if (reversed(entry) < entry) continue;
    bonds.push_back({.first = static_cast<std::uint32_t>(entry[0]),
                     .second = static_cast<std::uint32_t>(entry[1]),
                     .image = {entry[2], entry[3], entry[4]}});
  }
  if (structure.atoms.box.is_periodic()) {
    if (const int n_mended = mend_images(structure.atoms, bonds); n_mended > 0) {
      notes.push_back(concat(n_mended,
                             " bonds of the file lead to images that do not fit the "
                             "positions; the nearest are taken"));
    }
  }
  structure.bonds = std::move(bonds);
}

}  // namespace trivalent::dual
