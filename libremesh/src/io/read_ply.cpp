#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/binary_numbers.h"
#include "io/mesh_readers.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

enum class Encoding { text, little_endian, big_endian };

/// Of C; names with a size mean the same.
constexpr std::array ply_formats = {NamedFormat{"char", int8},     NamedFormat{"uchar", uint8},
                                    NamedFormat{"short", int16},   NamedFormat{"ushort", uint16},
                                    NamedFormat{"int", int32},     NamedFormat{"uint", uint32},
                                    NamedFormat{"float", float32}, NamedFormat{"double", float64}};

struct Property {
  std::string name;
  NumberFormat number = float32;
  std::optional<NumberFormat> list_size;  ///< type of the length, if it is a list
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
};

NumberFormat number_named(std::string_view name, const TextScanner& scanner) {
  if (const auto format = find_format(ply_formats, name)) return *format;
  if (const auto format = sized_format(name)) return *format;
  scanner.fail(concat(in_quotes(name), " is no type of PLY numbers"));
}

Property read_property(TextScanner& scanner) {
  Property property;
  std::string_view type = scanner.word();
  if (type == "list") {
    property.list_size = number_named(scanner.word(), scanner);
    type = scanner.word();
  }
  property.number = number_named(type, scanner);
  property.name = scanner.word();
  return property;
}

Encoding read_encoding(TextScanner& scanner) {
  const std::string_view word = scanner.word();
  if (word == "ascii") return Encoding::text;
  if (word == "binary_little_endian") return Encoding::little_endian;
  if (word == "binary_big_endian") return Encoding::big_endian;
  scanner.fail(concat(in_quotes(word), " is no PLY encoding"));
}

Element read_element(TextScanner& scanner) {
  Element element{std::string(scanner.word()), 0, {}};
  const std::int64_t count = scanner.integer("the number of elements");
  if (count < 0) scanner.fail("a count is negative");
  element.count = static_cast<std::uint64_t>(count);
  return element;
}

Header read_header(TextScanner& scanner) {
  Header header;
  bool has_format = false;
  scanner.next_line();  // to the line `ply`
  while (scanner.next_line()) {
    const std::string_view keyword = scanner.word();
    if (keyword == "format") {
      header.encoding = read_encoding(scanner);
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(read_element(scanner));
    } else if (keyword == "property") {
      if (header.elements.empty()) scanner.fail("a property stands before the first element");
      header.elements.back().properties.push_back(read_property(scanner));
    } else if (keyword == "end_header") {
      if (!has_format) scanner.fail("the header does not tell its format");
      return header;
    } else if (keyword != "comment" && keyword != "obj_info") {
      scanner.fail(concat(in_quotes(keyword), " is no part of a PLY header"));
    }
  }
  scanner.fail("the file ends before 'end_header'; is it cut short?");
}

/// The numbers after the header, in any encoding.
class Body {
 public:
  /// @param begin  Offset of the first binary number; text is read from where the scanner stands.
  Body(const Source& source, TextScanner& scanner, Encoding encoding, std::size_t begin)
      : source_(source), scanner_(scanner), encoding_(encoding), at_(begin) {}

  [[nodiscard]] std::size_t bytes_left() const {
    return encoding_ == Encoding::text ? scanner_.bytes_left() : source_.bytes.size() - at_;
  }

  /// Minimum size of a number; in text, a digit and a separator.
  [[nodiscard]] std::size_t bytes_of(NumberFormat format) const {
    return encoding_ == Encoding::text ? 2 : format.size;
  }

  double number(NumberFormat format) {
    if (encoding_ == Encoding::text) return scanner_.number("a property");
    if (bytes_left() < format.size) fail("the file ends within an element; is it cut short?");
    at_ += format.size;
    const ByteOrder order =
        encoding_ == Encoding::big_endian ? ByteOrder::big_endian : ByteOrder::little_endian;
    return number_of(std::string_view(source_.bytes).substr(at_ - format.size, format.size), format,
                     order);
  }

  /// Ends the line of an element, if text.
  void end_row() {
    if (encoding_ == Encoding::text && scanner_.skip_rest_of_line()) ++rows_with_more_;
  }
  [[nodiscard]] std::size_t rows_with_more() const { return rows_with_more_; }

