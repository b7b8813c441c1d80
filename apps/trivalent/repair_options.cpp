#include "repair_options.h"

#include "trivalent/shell/option_names.h"

namespace trivalent::apps {
void add_repair_options(po::options_description& options) {
  const remesh::RepairOptions defaults;
  options.add_options()  //
      ("repair", with_default_name(defaults.method, shell::repair_names),
       "safe: repair what can be repaired without changing the shape; none: refuse what is not "
       "sound; wrap: a new closed surface a small distance outside of everything, for scans, soups "
       "and points")  //
      ("holes", with_default_name(defaults.holes, shell::hole_names),
       "keep: leave holes open; fill: close all of them")  //
      ("components", with_default_name(defaults.components, shell::component_names),
       "all: keep every component; largest: keep only the largest")  //
      ("wrap-alpha", po::value<double>(),
       "size of the gaps that a wrap closes, in units of the input; default: 1/100 of its "
       "diagonal, more among sparse points")  //
      ("wrap-offset", po::value<double>(),
       "distance of a wrap from the input, in its units; default: 1/30 of alpha, or an edge of the "
       "net where the wrap would be thinner than that, as of an open surface");
}

remesh::RepairOptions repair_options(const Session& session) {
  return {.method = named_value(session, "repair", shell::repair_names),
          .holes = named_value(session, "holes", shell::hole_names),
          .components = named_value(session, "components", shell::component_names),
          .wrap_alpha = session.find<double>("wrap-alpha"),
          .wrap_offset = session.find<double>("wrap-offset")};
}

}  // namespace trivalent::apps
