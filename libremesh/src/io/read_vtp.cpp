#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "io/mesh_readers.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

/// How a number of a DataArray is stored.
struct NumberType {
  std::string_view name;
  std::size_t size;
  enum class Kind { signed_integer, unsigned_integer, real } kind;
};

constexpr std::array number_types = {
    NumberType{"Int8", 1, NumberType::Kind::signed_integer},
    NumberType{"UInt8", 1, NumberType::Kind::unsigned_integer},
    NumberType{"Int16", 2, NumberType::Kind::signed_integer},
    NumberType{"UInt16", 2, NumberType::Kind::unsigned_integer},
    NumberType{"Int32", 4, NumberType::Kind::signed_integer},
    NumberType{"UInt32", 4, NumberType::Kind::unsigned_integer},
    NumberType{"Int64", 8, NumberType::Kind::signed_integer},
    NumberType{"UInt64", 8, NumberType::Kind::unsigned_integer},
    NumberType{"Float32", 4, NumberType::Kind::real},
    NumberType{"Float64", 8, NumberType::Kind::real},
};

/// The bits of so many bytes, the lowest first or last.
std::uint64_t bits_at(std::string_view bytes, bool is_big_endian) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto byte = static_cast<unsigned char>(bytes[is_big_endian ? i : bytes.size() - 1 - i]);
    bits = bits << 8 | byte;
  }
  return bits;
}

double number_at(std::string_view bytes, NumberType::Kind kind, bool is_big_endian) {
  const std::uint64_t bits = bits_at(bytes, is_big_endian);
  switch (kind) {
    case NumberType::Kind::unsigned_integer:
      return static_cast<double>(bits);
    case NumberType::Kind::signed_integer: {
      const std::size_t unused = 64 - 8 * bytes.size();
      return static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused);
    }
    case NumberType::Kind::real:
      break;
  }
  if (bytes.size() == 8) return std::bit_cast<double>(bits);
  return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
}

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// What a character of base64 stands for; none if it is no such character.
std::optional<std::uint32_t> base64_value(char c) {
  if (c >= 'A' && c <= 'Z') return static_cast<std::uint32_t>(c - 'A');
  if (c >= 'a' && c <= 'z') return static_cast<std::uint32_t>(c - 'a' + 26);
  if (c >= '0' && c <= '9') return static_cast<std::uint32_t>(c - '0' + 52);
  if (c == '+') return 62;
  if (c == '/') return 63;
  return std::nullopt;
}

/// Reads VTK's XML files of PolyData: arrays as text, base64 or plain bytes, within or behind the
/// XML, packed by zlib or not.
class VtpReader {
 public:
  explicit VtpReader(const Source& source) : source_(source) {}

  PolygonSoup run() {
    parse();
    const pugi::xml_node file = document_.child("VTKFile");
    if (!file) fail("there is no element VTKFile");
    const std::string_view type = file.attribute("type").value();
    if (type != "PolyData") {
      fail(concat("it holds ", in_quotes(type),
                  ", not PolyData; extract its surface in ParaView, and save that"));
    }
    is_big_endian_ = file.attribute("byte_order").value() == std::string_view("BigEndian");
    header_size_ = file.attribute("header_type").value() == std::string_view("UInt64") ? 8 : 4;
    compressor_ = file.attribute("compressor").value();
    if (!compressor_.empty() && compressor_ != "vtkZLibDataCompressor") {
      fail(concat("its arrays are packed by ", in_quotes(compressor_),
                  "; save it with the compressor ZLib, or none"));
    }
    for (const pugi::xml_node piece : file.child("PolyData").children("Piece")) read_piece(piece);
    if (lines_ > 0) soup_.notes.push_back(concat("left out ", counted(lines_, "line")));
    return std::move(soup_);
  }

 private:
  /// Encoded bytes of an array.
  struct Stream {
    std::string_view rest;
    bool is_base64 = false;
  };

  [[noreturn]] void fail(std::string_view problem) const { remesh::fail(source_, problem); }
  [[noreturn]] void fail_in(const pugi::xml_node& array, std::string_view problem) const {
    fail(concat("array ", in_quotes(array.attribute("Name").value()), " in ", array.parent().name(),
                " of piece ", pieces_, " (counted from 0): ", problem));
  }

