#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace trivalent::shell {

using Json = nlohmann::ordered_json;

/// JSON text with an end of line; characters that are not UTF-8 (in file names) are replaced.
[[nodiscard]] std::string json_text(const Json& json);

/// [x, y, z].
[[nodiscard]] Json vector_json(const Eigen::Vector3d& vector);

}  // namespace trivalent::shell
