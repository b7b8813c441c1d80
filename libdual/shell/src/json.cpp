#include "trivalent/shell/json.h"

#include <nlohmann/json.hpp>

namespace trivalent::shell {

std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

Json vector_json(const Eigen::Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

}  // namespace trivalent::shell
