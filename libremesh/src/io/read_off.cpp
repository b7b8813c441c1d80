#include <optional>
#include <vector>

#include "io/mesh_readers.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

/// How rows are told apart: files in the wild have one vertex or face per line, and often columns
/// that the header does not announce; by the letter of the format, only the numbers count.
enum class Rows { lines, words };

class OffReader {
 public:
  OffReader(const Source& source, Rows rows)
      : source_(source), rows_(rows), scanner_(source, Continuation::none) {}

  PolygonSoup run() {
    read_counts();
    for (std::size_t i = 0; i < vertices_; ++i) {
      soup_.points.push_back(scanner_.position(i));
      end_row();
    }
    for (std::size_t i = 0; i < faces_; ++i) {
      read_face(i);
      end_row();
    }
    add_notes();
    return std::move(soup_);
  }

 private:
  void read_counts() {
    scanner_.next_line();
    // Some files lack the keyword.
    if (!parse_integer(scanner_.peek())) check_keyword();
    const std::int64_t vertices = scanner_.integer("the number of vertices");
    const std::int64_t faces = scanner_.integer("the number of faces");
    if (vertices < 0 || faces < 0) scanner_.fail("a count is negative");
    // The number of edges may be missing; nobody needs it.
    scanner_.skip_rest_of_line();
    vertices_ = static_cast<std::size_t>(vertices);
    faces_ = static_cast<std::size_t>(faces);
    // Three digits with blanks between make a vertex; a digit and a line end make a face.
    check_declared(source_, {"vertices", vertices_, 6}, scanner_.bytes_left());
    check_declared(source_, {"faces", faces_, 2}, scanner_.bytes_left() - 5 * vertices_);
    soup_.points.reserve(vertices_);
    soup_.ends.reserve(faces_);
    soup_.corners.reserve(3 * faces_);
  }

  void check_keyword() {
    const std::string_view keyword = scanner_.word();
    if (!is_off_keyword(keyword)) scanner_.fail("not an OFF file: its first word is not OFF");
    if (keyword.find('4') != keyword.npos || keyword.find('n') != keyword.npos) {
      scanner_.fail(concat("points of ", keyword, " files are not three-dimensional"));
    }
    if (scanner_.peek() == "BINARY")
      scanner_.fail("binary OFF files are not read; write it as text");
  }

  void read_face(std::size_t index) {
    const std::int64_t size = scanner_.integer("a face's number of corners");
    if (size < 1) scanner_.fail(concat("face ", index, " has ", size, " corners"));
    check_declared(source_, {"corners in one face", static_cast<std::uint64_t>(size), 1},
                   scanner_.bytes_left() / 2);
    for (std::int64_t k = 0; k < size; ++k) {
      const std::int64_t v = scanner_.integer("a face's vertex");
      if (v < 0 || static_cast<std::size_t>(v) >= vertices_) {
        scanner_.fail(concat("face ", index, " refers to vertex ", v, " of ", vertices_,
                             " (counted from 0)"));
      }
      soup_.corners.push_back(static_cast<int>(v));
    }
    soup_.ends.push_back(soup_.corners.size());
  }

  void end_row() {
    if (rows_ == Rows::lines && scanner_.skip_rest_of_line()) ++rows_with_more_;
  }

  void add_notes() {
    if (rows_with_more_ > 0) {
      soup_.notes.push_back(
          concat("ignored further columns on ", counted(rows_with_more_, "line")));
    }
    std::size_t lines_left = 0;
    while (scanner_.next_line()) {
      ++lines_left;
      scanner_.skip_rest_of_line();
    }
    if (lines_left > 0) {
      soup_.notes.push_back(
          concat("ignored ", counted(lines_left, "line"), " after the last face"));
    }
  }

  const Source& source_;
  Rows rows_;
  TextScanner scanner_;
  std::size_t vertices_ = 0;
  std::size_t faces_ = 0;
  std::size_t rows_with_more_ = 0;
  PolygonSoup soup_;
};

}  // namespace

bool is_off_keyword(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N", "4", "n"}) {
    if (word.substr(0, prefix.size()) == prefix) word.remove_prefix(prefix.size());
  }
  return word == "OFF";
}

PolygonSoup read_off(const Source& source) {
  try {
    return OffReader(source, Rows::lines).run();
  } catch (const FileError&) {
    // Several rows may share a line. If that is not it either, the first message is the better one.
    try {
      return OffReader(source, Rows::words).run();
    } catch (const FileError&) {
    }
    throw;
  }
}

}  // namespace trivalent::remesh
