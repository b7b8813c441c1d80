#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// Values at the points of a regular grid, such as a tomogram or an electron density.
struct Volume {
  std::array<int, 3> size = {0, 0, 0};                  ///< points along each axis, >= 2
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();     ///< the first point
  Eigen::Matrix3d steps = Eigen::Matrix3d::Identity();  ///< columns: to the next point of each axis
  std::vector<float> values;                            ///< all finite; the first axis runs fastest
  std::vector<std::string> notes = {};  ///< one sentence per kind of change made while reading

  /// The value between the points, by cubics whose slopes are continuous [Keys1981]. Beyond the
  /// first and the last point it repeats along periodic axes and stays as it is along others.
  [[nodiscard]] double value_at(const Eigen::Vector3d& p, const Lattice::Periodic& periodic) const;
};

/// What a file of nothing but numbers does not tell.
struct RawLayout {
  std::array<int, 3> size = {0, 0, 0};  ///< points along each axis; the first runs fastest
  std::string type = "uint8";  ///< int8 to int64, uint8 to uint64, float32 or float64; with "be" at
                               ///< the end if the highest byte comes first
  Eigen::Vector3d spacing = Eigen::Vector3d::Ones();  ///< between points of each axis, > 0
};

/// Whether a file holds values on a grid, by the extension of its name: .vti, .cube, .cub, .nrrd,
/// .nhdr, .mrc, .map, .ccp4 and .raw, each also with .gz.
[[nodiscard]] bool is_volume_file(const std::filesystem::path& path);

/// Reads the values of a grid: VTK image data (.vti; the active scalars, else the first array of
/// one component), Gaussian cube (in Å), NRRD (also with a file of its own for the numbers), MRC or
/// CCP4 (.mrc, .map, .ccp4) or raw numbers. Left-handed axes are turned around.
///
/// @param raw  Of a .raw file; others say it themselves.
/// @throws FileError      if the file is missing, of no such kind, cut short, malformed or holds a
///   value that is not finite; the message names the line, byte or point.
/// @throws InvalidOption  if a .raw file has no layout, or one that is out of its range, or another
///   file has one.
///
/// Cost: O(n) for n values, and up to 12 bytes of memory each beside the file's.
[[nodiscard]] Volume read_volume(const std::filesystem::path& path,
                                 const std::optional<RawLayout>& raw = {});

/// The cell of a volume that is periodic along some of its axes; what is not periodic frames it. An
/// axis whose last points repeat the first ones is a step shorter than its points.
[[nodiscard]] Lattice lattice_of(const Volume& volume, const Lattice::Periodic& periodic);

/// Triangulates the surface on which a volume has a value. It is lower inside; where nothing is
/// periodic, inside is what does not reach the border.
///
/// @param edge_length  Mean edge length of the triangles, > 0.
/// @throws InvalidMesh if there is no such surface, or it reaches the border along an axis that is
///   not periodic, or it touches itself.
[[nodiscard]] TriMesh level_set(const Volume& volume, double level,
                                const Lattice::Periodic& periodic, double edge_length);

}  // namespace trivalent::remesh
