#include "trivalent/dual/dual_size.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "trivalent/dual/error.h"

namespace trivalent::dual {
namespace {

using remesh::TriMesh;

void check_positive(std::string_view name, double value) {
  if (std::isfinite(value) && value > 0.0) return;
  throw InvalidOption(concat("scale_for_size: ", name, " must be > 0 and finite, but is ", value));
}

/// Of the cell, or else of the bounding box.
double longest_side(const TriMesh& mesh) {
  if (!mesh.lattice.is_periodic()) return remesh::bounding_box(mesh).longest_side();
  double longest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!mesh.lattice.periodic()[k]) continue;
    longest = std::max(longest, mesh.lattice.cell().col(static_cast<Eigen::Index>(k)).norm());
  }
  return longest;
}

struct ScaleForSize {
  const TriMesh& mesh;

  double operator()(const MeanBond& bond) const {
    check_positive("the bond length", bond.length);
    const double mean = mean_bond_length(build_dual(mesh));
    if (mean > 0.0 && std::isfinite(mean)) return bond.length / mean;
    throw InvalidNetwork(
        "scale_for_size: the dual has no bonds of a finite length; give a scale instead");
  }
  double operator()(const LongestSide& side) const {
    check_positive("the longest side", side.length);
    const double longest = longest_side(mesh);
    if (longest > 0.0 && std::isfinite(longest)) return side.length / longest;
    throw InvalidNetwork("scale_for_size: the mesh has no finite extent");
  }
  double operator()(const Scale& scale) const {
    check_positive("the scale", scale.factor);
    return scale.factor;
  }
};

}  // namespace

double scale_for_size(const TriMesh& mesh, const DualSize& size) {
  if (mesh.n_faces() == 0) throw InvalidNetwork("scale_for_size: the mesh has no faces");
  return std::visit(ScaleForSize{mesh}, size);
}

}  // namespace trivalent::dual
