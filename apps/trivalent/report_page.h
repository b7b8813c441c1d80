#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "terminal.h"
#include "trivalent/view/shell_page.h"

namespace trivalent::apps {

/// What pages name as their maker.
inline constexpr const char* program_name = "trivalent " TRIVALENT_VERSION;

/// Writes a page with the program's viewer in it; `program` is filled in.
void write_page(const std::filesystem::path& path, dual::ShellPage page);

/// Options and other flat JSON objects as rows.
[[nodiscard]] std::vector<TableRow> page_rows(const Json& object);

}  // namespace trivalent::apps
