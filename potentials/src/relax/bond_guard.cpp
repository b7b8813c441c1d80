#include "relax/bond_guard.h"

#include <algorithm>

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

}  // namespace

BondGuard::BondGuard(const Atoms& atoms, std::vector<Bond> bonds, double limit)
    : bonds_(std::move(bonds)), limit_(limit) {
  limits_.assign(bonds_.size(), std::numeric_limits<double>::infinity());
  accept(atoms);
}

bool BondGuard::allows(const Atoms& atoms) const {
  const auto any_torn = sum_over_chunks<Any>(bonds_.size(), [&](std::size_t begin, auto end) {
    for (std::size_t k = begin; k < end; ++k) {
      const double limit = limits_.empty() ? limit_ : limits_[k];
      if (!(bond_length(atoms, bonds_[k]) <= limit)) return Any{true};
    }
    return Any{};
  });
  return !any_torn.value;
}

void BondGuard::accept(const Atoms& atoms) {
  if (limits_.empty()) return;
  bool is_any_beyond = false;
  for (std::size_t k = 0; k < bonds_.size(); ++k) {
    const double length = std::min(limits_[k], bond_length(atoms, bonds_[k]));
    limits_[k] = std::max(limit_, length);
    is_any_beyond = is_any_beyond || length > limit_;
  }
  if (!is_any_beyond) limits_.clear();
}

}  // namespace trivalent::potentials::relax_detail
