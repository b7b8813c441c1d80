#include <array>
#include <bit>
#include <optional>
#include <string>
#include <vector>

#include "io/binary_numbers.h"
#include "io/mesh_readers.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

/// A header word, such as STCN4nOFF, taken apart.
struct Keyword {
  bool has_texture = false;
  bool has_color = false;
  bool has_normal = false;
  bool is_spatial = true;      ///< points have three coordinates
  std::string_view rest = {};  ///< what follows OFF without a blank
};

std::optional<Keyword> parse_keyword(std::string_view word) {
  Keyword keyword;
  const auto take = [&word](std::string_view prefix) {
    if (!word.starts_with(prefix)) return false;
    word.remove_prefix(prefix.size());
    return true;
  };
  keyword.has_texture = take("ST");
  keyword.has_color = take("C");
  keyword.has_normal = take("N");
  const bool has_fourth = take("4");
  const bool has_any_number = take("n");
  keyword.is_spatial = !has_fourth && !has_any_number;
  if (!take("OFF")) return std::nullopt;
  keyword.rest = word;
  if (!word.empty() && !parse_integer(word)) return std::nullopt;
  return keyword;
}

/// Where a text file says what it holds; and binary ones, before their numbers.
struct Head {
  Keyword keyword;
  bool is_binary = false;
};

/// Leaves the scanner before the counts, except for one that is glued to the keyword.
Head read_head(TextScanner& scanner) {
  scanner.next_line();
  Head head;
  // Some files lack the keyword.
  if (parse_integer(scanner.peek())) return head;
  const std::string_view word = scanner.word();
  const std::optional<Keyword> keyword = parse_keyword(word);
  if (!keyword) scanner.fail("not an OFF file: its first word is not OFF");
  head.keyword = *keyword;
  if (!keyword->is_spatial)
    scanner.fail(concat("points of ", word, " files are not three-dimensional"));
  head.is_binary = lower_case(std::string(scanner.peek().substr(0, 8))) == "binary";
  return head;
}

// ---- text --------------------------------------------------------------------------------------

/// How rows are told apart: files in the wild have one vertex or face per line, and often columns
/// that the header does not announce; by the letter of the format, only the numbers count.
enum class Rows { lines, words };

class OffReader {
 public:
  /// @param scanner  Behind the head of the file.
  OffReader(const Source& source, Rows rows, const Head& head, const TextScanner& scanner)
      : source_(source), rows_(rows), glued_(head.keyword.rest), scanner_(scanner) {}

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
    const std::int64_t vertices =
        glued_.empty() ? scanner_.integer("the number of vertices") : *parse_integer(glued_);
    const std::int64_t faces = scanner_.integer("the number of faces");
    if (vertices < 0 || faces < 0) scanner_.fail("a count is negative");
    // The number of edges may be missing; nobody needs it. The rest of the file may share its line.
    (void)scanner_.word();
    if (rows_ == Rows::lines) scanner_.skip_rest_of_line();
    vertices_ = static_cast<std::size_t>(vertices);
    faces_ = static_cast<std::size_t>(faces);
    // Three digits with blanks between make a vertex; a digit and a line end make a face.
    check_declared(source_, {"vertices", vertices_, 6}, scanner_.bytes_left());
    check_declared(source_, {"faces", faces_, 2}, scanner_.bytes_left() - 5 * vertices_);
    soup_.points.reserve(vertices_);
    soup_.ends.reserve(faces_);
    soup_.corners.reserve(3 * faces_);
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
  std::string_view glued_;
  TextScanner scanner_;
  std::size_t vertices_ = 0;
  std::size_t faces_ = 0;
  std::size_t rows_with_more_ = 0;
  PolygonSoup soup_;
};

// ---- binary ------------------------------------------------------------------------------------

/// How a program writes binary files. The format wants the highest byte first and a number of
/// colors after each face; OpenMesh writes the lowest first, and no colors.
struct BinaryVariant {
  ByteOrder byte_order = ByteOrder::big_endian;
  bool has_face_colors = true;
};

class BinaryOffReader {
 public:
  /// @param bytes  Those behind the line of the keyword.
  BinaryOffReader(const Source& source, const Keyword& keyword, std::string_view bytes,
                  BinaryVariant variant)
      : source_(source), keyword_(keyword), bytes_(bytes), variant_(variant) {}

