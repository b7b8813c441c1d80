#include "trivalent/view/vtp.h"

#include <bit>
#include <cstdint>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "trivalent/remesh/whole_file.h"

namespace trivalent::dual {
namespace {

/// Little endian bytes, whatever the machine.
template <typename Value>
void append_bytes(std::string& bytes, Value value) {
  using Bits = std::conditional_t<sizeof(Value) == 8, std::uint64_t, std::uint32_t>;
  Bits bits = std::bit_cast<Bits>(value);
  for (std::size_t i = 0; i < sizeof(Value); ++i, bits >>= 8) {
    bytes += static_cast<char>(bits & 0xff);
  }
}

/// The XML part, and the arrays that follow it as plain bytes.
struct Document {
  std::string xml;
  std::string arrays;

  template <typename Value>
  void add_array(const std::string& name, const std::vector<Value>& values, int components = 1) {
    static_assert(std::is_same_v<Value, double> || std::is_same_v<Value, std::int32_t>);
    const char* type = std::is_same_v<Value, double> ? "Float64" : "Int32";
    xml +=
        concat("        <DataArray type=\"", type, "\" Name=\"", name, "\" NumberOfComponents=\"",
               components, "\" format=\"appended\" offset=\"", arrays.size(), "\"/>\n");
    append_bytes(arrays, static_cast<std::uint64_t>(values.size() * sizeof(Value)));
    for (const Value& value : values) append_bytes(arrays, value);
  }
};

std::int32_t atomic_number(potentials::Species species) {
  return species == potentials::Species::carbon ? 6 : 1;
}

void add_points(Document& document, const ShellState& state) {
  std::vector<double> coordinates;
  for (const Eigen::Vector3d& position : state.structure.atoms.positions) {
    coordinates.insert(coordinates.end(), position.begin(), position.end());
  }
  document.xml += "      <Points>\n";
  document.add_array("Points", coordinates, 3);
  document.xml += "      </Points>\n";
}

void add_point_data(Document& document, const ShellState& state) {
  std::vector<std::int32_t> ids;
  std::vector<std::int32_t> numbers;
  for (const potentials::Species species : state.structure.atoms.species) {
    ids.push_back(static_cast<std::int32_t>(ids.size()) + 1);
    numbers.push_back(atomic_number(species));
  }
  document.xml += state.find("energy") != nullptr ? "      <PointData Scalars=\"energy\">\n"
                                                  : "      <PointData>\n";
  document.add_array("id", ids);
  document.add_array("atomic_number", numbers);
  for (const AtomMap& map : state.maps) {
    if (map.categories.empty()) {
      document.add_array(map.name, map.values);
    } else {
      document.add_array(map.name, std::vector<std::int32_t>(map.values.begin(), map.values.end()));
    }
  }
  document.xml += "      </PointData>\n";
}

/// Cells of one kind: the points of each, one after the other.
template <typename Cells>
void add_cells(Document& document, const char* kind, const Cells& cells) {
  std::vector<std::int32_t> connectivity;
  std::vector<std::int32_t> offsets;
  for (const auto& cell : cells) {
    connectivity.insert(connectivity.end(), cell.begin(), cell.end());
    offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
  }
  document.xml += concat("      <", kind, ">\n");
  document.add_array("connectivity", connectivity);
  document.add_array("offsets", offsets);
  document.xml += concat("      </", kind, ">\n");
}

std::vector<std::array<std::int32_t, 1>> vertices(std::size_t n_atoms) {
  std::vector<std::array<std::int32_t, 1>> cells;
  for (std::size_t i = 0; i < n_atoms; ++i) cells.push_back({static_cast<std::int32_t>(i)});
  return cells;
}

/// Cells are numbered vertices first, then lines, then polygons.
void add_cell_data(Document& document, const ShellState& state, const Drawing& drawing) {
  std::vector<double> lengths(state.structure.atoms.size(),
                              std::numeric_limits<double>::quiet_NaN());
  std::vector<std::int32_t> sizes(state.structure.atoms.size() + drawing.bonds.size(), 0);
  const std::vector<Eigen::Vector3d>& positions = state.structure.atoms.positions;
  for (const auto& [first, second] : drawing.bonds) {
    lengths.push_back((positions[first] - positions[second]).norm());
  }
  for (const auto& ring : drawing.rings) sizes.push_back(static_cast<std::int32_t>(ring.size()));
  lengths.resize(sizes.size(), std::numeric_limits<double>::quiet_NaN());
  document.xml += "      <CellData>\n";
  document.add_array("bond_length", lengths);
  document.add_array("ring_size", sizes);
  document.xml += "      </CellData>\n";
}

}  // namespace

void write_vtp(std::ostream& out, const ShellState& state) {
  check_state("write_vtp", state);
  // What crosses a periodic boundary would need points that are no atoms, without values.
  Drawing drawing;
  drawing.bonds = drawable_bonds(state.structure);
  drawing.rings = drawable_rings(state.structure);
  Document document;
  add_point_data(document, state);
  add_cell_data(document, state, drawing);
  add_points(document, state);
  add_cells(document, "Verts", vertices(state.structure.atoms.size()));
  add_cells(document, "Lines", drawing.bonds);
  add_cells(document, "Polys", drawing.rings);
  out << "<?xml version=\"1.0\"?>\n"
      << "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
         "header_type=\"UInt64\">\n"
      << "  <PolyData>\n    <Piece NumberOfPoints=\"" << state.structure.atoms.size()
      << "\" NumberOfVerts=\"" << state.structure.atoms.size() << "\" NumberOfLines=\""
      << drawing.bonds.size() << "\" NumberOfStrips=\"0\" NumberOfPolys=\"" << drawing.rings.size()
      << "\">\n"
      << document.xml << "    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n_";
  out.write(document.arrays.data(), static_cast<std::streamsize>(document.arrays.size()));
  out << "\n  </AppendedData>\n</VTKFile>\n";
}

void write_vtp(const std::filesystem::path& path, const ShellState& state) {
  remesh::write_whole_file(path, [&](std::ostream& out) { write_vtp(out, state); });
}

}  // namespace trivalent::dual
