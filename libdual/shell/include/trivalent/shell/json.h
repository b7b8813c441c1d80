#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace trivalent::shell {

using Json = nlohmann::ordered_json;

/// JSON text with an end of line; characters that are not UTF-8 (in file names) are replaced.
[[nodiscard]] std::string json_text(const Json& json);

}  // namespace trivalent::shell