  [[noreturn]] void fail(std::string_view problem) const {
    if (encoding_ == Encoding::text) scanner_.fail(problem);
    throw FileError(concat("read_mesh: ", source_.name, ": byte ", at_, ": ", problem));
  }

 private:
  const Source& source_;
  TextScanner& scanner_;
  Encoding encoding_;
  std::size_t at_;
  std::size_t rows_with_more_ = 0;
};

/// Reads the elements of one file.
class PlyReader {
 public:
  PlyReader(const Source& source, const Header& header, const Body& body)
      : source_(source), header_(header), body_(body) {}

  PolygonSoup run() {
    for (const Element& element : header_.elements) read_element(element);
    if (header_.encoding != Encoding::text && body_.bytes_left() > 0) {
      soup_.notes.push_back(
          concat("ignored ", counted(body_.bytes_left(), "byte"), " after the last element"));
    }
    if (body_.rows_with_more() > 0) {
      soup_.notes.push_back(
          concat("ignored further columns on ", counted(body_.rows_with_more(), "line")));
    }
    check_corners();
    return std::move(soup_);
  }

  [[nodiscard]] std::size_t bytes_left() const { return body_.bytes_left(); }

 private:
  void read_element(const Element& element) {
    if (element.count == 0) return;
    std::uint64_t least = 0;
    for (const Property& p : element.properties)
      least += body_.bytes_of(p.list_size.value_or(p.number));
    if (least == 0) body_.fail(concat("elements ", in_quotes(element.name), " have no properties"));
    const std::string things = in_quotes(element.name) + " elements";
    // The last line of a text may lack its end.
    check_declared(source_, {things, element.count, least}, body_.bytes_left() + 1);
    if (element.name == "vertex") return read_vertices(element);
    if (element.name == "face") return read_faces(element);
    if (element.name == "tristrips") return read_strips(element);
    for (std::uint64_t i = 0; i < element.count; ++i) read_row(element, [](std::size_t, double) {});
    soup_.notes.push_back(
        concat("ignored ", counted(element.count, "element"), ' ', in_quotes(element.name)));
  }

  void read_vertices(const Element& element) {
    const std::array<std::size_t, 3> place = {place_of(element, "x"), place_of(element, "y"),
                                              place_of(element, "z")};
    soup_.points.reserve(soup_.points.size() + element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      Eigen::Vector3d p = Eigen::Vector3d::Zero();
      read_row(element, [&](std::size_t property, double value) {
        for (std::size_t k = 0; k < 3; ++k) {
          if (property == place[k]) p[static_cast<Eigen::Index>(k)] = value;
        }
      });
      if (!p.allFinite()) {
        body_.fail(
            concat("vertex ", i, " (counted from 0) has a coordinate that is not a finite number"));
      }
      soup_.points.push_back(p);
    }
  }

  [[nodiscard]] std::size_t place_of_corners(const Element& element) const {
    return place_of(element,
                    has_property(element, "vertex_indices") ? "vertex_indices" : "vertex_index");
  }

  /// Strips, one or more of them in each list, with -1 between.
  void read_strips(const Element& element) {
    const std::size_t place = place_of_corners(element);
    std::vector<int> strip;
    const auto end_strip = [&] {
      append_strip(soup_, strip);
      strip.clear();
    };
    for (std::uint64_t i = 0; i < element.count; ++i) {
      read_row(element, [&](std::size_t property, double value) {
        if (property != place) return;
        if (value == -1.0) return end_strip();
        strip.push_back(checked_corner(value, "strip", i));
      });
      end_strip();
    }
  }

  [[nodiscard]] int checked_corner(double value, std::string_view thing, std::uint64_t i) const {
    if (value >= 0.0 && value <= std::numeric_limits<int>::max() && value == std::floor(value))
      return static_cast<int>(value);
    body_.fail(concat(thing, ' ', i, " (counted from 0) refers to vertex ", value));
  }

