#include "io/binary_numbers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <ostream>

namespace trivalent::remesh {

std::optional<NumberFormat> find_format(std::span<const NamedFormat> formats,
                                        std::string_view name) {
  const auto found = std::ranges::find(formats, name, &NamedFormat::name);
  if (found == formats.end()) return std::nullopt;
  return found->format;
}

std::optional<NumberFormat> sized_format(std::string_view name) {
  constexpr std::array formats = {NamedFormat{"int8", int8},       NamedFormat{"uint8", uint8},
                                  NamedFormat{"int16", int16},     NamedFormat{"uint16", uint16},
                                  NamedFormat{"int32", int32},     NamedFormat{"uint32", uint32},
                                  NamedFormat{"int64", int64},     NamedFormat{"uint64", uint64},
                                  NamedFormat{"float32", float32}, NamedFormat{"float64", float64}};
  return find_format(formats, name);
}

std::uint64_t bits_of(std::string_view bytes, ByteOrder order) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::size_t from_top = order == ByteOrder::big_endian ? i : bytes.size() - 1 - i;
    bits = bits << 8U | static_cast<unsigned char>(bytes[from_top]);
  }
  return bits;
}

double number_of(std::string_view bytes, NumberFormat format, ByteOrder order) {
  const std::uint64_t bits = bits_of(bytes, order);
  switch (format.kind) {
    case NumberFormat::Kind::unsigned_integer:
      return static_cast<double>(bits);
    case NumberFormat::Kind::signed_integer: {
      const std::size_t unused = 64 - 8 * format.size;
      return static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused);
    }
    case NumberFormat::Kind::real:
      break;
  }
  if (format.size == 8) return std::bit_cast<double>(bits);
  return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
}

void write_little_endian(std::ostream& out, std::uint32_t bits) {
  for (unsigned k = 0; k < 4; ++k) out.put(static_cast<char>(bits >> (8U * k) & 0xffU));
}

}  // namespace trivalent::remesh
