#include "trivalent/remesh/polygon_soup.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "io/file_bytes.h"
#include "io/mesh_readers.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

namespace fs = std::filesystem;

// ---- kind of file ------------------------------------------------------------------------------

enum class Kind { off, obj, ply, text_stl, binary_stl, vtk, vtp, vtu, points };

std::string name_of(Kind kind) {
  switch (kind) {
    case Kind::off:
      return "OFF";
    case Kind::obj:
      return "OBJ";
    case Kind::ply:
      return "PLY";
    case Kind::text_stl:
    case Kind::binary_stl:
      return "STL";
    case Kind::vtk:
      return "VTK";
    case Kind::vtp:
      return "VTP";
    case Kind::vtu:
      return "VTU";
    case Kind::points:
      return "points";
  }
  return {};
}

/// Text STL begins with "solid", but so do the headers of some binary ones; a facet must follow.
bool is_text_stl(const Source& source) {
  constexpr std::size_t longest_keyword = 16;
  TextScanner scanner(source, Continuation::none);
  const std::string_view first = scanner.word_across_lines().substr(0, longest_keyword);
  if (lower_case(std::string(first)) != "solid") return false;
  scanner.next_line();
  const std::string second = lower_case(std::string(scanner.word().substr(0, longest_keyword)));
  return second == "facet" || second == "endsolid" || second == "end";
}

/// By its size alone: such a file may begin with any bytes.
bool is_binary_stl(std::string_view bytes) {
  return !bytes.empty() && declared_stl_size(bytes) == bytes.size();
}

/// The text behind the mark U+FEFF that some editors put first.
Source without_mark(const Source& source) {
  constexpr std::string_view utf8_mark = "\xef\xbb\xbf";
  const std::string_view bytes = source.bytes;
  if (is_binary_stl(bytes)) return source;
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff"))
    fail(source, "is text of 16 bits a letter; save it as UTF-8 or plain ASCII");
  return bytes.starts_with(utf8_mark) ? Source{bytes.substr(utf8_mark.size()), source.name}
                                      : source;
}

/// What the bytes say they are; none for OBJ and points, which have no mark.
std::optional<Kind> kind_by_mark(const Source& source) {
  constexpr std::size_t longest_xml_head = 1000;
  const std::string_view bytes = source.bytes;
  if (is_binary_stl(bytes)) return Kind::binary_stl;
  if (bytes.starts_with("ply") && bytes.find_first_of("\r\n") == bytes.find_first_not_of(" \t", 3))
    return Kind::ply;
  if (bytes.starts_with("# vtk DataFile")) return Kind::vtk;
  const std::string_view head = bytes.substr(0, longest_xml_head);
  if (head.find("<VTKFile") != head.npos)
    return head.find("\"UnstructuredGrid\"") == head.npos ? Kind::vtp : Kind::vtu;
  if (is_text_stl(source)) return Kind::text_stl;
  if (is_off_keyword(TextScanner(source, Continuation::none).word_across_lines())) return Kind::off;
  return std::nullopt;
}

std::optional<Kind> kind_by_extension(const Source& source) {
  const std::string extension = extension_of(source);
  if (extension == ".off") return Kind::off;
  if (extension == ".obj") return Kind::obj;
  if (extension == ".ply") return Kind::ply;
  // Binary unless its content said otherwise.
  if (extension == ".stl") return Kind::binary_stl;
  if (extension == ".vtk") return Kind::vtk;
  if (extension == ".vtp") return Kind::vtp;
  if (extension == ".vtu") return Kind::vtu;
  if (extension == ".xyz" || extension == ".pwn") return Kind::points;
  return std::nullopt;
}

/// What a text without a mark looks like.
std::optional<Kind> kind_by_first_word(const Source& source) {
  const std::string_view word = TextScanner(source, Continuation::none).word_across_lines();
  if (parse_number(word)) return Kind::points;
  for (const std::string_view statement : {"v", "vn", "vt", "f", "g", "o", "s", "mtllib"}) {
    if (word == statement) return Kind::obj;
  }
  return std::nullopt;
}

