#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "io/text_scanner.h"
#include "trivalent/remesh/polygon_soup.h"

namespace trivalent::remesh {

/// One reader per kind of file. What the bytes declare is never trusted with memory: counts are
/// held against the bytes that are left.
[[nodiscard]] PolygonSoup read_off(const Source& source);
[[nodiscard]] PolygonSoup read_obj(const Source& source);
[[nodiscard]] PolygonSoup read_ply(const Source& source);
[[nodiscard]] PolygonSoup read_text_stl(const Source& source);
[[nodiscard]] PolygonSoup read_binary_stl(const Source& source);
/// VTK's files, legacy (.vtk) and of XML (.vtp, .vtu).
[[nodiscard]] PolygonSoup read_vtk(const Source& source);
[[nodiscard]] PolygonSoup read_vtk_xml(const Source& source);
/// One point per line: three coordinates and whatever follows them.
[[nodiscard]] PolygonSoup read_points(const Source& source);

/// Whether a word is one of OFF's header words, such as OFF, COFF or STCN4nOFF; the number of
/// vertices may follow without a blank (OFF490).
[[nodiscard]] bool is_off_keyword(std::string_view word);

/// Size that a binary STL file declares by its count of triangles; 0 if it is too short to tell.
[[nodiscard]] std::uint64_t declared_stl_size(std::string_view bytes);

/// Adds the triangles of a strip of corners. Those that repeat a corner, which only connect strips,
/// are left out.
void append_strip(PolygonSoup& soup, std::span<const int> strip);

[[noreturn]] void fail(const Source& source, std::string_view problem);

/// What a header declares: so many things, each of at least so many bytes.
struct Declared {
  std::string_view things;
  std::uint64_t count = 0;
  std::uint64_t bytes_each = 1;
};

/// Throws FileError if fewer bytes are left than was declared, or indices could not be counted.
void check_declared(const Source& source, const Declared& declared, std::size_t bytes_left);

/// "12 quads", "1 quad".
[[nodiscard]] std::string counted(std::size_t count, std::string_view thing);

}  // namespace trivalent::remesh
