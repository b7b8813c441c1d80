#pragma once

#include <string_view>

namespace trivalent::apps {

/// The commit that the program was built from, with -dirty if files were changed since; empty if it
/// is not known.
extern const std::string_view commit;

}  // namespace trivalent::apps
