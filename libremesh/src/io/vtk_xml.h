#pragma once

#include <cstdint>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "io/binary_numbers.h"
#include "io/text_scanner.h"

namespace trivalent::remesh {

/// One of VTK's XML files: arrays as text, base64 or plain bytes, within or behind the XML, packed
/// by zlib or LZ4, or not packed.
class VtkXmlFile {
 public:
  /// @throws FileError if the bytes are no sound XML of VTK, or packed in another way.
  explicit VtkXmlFile(const Source& source);

  /// The element VTKFile.
  [[nodiscard]] pugi::xml_node root() const { return document_.child("VTKFile"); }

  /// The numbers of a DataArray.
  /// @throws FileError if they are damaged or cut short.
  [[nodiscard]] std::vector<double> values_of(const pugi::xml_node& array) const;

  /// Throws FileError about an array.
  [[noreturn]] void fail_in(const pugi::xml_node& array, std::string_view problem) const;

 private:
  enum class Compressor { none, zlib, lz4 };

  /// Encoded bytes of an array.
  struct Stream {
    std::string_view rest;
    bool is_base64 = false;
  };

  /// A block of packed bytes, and how many they are unpacked.
  struct Block {
    std::uint64_t index = 0;
    std::string_view packed;
    std::uint64_t unpacked_size = 0;
  };

  void parse();
  void read_encoding();
  void check_left(const pugi::xml_node& array, const Stream& stream, std::uint64_t size) const;
  std::string take(const pugi::xml_node& array, Stream& stream, std::uint64_t size) const;
  std::string take_base64(const pugi::xml_node& array, Stream& stream, std::uint64_t size) const;
  [[nodiscard]] std::uint64_t header_word(std::string_view header, std::size_t i) const;
  [[nodiscard]] std::string plain_bytes(const pugi::xml_node& array, Stream stream) const;
  [[nodiscard]] std::string unpacked_bytes(const pugi::xml_node& array, Stream stream) const;
  void unpack(const pugi::xml_node& array, const Block& block, std::string& bytes) const;
  [[nodiscard]] Stream stream_of(const pugi::xml_node& array, std::string_view format) const;
  [[nodiscard]] std::vector<double> numbers_of_text(const pugi::xml_node& array) const;

  const Source& source_;
  std::string xml_;  // the document points into it
  pugi::xml_document document_;
  Stream appended_;
  ByteOrder byte_order_ = ByteOrder::little_endian;
  std::size_t header_size_ = 4;
  Compressor compressor_ = Compressor::none;
};

}  // namespace trivalent::remesh
