#include <optional>

#include "io/mesh_readers.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

/// The number of points may stand alone on the first line.
std::optional<std::int64_t> read_count(TextScanner& scanner) {
  TextScanner ahead = scanner;
  if (!ahead.next_line()) return std::nullopt;
  const auto count = parse_integer(ahead.word());
  if (!count || ahead.skip_rest_of_line()) return std::nullopt;
  scanner.next_line();
  scanner.skip_rest_of_line();
  if (*count < 0) scanner.fail("a count is negative");
  return count;
}

}  // namespace

PolygonSoup read_points(const Source& source) {
  TextScanner scanner(source, Continuation::none);
  const auto declared = read_count(scanner);
  PolygonSoup soup;
  std::size_t rows_with_more = 0;
  while (scanner.next_line()) {
    soup.points.push_back(scanner.position(soup.points.size()));
    // Normals, colors or intensities.
    if (scanner.skip_rest_of_line()) ++rows_with_more;
  }
  if (declared && static_cast<std::uint64_t>(*declared) != soup.points.size()) {
    fail(source, concat("declares ", *declared, " points but holds ", soup.points.size(),
                        "; is it cut short?"));
  }
  if (rows_with_more > 0) {
    soup.notes.push_back(concat("ignored further columns on ", counted(rows_with_more, "line")));
  }
  return soup;
}

}  // namespace trivalent::remesh
