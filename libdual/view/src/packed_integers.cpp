#include "packed_integers.h"

#include <zlib.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "trivalent/dual/error.h"

namespace trivalent::dual {
namespace {

/// 0, -1, 1, -2, ... as 0, 1, 2, 3, ...: small numbers of either sign have leading zeros.
std::uint32_t without_sign(std::int32_t value) {
  const auto bits = static_cast<std::uint32_t>(value);
  return (bits << 1) ^ (value < 0 ? ~0u : 0u);
}

std::vector<std::uint32_t> differences(std::span<const std::int32_t> values, std::size_t stride) {
  std::vector<std::uint32_t> result(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool has_before = stride > 0 && i >= stride;
    // Unsigned, since the difference of two far ones wraps around; so does adding it up again.
    const auto before = has_before ? static_cast<std::uint32_t>(values[i - stride]) : 0u;
    const std::uint32_t step = static_cast<std::uint32_t>(values[i]) - before;
    result[i] = without_sign(static_cast<std::int32_t>(step));
  }
  return result;
}

std::vector<unsigned char> deflated(const std::vector<unsigned char>& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<unsigned char> result(size);
  constexpr int level = 6;
  if (compress2(result.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()), level) !=
      Z_OK) {
    throw Error("write_shell_page: zlib cannot compress the data");
  }
  result.resize(size);
  return result;
}

}  // namespace

std::string base64(std::span<const unsigned char> bytes) {
  constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (k < n ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= n ? letters[word >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

nlohmann::ordered_json packed_integers(std::span<const std::int32_t> values, std::size_t stride) {
  const std::vector<std::uint32_t> numbers = differences(values, stride);
  const std::uint32_t largest =
      numbers.empty() ? 0 : *std::max_element(numbers.begin(), numbers.end());
  std::vector<unsigned char> bytes;
  int planes = 0;
  for (; planes < 4 && (planes == 0 || largest >> (8 * planes) > 0); ++planes) {
    for (const std::uint32_t number : numbers) {
      bytes.push_back(static_cast<unsigned char>(number >> (8 * planes) & 0xff));
    }
  }
  return {{"count", values.size()},
          {"stride", stride},
          {"bytes", planes},
          {"data", base64(deflated(bytes))}};
}

}  // namespace trivalent::dual
