#include <optional>
#include <string>
#include <vector>

#include "io/mesh_readers.h"
#include "io/vtk_cells.h"
#include "io/vtk_xml.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

/// Reads VTK's XML files of PolyData (.vtp) and of UnstructuredGrid (.vtu).
class VtkXmlReader {
 public:
  explicit VtkXmlReader(const Source& source) : source_(source), file_(source), cells_(source) {}

  PolygonSoup run() {
    const std::string type = file_.root().attribute("type").value();
    const bool is_grid = type == "UnstructuredGrid";
    if (type != "PolyData" && !is_grid) {
      fail(source_, concat("it holds ", in_quotes(type),
                           ", not PolyData or an UnstructuredGrid; extract its surface in "
                           "ParaView, and save that"));
    }
    for (const pugi::xml_node piece : file_.root().child(type.c_str()).children("Piece")) {
      first_point_ = cells_.points();
      read_points(piece);
      if (is_grid) {
        read_grid(piece);
      } else {
        read_cells(piece, {"NumberOfPolys", "Polys", VtkCell::polygon});
        read_cells(piece, {"NumberOfStrips", "Strips", VtkCell::strip});
        cells_.leave_out_lines(declared(piece, "NumberOfLines"));
      }
      ++pieces_;
    }
    return cells_.take();
  }

 private:
  /// Names of a kind of cells in PolyData.
  struct CellsOfPiece {
    const char* count;
    const char* element;
    VtkCell type;
  };

  [[nodiscard]] std::uint64_t declared(const pugi::xml_node& piece, const char* name) const {
    const std::string_view word = piece.attribute(name).as_string("0");
    const auto count = parse_integer(word);
    if (!count || *count < 0) {
      fail(source_,
           concat("piece ", pieces_, " (counted from 0): ", name, " is ", in_quotes(word)));
    }
    return static_cast<std::uint64_t>(*count);
  }

  void read_points(const pugi::xml_node& piece) {
    const std::uint64_t count = declared(piece, "NumberOfPoints");
    const pugi::xml_node array = piece.child("Points").child("DataArray");
    const std::vector<double> values = array ? file_.values_of(array) : std::vector<double>();
    if (values.size() % 3 != 0 || values.size() / 3 != count) {
      fail(source_, concat("piece ", pieces_, " (counted from 0) declares ", count,
                           " points, but holds ", values.size(), " coordinates"));
    }
    cells_.add_points(values);
  }

  void check_count(std::uint64_t wanted, std::string_view things, std::size_t found) const {
    if (found == wanted) return;
    fail(source_, concat("piece ", pieces_, " (counted from 0) declares ", wanted, ' ', things,
                         ", but holds ", found));
  }

  [[nodiscard]] std::vector<double> values_named(const pugi::xml_node& cells,
                                                 const char* name) const {
    const pugi::xml_node array = cells.find_child_by_attribute("Name", name);
    if (!array) {
      fail(source_, concat("piece ", pieces_, " (counted from 0) has no array '", name, "' in ",
                           cells ? cells.name() : "its cells"));
    }
    return file_.values_of(array);
  }

  void add(const pugi::xml_node& cells, const std::vector<double>& ends,
           const std::vector<double>& types, VtkCell type) {
    const pugi::xml_node array = cells.find_child_by_attribute("Name", "connectivity");
    const std::vector<double> connectivity = values_named(cells, "connectivity");
    cells_.add_cells({connectivity, ends, types, type, first_point_,
                      [&](std::string_view problem) { file_.fail_in(array, problem); }});
  }

  void read_cells(const pugi::xml_node& piece, const CellsOfPiece& names) {
    const std::uint64_t count = declared(piece, names.count);
    if (count == 0) return;
    const pugi::xml_node cells = piece.child(names.element);
    const std::vector<double> ends = values_named(cells, "offsets");
    check_count(count, names.element, ends.size());
    add(cells, ends, {}, names.type);
  }

  void read_grid(const pugi::xml_node& piece) {
    const std::uint64_t count = declared(piece, "NumberOfCells");
    if (count == 0) return;
    const pugi::xml_node cells = piece.child("Cells");
    const std::vector<double> ends = values_named(cells, "offsets");
    const std::vector<double> types = values_named(cells, "types");
    check_count(count, "cells", ends.size());
    check_count(count, "types of cells", types.size());
    add(cells, ends, types, VtkCell::polygon);
  }

  const Source& source_;
  VtkXmlFile file_;
  VtkCells cells_;
  std::size_t first_point_ = 0;
  std::size_t pieces_ = 0;
};

}  // namespace

PolygonSoup read_vtk_xml(const Source& source) { return VtkXmlReader(source).run(); }

}  // namespace trivalent::remesh
