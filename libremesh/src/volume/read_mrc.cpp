#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "io/mesh_readers.h"
#include "trivalent/remesh/error.h"
#include "volume/volume_readers.h"

namespace trivalent::remesh {

namespace {

constexpr std::size_t map_header_size = 1024;

/// The 256 words of a map's header, counted from 1 as in the format's description [Cheng2015].
class MapHeader {
 public:
  explicit MapHeader(const Source& source) : source_(source) {
    if (source.bytes.size() < map_header_size) {
      fail(source, concat("holds ", source.bytes.size(), " bytes; the header of a map alone has ",
                          map_header_size, "; is it cut short?"));
    }
    constexpr std::size_t mark = 53;
    if (bytes(mark, 4) != "MAP ") fail(source, "is no MRC or CCP4 map: 'MAP ' is not at byte 208");
    constexpr char big_endian_stamp = 0x11;
    if (bytes(mark + 1, 1)[0] == big_endian_stamp) order_ = ByteOrder::big_endian;
  }

  [[nodiscard]] ByteOrder order() const { return order_; }
  [[nodiscard]] std::int64_t integer(std::size_t word) const {
    return static_cast<std::int64_t>(number_of(bytes(word, 4), int32, order_));
  }
  [[nodiscard]] double real(std::size_t word) const {
    return number_of(bytes(word, 4), float32, order_);
  }

 private:
  [[nodiscard]] std::string_view bytes(std::size_t word, std::size_t count) const {
    return source_.bytes.substr(4 * (word - 1), count);
  }

  const Source& source_;
  ByteOrder order_ = ByteOrder::little_endian;
};

NumberFormat format_of_mode(const Source& source, std::int64_t mode) {
  switch (mode) {
    case 0:
      return int8;
    case 1:
      return int16;
    case 2:
      return float32;
    case 6:
      return uint16;
    default:
      fail(source, concat("its values are of mode ", mode,
                          "; the modes 0, 1, 2 and 6 are read: save it as 32-bit numbers (2)"));
  }
}

/// Which of the cell's axes columns, rows and sections run along.
std::array<std::size_t, 3> axes_of(const Source& source, const MapHeader& header) {
  constexpr std::size_t first_word = 17;
  std::array<std::size_t, 3> axes = {};
  std::array<bool, 3> is_taken = {};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int64_t axis = header.integer(first_word + k);
    if (axis < 1 || axis > 3 || is_taken[static_cast<std::size_t>(axis - 1)]) {
      fail(source, concat("words 17 to 19 of its header are no order of the axes 1, 2 and 3"));
    }
    axes[k] = static_cast<std::size_t>(axis - 1);
    is_taken[axes[k]] = true;
  }
  return axes;
}

/// The cell's vectors as columns, a along x and b in the xy plane.
Eigen::Matrix3d cell_of(const MapHeader& header) {
  constexpr std::size_t lengths = 11;
  constexpr std::size_t angles = 14;
  std::array<double, 3> cosines = {};
  for (std::size_t k = 0; k < 3; ++k) {
    cosines[k] = std::cos(header.real(angles + k) * std::numbers::pi / 180.0);
  }
  const auto [cos_alpha, cos_beta, cos_gamma] = cosines;
  const double sin_gamma = std::sqrt(1.0 - cos_gamma * cos_gamma);
  const double c_y = (cos_alpha - cos_beta * cos_gamma) / sin_gamma;
  Eigen::Matrix3d cell;
  cell.col(0) << 1.0, 0.0, 0.0;
  cell.col(1) << cos_gamma, sin_gamma, 0.0;
  cell.col(2) << cos_beta, c_y, std::sqrt(1.0 - cos_beta * cos_beta - c_y * c_y);
  for (std::size_t k = 0; k < 3; ++k) {
    cell.col(static_cast<Eigen::Index>(k)) *= header.real(lengths + k);
  }
  return cell;
}

}  // namespace

Volume read_mrc(const Source& source) {
  const MapHeader header(source);
  const std::array<std::size_t, 3> axes = axes_of(source, header);
  std::array<std::int64_t, 3> in_file = {};
  for (std::size_t k = 0; k < 3; ++k) in_file[k] = header.integer(1 + k);
  static_cast<void>(checked_points(source, in_file, source.bytes.size()));
  constexpr std::size_t symmetry_bytes = 24;
  const std::int64_t extended = header.integer(symmetry_bytes);
  if (extended < 0 || map_header_size + static_cast<std::size_t>(extended) > source.bytes.size()) {
    fail(source, concat("its extended header of ", extended, " bytes is longer than the file"));
  }
  const std::array<int, 3> size = {static_cast<int>(in_file[0]), static_cast<int>(in_file[1]),
                                   static_cast<int>(in_file[2])};
  const std::vector<float> values =
      values_of(source, size,
                {.bytes = source.bytes.substr(map_header_size + static_cast<std::size_t>(extended)),
                 .format = format_of_mode(source, header.integer(4)),
                 .order = header.order()});

  Volume volume;
  volume.steps = cell_of(header);
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(axes[k]);
    volume.size[axes[k]] = size[k];
    start[axis] = static_cast<double>(header.integer(5 + k));
    const std::int64_t intervals = header.integer(8 + axes[k]);
    if (intervals < 1) fail(source, concat("its cell has ", intervals, " intervals on an axis"));
    volume.steps.col(axis) /= static_cast<double>(intervals);
  }
  constexpr std::size_t origin = 50;
  volume.origin =
      volume.steps * start +
      Eigen::Vector3d(header.real(origin), header.real(origin + 1), header.real(origin + 2));
  volume.values.resize(values.size());
  std::array<std::size_t, 3> stride = {};
  stride[0] = 1;
  stride[1] = static_cast<std::size_t>(volume.size[0]);
  stride[2] = stride[1] * static_cast<std::size_t>(volume.size[1]);
  std::size_t next = 0;
  for (std::size_t section = 0; section < static_cast<std::size_t>(size[2]); ++section) {
    for (std::size_t row = 0; row < static_cast<std::size_t>(size[1]); ++row) {
      for (std::size_t column = 0; column < static_cast<std::size_t>(size[0]); ++column) {
        volume
            .values[column * stride[axes[0]] + row * stride[axes[1]] + section * stride[axes[2]]] =
            values[next++];
      }
    }
  }
  return volume;
}

}  // namespace trivalent::remesh
