#include "relax/bond_guard.h"

#include <algorithm>
#include <limits>

#include "parallel.h"

namespace trivalent::potentials::relax_detail {

namespace {

struct Any {
  bool value = false;
  Any& operator+=(const Any& other) {
    value = value || other.value;
    return *this;
  }
};

// C-C 1.95 Å.
double usual_limit(const Atoms& atoms, const Bond& bond) {
  return 0.975 * bond_reach(atoms.species[bond.first], atoms.species[bond.second]);
}

}  // namespace

BondGuard::BondGuard(const Atoms& atoms, std::vector<Bond> bonds) : bonds_(std::move(bonds)) {
  limits_.assign(bonds_.size(), std::numeric_limits<double>::infinity());
  accept(atoms);
}

bool BondGuard::allows(const Atoms& atoms) const {
  const auto any_torn = sum_over_chunks<Any>(bonds_.size(), [&](std::size_t begin, auto end) {
    for (std::size_t k = begin; k < end; ++k) {
      if (!(bond_length(atoms, bonds_[k]) <= limits_[k])) return Any{true};
    }
    return Any{};
  });
  return !any_torn.value;
}

void BondGuard::accept(const Atoms& atoms) {
  if (!is_any_beyond_) return;
  is_any_beyond_ = false;
  for (std::size_t k = 0; k < bonds_.size(); ++k) {
    const double usual = usual_limit(atoms, bonds_[k]);
    limits_[k] = std::max(usual, std::min(limits_[k], bond_length(atoms, bonds_[k])));
    is_any_beyond_ = is_any_beyond_ || limits_[k] > usual;
  }
}

}  // namespace trivalent::potentials::relax_detail
