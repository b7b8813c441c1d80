#include <cstddef>
#include <string>

#include "io/binary_numbers.h"
#include "io/mesh_readers.h"
#include "io/weld_points.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

constexpr std::size_t header_size = 80;
constexpr std::size_t count_size = 4;
/// Normal, three corners (32-bit floats) and a 16-bit attribute.
constexpr std::size_t triangle_size = 50;

/// The number of triangles that a binary file declares.
std::size_t declared_triangles(std::string_view bytes) {
  return bits_of(bytes.substr(header_size, count_size), ByteOrder::little_endian);
}

Eigen::Vector3d corner_at(const char* bytes) {
  Eigen::Vector3d p;
  for (int k = 0; k < 3; ++k) {
    p[k] = number_of({bytes + std::ptrdiff_t{4} * k, 4}, float32, ByteOrder::little_endian);
  }
  return p;
}

class TextStlReader {
 public:
  explicit TextStlReader(const Source& source) : scanner_(source, Continuation::none) {}

  PolygonSoup run() {
    std::size_t solids = 0;
    for (std::string word = next(); !word.empty(); word = next()) {
      if (word != "solid") scanner_.fail(concat(in_quotes(word), " stands where 'solid' should"));
      scanner_.skip_rest_of_line();  // the name
      read_facets();
      scanner_.skip_rest_of_line();
      ++solids;
    }
    if (solids > 1) soup_.notes.push_back(concat("joined ", counted(solids, "solid")));
    weld_points(soup_);
    return std::move(soup_);
  }

 private:
  /// Keywords come in upper or lower case, and some with a blank, as in `end solid`.
  std::string next() {
    std::string word = next_word();
    if (word == "end") word += next_word();
    return word;
  }

  std::string next_word() {
    constexpr std::size_t longest_keyword = 16;
    return lower_case(std::string(scanner_.word_across_lines().substr(0, longest_keyword)));
  }

  void expect(std::string_view keyword) {
    const std::string word = next();
    if (word == keyword) return;
    if (word.empty())
      scanner_.fail(concat("the file ends before '", keyword, "'; is it cut short?"));
    scanner_.fail(concat(in_quotes(word), " stands where '", keyword, "' should"));
  }

  void read_facets() {
    for (;;) {
      const std::string word = next();
      if (word == "endsolid") return;
      if (word.empty()) scanner_.fail("the file ends before 'endsolid'; is it cut short?");
      if (word != "facet") scanner_.fail(concat(in_quotes(word), " stands where 'facet' should"));
      read_facet();
    }
  }

  void read_facet() {
    expect("normal");
    for (int k = 0; k < 3; ++k) (void)scanner_.word_across_lines();  // often wrong, never needed
    expect("outer");
    expect("loop");
    for (int k = 0; k < 3; ++k) {
      expect("vertex");
      soup_.corners.push_back(static_cast<int>(soup_.points.size()));
      soup_.points.push_back(scanner_.position(soup_.points.size()));
    }
    soup_.ends.push_back(soup_.corners.size());
    expect("endloop");
    expect("endfacet");
  }

  TextScanner scanner_;
  PolygonSoup soup_;
};

}  // namespace

std::uint64_t declared_stl_size(std::string_view bytes) {
  if (bytes.size() < header_size + count_size) return 0;
  return header_size + count_size + std::uint64_t{triangle_size} * declared_triangles(bytes);
}

PolygonSoup read_text_stl(const Source& source) { return TextStlReader(source).run(); }

PolygonSoup read_binary_stl(const Source& source) {
  const std::string_view bytes = source.bytes;
  if (bytes.size() < header_size + count_size) {
    fail(source, concat("too short for an STL file: ", counted(bytes.size(), "byte")));
  }
  const std::size_t body = header_size + count_size;
  const std::size_t declared = declared_triangles(bytes);
  // Programs that write as they go leave the count at 0.
  const bool is_streamed = declared == 0 && bytes.size() > body;
  const std::size_t triangles = is_streamed ? (bytes.size() - body) / triangle_size : declared;
  check_declared(source, {"triangles", triangles, triangle_size}, bytes.size() - body);
  PolygonSoup soup;
  soup.points.reserve(3 * triangles);
  for (std::size_t t = 0; t < triangles; ++t) {
    for (std::size_t k = 1; k <= 3; ++k) {
      const Eigen::Vector3d p = corner_at(bytes.data() + body + t * triangle_size + 12 * k);
      if (!p.allFinite()) {
        fail(source, concat("triangle ", t,
                            " (counted from 0) has a coordinate that is not a finite number"));
      }
      soup.corners.push_back(static_cast<int>(soup.points.size()));
      soup.points.push_back(p);
    }
    soup.ends.push_back(soup.corners.size());
  }
  if (is_streamed) {
    soup.notes.push_back(
        concat("took ", counted(triangles, "triangle"), ", although the file declares none"));
  }
  const std::size_t left = bytes.size() - body - triangles * triangle_size;
  if (left > 0)
    soup.notes.push_back(concat("ignored ", counted(left, "byte"), " after the last triangle"));
  weld_points(soup);
  return soup;
}

}  // namespace trivalent::remesh
