#include "report_page.h"

#include "viewer_page.h"

namespace trivalent::apps {

void write_page(const std::filesystem::path& path, dual::ShellPage page) {
  page.program = program_name;
  dual::write_shell_page(path, page, viewer_page);
}

std::vector<TableRow> page_rows(const Json& object) {
  std::vector<TableRow> rows;
  for (const auto& [name, value] : object.items()) {
    rows.push_back({name, value.is_string() ? value.get<std::string>() : value.dump()});
  }
  return rows;
}

}  // namespace trivalent::apps
