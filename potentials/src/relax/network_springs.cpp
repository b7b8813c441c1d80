#include "relax/network_springs.h"

#include <algorithm>

#include "parallel.h"
#include "relax/spring_recipes.h"
#include "trivalent/potentials/neighbor_list.h"

namespace trivalent::potentials::relax_detail {

namespace {

// Contacts are searched again once an atom has moved half of this [Å].
constexpr double contact_skin = 0.8;

std::array<std::int32_t, 3> back(const std::array<std::int32_t, 3>& image) {
  return {-image[0], -image[1], -image[2]};
}

Eigen::Vector3d separation(const AtomsView& atoms, std::size_t from, const auto& to) {
  return atoms.box.shifted(atoms.positions[to.atom] - atoms.positions[from], to.image);
}

// Adds to the force on one end of a spring; returns that end's half of the energy.
double add_spring(const Eigen::Vector3d& between, double excess, double stiffness,
                  Eigen::Vector3d& force) {
  if (excess == 0.0) return 0.0;
  force += stiffness * excess * between.stableNormalized();
  return 0.25 * stiffness * excess * excess;
}

}  // namespace

NetworkSprings::NetworkSprings(const AtomsView& atoms, std::span<const Bond> bonds,
                               const SpringOptions& options)
    : options_(options), first_bonded_(atoms.size() + 1, 0), bonded_(2 * bonds.size()) {
  for (const Bond& bond : bonds) {
    ++first_bonded_[bond.first + 1];
    ++first_bonded_[bond.second + 1];
  }
  for (std::size_t i = 0; i < atoms.size(); ++i) first_bonded_[i + 1] += first_bonded_[i];
  std::vector<std::size_t> next(first_bonded_.begin(), first_bonded_.end() - 1);
  for (std::size_t k = 0; k < bonds.size(); ++k) {
    const Bond& bond = bonds[k];
    bonded_[next[bond.first]++] = {bond.second, bond.image, options_.lengths[k]};
    bonded_[next[bond.second]++] = {bond.first, back(bond.image), options_.lengths[k]};
  }
  set_scales(atoms);
  bends_.assign(atoms.size(), Eigen::Vector3d::Zero());
}

void NetworkSprings::set_scales(const AtomsView& atoms) {
  scales_.assign(atoms.size(), 1.0);
  for (std::size_t i = 0; i < scales_.size(); ++i) {
    double sum = 0.0;
    for (const Spring& spring : bonded(i)) {
      sum += spring.length.max / bond_at_rest(atoms.species[i], atoms.species[spring.atom]);
    }
    if (!bonded(i).empty()) {
      scales_[i] = std::min(1.0, sum / static_cast<double>(bonded(i).size()));
    }
  }
}

void NetworkSprings::compute(const AtomsView& atoms, EnergyForces& result) {
  result.energies.resize(atoms.size());
  result.forces.resize(atoms.size());
  result.virial.setZero();
  if (have_moved(atoms)) find_contacts(atoms);
  find_bends(atoms);
  result.energy = sum_over_chunks<double>(atoms.size(), [&](std::size_t begin, std::size_t end) {
    double energy = 0.0;
    for (std::size_t i = begin; i < end; ++i) energy += evaluate_atom(atoms, i, result);
    return energy;
  });
}

bool NetworkSprings::have_moved(const AtomsView& atoms) const {
  if (positions_of_contacts_.size() != atoms.size()) return true;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    const double moved = (atoms.positions[i] - positions_of_contacts_[i]).norm();
    if (!(moved <= 0.5 * contact_skin)) return true;
  }
  return false;
}

void NetworkSprings::find_contacts(const AtomsView& atoms) {
  first_contact_.assign(atoms.size() + 1, 0);
  contacts_.clear();
  positions_of_contacts_.assign(atoms.positions.begin(), atoms.positions.end());
  if (options_.contact_stiffness == 0.0) return;
  const NeighborList neighbors(atoms, options_.contact.others + contact_skin);
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    for (const Neighbor& neighbor : neighbors[i]) {
      const double shorter = bond_reach(atoms.species[i], atoms.species[neighbor.atom]) /
                             bond_reach(Species::carbon, Species::carbon);
      const double distance = shorter * contact_distance(i, neighbor.atom);
      if (neighbor.distance > distance + contact_skin) continue;
      if (is_bonded(i, neighbor.atom, neighbor.image)) continue;
      contacts_.push_back({neighbor.atom, neighbor.image, distance});
    }
    first_contact_[i + 1] = contacts_.size();
  }
}

bool NetworkSprings::is_bonded(std::size_t from, std::uint32_t to, const Image& image) const {
  return std::ranges::any_of(bonded(from), [&](const Spring& spring) {
    return spring.atom == to && spring.image == image;
  });
}

double NetworkSprings::contact_distance(std::size_t from, std::uint32_t to) const {
  bool is_third = false;
  for (const Spring& first : bonded(from)) {
    for (const Spring& second : bonded(first.atom)) {
      if (second.atom == to) return options_.contact.second;
      for (const Spring& third : bonded(second.atom)) is_third = is_third || third.atom == to;
    }
  }
  return is_third ? options_.contact.third : options_.contact.others;
}

void NetworkSprings::find_bends(const AtomsView& atoms) {
  if (options_.smoothness == 0.0) return;
  for_each_chunk(atoms.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto own = bonded(i);
      bends_[i].setZero();
      // At the edge of an open network there is no saying where an atom wants to be.
      if (own.size() < 3) continue;
      for (const Spring& spring : own) bends_[i] += separation(atoms, i, spring);
      bends_[i] /= static_cast<double>(own.size());
    }
  });
}

// Sets the force on an atom; returns its half of all pairs and its own bend.
double NetworkSprings::evaluate_atom(const AtomsView& atoms, std::size_t atom,
                                     EnergyForces& result) const {
  Eigen::Vector3d force = options_.smoothness * bends_[atom];
  double energy = 0.5 * options_.smoothness * bends_[atom].squaredNorm();
  for (const Spring& spring : bonded(atom)) {
    const Eigen::Vector3d between = separation(atoms, atom, spring);
    const double length = between.norm();
    const double excess = length - std::clamp(length, spring.length.min, spring.length.max);
    energy += add_spring(between, excess, options_.bond_stiffness, force);
    const auto n_bonded = static_cast<double>(bonded(spring.atom).size());
    force -= options_.smoothness / n_bonded * bends_[spring.atom];
  }
  for (std::size_t k = first_contact_[atom]; k < first_contact_[atom + 1]; ++k) {
    const Contact& contact = contacts_[k];
    const Eigen::Vector3d between = separation(atoms, atom, contact);
    const double distance = contact.distance * std::min(scales_[atom], scales_[contact.atom]);
    const double overlap = std::min(between.norm() - distance, 0.0);
    energy += add_spring(between, overlap, options_.contact_stiffness, force);
  }
  result.energies[atom] = energy;
  result.forces[atom] = force;
  return energy;
}

}  // namespace trivalent::potentials::relax_detail
