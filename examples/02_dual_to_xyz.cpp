// Builds a carbon shell on a torus and writes it for ASE and OVITO (XYZ) and for LAMMPS (data).
#include <cstdio>
#include <exception>

#include "trivalent/dual/columns.h"
#include "trivalent/dual/network_checks.h"
#include "trivalent/formats/lammps_data.h"
#include "trivalent/formats/xyz.h"
#include "trivalent/remesh/shapes.h"
#include "trivalent/shell/build_shell.h"

namespace dual = trivalent::dual;

int run() {
  const auto torus = trivalent::remesh::make_shape("torus", {{"R", 3.0}, {"r", 1.0}}, 0.15);

  dual::ShellOptions options;
  options.size = dual::AtomCount{2000};  // or LongestSide{50.0}, or Scale{12.0}
  options.bond = 1.42;                   // [Å]
  options.method = trivalent::remesh::CrystalOptions{.effort = trivalent::remesh::Effort::quick};
  dual::Structure shell = dual::build_shell(torus, options).structure;
  shell.columns = dual::network_columns(shell);

  dual::write_xyz("torus.extxyz", shell);
  dual::write_lammps_data("torus.data", shell, {.style = dual::AtomStyle::molecular});

  const dual::NetworkReport report = dual::check_network(shell);
  std::printf("%d atoms, %d bonds of %.3f Å on average, %.1f %% hexagons\n", report.atoms,
              report.bonds, report.bond_mean, 100.0 * report.hexagon_fraction);
  // Closed, and of genus 1: three bonds everywhere, and as many missing as surplus ring corners.
  return report.is_trivalent() && report.ring_excess == 0 ? 0 : 1;
}

int main() {
  try {
    return run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
