#include "trivalent/shell/ideal_source.h"

#include <algorithm>
#include <cmath>

#include "trivalent/dual/error.h"
#include "trivalent/dual/ideal_structures.h"
#include "trivalent/shell/surface_source.h"

namespace trivalent::shell {
namespace {

using remesh::ShapeParameter;

const ShapeParameter periodic_parameter = {"periodic", 1,
                                           "1: goes on in the next cell; 0: bare edges"};
const ShapeParameter hydrogen_parameter = {"hydrogen", 0,
                                           "1: edges capped with hydrogen, not periodic"};

/// The values of a call, checked against what its structure knows.
class Values {
 public:
  explicit Values(const ShapeCall& call) : call_(call) {
    const auto known =
        std::ranges::find(ideal_structures(), call.name, &remesh::ShapeDescription::name);
    for (const ShapeParameter& parameter : known->parameters) {
      values_.push_back({parameter.name, parameter.default_value});
    }
    for (const remesh::ShapeArgument& argument : call.arguments) {
      const auto found = std::ranges::find(values_, argument.name, &remesh::ShapeArgument::name);
      if (found == values_.end()) {
        throw remesh::InvalidOption(
            dual::concat(call.name, " has no parameter '", argument.name, "'"));
      }
      if (!argument.list.empty() ||
          std::ranges::count(call.arguments, argument.name, &remesh::ShapeArgument::name) > 1) {
        throw remesh::InvalidOption(
            dual::concat(call.name, ": ", argument.name, " is given several numbers"));
      }
      if (argument.value != std::round(argument.value) || std::abs(argument.value) > 1e9) {
        throw remesh::InvalidOption(dual::concat(call.name, ": ", argument.name, " is ",
                                                 argument.value, "; it must be a whole number"));
      }
      found->value = argument.value;
    }
  }

  [[nodiscard]] int operator[](std::string_view name) const {
    return static_cast<int>(std::ranges::find(values_, name, &remesh::ShapeArgument::name)->value);
  }

  [[nodiscard]] bool is_given(std::string_view name) const {
    return std::ranges::count(call_.arguments, name, &remesh::ShapeArgument::name) > 0;
  }

  /// @throws InvalidOption if one value is set together with a choice that leaves no room for it.
  void refuse(std::string_view name, std::string_view reason) const {
    if (is_given(name) && (*this)[name] != 0) {
      throw remesh::InvalidOption(
          dual::concat(call_.name, ": ", name, "=", (*this)[name], ": ", reason));
    }
  }

  [[nodiscard]] dual::Edges edges() const {
    if ((*this)["hydrogen"] != 0) {
      refuse("periodic", "a periodic structure leaves no edges for hydrogen=1");
      return dual::Edges::hydrogen;
    }
    return (*this)["periodic"] != 0 ? dual::Edges::periodic : dual::Edges::bare;
  }

 private:
  const ShapeCall& call_;
  std::vector<remesh::ShapeArgument> values_;
};

dual::Structure make_nanotube(const Values& values) {
  const int caps = values["caps"];
  if (caps < 0 || caps > 2) {
    throw remesh::InvalidOption(dual::concat("nanotube: caps is ", caps, "; it must be 0, 1 or 2"));
  }
  if (caps == 0) {
    values.refuse("length", "the length of a tube without caps is set by cells");
    return dual::nanotube(
        {.n = values["n"], .m = values["m"], .cells = values["cells"], .edges = values.edges()});
  }
  values.refuse("cells", "the straight part of a tube with caps is set by length, in Å");
  values.refuse("periodic", "a tube with caps is not periodic");
  dual::CappedNanotube tube = {
      .n = values["n"], .m = values["m"], .length = static_cast<double>(values["length"])};
  if (caps == 1) {
    tube.open_end = values["hydrogen"] != 0 ? dual::Edges::hydrogen : dual::Edges::bare;
  } else {
    values.refuse("hydrogen", "caps=2 leaves no edges");
  }
  return dual::capped_nanotube(tube);
}

}  // namespace

const std::vector<remesh::ShapeDescription>& ideal_structures() {
  static const std::vector<remesh::ShapeDescription> structures = {
      {"nanotube",
       "tube of graphene along z",
       {{"n", 10, "first number of the chiral vector"},
        {"m", 10, "second number"},
        {"cells", 1, "translational cells along the tube"},
        {"caps", 0, "ends closed by six pentagons each: 0, 1 or 2"},
        {"length", 0, "straight part of a tube with caps, in Å"},
        periodic_parameter,
        hydrogen_parameter}},
      {"graphene",
       "sheet in the xy plane",
       {{"nx", 10, "cells of 2.46 Å along a zigzag row"},
        {"ny", 6, "cells of 4.26 Å across"},
        periodic_parameter,
        hydrogen_parameter}},
      {"fullerene",
       "icosahedral cage",
       {{"N", 60, "atoms: 20 (h² + hk + k²) for whole h and k, as 20, 60, 80, 140, 180, 240"}}},
      {"onion", "icosahedral cages of 60 k² atoms inside each other", {{"walls", 3, "how many"}}}};
  return structures;
}

bool is_ideal_structure(std::string_view text) {
  const std::string_view name = text.substr(0, text.find(':'));
  return std::ranges::count(ideal_structures(), name, &remesh::ShapeDescription::name) > 0;
}

dual::Structure make_ideal_structure(std::string_view text) {
  const ShapeCall call = parse_shape(text);
  const Values values(call);
  if (call.name == "nanotube") return make_nanotube(values);
  if (call.name == "graphene") {
    return dual::graphene_sheet(values["nx"], values["ny"], values.edges());
  }
  if (call.name == "fullerene") return dual::icosahedral_fullerene(values["N"]);
  return dual::icosahedral_onion(values["walls"]);
}

}  // namespace trivalent::shell
