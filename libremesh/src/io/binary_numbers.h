#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <span>
#include <string_view>

namespace trivalent::remesh {

enum class ByteOrder { little_endian, big_endian };

/// How a binary file stores a number.
struct NumberFormat {
  enum class Kind { signed_integer, unsigned_integer, real } kind;
  std::size_t size;  ///< [bytes] 1, 2, 4 or 8; 4 or 8 if real
};

inline constexpr NumberFormat int8 = {NumberFormat::Kind::signed_integer, 1};
inline constexpr NumberFormat int16 = {NumberFormat::Kind::signed_integer, 2};
inline constexpr NumberFormat int32 = {NumberFormat::Kind::signed_integer, 4};
inline constexpr NumberFormat int64 = {NumberFormat::Kind::signed_integer, 8};
inline constexpr NumberFormat uint8 = {NumberFormat::Kind::unsigned_integer, 1};
inline constexpr NumberFormat uint16 = {NumberFormat::Kind::unsigned_integer, 2};
inline constexpr NumberFormat uint32 = {NumberFormat::Kind::unsigned_integer, 4};
inline constexpr NumberFormat uint64 = {NumberFormat::Kind::unsigned_integer, 8};
inline constexpr NumberFormat float32 = {NumberFormat::Kind::real, 4};
inline constexpr NumberFormat float64 = {NumberFormat::Kind::real, 8};

/// A format by the name that files of some kind give it.
struct NamedFormat {
  std::string_view name;
  NumberFormat format;
};

/// The format of that name, if it is among them.
[[nodiscard]] std::optional<NumberFormat> find_format(std::span<const NamedFormat> formats,
                                                      std::string_view name);

/// The format of a name that gives its size: int8 to int64, uint8 to uint64, float32, float64.
[[nodiscard]] std::optional<NumberFormat> sized_format(std::string_view name);

/// The bits of up to 8 bytes.
[[nodiscard]] std::uint64_t bits_of(std::string_view bytes, ByteOrder order);

/// @param bytes  As many as the format has.
[[nodiscard]] double number_of(std::string_view bytes, NumberFormat format, ByteOrder order);

void write_little_endian(std::ostream& out, std::uint32_t bits);

}  // namespace trivalent::remesh