  void read_faces(const Element& element) {
    const std::size_t place = place_of_corners(element);
    soup_.ends.reserve(soup_.ends.size() + element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      read_row(element, [&](std::size_t property, double value) {
        if (property != place) return;
        soup_.corners.push_back(checked_corner(value, "face", i));
      });
      soup_.ends.push_back(soup_.corners.size());
    }
  }

  /// Calls `take(property, value)` for every number of one element, lengths of lists excepted.
  template <typename Take>
  void read_row(const Element& element, const Take& take) {
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const Property& property = element.properties[k];
      const std::uint64_t values = property.list_size ? list_size(property) : 1;
      for (std::uint64_t i = 0; i < values; ++i) take(k, body_.number(property.number));
    }
    body_.end_row();
  }

  std::uint64_t list_size(const Property& property) {
    const double size = body_.number(*property.list_size);
    const std::size_t most = (body_.bytes_left() + 1) / body_.bytes_of(property.number);
    if (size >= 0.0 && size <= static_cast<double>(most) && size == std::floor(size))
      return static_cast<std::uint64_t>(size);
    body_.fail(concat("a list of ", size, " values, but the file holds at most ", most, " more"));
  }

  static bool has_property(const Element& element, std::string_view name) {
    return std::any_of(element.properties.begin(), element.properties.end(),
                       [name](const Property& p) { return p.name == name; });
  }

  [[nodiscard]] std::size_t place_of(const Element& element, std::string_view name) const {
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      if (element.properties[k].name == name) return k;
    }
    body_.fail(concat("elements ", in_quotes(element.name), " have no property '", name, "'"));
  }

  /// At the end, because faces may come before vertices.
  void check_corners() const {
    for (std::size_t i = 0; i < soup_.ends.size(); ++i) {
      for (const int v : soup_.polygon(i)) {
        if (static_cast<std::size_t>(v) < soup_.points.size()) continue;
        fail(source_, concat("face ", i, " refers to vertex ", v, " of ", soup_.points.size(),
                             " (counted from 0)"));
      }
    }
  }

  const Source& source_;
  const Header& header_;
  Body body_;
  PolygonSoup soup_;
};

/// Where the numbers of a binary file may begin, the likelier offset first. One line end follows
/// `end_header` and blanks, not always of the kind of the other lines; and the first number may
/// look like a part of it.
std::vector<std::size_t> possible_beginnings(std::string_view bytes, std::size_t header_end) {
  const std::size_t line_end = std::min(bytes.find_first_not_of(" \t", header_end), bytes.size());
  const std::size_t short_end = std::min(line_end + 1, bytes.size());
  const std::size_t long_end = std::min(line_end + 2, bytes.size());
  const std::string_view ending = bytes.substr(line_end, 2);
  const bool is_pair = ending == "\r\n" || ending == "\n\r";
  if (!is_pair) return {short_end};
  const std::size_t first = std::min(bytes.find_first_of("\r\n"), bytes.size());
  const std::string_view first_ending = bytes.substr(first, 2);
  // CRLF ends a line unless lines end in CR alone; LFCR only where other lines end so.
  const bool cr_alone = first_ending.front() == '\r' && first_ending != "\r\n";
  const bool pair_is_likely = ending == "\r\n" ? !cr_alone : first_ending == "\n\r";
  if (pair_is_likely) return {long_end, short_end};
  return {short_end, long_end};
}

}  // namespace

PolygonSoup read_ply(const Source& source) {
  TextScanner scanner(source, Continuation::none);
  const Header header = read_header(scanner);
  const auto body_from = [&](std::size_t begin) {
    return Body(source, scanner, header.encoding, begin);
  };
  if (header.encoding == Encoding::text) return PlyReader(source, header, body_from(0)).run();
  const std::vector<std::size_t> beginnings = possible_beginnings(source.bytes, scanner.offset());
  for (const std::size_t begin : beginnings) {
    if (beginnings.size() == 1) break;
    // The right offset leaves no byte over.
    try {
      PlyReader reader(source, header, body_from(begin));
      PolygonSoup soup = reader.run();
      if (reader.bytes_left() == 0) return soup;
    } catch (const FileError&) {
      continue;
    }
  }
  return PlyReader(source, header, body_from(beginnings.front())).run();
}

}  // namespace trivalent::remesh
