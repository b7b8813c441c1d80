#include <cmath>
#include <limits>

#include "io/mesh_readers.h"
#include "io/vtk_xml.h"
#include "trivalent/remesh/error.h"
#include "volume/volume_readers.h"

namespace trivalent::remesh {

namespace {

/// First and last index along each axis.
struct Extent {
  std::array<std::int64_t, 3> first;
  std::array<std::int64_t, 3> last;
};

/// Reads VTK's XML file of ImageData.
class VtiReader {
 public:
  explicit VtiReader(const Source& source) : source_(source), file_(source) {}

  Volume run() {
    const std::string type = file_.root().attribute("type").value();
    if (type != "ImageData") fail(source_, concat("it holds ", in_quotes(type), ", no ImageData"));
    const pugi::xml_node image = file_.root().child("ImageData");
    whole_ = extent_of(image, "WholeExtent");
    read_axes(image);
    const bool has_point_data = !image.child("Piece").child("PointData").first_child().empty();
    if (!has_point_data) {
      // Values of cells stand in their middles.
      for (std::int64_t& last : whole_.last) --last;
      volume_.origin += 0.5 * volume_.steps.rowwise().sum();
    }
    std::array<std::int64_t, 3> size = {};
    for (std::size_t k = 0; k < 3; ++k) size[k] = whole_.last[k] - whole_.first[k] + 1;
    // Packed values take less than a byte each.
    constexpr std::size_t best_compression = 1100;
    const std::size_t points =
        checked_points(source_, size, source_.bytes.size() * best_compression);
    for (std::size_t k = 0; k < 3; ++k) volume_.size[k] = static_cast<int>(size[k]);
    const char* const kind = has_point_data ? "PointData" : "CellData";
    std::size_t declared = 0;
    for (const pugi::xml_node piece : image.children("Piece")) {
      declared += points_in(piece_extent(piece, kind));
    }
    if (declared < points) {
      fail(source_, concat("its pieces hold ", declared, " of ", points,
                           " values; a file of parts (.pvti) is not read: save it as one"));
    }
    // What no piece covers stays no number, which is refused.
    volume_.values.assign(points, std::numeric_limits<float>::quiet_NaN());
    for (const pugi::xml_node piece : image.children("Piece")) read_piece(piece, kind);
    return std::move(volume_);
  }

 private:
  [[nodiscard]] std::vector<double> numbers_of(const pugi::xml_node& node, const char* name,
                                               std::size_t count) const {
    const std::string_view text = node.attribute(name).value();
    const Source words = {.bytes = text, .name = source_.name};
    TextScanner scanner(words, Continuation::none);
    std::vector<double> numbers;
    for (std::string_view word = scanner.word_across_lines(); !word.empty();
         word = scanner.word_across_lines()) {
      const auto number = parse_number(word);
      if (!number) break;
      numbers.push_back(*number);
    }
    if (numbers.size() != count) {
      fail(source_,
           concat(node.name(), ": ", name, " must be ", count, " numbers, not ", in_quotes(text)));
    }
    return numbers;
  }

  [[nodiscard]] Extent extent_of(const pugi::xml_node& node, const char* name) const {
    const std::vector<double> numbers = numbers_of(node, name, 6);
    Extent extent = {};
    constexpr double limit = 2147483647.0;
    for (const double number : numbers) {
      if (number == std::floor(number) && std::abs(number) <= limit) continue;
      fail(source_, concat(node.name(), ": ", name, " must be whole numbers, not ",
                           in_quotes(node.attribute(name).value())));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      extent.first[k] = static_cast<std::int64_t>(numbers[2 * k]);
      extent.last[k] = static_cast<std::int64_t>(numbers[2 * k + 1]);
    }
    return extent;
  }

  void read_axes(const pugi::xml_node& image) {
    const auto numbers = [&](const char* name, std::vector<double> otherwise) {
      if (!image.attribute(name)) return otherwise;
      return numbers_of(image, name, otherwise.size());
    };
    const std::vector<double> origin = numbers("Origin", {0.0, 0.0, 0.0});
    const std::vector<double> spacing = numbers("Spacing", {1.0, 1.0, 1.0});
    const std::vector<double> direction =
        numbers("Direction", {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0});
    Eigen::Vector3d first;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      for (Eigen::Index row = 0; row < 3; ++row) {
        volume_.steps(row, k) = spacing[axis] * direction[3 * static_cast<std::size_t>(row) + axis];
      }
      volume_.origin[k] = origin[axis];
      first[k] = static_cast<double>(whole_.first[axis]);
    }
    volume_.origin += volume_.steps * first;
  }

  /// The active scalars, else the first array of one component.
  [[nodiscard]] pugi::xml_node array_of(const pugi::xml_node& data) {
    const std::string active = data.attribute("Scalars").value();
    pugi::xml_node array = data.find_child_by_attribute("Name", active.c_str());
    const auto is_scalar = [](const pugi::xml_node& node) {
      return node.attribute("NumberOfComponents").as_int(1) == 1;
    };
    if (!array || !is_scalar(array)) array = data.find_child(is_scalar);
    if (!array) fail(source_, concat("it has no array of one component in its ", data.name()));
    const std::string name = array.attribute("Name").value();
    const auto arrays = std::distance(data.begin(), data.end());
    if (arrays > 1 && volume_.notes.empty()) {
      volume_.notes.push_back(concat("took ", in_quotes(name), " of ", arrays, " arrays"));
    }
    return array;
  }

  /// The values a piece has, of points or of cells.
  [[nodiscard]] Extent piece_extent(const pugi::xml_node& piece, std::string_view kind) const {
    Extent extent = extent_of(piece, "Extent");
    for (std::size_t k = 0; k < 3; ++k) {
      if (kind == "CellData") --extent.last[k];
      if (extent.first[k] < whole_.first[k] || extent.last[k] > whole_.last[k] ||
          extent.first[k] > extent.last[k]) {
        fail(source_, "the extent of a piece lies outside of WholeExtent");
      }
    }
    return extent;
  }

  static std::size_t points_in(const Extent& extent) {
    std::size_t count = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      count *= static_cast<std::size_t>(extent.last[k] - extent.first[k] + 1);
    }
    return count;
  }

  void read_piece(const pugi::xml_node& piece, const char* kind) {
    const Extent extent = piece_extent(piece, kind);
    const pugi::xml_node array = array_of(piece.child(kind));
    const std::vector<double> values = file_.values_of(array);
    if (values.size() != points_in(extent)) {
      file_.fail_in(array, concat("holds ", values.size(), " values where its extent has ",
                                  points_in(extent)));
    }
    const auto at = [&](std::size_t k, std::int64_t index) {
      return static_cast<std::size_t>(index - whole_.first[k]);
    };
    const auto nx = static_cast<std::size_t>(volume_.size[0]);
    const auto ny = static_cast<std::size_t>(volume_.size[1]);
    std::size_t next = 0;
    for (std::int64_t z = extent.first[2]; z <= extent.last[2]; ++z) {
      for (std::int64_t y = extent.first[1]; y <= extent.last[1]; ++y) {
        for (std::int64_t x = extent.first[0]; x <= extent.last[0]; ++x) {
          volume_.values[at(0, x) + nx * (at(1, y) + ny * at(2, z))] =
              static_cast<float>(values[next++]);
        }
      }
    }
  }

  const Source& source_;
  VtkXmlFile file_;
  Extent whole_ = {};
  Volume volume_;
};

}  // namespace

Volume read_vti(const Source& source) { return VtiReader(source).run(); }

}  // namespace trivalent::remesh
