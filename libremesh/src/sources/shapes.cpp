#include "trivalent/remesh/shapes.h"

#include <algorithm>
#include <cmath>

#include "sources/built_in_shapes.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

struct BuiltInShape {
  ShapeDescription description;
  TriMesh (*make)(const Request&);
};

/// A new shape is one row here, and one function.
const std::vector<BuiltInShape>& shape_table() {
  static const ShapeParameter radius{"radius", 1.0, "radius"};
  static const ShapeParameter major{"R", 1.0, "radius of the center line"};
  static const ShapeParameter minor{"r", 0.4, "radius of the tube"};
  static const ShapeParameter cell{"a", 1.0, "edge of the cell"};
  constexpr double necks = 20.0;  // a cell has several
  const std::vector<ShapeParameter> arms = {
      {"radius", 1.0, "radius of the tubes"},
      {"length", 4.0, "from the middle to the hemisphere that closes an arm, or to its open end"},
      {"neck", 1.0, "radius of the fillets between arms, about"},
      {"open", 0.0, "1: arms are open; 0: closed"}};
  std::vector<ShapeParameter> any_arms = arms;
  any_arms.push_back({"arm", 0.0,
                      "direction x y z of an arm, its length and radius if they differ; "
                      "once for each arm, as in 'junction:arm=1 0 0,arm=-1 0 0,arm=0 1 1 6 0.8'. "
                      "Or, of open arms, direction, length and chiral indices: 'arm=0 1 1 6 8 4'",
                      true});
  std::vector<ShapeParameter> equal_arms = arms;
  equal_arms.push_back({"n", 0.0,
                        "of open arms that end as (n,m) nanotubes: first chiral index, which sets "
                        "the size; 0: any tubes"});
  equal_arms.push_back({"m", 0.0, "second chiral index"});
  const auto tubes = [](double edge) {
    return std::vector<ShapeParameter>{{"a", edge, "edge of the cell"},
                                       {"radius", 1.0, "radius of the tubes"},
                                       {"neck", 1.0, "radius of the fillets, about"}};
  };
  static const std::vector<BuiltInShape> table = {
      {{"sphere", "sphere", {radius}}, sphere},
      {{"ellipsoid",
        "ellipsoid; triangles are stretched along the axes",
        {{"a", 1.5, "semi-axis along x"},
         {"b", 1.0, "semi-axis along y"},
         {"c", 0.75, "semi-axis along z"}}},
       ellipsoid},
      {{"torus", "torus around the z axis", {major, minor}}, torus},
      {{"double-torus",
        "two tori side by side, joined smoothly (genus 2); r is at most 0.6 R",
        {major, {"r", 0.4, "radius of the tubes"}}},
       double_torus},
      {{"capsule",
        "cylinder along z with hemispheres at both ends",
        {radius, {"length", 3.0, "length of the cylinder between the hemispheres"}}},
       capsule},
      {{"tube", "cylinder along z, closed by flat discs", {radius, {"length", 4.0, "length"}}},
       tube},
      {{"open-tube", "cylinder along z, open at both ends", {radius, {"length", 4.0, "length"}}},
       open_tube},
      {{"wavy-sheet",
        "open sheet z = amplitude sin(2π x/wavelength) sin(2π y/wavelength)",
        {{"width", 2.0, "extent along x"},
         {"depth", 2.0, "extent along y"},
         {"amplitude", 0.1, "amplitude; may be 0 or negative"},
         {"wavelength", 1.0, "wavelength along x and y"}}},
       wavy_sheet},
      {{"y-junction", "three tubes at 120 degrees to each other", equal_arms}, y_junction},
      {{"t-junction", "a tube that meets another at a right angle", equal_arms}, t_junction},
      {{"x-junction", "two tubes that cross at right angles", equal_arms}, x_junction},
      {{"tetrapod", "four tubes towards the corners of a tetrahedron", equal_arms}, tetrapod},
      {{"six-arm-junction", "three tubes that cross at right angles", equal_arms},
       six_arm_junction},
      {{"junction", "any number of tubes that meet", any_arms}, junction},
      {{"cubic-network", "periodic: tubes along the edges of a cubic lattice", tubes(6.0)},
       cubic_network},
      {{"diamond-network", "periodic: tubes along the bonds of diamond, in its cubic cell",
        tubes(14.0)},
       diamond_network},
      {{"honeycomb-network", "periodic along x and y: tubes along the bonds of a honeycomb",
        tubes(10.0)},
       honeycomb_network},
      {{"schwarz-p", "periodic: Schwarz' P surface in its cubic cell", {cell}, necks}, schwarz_p},
      {{"schwarz-d",
        "periodic: Schwarz' D surface in a cubic cell of two by two by two",
        {cell},
        necks},
       schwarz_d},
      {{"gyroid", "periodic: Schoen's gyroid in its cubic cell", {cell}, necks}, gyroid},
      {{"i-wp", "periodic: Schoen's I-WP surface in its cubic cell", {cell}, necks}, i_wp},
      {{"neovius", "periodic: Neovius' surface in its cubic cell", {cell}, necks}, neovius},
      {{"plane",
        "periodic along x and y: flat sheet, the cell a parallelogram",
        {{"a", 1.0, "length along x"},
         {"b", 1.0, "length of the other side"},
         {"gamma", 90.0, "angle between the sides [degree]"}}},
       plane},
      {{"periodic-tube",
        "periodic along z: cylinder",
        {radius, {"length", 2.0, "length of the cell"}}},
       periodic_tube},
      {{"wave",
        "periodic along x and y: sheet z = amplitude sin(2π x/a) sin(2π y/b)",
        {{"a", 1.0, "length along x"},
         {"b", 1.0, "length along y"},
         {"amplitude", 0.1, "amplitude; may be 0 or negative"}}},
       wave}};
  return table;
}

