#include "relax/network_springs.h"

#include <algorithm>

#include "parallel.h"
#include "trivalent/potentials/neighbor_list.h"

namespace trivalent::potentials::relax_detail {

namespace {

// Contacts are searched again once an atom has moved half of this [Å].
constexpr double contact_skin = 0.8;

constexpr double carbon_bond = 1.42;    // [Å]
constexpr double hydrogen_bond = 1.09;  // to carbon [Å]

std::array<std::int32_t, 3> back(const std::array<std::int32_t, 3>& image) {
  return {-image[0], -image[1], -image[2]};
}

}  // namespace

NetworkSprings::NetworkSprings(const Atoms& atoms, std::span<const Bond> bonds,
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
    const double rest = options_.rest_lengths.empty() ? 0.0 : options_.rest_lengths[k];
    bonded_[next[bond.first]++] = {bond.second, bond.image, rest};
    bonded_[next[bond.second]++] = {bond.first, back(bond.image), rest};
  }
  set_scales();
  bends_.assign(atoms.size(), Eigen::Vector3d::Zero());
}

void NetworkSprings::set_scales() {
  scales_.assign(first_bonded_.size() - 1, 1.0);
  if (options_.rest_lengths.empty()) return;
  for (std::size_t i = 0; i < scales_.size(); ++i) {
    double sum = 0.0;
    for (const Link& link : bonded(i)) sum += link.length;
    const double mean = sum / std::max(1.0, static_cast<double>(bonded(i).size()));
    scales_[i] = std::min(1.0, mean / carbon_bond);
  }
}

Eigen::Vector3d NetworkSprings::separation(const Atoms& atoms, std::size_t atom,
                                           const Link& link) const {
  Eigen::Vector3d between = atoms.positions[link.atom] - atoms.positions[atom];
  for (int k = 0; k < 3; ++k) {
    const std::int32_t times = link.image[static_cast<std::size_t>(k)];
    if (times != 0) between += times * atoms.box.cell.col(k);
  }
  return between;
}

double NetworkSprings::excess(const Atoms& atoms, std::size_t atom, const Link& link,
                              double length) const {
  const bool has_hydrogen =
      atoms.species[atom] == Species::hydrogen || atoms.species[link.atom] == Species::hydrogen;
  if (has_hydrogen) return length - hydrogen_bond;
  if (!options_.rest_lengths.empty()) return length - link.length;
  return length - std::clamp(length, options_.shortest, options_.longest);
}

void NetworkSprings::compute(const Atoms& atoms, EnergyForces& result) {
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

bool NetworkSprings::have_moved(const Atoms& atoms) const {
  if (positions_of_contacts_.size() != atoms.size()) return true;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    const double way = (atoms.positions[i] - positions_of_contacts_[i]).norm();
    if (!(way <= 0.5 * contact_skin)) return true;
  }
  return false;
}

void NetworkSprings::find_contacts(const Atoms& atoms) {
  const NeighborList neighbors(atoms, options_.contact.others + contact_skin);
  first_contact_.assign(1, 0);
  contacts_.clear();
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    const auto own = bonded(i);
    for (const Neighbor& neighbor : neighbors[i]) {
      const Link link = {neighbor.atom, neighbor.image, contact_distance(i, neighbor.atom)};
      const bool may_touch = neighbor.distance <= link.length + contact_skin;
      const bool is_bonded = std::any_of(own.begin(), own.end(),
                                         [&](const Link& bond) { return bond.leads_to(link); });
      if (may_touch && !is_bonded) contacts_.push_back(link);
    }
    first_contact_.push_back(contacts_.size());
  }
  positions_of_contacts_ = atoms.positions;
}

double NetworkSprings::contact_distance(std::size_t from, std::uint32_t to) const {
  bool is_third = false;
  for (const Link& first : bonded(from)) {
    for (const Link& second : bonded(first.atom)) {
      if (second.atom == to) return options_.contact.second;
      for (const Link& third : bonded(second.atom)) is_third = is_third || third.atom == to;
    }
  }
  return is_third ? options_.contact.third : options_.contact.others;
}

void NetworkSprings::find_bends(const Atoms& atoms) {
  for_each_chunk(atoms.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto own = bonded(i);
      bends_[i].setZero();
      // At the edge of an open network there is no saying where an atom wants to be.
      if (own.size() < 3) continue;
      for (const Link& link : own) bends_[i] += separation(atoms, i, link);
      bends_[i] /= static_cast<double>(own.size());
    }
  });
}

// Sets the force on an atom; returns its half of all pairs and its own bend.
double NetworkSprings::evaluate_atom(const Atoms& atoms, std::size_t atom,
                                     EnergyForces& result) const {
  Eigen::Vector3d force = options_.smoothness * bends_[atom];
  double energy = 0.5 * options_.smoothness * bends_[atom].squaredNorm();
  for (const Link& link : bonded(atom)) {
    const Eigen::Vector3d between = separation(atoms, atom, link);
    energy += add_spring(between, excess(atoms, atom, link, between.norm()),
                         options_.bond_stiffness, force);
    const auto n_bonded = static_cast<double>(bonded(link.atom).size());
    force -= options_.smoothness / n_bonded * bends_[link.atom];
  }
  for (std::size_t k = first_contact_[atom]; k < first_contact_[atom + 1]; ++k) {
    const Link& contact = contacts_[k];
    const Eigen::Vector3d between = separation(atoms, atom, contact);
    const double distance = contact.length * std::min(scales_[atom], scales_[contact.atom]);
    const double overlap = std::min(between.norm() - distance, 0.0);
    energy += add_spring(between, overlap, options_.contact_stiffness, force);
  }
  result.energies[atom] = energy;
  result.forces[atom] = force;
  return energy;
}

double NetworkSprings::add_spring(const Eigen::Vector3d& between, double excess, double stiffness,
                                  Eigen::Vector3d& force) const {
  if (excess == 0.0) return 0.0;
  force += stiffness * excess * between.stableNormalized();
  return 0.25 * stiffness * excess * excess;
}

}  // namespace trivalent::potentials::relax_detail