/// What the content is by its mark, else what was expected, else what its first word says.
Kind kind_of(const Source& source, std::optional<Kind> expected) {
  if (const auto kind = kind_by_mark(source)) return *kind;
  if (expected) return *expected;
  if (const auto kind = kind_by_first_word(source)) return *kind;
  fail(source,
       concat("neither its extension '", extension_of(source),
              "' nor its content is known; save it as .off, .obj, .ply, .stl, .vtk, .vtp, .vtu, or "
              ".xyz for points, each also with .gz"));
}

PolygonSoup read_kind(const Source& source, Kind kind) {
  switch (kind) {
    case Kind::off:
      return read_off(source);
    case Kind::obj:
      return read_obj(source);
    case Kind::ply:
      return read_ply(source);
    case Kind::text_stl:
      return read_text_stl(source);
    case Kind::vtk:
      return read_vtk(source);
    case Kind::vtp:
    case Kind::vtu:
      return read_vtk_xml(source);
    case Kind::points:
      return read_points(source);
    case Kind::binary_stl:
      break;
  }
  return read_binary_stl(source);
}

}  // namespace

void fail(const Source& source, std::string_view problem) {
  throw FileError(concat("read_mesh: ", source.name, ": ", problem));
}

void check_declared(const Source& source, const Declared& declared, std::size_t bytes_left) {
  if (declared.count > bytes_left / declared.bytes_each) {
    fail(source,
         concat("declares ", declared.count, ' ', declared.things, ", more than its remaining ",
                bytes_left, " bytes can hold; is it cut short?"));
  }
  // Three corners each must be countable.
  constexpr std::uint64_t most = std::numeric_limits<int>::max() / 3;
  if (declared.count > most) {
    fail(source, concat("declares ", declared.count, ' ', declared.things, "; at most ", most,
                        " are read"));
  }
}

void append_strip(PolygonSoup& soup, std::span<const int> strip) {
  for (std::size_t i = 0; i + 2 < strip.size(); ++i) {
    if (strip[i] == strip[i + 1] || strip[i + 1] == strip[i + 2] || strip[i] == strip[i + 2])
      continue;
    const std::size_t odd = i % 2;  // every other triangle runs the other way
    for (const std::size_t k : {i + odd, i + 1 - odd, i + 2}) soup.corners.push_back(strip[k]);
    soup.ends.push_back(soup.corners.size());
  }
}

std::string counted(std::size_t count, std::string_view thing) {
  return concat(count, ' ', thing, count == 1 ? "" : "s");
}

BoundingBox bounding_box(std::span<const Eigen::Vector3d> points) {
  BoundingBox box{points.front(), points.front()};
  for (const Eigen::Vector3d& p : points) {
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

PolygonSoup parse_polygon_soup(std::string_view bytes, const std::string& name) {
  // No mesh packs better than this; what does is made to fill the memory.
  constexpr std::size_t best_compression = 200;
  std::string unpacked;
  if (is_gzipped(bytes)) {
    unpacked = unpack({bytes, name}, best_compression);
    bytes = unpacked;
  }
  const Source source = without_mark({bytes, name});
  if (source.bytes.empty()) fail(source, "the file is empty");
  const auto expected = kind_by_extension(source);
  const Kind kind = kind_of(source, expected);
  PolygonSoup soup = read_kind(source, kind);
  if (expected && name_of(kind) != name_of(*expected)) {
    soup.notes.push_back(
        concat("read as ", name_of(kind), ", which its content is, not as ", name_of(*expected)));
  }
  return soup;
}

bool has_mesh_extension(const fs::path& path) {
  return kind_by_extension({.bytes = {}, .name = path.string()}).has_value();
}

PolygonSoup read_polygon_soup(const fs::path& path) {
  return parse_polygon_soup(read_bytes(path), path.string());
}

}  // namespace trivalent::remesh
