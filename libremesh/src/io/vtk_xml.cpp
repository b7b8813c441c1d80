#include "io/vtk_xml.h"

#include <lz4.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <optional>

#include "io/mesh_readers.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

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

/// Unpacks into exactly the bytes of `unpacked`; false if they do not fit or are damaged.
bool unpack_zlib(std::string_view packed, std::span<char> unpacked) {
  auto length = static_cast<uLongf>(unpacked.size());
  const int status =
      uncompress(reinterpret_cast<Bytef*>(unpacked.data()), &length,
                 reinterpret_cast<const Bytef*>(packed.data()), static_cast<uLong>(packed.size()));
  return status == Z_OK && length == unpacked.size();
}

bool unpack_lz4(std::string_view packed, std::span<char> unpacked) {
  if (packed.size() > LZ4_MAX_INPUT_SIZE || unpacked.size() > LZ4_MAX_INPUT_SIZE) return false;
  const int length =
      LZ4_decompress_safe(packed.data(), unpacked.data(), static_cast<int>(packed.size()),
                          static_cast<int>(unpacked.size()));
  return length >= 0 && static_cast<std::size_t>(length) == unpacked.size();
}

}  // namespace

VtkXmlFile::VtkXmlFile(const Source& source) : source_(source) {
  parse();
  if (!root()) fail(source_, "there is no element VTKFile");
  read_encoding();
}

void VtkXmlFile::fail_in(const pugi::xml_node& array, std::string_view problem) const {
  pugi::xml_node piece = array;
  while (piece && piece.name() != std::string_view("Piece")) piece = piece.parent();
  std::size_t index = 0;
  for (auto before = piece.previous_sibling("Piece"); before;
       before = before.previous_sibling("Piece")) {
    ++index;
  }
  fail(source_, concat("array ", in_quotes(array.attribute("Name").value()), " in ",
                       array.parent().name(), " of piece ", index, " (counted from 0): ", problem));
}

/// What follows the tag AppendedData may be no XML, and is kept apart.
void VtkXmlFile::parse() {
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
    remesh::fail(source_, concat("no sound XML near byte ", result.offset, ": ",
                                 result.description(), "; is it cut short?"));
  }
  appended_.is_base64 =
      document_.child("VTKFile").child("AppendedData").attribute("encoding").value() ==
      std::string_view("base64");
}

void VtkXmlFile::read_encoding() {
  if (root().attribute("byte_order").value() == std::string_view("BigEndian")) {
    byte_order_ = ByteOrder::big_endian;
  }
  header_size_ = root().attribute("header_type").value() == std::string_view("UInt64") ? 8 : 4;
  const std::string_view compressor = root().attribute("compressor").value();
  if (compressor == "vtkZLibDataCompressor") {
    compressor_ = Compressor::zlib;
  } else if (compressor == "vtkLZ4DataCompressor") {
    compressor_ = Compressor::lz4;
  } else if (!compressor.empty()) {
    fail(source_, concat("its arrays are packed by ", in_quotes(compressor),
                         "; save it with the compressor ZLib or LZ4, or none"));
  }
}

void VtkXmlFile::check_left(const pugi::xml_node& array, const Stream& stream,
                            std::uint64_t size) const {
  if (size <= stream.rest.size()) return;
  fail_in(array, concat("declares ", size, " bytes, more than the ", stream.rest.size(),
                        " that are left; is it cut short?"));
}

std::string VtkXmlFile::take(const pugi::xml_node& array, Stream& stream,
                             std::uint64_t size) const {
  check_left(array, stream, size);
  if (stream.is_base64) return take_base64(array, stream, size);
  std::string taken(stream.rest.substr(0, size));
  stream.rest.remove_prefix(size);
  return taken;
}

/// What is taken begins and ends with a group of four characters.
std::string VtkXmlFile::take_base64(const pugi::xml_node& array, Stream& stream,
                                    std::uint64_t size) const {
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
        fail_in(array, concat(in_quotes(stream.rest.substr(at, 1)), " is no character of base64"));
      }
      bits = bits << 6 | *value;
    }
    for (const int shift : {16, 8, 0}) taken += static_cast<char>(bits >> shift & 0xff);
  }
  taken.resize(size);
  stream.rest.remove_prefix(at);
  return taken;
}

std::uint64_t VtkXmlFile::header_word(std::string_view header, std::size_t i) const {
  return bits_of(header.substr(i * header_size_, header_size_), byte_order_);
}

std::string VtkXmlFile::plain_bytes(const pugi::xml_node& array, Stream stream) const {
  Stream start = stream;
  const std::uint64_t size = header_word(take(array, start, header_size_), 0);
  check_left(array, stream, size);  // before the sum below may overflow
  return take(array, stream, header_size_ + size).substr(header_size_);
}

std::string VtkXmlFile::unpacked_bytes(const pugi::xml_node& array, Stream stream) const {
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
    unpack(array, {i, std::string_view(packed).substr(at, from), to}, bytes);
    at += from;
  }
  return bytes;
}

/// Appends what a block unpacks to.
void VtkXmlFile::unpack(const pugi::xml_node& array, const Block& block, std::string& bytes) const {
  constexpr std::uint64_t best_compression = 1100;  // of zlib, and a little more; LZ4's is 255
  if (block.unpacked_size / best_compression > block.packed.size()) {
    fail_in(array, concat("block ", block.index, " cannot unpack from ", block.packed.size(),
                          " to ", block.unpacked_size, " bytes"));
  }
  const std::size_t before = bytes.size();
  bytes.resize(before + block.unpacked_size);
  const std::span<char> unpacked = std::span(bytes).subspan(before);
  const bool is_sound = compressor_ == Compressor::lz4 ? unpack_lz4(block.packed, unpacked)
                                                       : unpack_zlib(block.packed, unpacked);
  if (!is_sound) fail_in(array, concat("block ", block.index, " of its packed data is damaged"));
}

VtkXmlFile::Stream VtkXmlFile::stream_of(const pugi::xml_node& array,
                                         std::string_view format) const {
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

std::vector<double> VtkXmlFile::numbers_of_text(const pugi::xml_node& array) const {
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

std::vector<double> VtkXmlFile::values_of(const pugi::xml_node& array) const {
  const std::string_view format = array.attribute("format").as_string("ascii");
  if (format == "ascii") return numbers_of_text(array);
  if (format != "binary" && format != "appended") {
    fail_in(array, concat("its format is ", in_quotes(format), ", not ascii, binary or appended"));
  }
  const std::string type_name = array.attribute("type").value();  // Int8 to Float64
  const auto number_format = sized_format(lower_case(type_name));
  if (!number_format) {
    fail_in(array, concat("its type ", in_quotes(type_name), " is not known"));
  }
  const std::size_t size = number_format->size;
  const Stream stream = stream_of(array, format);
  const std::string bytes =
      compressor_ == Compressor::none ? plain_bytes(array, stream) : unpacked_bytes(array, stream);
  if (bytes.size() % size != 0) {
    fail_in(array, concat(bytes.size(), " bytes are no whole number of ", type_name));
  }
  std::vector<double> values;
  values.reserve(bytes.size() / size);
  for (std::size_t at = 0; at < bytes.size(); at += size) {
    values.push_back(
        number_of(std::string_view(bytes).substr(at, size), *number_format, byte_order_));
  }
  return values;
}

}  // namespace trivalent::remesh