  /// What follows the tag AppendedData may be no XML, and is kept apart.
  void parse() {
    constexpr std::string_view tag = "<AppendedData";
    constexpr std::string_view ends = "</AppendedData></VTKFile>";
    const std::string_view bytes = source_.bytes;
    const std::size_t begin = bytes.find(tag);
    const std::size_t end = begin == bytes.npos ? bytes.npos : bytes.find('>', begin);
    xml_ = bytes.substr(0, end == bytes.npos ? end : end + 1);
    if (end != bytes.npos) {
      xml_ += ends;
      const std::size_t mark = bytes.find('_', end);
      if (mark != bytes.npos) appended_.rest = bytes.substr(mark + 1);
    }
    const pugi::xml_parse_result result = document_.load_buffer_inplace(xml_.data(), xml_.size());
    if (!result) {
      fail(concat("no sound XML near byte ", result.offset, ": ", result.description(),
                  "; is it cut short?"));
    }
    appended_.is_base64 =
        document_.child("VTKFile").child("AppendedData").attribute("encoding").value() ==
        std::string_view("base64");
  }

  // ---- arrays ----------------------------------------------------------------------------------

  void check_left(const pugi::xml_node& array, const Stream& stream, std::uint64_t size) const {
    if (size <= stream.rest.size()) return;
    fail_in(array, concat("declares ", size, " bytes, more than the ", stream.rest.size(),
                          " that are left; is it cut short?"));
  }

  /// The next bytes of a stream. In base64 they begin and end with a group of four characters.
  std::string take(const pugi::xml_node& array, Stream& stream, std::uint64_t size) const {
    check_left(array, stream, size);
    if (!stream.is_base64) {
      const std::string taken(stream.rest.substr(0, size));
      stream.rest.remove_prefix(size);
      return taken;
    }
    std::string taken;
    taken.reserve(size + 2);
    std::size_t at = 0;
    while (taken.size() < size) {
      std::uint32_t bits = 0;
      for (int k = 0; k < 4; ++k, ++at) {
        while (at < stream.rest.size() && is_space(stream.rest[at])) ++at;
        if (at == stream.rest.size()) fail_in(array, "its base64 ends early; is it cut short?");
        const bool is_padding = stream.rest[at] == '=' && k > 1;
        const auto value = is_padding ? 0 : base64_value(stream.rest[at]);
        if (!value) {
          fail_in(array,
                  concat(in_quotes(stream.rest.substr(at, 1)), " is no character of base64"));
        }
        bits = bits << 6 | *value;
      }
      for (const int shift : {16, 8, 0}) taken += static_cast<char>(bits >> shift & 0xff);
    }
    taken.resize(size);
    stream.rest.remove_prefix(at);
    return taken;
  }

  [[nodiscard]] std::uint64_t header_word(std::string_view header, std::size_t i) const {
    return bits_at(header.substr(i * header_size_, header_size_), is_big_endian_);
  }

  std::string plain_bytes(const pugi::xml_node& array, Stream stream) const {
    Stream start = stream;
    const std::uint64_t size = header_word(take(array, start, header_size_), 0);
    check_left(array, stream, size);  // before the sum below may overflow
    return take(array, stream, header_size_ + size).substr(header_size_);
  }