  PolygonSoup run() {
    const std::uint32_t vertices = integer();
    const std::uint32_t faces = integer();
    (void)integer();  // edges
    const std::size_t numbers = 3 + (keyword_.has_normal ? 3 : 0) + (keyword_.has_color ? 4 : 0) +
                                (keyword_.has_texture ? 2 : 0);
    check_declared(source_, {"vertices", vertices, 4 * numbers}, bytes_.size() - at_);
    for (std::uint32_t i = 0; i < vertices; ++i) read_vertex(numbers);
    check_declared(source_, {"faces", faces, 4}, bytes_.size() - at_);
    for (std::uint32_t i = 0; i < faces; ++i) read_face(i, vertices);
    if (bytes_left() > 0) {
      soup_.notes.push_back(
          concat("ignored ", counted(bytes_left(), "byte"), " after the last face"));
    }
    return std::move(soup_);
  }

  [[nodiscard]] std::size_t bytes_left() const { return bytes_.size() - at_; }

 private:
  std::uint32_t integer() {
    if (bytes_left() < 4) fail(source_, "the file ends within a number; is it cut short?");
    at_ += 4;
    return static_cast<std::uint32_t>(bits_of(bytes_.substr(at_ - 4, 4), variant_.byte_order));
  }

  void read_vertex(std::size_t numbers) {
    Eigen::Vector3d p;
    for (double& x : p) x = static_cast<double>(std::bit_cast<float>(integer()));
    if (!p.allFinite()) {
      fail(source_, concat("vertex ", soup_.points.size(),
                           " (counted from 0) has a coordinate that is not a finite number"));
    }
    at_ += 4 * (numbers - 3);
    soup_.points.push_back(p);
  }

  void read_face(std::uint32_t index, std::uint32_t vertices) {
    const std::uint32_t size = integer();
    check_declared(source_, {"corners in one face", size, 4}, bytes_left());
    for (std::uint32_t k = 0; k < size; ++k) {
      const std::uint32_t v = integer();
      if (v >= vertices) {
        fail(source_, concat("face ", index, " refers to vertex ", v, " of ", vertices,
                             " (counted from 0)"));
      }
      soup_.corners.push_back(static_cast<int>(v));
    }
    soup_.ends.push_back(soup_.corners.size());
    if (!variant_.has_face_colors) return;
    const std::uint32_t colors = integer();
    check_declared(source_, {"colors of one face", colors, 4}, bytes_left());
    at_ += std::size_t{4} * colors;
  }

  const Source& source_;
  const Keyword& keyword_;
  std::string_view bytes_;
  BinaryVariant variant_;
  std::size_t at_ = 0;
  PolygonSoup soup_;
};

PolygonSoup read_binary(const Source& source, const Keyword& keyword, std::string_view bytes) {
  constexpr std::array variants = {BinaryVariant{ByteOrder::big_endian, true},
                                   BinaryVariant{ByteOrder::big_endian, false},
                                   BinaryVariant{ByteOrder::little_endian, true},
                                   BinaryVariant{ByteOrder::little_endian, false}};
  for (const BinaryVariant variant : variants) {
    // The right one leaves no byte over.
    try {
      BinaryOffReader reader(source, keyword, bytes, variant);
      PolygonSoup soup = reader.run();
      if (reader.bytes_left() == 0) return soup;
    } catch (const FileError&) {
      continue;
    }
  }
  return BinaryOffReader(source, keyword, bytes, variants.front()).run();
}

}  // namespace

bool is_off_keyword(std::string_view word) { return parse_keyword(word).has_value(); }

PolygonSoup read_off(const Source& source) {
  TextScanner scanner(source, Continuation::none);
  const Head head = read_head(scanner);
  if (head.is_binary) {
    (void)scanner.raw_line();
    return read_binary(source, head.keyword, source.bytes.substr(scanner.offset()));
  }
  try {
    return OffReader(source, Rows::lines, head, scanner).run();
  } catch (const FileError&) {
    // Several rows may share a line. If that is not it either, the first message is the better one.
    try {
      return OffReader(source, Rows::words, head, scanner).run();
    } catch (const FileError&) {
    }
    throw;
  }
}

}  // namespace trivalent::remesh