std::string names_of(const std::vector<ShapeParameter>& parameters) {
  std::string names;
  for (const auto& parameter : parameters) names += (names.empty() ? "" : ", ") + parameter.name;
  return names;
}

const BuiltInShape& find_shape(std::string_view name) {
  std::string known;
  for (const BuiltInShape& shape : shape_table()) {
    if (shape.description.name == name) return shape;
    known += (known.empty() ? "" : ", ") + shape.description.name;
  }
  throw InvalidOption(concat("make_shape: no shape is called '", name, "'; there are ", known));
}

/// @throws InvalidOption unless the argument fits the parameter.
void check_argument(const ShapeDescription& shape, const ShapeParameter& parameter,
                    const ShapeArgument& argument) {
  const auto refuse = [&](const auto&... reason) {
    throw InvalidOption(concat("make_shape: ", shape.name, ": ", argument.name, " ", reason...));
  };
  if (parameter.is_list == argument.list.empty()) {
    refuse("is ", parameter.is_list ? "a list of numbers" : "one number");
  }
  const auto is_finite = [](double value) { return std::isfinite(value); };
  if (!is_finite(argument.value) || !std::ranges::all_of(argument.list, is_finite)) {
    refuse("must be a finite number");
  }
}

Request request_for(const ShapeDescription& shape, const std::vector<ShapeArgument>& arguments) {
  Request request = {.shape = shape.name, .values = {}};
  for (const ShapeParameter& parameter : shape.parameters) {
    if (!parameter.is_list) request.values[parameter.name] = parameter.default_value;
  }
  for (const ShapeArgument& argument : arguments) {
    const auto known = std::ranges::find(shape.parameters, argument.name, &ShapeParameter::name);
    if (known == shape.parameters.end()) {
      throw InvalidOption(concat("make_shape: ", shape.name, " has no parameter '", argument.name,
                                 "'; it has ", names_of(shape.parameters)));
    }
    check_argument(shape, *known, argument);
    if (!known->is_list && std::ranges::count(arguments, argument.name, &ShapeArgument::name) > 1) {
      throw InvalidOption(
          concat("make_shape: ", shape.name, ": ", argument.name, " is given several times"));
    }
    if (known->is_list) {
      request.lists.push_back(argument.list);
    } else {
      request.values[argument.name] = argument.value;
    }
  }
  return request;
}

}  // namespace

const std::vector<ShapeDescription>& built_in_shapes() {
  static const std::vector<ShapeDescription> descriptions = [] {
    std::vector<ShapeDescription> all;
    for (const BuiltInShape& shape : shape_table()) all.push_back(shape.description);
    return all;
  }();
  return descriptions;
}

TriMesh make_shape(std::string_view name, const std::vector<ShapeArgument>& arguments,
                   double edge_length) {
  const BuiltInShape& shape = find_shape(name);
  Request request = request_for(shape.description, arguments);
  if (!(edge_length > 0.0) || !std::isfinite(edge_length)) {
    throw InvalidOption(
        concat("make_shape: edge_length must be > 0 and finite, but is ", edge_length));
  }
  request.edge_length = edge_length;
  return shape.make(request);
}

}  // namespace trivalent::remesh
