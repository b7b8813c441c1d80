#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "io/file_bytes.h"
#include "io/mesh_readers.h"
#include "trivalent/remesh/error.h"
#include "volume/volume_readers.h"

namespace trivalent::remesh {

namespace {

using Reader = Volume (*)(const Source&);

struct VolumeFormat {
  std::string_view extension;
  Reader read;  ///< null for raw numbers
};

constexpr std::array formats = {VolumeFormat{".vti", read_vti},   VolumeFormat{".cube", read_cube},
                                VolumeFormat{".cub", read_cube},  VolumeFormat{".nrrd", read_nrrd},
                                VolumeFormat{".nhdr", read_nrrd}, VolumeFormat{".mrc", read_mrc},
                                VolumeFormat{".map", read_mrc},   VolumeFormat{".ccp4", read_mrc},
                                VolumeFormat{".raw", nullptr}};

const VolumeFormat* format_of(const Source& source) {
  const auto* const found =
      std::ranges::find(formats, extension_of(source), &VolumeFormat::extension);
  return found == formats.end() ? nullptr : found;
}

/// Turns the first axis around where the three are left-handed.
void make_right_handed(Volume& volume) {
  if (volume.steps.determinant() > 0.0) return;
  const auto along = static_cast<std::ptrdiff_t>(volume.size[0]);
  for (auto row = volume.values.begin(); row != volume.values.end(); row += along) {
    std::reverse(row, row + along);
  }
  volume.origin += (volume.size[0] - 1) * volume.steps.col(0);
  volume.steps.col(0) *= -1.0;
}

void check_volume(const Source& source, const Volume& volume) {
  constexpr double flat = 1e-6;  // of a cuboid's volume
  const double cuboid = volume.steps.colwise().norm().prod();
  if (!volume.steps.allFinite() || !volume.origin.allFinite() ||
      !(std::abs(volume.steps.determinant()) > flat * cuboid)) {
    fail(source, "its three axes span no volume");
  }
  const auto bad =
      std::ranges::find_if_not(volume.values, [](float x) { return std::isfinite(x); });
  if (bad == volume.values.end()) return;
  auto index = bad - volume.values.begin();
  std::array<std::ptrdiff_t, 3> point = {};
  for (std::size_t k = 0; k < 3; ++k) {
    point[k] = index % volume.size[k];
    index /= volume.size[k];
  }
  fail(source, concat("the value at point (", point[0], ", ", point[1], ", ", point[2],
                      "), counted from 0, is ", *bad, "; all must be finite"));
}

}  // namespace

bool is_volume_file(const std::filesystem::path& path) {
  return format_of({.bytes = {}, .name = path.string()}) != nullptr;
}

std::size_t checked_points(const Source& source, const std::array<std::int64_t, 3>& size,
                           std::size_t bytes_left) {
  constexpr std::int64_t most = 100'000;
  std::size_t points = 1;
  for (const std::int64_t n : size) {
    if (n < 2 || n > most) {
      fail(source, concat("a volume of ", size[0], " x ", size[1], " x ", size[2],
                          " points; each must be from 2 to ", most));
    }
    points *= static_cast<std::size_t>(n);
  }
  if (points > bytes_left) {
    fail(source, concat("declares ", size[0], " x ", size[1], " x ", size[2],
                        " values, more than its remaining ", bytes_left,
                        " bytes can hold; is it cut short?"));
  }
  return points;
}

std::vector<float> values_of(const Source& source, const std::array<int, 3>& size,
                             const NumberArray& numbers) {
  const std::size_t points =
      checked_points(source, {size[0], size[1], size[2]}, numbers.bytes.size());
  const std::size_t width = numbers.format.size;
  if (numbers.bytes.size() / width < points) {
    fail(source, concat("holds ", numbers.bytes.size(), " bytes of values; ", size[0], " x ",
                        size[1], " x ", size[2], " of ", width, " bytes each are ", points * width,
                        "; is it cut short?"));
  }
  std::vector<float> values(points);
  for (std::size_t i = 0; i < points; ++i) {
    values[i] = static_cast<float>(
        number_of(numbers.bytes.substr(i * width, width), numbers.format, numbers.order));
  }
  return values;
}

Volume read_volume(const std::filesystem::path& path, const std::optional<RawLayout>& raw) {
  // Masks of one value pack a thousandfold, as well as gzip can.
  constexpr std::size_t best_compression = 1100;
  std::string bytes = read_bytes(path);
  const Source named = {.bytes = bytes, .name = path.string()};
  const VolumeFormat* const format = format_of(named);
  if (format == nullptr) {
    fail(named, "is no volume; save it as .vti, .cube, .nrrd, .mrc, .map or .raw, each also .gz");
  }
  if (raw && format->read != nullptr) {
    throw InvalidOption(concat("read_volume: ", path.string(),
                               " says its sizes itself; a layout is for .raw files only"));
  }
  if (!raw && format->read == nullptr) {
    throw InvalidOption(concat("read_volume: ", path.string(),
                               " does not say what it holds; give its sizes and type (--raw)"));
  }
  if (is_gzipped(bytes)) bytes = unpack(named, best_compression);
  const Source source = {.bytes = bytes, .name = path.string()};
  Volume volume = raw ? read_raw(source, *raw) : format->read(source);
  check_volume(source, volume);
  make_right_handed(volume);
  return volume;
}

}  // namespace trivalent::remesh
