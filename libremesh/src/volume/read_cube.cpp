#include <cmath>

#include "io/mesh_readers.h"
#include "trivalent/remesh/error.h"
#include "volume/volume_readers.h"

namespace trivalent::remesh {

namespace {

constexpr double bohr = 0.529177210903;  // [Å], CODATA 2018

}  // namespace

Volume read_cube(const Source& source) {
  TextScanner scanner(source, Continuation::none);
  scanner.raw_line();  // two of comments
  scanner.raw_line();
  Volume volume;
  // A negative number of atoms announces a line of orbitals behind the atoms.
  const std::int64_t signed_atoms = scanner.integer("number of atoms");
  for (double& x : volume.origin) x = scanner.number("origin");
  std::int64_t values_each = 1;
  if (!scanner.peek().empty()) values_each = scanner.integer("number of values of a point");
  std::array<std::int64_t, 3> size = {};
  double unit = bohr;
  for (std::size_t k = 0; k < 3; ++k) {
    size[k] = scanner.integer("number of points");
    if (size[k] < 0) unit = 1.0;  // negative numbers: lengths in Å
    size[k] = std::abs(size[k]);
    for (double& x : volume.steps.col(static_cast<Eigen::Index>(k))) x = scanner.number("step");
  }
  volume.origin *= unit;
  volume.steps *= unit;
  const std::size_t points = checked_points(source, size, scanner.bytes_left());
  const std::int64_t atoms = std::abs(signed_atoms);
  check_declared(source, {"atoms", static_cast<std::uint64_t>(atoms), 2}, scanner.bytes_left());
  for (std::int64_t i = 0; i < atoms; ++i) {
    scanner.integer("atomic number");
    for (int k = 0; k < 4; ++k) scanner.number("charge and position of an atom");
  }
  if (signed_atoms < 0) {
    values_each = scanner.integer("number of orbitals");
    if (values_each < 1) scanner.fail("a cube file holds 1 or more orbitals");
    check_declared(source, {"orbitals", static_cast<std::uint64_t>(values_each), 2},
                   scanner.bytes_left());
    for (std::int64_t i = 0; i < values_each; ++i) scanner.integer("number of an orbital");
  }
  if (values_each < 1) scanner.fail("a cube file holds 1 or more values at a point");
  if (values_each > 1) {
    volume.notes.push_back(concat("holds ", values_each, " values at each point: took the first"));
  }
  for (std::size_t k = 0; k < 3; ++k) volume.size[k] = static_cast<int>(size[k]);
  volume.values.resize(points);
  // The last axis runs fastest in the file.
  const auto [nx, ny, nz] = volume.size;
  for (int x = 0; x < nx; ++x) {
    for (int y = 0; y < ny; ++y) {
      for (int z = 0; z < nz; ++z) {
        const auto index = static_cast<std::size_t>(x) +
                           static_cast<std::size_t>(nx) *
                               (static_cast<std::size_t>(y) +
                                static_cast<std::size_t>(ny) * static_cast<std::size_t>(z));
        volume.values[index] = static_cast<float>(scanner.number("value"));
        for (std::int64_t i = 1; i < values_each; ++i) scanner.number("value");
      }
    }
  }
  if (!scanner.word_across_lines().empty()) {
    volume.notes.push_back("values behind the last point were ignored");
  }
  return volume;
}

}  // namespace trivalent::remesh
