#pragma once

#include <cstddef>
#include <vector>

#include "crystal/membrane.h"

namespace trivalent::remesh {

/// The energy of a whole net, by several threads. Its terms are dealt out to parts, as many as the
/// net's size asks for, whose sums are added in order: the same bytes on any number of threads.
class ParallelMembrane {
 public:
  /// @param membrane  Must outlive this object.
  /// @param count     Of vertices and images.
  ParallelMembrane(const Membrane& membrane, const MembraneTerms<double>& terms, std::size_t count);

  /// As membrane_energy(), but sets the gradient.
  double evaluate(const std::vector<Lanes<double>>& x, std::vector<Lanes<double>>& gradient);

 private:
  struct Part {
    MembraneTerms<double> terms;
    std::vector<Lanes<double>> gradient;
    double energy = 0.0;
  };
  const Membrane& membrane_;
  std::vector<Part> parts_;
};

}  // namespace trivalent::remesh
