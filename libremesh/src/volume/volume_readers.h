#pragma once

#include <cstdint>
#include <filesystem>

#include "io/binary_numbers.h"
#include "io/text_scanner.h"
#include "trivalent/remesh/volume.h"

namespace trivalent::remesh {

/// One reader per kind of file; each leaves the checks of check_volume() to read_volume().
[[nodiscard]] Volume read_vti(const Source& source);
[[nodiscard]] Volume read_cube(const Source& source);
[[nodiscard]] Volume read_nrrd(const Source& source);
[[nodiscard]] Volume read_mrc(const Source& source);
[[nodiscard]] Volume read_raw(const Source& source, const RawLayout& layout);

/// Numbers of one kind without anything between them.
struct NumberArray {
  std::string_view bytes;
  NumberFormat format;
  ByteOrder order = ByteOrder::little_endian;
};

/// As many numbers as a volume of this size has.
///
/// @throws FileError if there are fewer bytes; more are left alone.
[[nodiscard]] std::vector<float> values_of(const Source& source, const std::array<int, 3>& size,
                                           const NumberArray& numbers);

/// The number of points, if all three sizes are from 2 to 100,000 and so many values of a byte or
/// more can be in so many bytes.
///
/// @throws FileError otherwise, which keeps headers from asking for memory.
[[nodiscard]] std::size_t checked_points(const Source& source,
                                         const std::array<std::int64_t, 3>& size,
                                         std::size_t bytes_left);

}  // namespace trivalent::remesh
