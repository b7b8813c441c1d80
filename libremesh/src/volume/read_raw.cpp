#include "trivalent/remesh/error.h"
#include "volume/volume_readers.h"

namespace trivalent::remesh {

namespace {

constexpr std::array number_formats = {
    NamedFormat{"int8", int8},      NamedFormat{"uint8", uint8},   NamedFormat{"int16", int16},
    NamedFormat{"uint16", uint16},  NamedFormat{"int32", int32},   NamedFormat{"uint32", uint32},
    NamedFormat{"int64", int64},    NamedFormat{"uint64", uint64}, NamedFormat{"float32", float32},
    NamedFormat{"float64", float64}};

}  // namespace

Volume read_raw(const Source& source, const RawLayout& layout) {
  std::string_view type = layout.type;
  NumberArray numbers = {.bytes = source.bytes, .format = uint8};
  if (type.ends_with("be")) {
    numbers.order = ByteOrder::big_endian;
    type.remove_suffix(2);
  }
  bool is_known = false;
  for (const auto& [name, format] : number_formats) {
    if (name != type) continue;
    numbers.format = format;
    is_known = true;
  }
  if (!is_known) {
    throw InvalidOption(concat("read_volume: ", in_quotes(layout.type),
                               " is no type of numbers; int8 to int64, uint8 to uint64, float32 "
                               "and float64 are, each also with 'be' for big-endian"));
  }
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
