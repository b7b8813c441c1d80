#include "module.h"

#include "errors.h"
#include "trivalent/dual/energy_summary.h"

namespace trivalent::python {

PYBIND11_MODULE(_core, module) {
  module.doc() = "The libraries in C++; `trivalent` is what to import";
  module.attr("version") = TRIVALENT_VERSION;
  module.attr("graphene_energy") = dual::graphene_energy;
  translate_errors();
  add_structure(module);
  add_surface(module);
  add_potentials(module);
  add_build(module);
  add_relax(module);
  add_views(module);
}

}  // namespace trivalent::python
