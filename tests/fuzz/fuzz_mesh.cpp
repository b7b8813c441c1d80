// Feeds bytes to the reader of one kind of mesh file: whatever they are, they give points and
// triangles whose indices and numbers can be trusted, or an error that says where.

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "trivalent/remesh/error.h"
#include "trivalent/remesh/polygon_soup.h"

namespace {

using namespace trivalent::remesh;  // NOLINT(google-build-using-namespace)

bool is_consistent(const TriangleSoup& soup) {
  const auto n_points = static_cast<int>(soup.points.size());
  return std::all_of(soup.points.begin(), soup.points.end(),
                     [](const Eigen::Vector3d& p) { return p.allFinite(); }) &&
         std::all_of(soup.triangles.begin(), soup.triangles.end(), [&](const auto& t) {
           return t[0] != t[1] && t[1] != t[2] && t[2] != t[0] &&
                  std::all_of(t.begin(), t.end(), [&](int v) { return v >= 0 && v < n_points; });
         });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    if (!is_consistent(triangulate(parse_polygon_soup(bytes, FUZZED_NAME)))) std::abort();
  } catch (const Error& error) {
    if (std::string_view(error.what()).empty()) std::abort();
  }
  return 0;
}
