#include <cmath>

#include "io/mesh_readers.h"
#include "trivalent/remesh/error.h"
#include "volume/volume_readers.h"

namespace trivalent::remesh {

namespace {

constexpr double bohr = 0.529177210903;  // [Å], CODATA 2018

/// Reads a Gaussian cube file from its beginning to its end.
class CubeReader {
 public:
  explicit CubeReader(const Source& source)
      : source_(source), scanner_(source, Continuation::none) {}

  Volume run() {
    scanner_.raw_line();  // two of comments
    scanner_.raw_line();
    read_grid();
    skip_atoms();
    read_orbitals();
    read_values();
    if (!scanner_.word_across_lines().empty()) {
      volume_.notes.push_back("values behind the last point were ignored");
    }
    return std::move(volume_);
  }

 private:
  void read_grid() {
    signed_atoms_ = scanner_.integer("number of atoms");
    for (double& x : volume_.origin) x = scanner_.number("origin");
    if (!scanner_.peek().empty()) values_each_ = scanner_.integer("number of values of a point");
    std::array<std::int64_t, 3> size = {};
    double unit = bohr;
    for (std::size_t k = 0; k < 3; ++k) {
      size[k] = scanner_.integer("number of points");
      if (size[k] < 0) unit = 1.0;  // negative numbers: lengths in Å
      size[k] = std::abs(size[k]);
      for (double& x : volume_.steps.col(static_cast<Eigen::Index>(k))) {
        x = scanner_.number("step");
      }
    }
    volume_.origin *= unit;
    volume_.steps *= unit;
    volume_.values.resize(checked_points(source_, size, scanner_.bytes_left()));
    for (std::size_t k = 0; k < 3; ++k) volume_.size[k] = static_cast<int>(size[k]);
  }

  void skip_atoms() {
    const std::int64_t atoms = std::abs(signed_atoms_);
    check_declared(source_, {"atoms", static_cast<std::uint64_t>(atoms), 2}, scanner_.bytes_left());
    for (std::int64_t i = 0; i < atoms; ++i) {
      scanner_.integer("atomic number");
      for (int k = 0; k < 4; ++k) scanner_.number("charge and position of an atom");
    }
  }

  void read_orbitals() {
    // A negative number of atoms announces a line of orbitals behind the atoms.
    if (signed_atoms_ < 0) {
      values_each_ = scanner_.integer("number of orbitals");
      if (values_each_ < 1) scanner_.fail("a cube file holds 1 or more orbitals");
      check_declared(source_, {"orbitals", static_cast<std::uint64_t>(values_each_), 2},
                     scanner_.bytes_left());
      for (std::int64_t i = 0; i < values_each_; ++i) scanner_.integer("number of an orbital");
    }
    if (values_each_ < 1) scanner_.fail("a cube file holds 1 or more values at a point");
    if (values_each_ == 1) return;
    volume_.notes.push_back(
        concat("holds ", values_each_, " values at each point: took the first"));
  }

  /// The last axis runs fastest in the file.
  void read_values() {
    const auto [nx, ny, nz] = volume_.size;
    for (int x = 0; x < nx; ++x) {
      for (int y = 0; y < ny; ++y) {
        for (int z = 0; z < nz; ++z) {
          const auto row = static_cast<std::size_t>(y) +
                           static_cast<std::size_t>(ny) * static_cast<std::size_t>(z);
          volume_.values[static_cast<std::size_t>(x) + static_cast<std::size_t>(nx) * row] =
              static_cast<float>(scanner_.number("value"));
          for (std::int64_t i = 1; i < values_each_; ++i) scanner_.number("value");
        }
      }
    }
  }

  const Source& source_;
  TextScanner scanner_;
  Volume volume_;
  std::int64_t signed_atoms_ = 0;
  std::int64_t values_each_ = 1;
};

}  // namespace

Volume read_cube(const Source& source) { return CubeReader(source).run(); }

}  // namespace trivalent::remesh
