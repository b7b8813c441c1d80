#include "report_page.h"

#include "viewer_page.h"

namespace trivalent::apps {

void write_page(const std::filesystem::path& path, dual::ShellPage page) {
  page.program = "trivalent " TRIVALENT_VERSION;
  dual::write_shell_page(path, page, viewer_page);
}

std::vector<dual::PageRow> page_rows(const std::vector<TableRow>& rows) {
  std::vector<dual::PageRow> result;
  for (const TableRow& row : rows) result.push_back({row.name, row.value});
  return result;
}

std::vector<dual::PageRow> page_rows(const Json& object) {
  std::vector<dual::PageRow> rows;
  for (const auto& [name, value] : object.items()) {
    rows.push_back({name, value.is_string() ? value.get<std::string>() : value.dump()});
  }
  return rows;
}

Json scale_json(const dual::ColorScale& scale) {
  return {{"low", scale.low}, {"middle", scale.middle()}, {"high", scale.high}};
}

}  // namespace trivalent::apps
