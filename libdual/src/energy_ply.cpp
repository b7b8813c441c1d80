#include "trivalent/dual/energy_ply.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <ostream>
#include <vector>

#include "text_file.h"
#include "trivalent/dual/network_checks.h"
#include "trivalent/remesh/whole_file.h"

namespace trivalent::dual {
namespace {

// The ends and the middle of ColorBrewer's RdBu, which stays readable without red-green vision.
constexpr Color blue = {33, 102, 172};
constexpr Color white = {247, 247, 247};
constexpr Color red = {178, 24, 43};

Color blend(const Color& from, const Color& to, double fraction) {
  Color color = {};
  for (std::size_t i = 0; i < color.size(); ++i) {
    color[i] = static_cast<std::uint8_t>(std::lround(std::lerp(from[i], to[i], fraction)));
  }
  return color;
}

double percentile(const std::vector<double>& sorted, double fraction) {
  const double position = fraction * static_cast<double>(sorted.size() - 1);
  return sorted[static_cast<std::size_t>(std::lround(position))];
}

void check_map(const Network& network, std::span<const double> energies) {
  if (energies.size() != network.positions.size()) {
    throw InvalidNetwork(concat("write_energy_ply: ", energies.size(), " energies for ",
                                network.positions.size(), " atoms"));
  }
  for (std::size_t i = 0; i < energies.size(); ++i) {
    if (network.positions[i].allFinite() && std::isfinite(energies[i])) continue;
    throw InvalidNetwork(concat("write_energy_ply: atom ", i,
                                " has a coordinate or energy that is not "
                                "finite"));
  }
}

void write_header(std::ostream& out, const Network& network, const EnergyPlyOptions& options) {
  const ColorScale& scale = options.scale;
  out << "ply\nformat " << (options.kind == PlyKind::text ? "ascii" : "binary_little_endian")
      << " 1.0\n"
      << "comment energy per atom in eV; blue " << scale.center - scale.half_width << ", white "
      << scale.center << ", red " << scale.center + scale.half_width << '\n'
      << "element vertex " << network.positions.size() << '\n'
      << "property double x\nproperty double y\nproperty double z\n"
      << "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      << "property double energy\n"
      << "element face " << network.rings.size() << '\n'
      << "property list int int vertex_indices\n"
      << "end_header\n";
}

/// One line of a text PLY.
class TextRow {
 public:
  void add(double value) {
    separate();
    append_real(line_, value, Digits::ten_decimals);
  }
  void add(std::uint8_t value) { add(static_cast<std::int32_t>(value)); }
  void add(std::int32_t value) {
    separate();
    append_integer(line_, value);
  }
  void write(std::ostream& out) {
    line_ += '\n';
    out.write(line_.data(), static_cast<std::streamsize>(line_.size()));
    line_.clear();
  }

 private:
  void separate() {
    if (!line_.empty()) line_ += ' ';
  }
  std::string line_;
};

/// One record of a binary PLY, little endian as the header says.
class BinaryRow {
 public:
  template <typename Value>
  void add(Value value) {
    auto bytes = std::bit_cast<std::array<char, sizeof(Value)>>(value);
    if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
    record_.append(bytes.data(), bytes.size());
  }
  void write(std::ostream& out) {
    out.write(record_.data(), static_cast<std::streamsize>(record_.size()));
    record_.clear();
  }

 private:
  std::string record_;
};

template <typename Row>
void write_vertices(std::ostream& out, const Network& network, std::span<const double> energies,
                    const ColorScale& scale) {
  Row row;
  for (std::size_t i = 0; i < energies.size(); ++i) {
    for (const double coordinate : network.positions[i]) row.add(coordinate);
    for (const std::uint8_t channel : scale.color(energies[i])) row.add(channel);
    row.add(energies[i]);
    row.write(out);
  }
}

template <typename Row>
void write_faces(std::ostream& out, const Network& network) {
  Row row;
  for (const auto& ring : network.rings) {
    row.add(static_cast<std::int32_t>(ring.size()));
    for (const int atom : ring) row.add(static_cast<std::int32_t>(atom));
    row.write(out);
  }
}

}  // namespace

Color ColorScale::color(double value) const {
  const double position = std::clamp((value - center) / half_width, -1.0, 1.0);
  return position < 0.0 ? blend(white, blue, -position) : blend(white, red, position);
}

ColorScale make_color_scale(std::span<const double> values, double center) {
  const auto is_finite = [](double value) { return std::isfinite(value); };
  if (!std::isfinite(center) || !std::all_of(values.begin(), values.end(), is_finite)) {
    throw InvalidOption("make_color_scale: values and center must be finite");
  }
  ColorScale scale = {.center = center};
  if (values.empty()) return scale;
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const double widest =
      std::max(center - percentile(sorted, 0.02), percentile(sorted, 0.98) - center);
  // Equal values at the center leave no width; any will do.
  if (widest > 0.0) scale.half_width = widest;
  return scale;
}

void write_energy_ply(std::ostream& out, const Network& network, std::span<const double> energies,
                      const EnergyPlyOptions& options) {
  check_map(network, energies);
  static_cast<void>(check_network(network));
  write_header(out, network, options);
  if (options.kind == PlyKind::text) {
    write_vertices<TextRow>(out, network, energies, options.scale);
    write_faces<TextRow>(out, network);
  } else {
    write_vertices<BinaryRow>(out, network, energies, options.scale);
    write_faces<BinaryRow>(out, network);
  }
}

void write_energy_ply(const std::filesystem::path& path, const Network& network,
                      std::span<const double> energies, const EnergyPlyOptions& options) {
  remesh::write_whole_file(
      path, [&](std::ostream& out) { write_energy_ply(out, network, energies, options); });
}

}  // namespace trivalent::dual
