#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "lammps_lines.h"
#include "trivalent/potentials/atoms.h"

namespace trivalent::dual {

/// The largest id and count of a LAMMPS data file.
inline constexpr std::int64_t max_lammps_id = std::numeric_limits<int>::max();

/// The header of a LAMMPS data file: counts, and the box.
class LammpsHeader {
 public:
  /// Reads up to the first section, whose name is the current line afterwards.
  ///
  /// @throws FileError on a line that read_data does not know, a box that is none, or counts that
  ///   the rest of the file cannot hold.
  explicit LammpsHeader(LammpsLines& lines);

  /// How many there are of "atoms", "bonds", "atom types", ...; 0 if the header does not say.
  [[nodiscard]] std::int64_t count(const std::string& what) const;
  /// Periodic in all directions.
  [[nodiscard]] potentials::Box box() const;
  /// Whether the header has all sides of the box.
  [[nodiscard]] bool has_box() const;
  /// Whether a section follows.
  [[nodiscard]] bool has_section() const { return has_section_; }

 private:
  void read_line(const LammpsLines& lines);
  bool read_side(const LammpsLines& lines);
  bool read_vector(const LammpsLines& lines);
  void read_count(const LammpsLines& lines);
  void check(const LineReader& reader) const;

  std::map<std::string, std::int64_t> counts_;
  std::array<std::optional<std::array<double, 2>>, 3> sides_;  // lo and hi
  std::array<std::optional<Eigen::Vector3d>, 3> vectors_;      // avec, bvec, cvec
  std::optional<Eigen::Vector3d> origin_;
  std::optional<Eigen::Vector3d> tilts_;  // xy xz yz
  bool has_section_ = false;
};

}  // namespace trivalent::dual
