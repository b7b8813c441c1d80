#include "repair_options.h"

namespace trivalent::apps {
namespace {

using remesh::ComponentPolicy;
using remesh::HolePolicy;
using remesh::RepairMethod;

constexpr shell::Names<RepairMethod, 3> repair_methods = {
    {{"none", RepairMethod::none}, {"safe", RepairMethod::safe}, {"wrap", RepairMethod::wrap}}};
constexpr shell::Names<HolePolicy, 2> hole_policies = {
    {{"keep", HolePolicy::keep}, {"fill", HolePolicy::fill}}};
constexpr shell::Names<ComponentPolicy, 2> component_policies = {
    {{"all", ComponentPolicy::keep_all}, {"largest", ComponentPolicy::keep_largest}}};

}  // namespace

void add_repair_options(po::options_description& options) {
  const remesh::RepairOptions defaults;
  options.add_options()  //
      ("repair", with_default_name(defaults.method, repair_methods),
       "safe: repair what can be repaired without changing the shape; none: refuse what is not "
       "sound; wrap: a new closed surface a small distance outside of everything, for scans, soups "
       "and points")  //
      ("holes", with_default_name(defaults.holes, hole_policies),
       "keep: leave holes open; fill: close all of them")  //
      ("components", with_default_name(defaults.components, component_policies),
       "all: keep every component; largest: keep only the largest")  //
      ("wrap-alpha", po::value<double>(),
       "size of the gaps that a wrap closes, in units of the input; default: 1/100 of its "
       "diagonal, more among sparse points")  //
      ("wrap-offset", po::value<double>(),
       "distance of a wrap from the input, in its units; default: 1/30 of alpha, or an edge of the "
       "net where the wrap would be thinner than that, as of an open surface");
}

remesh::RepairOptions repair_options(const Session& session) {
  return {.method = named_value(session, "repair", repair_methods),
          .holes = named_value(session, "holes", hole_policies),
          .components = named_value(session, "components", component_policies),
          .wrap_alpha = session.find<double>("wrap-alpha"),
          .wrap_offset = session.find<double>("wrap-offset")};
}

}  // namespace trivalent::apps
