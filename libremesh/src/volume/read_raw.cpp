#include "trivalent/remesh/error.h"
#include "volume/volume_readers.h"

namespace trivalent::remesh {

Volume read_raw(const Source& source, const RawLayout& layout) {
  std::string_view type = layout.type;
  NumberArray numbers = {.bytes = source.bytes, .format = uint8};
  if (type.ends_with("be")) {
    numbers.order = ByteOrder::big_endian;
    type.remove_suffix(2);
  }
  const auto format = sized_format(type);
  if (!format) {
    throw InvalidOption(concat("read_volume: ", in_quotes(layout.type),
                               " is no type of numbers; int8 to int64, uint8 to uint64, float32 "
                               "and float64 are, each also with 'be' for big-endian"));
  }
  numbers.format = *format;
  for (std::size_t k = 0; k < 3; ++k) {
    if (layout.size[k] < 2 || !(layout.spacing[static_cast<Eigen::Index>(k)] > 0.0)) {
      throw InvalidOption(
          concat("read_volume: raw values of ", layout.size[0], " x ", layout.size[1], " x ",
                 layout.size[2], " points, ", layout.spacing.x(), " x ", layout.spacing.y(), " x ",
                 layout.spacing.z(), " apart; sizes must be 2 or more, spacings above 0"));
    }
  }
  Volume volume{.size = layout.size, .values = values_of(source, layout.size, numbers)};
  volume.steps = layout.spacing.asDiagonal();
  const std::size_t used = volume.values.size() * numbers.format.size;
  if (used < source.bytes.size()) {
    throw FileError(concat("read_volume: ", source.name, ": holds ", source.bytes.size(),
                           " bytes; such a volume has ", used, "; are its sizes and type right?"));
  }
  return volume;
}

}  // namespace trivalent::remesh
