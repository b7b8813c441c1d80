#pragma once

#include <filesystem>
#include <vector>

#include "reports.h"
#include "terminal.h"
#include "trivalent/view/shell_page.h"

namespace trivalent::apps {

/// Puts the page's data into the viewer; `program` is filled in.
void write_page(const std::filesystem::path& path, dual::ShellPage page);

/// Rows of a result as a page shows them.
[[nodiscard]] std::vector<dual::PageRow> page_rows(const std::vector<TableRow>& rows);

/// The same of options and other flat JSON objects.
[[nodiscard]] std::vector<dual::PageRow> page_rows(const Json& object);

/// A color scale, as in report.json.
[[nodiscard]] Json scale_json(const dual::ColorScale& scale);

}  // namespace trivalent::apps
