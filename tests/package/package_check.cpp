// Uses every library of the package once: a sphere, remeshed, its dual, its energy.
#include <cstdio>

#include "trivalent/dual/network_checks.h"
#include "trivalent/potentials/rebo.h"
#include "trivalent/remesh/shapes.h"
#include "trivalent/shell/build_shell.h"

int main() {
  namespace dual = trivalent::dual;
  namespace remesh = trivalent::remesh;
  dual::ShellOptions options;
  options.size = dual::AtomCount{500};
  const auto shell = dual::build_shell(remesh::make_shape("sphere", {}, 0.05), options);
  const auto report = dual::check_network(shell.structure);
  const auto energy = trivalent::potentials::rebo(shell.structure.atoms);
  std::printf("%d atoms, %.4f eV/atom\n", report.atoms, energy.energy / report.atoms);
  return report.is_trivalent() && energy.energy < 0.0 ? 0 : 1;
}
