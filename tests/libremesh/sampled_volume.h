#pragma once

#include <array>
#include <functional>

#include "trivalent/remesh/volume.h"

namespace trivalent::remesh {

using Sizes = std::array<int, 3>;
using Field = std::function<double(const Eigen::Vector3d&)>;

inline std::size_t index_of(const Sizes& size, int x, int y, int z) {
  return static_cast<std::size_t>(x + size[0] * (y + size[1] * z));
}

/// A field at the points of a grid.
inline Volume sampled(const Field& field, const Sizes& size, const Eigen::Vector3d& origin,
                      const Eigen::Matrix3d& steps) {
  Volume volume{.size = size, .origin = origin, .steps = steps, .values = {}};
  for (int z = 0; z < size[2]; ++z) {
    for (int y = 0; y < size[1]; ++y) {
      for (int x = 0; x < size[0]; ++x) {
        volume.values.push_back(
            static_cast<float>(field(origin + steps * Eigen::Vector3d(x, y, z))));
      }
    }
  }
  return volume;
}

/// A volume with another size and step along each axis, whose values tell axes apart.
inline Volume lopsided() {
  const Field field = [](const Eigen::Vector3d& p) { return p.x() + 10.0 * p.y() - 3.0 * p.z(); };
  return sampled(field, {3, 4, 5}, {1.0, -2.0, 0.5}, Eigen::Vector3d(0.5, 0.25, 2.0).asDiagonal());
}

}  // namespace trivalent::remesh
