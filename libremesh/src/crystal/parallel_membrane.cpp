#include "crystal/parallel_membrane.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace trivalent::remesh {

namespace {

constexpr std::size_t max_parts = 4;
constexpr std::size_t min_hinges = 2048;  // of a part; fewer take less time than a thread's start

/// The k-th of so many equal parts.
template <typename Term>
std::vector<Term> part_of(const std::vector<Term>& terms, std::size_t k, std::size_t parts) {
  const auto at = [&](std::size_t n) {
    return terms.begin() + static_cast<std::ptrdiff_t>(n * terms.size() / parts);
  };
  return {at(k), at(k + 1)};
}

}  // namespace

ParallelMembrane::ParallelMembrane(const Membrane& membrane, const MembraneTerms<double>& terms,
                                   std::size_t count)
    : membrane_(membrane),
      parts_(std::clamp<std::size_t>(terms.hinges.size() / min_hinges, 1, max_parts)) {
  const std::size_t n = parts_.size();
  for (std::size_t k = 0; k < n; ++k) {
    parts_[k].terms = {.hinges = part_of(terms.hinges, k, n),
                       .edges = part_of(terms.edges, k, n),
                       .contacts = part_of(terms.contacts, k, n),
                       .tethers = part_of(terms.tethers, k, n),
                       .pulls = part_of(terms.pulls, k, n)};
    parts_[k].gradient.resize(count);
  }
}

double ParallelMembrane::evaluate(const std::vector<Lanes<double>>& x,
                                  std::vector<Lanes<double>>& gradient) {
  tbb::parallel_for(std::size_t{0}, parts_.size(), [&](std::size_t k) {
    Part& part = parts_[k];
    std::ranges::fill(part.gradient, Lanes<double>::Zero());
    part.energy = membrane_energy(membrane_, part.terms, x, part.gradient);
  });
  constexpr std::size_t vertices_at_once = 4096;
  const tbb::blocked_range<std::size_t> all(0, gradient.size(), vertices_at_once);
  tbb::parallel_for(all, [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      Lanes<double> sum = parts_[0].gradient[i];
      for (std::size_t k = 1; k < parts_.size(); ++k) sum += parts_[k].gradient[i];
      gradient[i] = sum;
    }
  });
  double energy = 0.0;
  for (const Part& part : parts_) energy += part.energy;
  return energy;
}

}  // namespace trivalent::remesh