  std::string unpacked_bytes(const pugi::xml_node& array, Stream stream) const {
    constexpr std::uint64_t best_compression = 1100;  // of zlib, and a little more
    Stream start = stream;
    const std::uint64_t blocks = header_word(take(array, start, header_size_), 0);
    if (blocks > stream.rest.size() / header_size_) {
      fail_in(array, concat("declares ", blocks, " packed blocks, more than its bytes can hold"));
    }
    const std::string header = take(array, stream, (3 + blocks) * header_size_);
    const std::uint64_t block_size = header_word(header, 1);
    const std::uint64_t last_size = header_word(header, 2);
    std::uint64_t packed_size = 0;
    for (std::uint64_t i = 0; i < blocks; ++i) {
      packed_size += std::min<std::uint64_t>(header_word(header, 3 + i), source_.bytes.size() + 1);
    }
    const std::string packed = take(array, stream, packed_size);
    std::string bytes;
    std::size_t at = 0;
    for (std::uint64_t i = 0; i < blocks; ++i) {
      const std::uint64_t from = header_word(header, 3 + i);
      const std::uint64_t to = i + 1 == blocks && last_size > 0 ? last_size : block_size;
      if (to / best_compression > from) {
        fail_in(array, concat("block ", i, " cannot unpack from ", from, " to ", to, " bytes"));
      }
      const std::size_t before = bytes.size();
      bytes.resize(before + to);
      auto length = static_cast<uLongf>(to);
      const int status =
          uncompress(reinterpret_cast<Bytef*>(bytes.data() + before), &length,
                     reinterpret_cast<const Bytef*>(packed.data() + at), static_cast<uLong>(from));
      if (status != Z_OK || length != to) {
        fail_in(array, concat("block ", i, " of its packed data is damaged"));
      }
      at += from;
    }
    return bytes;
  }

  [[nodiscard]] Stream stream_of(const pugi::xml_node& array, std::string_view format) const {
    if (format == "binary") return {array.child_value(), true};
    const auto offset = parse_integer(array.attribute("offset").value());
    if (!offset || *offset < 0 || static_cast<std::uint64_t>(*offset) > appended_.rest.size()) {
      fail_in(array, concat("its offset ", in_quotes(array.attribute("offset").value()),
                            " lies outside of the ", appended_.rest.size(),
                            " bytes of appended data; is the file cut short?"));
    }
    Stream stream = appended_;
    stream.rest.remove_prefix(static_cast<std::size_t>(*offset));
    return stream;
  }

  [[nodiscard]] std::vector<double> numbers_of_text(const pugi::xml_node& array) const {
    std::vector<double> values;
    std::string_view rest = array.child_value();
    for (;;) {
      while (!rest.empty() && is_space(rest.front())) rest.remove_prefix(1);
      if (rest.empty()) return values;
      const auto end = std::find_if(rest.begin(), rest.end(), is_space);
      const std::string_view word(rest.begin(), end);
      const auto value = parse_number(word);
      if (!value)
        fail_in(array, concat("value ", values.size(), " is ", in_quotes(word), ", not a number"));
      values.push_back(*value);
      rest.remove_prefix(word.size());
    }
  }

  [[nodiscard]] std::vector<double> values_of(const pugi::xml_node& array) const {
    const std::string_view format = array.attribute("format").as_string("ascii");
    if (format == "ascii") return numbers_of_text(array);
    if (format != "binary" && format != "appended") {
      fail_in(array,
              concat("its format is ", in_quotes(format), ", not ascii, binary or appended"));
    }
    const std::string_view type_name = array.attribute("type").value();
    const auto* type = std::ranges::find(number_types, type_name, &NumberType::name);
    if (type == number_types.end()) {
      fail_in(array, concat("its type ", in_quotes(type_name), " is not known"));
    }
    const Stream stream = stream_of(array, format);
    const std::string bytes =
        compressor_.empty() ? plain_bytes(array, stream) : unpacked_bytes(array, stream);
    if (bytes.size() % type->size != 0) {
      fail_in(array, concat(bytes.size(), " bytes are no whole number of ", type->name));
    }
    std::vector<double> values;
    values.reserve(bytes.size() / type->size);
    for (std::size_t at = 0; at < bytes.size(); at += type->size) {
      values.push_back(
          number_at(std::string_view(bytes).substr(at, type->size), type->kind, is_big_endian_));
    }
    return values;
  }

  // ---- pieces ----------------------------------------------------------------------------------

  [[nodiscard]] std::uint64_t declared(const pugi::xml_node& piece, const char* name) const {
    const std::string_view word = piece.attribute(name).as_string("0");
    const auto count = parse_integer(word);
    if (!count || *count < 0) {
      fail(concat("piece ", pieces_, " (counted from 0): ", name, " is ", in_quotes(word)));
    }
    return static_cast<std::uint64_t>(*count);
  }

