#include "trivalent/view/energy_ply.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <ostream>
#include <vector>

#include "trivalent/dual/network_checks.h"
#include "trivalent/formats/text_file.h"
#include "trivalent/remesh/whole_file.h"

namespace trivalent::dual {
namespace {

void check_map(const Structure& structure, std::span<const double> energies) {
  if (energies.size() != structure.atoms.size()) {
    throw InvalidNetwork(concat("write_energy_ply: ", energies.size(), " energies for ",
                                structure.atoms.size(), " atoms"));
  }
  for (std::size_t i = 0; i < energies.size(); ++i) {
    if (structure.atoms.positions[i].allFinite() && std::isfinite(energies[i])) continue;
    throw InvalidNetwork(concat("write_energy_ply: atom ", i,
                                " has a coordinate or energy that is not "
                                "finite"));
  }
}

void write_header(std::ostream& out, std::size_t n_atoms, std::size_t n_faces,
                  const EnergyPlyOptions& options) {
  const ColorScale& scale = options.scale;
  out << "ply\nformat " << (options.kind == PlyKind::text ? "ascii" : "binary_little_endian")
      << " 1.0\n"
      << "comment energy per atom in eV; blue " << scale.low << ", white " << scale.middle()
      << ", red " << scale.high << '\n'
      << "element vertex " << n_atoms << '\n'
      << "property double x\nproperty double y\nproperty double z\n"
      << "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      << "property double energy\n"
      << "element face " << n_faces << '\n'
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
void write_vertices(std::ostream& out, const Structure& structure, std::span<const double> energies,
                    const ColorScale& scale) {
  Row row;
  for (std::size_t i = 0; i < energies.size(); ++i) {
    for (const double coordinate : structure.atoms.positions[i]) row.add(coordinate);
    for (const std::uint8_t channel : scale.color(energies[i])) row.add(channel);
    row.add(energies[i]);
    row.write(out);
  }
}

template <typename Row>
void write_faces(std::ostream& out, const std::vector<std::vector<int>>& rings) {
  Row row;
  for (const auto& ring : rings) {
    row.add(static_cast<std::int32_t>(ring.size()));
    for (const int atom : ring) row.add(static_cast<std::int32_t>(atom));
    row.write(out);
  }
}

}  // namespace

void write_energy_ply(std::ostream& out, const Structure& structure,
                      std::span<const double> energies, const EnergyPlyOptions& options) {
  check_map(structure, energies);
  if (options.scale.colors.size() < 2 || !(options.scale.high > options.scale.low)) {
    throw InvalidOption("write_energy_ply: the color scale needs two colors and a width");
  }
  static_cast<void>(check_network(structure));
  const std::vector<std::vector<int>> rings = drawable_rings(structure);
  write_header(out, structure.atoms.size(), rings.size(), options);
  if (options.kind == PlyKind::text) {
    write_vertices<TextRow>(out, structure, energies, options.scale);
    write_faces<TextRow>(out, rings);
  } else {
    write_vertices<BinaryRow>(out, structure, energies, options.scale);
    write_faces<BinaryRow>(out, rings);
  }
}

void write_energy_ply(const std::filesystem::path& path, const Structure& structure,
                      std::span<const double> energies, const EnergyPlyOptions& options) {
  remesh::write_whole_file(
      path, [&](std::ostream& out) { write_energy_ply(out, structure, energies, options); });
}

}  // namespace trivalent::dual
