#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// A parameter of a built-in surface.
struct ShapeParameter {
  std::string name;
  double default_value = 0.0;  ///< in the shape's own unit of length
  std::string meaning;
  bool is_list = false;  ///< several numbers; may be given several times, and has no default
};

/// A built-in surface.
struct ShapeDescription {
  std::string name;
  std::string meaning;
  std::vector<ShapeParameter> parameters;
  double coarsest = 10.0;  ///< edges along the smallest parameter that show the topology
};

/// All built-in shapes: sphere, ellipsoid, torus, double-torus, capsule, tube, open-tube,
/// wavy-sheet and junctions of tubes, then the periodic ones: networks of tubes, schwarz-p,
/// schwarz-d, gyroid, i-wp, neovius, plane, periodic-tube and wave.
[[nodiscard]] const std::vector<ShapeDescription>& built_in_shapes();

/// A value for one of a shape's parameters.
struct ShapeArgument {
  std::string name;
  double value = 0.0;
  std::vector<double> list = {};  ///< instead, of a parameter that is a list
};

/// Makes a built-in shape; omitted parameters take their defaults.
///
/// @param edge_length  Mean edge length of the triangles, in the shape's own unit, > 0.
/// @throws InvalidOption if the name or a parameter is unknown, or a value out of its range.
[[nodiscard]] TriMesh make_shape(std::string_view name, const std::vector<ShapeArgument>& arguments,
                                 double edge_length);

}  // namespace trivalent::remesh