  void read_piece(const pugi::xml_node& piece) {
    const std::size_t first = soup_.points.size();
    read_points(piece);
    const std::size_t points = soup_.points.size() - first;
    for_each_cell(piece, "Polys", points, [&](std::span<const int> cell) {
      for (const int v : cell) soup_.corners.push_back(static_cast<int>(first) + v);
      soup_.ends.push_back(soup_.corners.size());
    });
    for_each_cell(piece, "Strips", points, [&](std::span<const int> cell) {
      for (std::size_t i = 0; i + 2 < cell.size(); ++i) {
        const std::size_t odd = i % 2;  // every other triangle runs the other way
        for (const std::size_t k : {i + odd, i + 1 - odd, i + 2}) {
          soup_.corners.push_back(static_cast<int>(first) + cell[k]);
        }
        soup_.ends.push_back(soup_.corners.size());
      }
    });
    lines_ += declared(piece, "NumberOfLines");
    ++pieces_;
  }

  void read_points(const pugi::xml_node& piece) {
    const std::uint64_t count = declared(piece, "NumberOfPoints");
    const pugi::xml_node array = piece.child("Points").child("DataArray");
    const std::vector<double> values = array ? values_of(array) : std::vector<double>();
    if (values.size() % 3 != 0 || values.size() / 3 != count) {
      fail(concat("piece ", pieces_, " (counted from 0) declares ", count, " points, but holds ",
                  values.size(), " coordinates"));
    }
    if (soup_.points.size() + count > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
      fail(concat("declares more than ", std::numeric_limits<int>::max(), " points"));
    }
    for (std::size_t i = 0; i < values.size(); i += 3) {
      soup_.points.emplace_back(values[i], values[i + 1], values[i + 2]);
      if (soup_.points.back().allFinite()) continue;
      fail(concat("vertex ", soup_.points.size() - 1,
                  " (counted from 0) has a coordinate that is not a finite number"));
    }
  }

  /// Calls visit(corners) for every polygon or strip of a piece.
  template <typename Visit>
  void for_each_cell(const pugi::xml_node& piece, const char* kind, std::size_t points,
                     const Visit& visit) {
    const std::uint64_t count = declared(piece, concat("NumberOf", kind).c_str());
    if (count == 0) return;
    const pugi::xml_node cells = piece.child(kind);
    const pugi::xml_node array = cells.find_child_by_attribute("Name", "connectivity");
    const std::vector<double> connectivity = values_of(array);
    const std::vector<double> offsets = values_of(cells.find_child_by_attribute("Name", "offsets"));
    if (offsets.size() != count) {
      fail(concat("piece ", pieces_, " (counted from 0) declares ", count, ' ', kind,
                  ", but holds ", offsets.size()));
    }
    std::vector<int> corners;
    double begin = 0.0;
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      const double end = offsets[i];
      if (!(end >= begin && end <= static_cast<double>(connectivity.size())) ||
          end != std::floor(end)) {
        fail_in(array, concat("face ", i, " (counted from 0) ends at ", end, " of ",
                              connectivity.size(), " corners"));
      }
      corners.clear();
      for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
        const double v = connectivity[k];
        if (!(v >= 0.0 && v < static_cast<double>(points)) || v != std::floor(v)) {
          fail_in(array,
                  concat("face ", i, " refers to vertex ", v, " of ", points, " (counted from 0)"));
        }
        corners.push_back(static_cast<int>(v));
      }
      visit(corners);
      begin = end;
    }
  }

  const Source& source_;
  std::string xml_;  // the document points into it
  pugi::xml_document document_;
  Stream appended_;
  bool is_big_endian_ = false;
  std::size_t header_size_ = 4;
  std::string compressor_;
  std::size_t pieces_ = 0;
  std::uint64_t lines_ = 0;
  PolygonSoup soup_;
};

}  // namespace

PolygonSoup read_vtp(const Source& source) { return VtpReader(source).run(); }

}  // namespace trivalent::remesh
