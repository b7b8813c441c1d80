#pragma once

#include <string_view>

namespace trivalent::apps {

/// The page that shows shells, without data; see dual::write_shell_page.
extern const std::string_view viewer_page;

}  // namespace trivalent::apps
