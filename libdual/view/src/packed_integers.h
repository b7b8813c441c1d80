#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

namespace trivalent::dual {

/// Packs integers into text for a page: differences to the entry `stride` before (0: none), small
/// ones without a sign, byte by byte of equal weight, deflated [RFC 1950], in base64. Neighbors in
/// a structure are neighbors in its file, so little is left.
///
/// Returns a JSON object: count, stride, number of bytes each, and the text.
[[nodiscard]] nlohmann::ordered_json packed_integers(std::span<const std::int32_t> values,
                                                     std::size_t stride);

/// Bytes as base64 [RFC 4648].
[[nodiscard]] std::string base64(std::span<const unsigned char> bytes);

}  // namespace trivalent::dual
