#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "io/binary_numbers.h"
#include "io/mesh_readers.h"
#include "io/vtk_cells.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

/// "The VTK File Formats"; vtkIdType is written as int, long is what Linux makes of it.
constexpr std::array vtk_formats = {
    NamedFormat{"char", int8},
    NamedFormat{"signed_char", int8},
    NamedFormat{"unsigned_char", uint8},
    NamedFormat{"short", int16},
    NamedFormat{"unsigned_short", uint16},
    NamedFormat{"int", int32},
    NamedFormat{"unsigned_int", uint32},
    NamedFormat{"vtkidtype", int32},
    NamedFormat{"long", int64},
    NamedFormat{"unsigned_long", uint64},
    NamedFormat{"vtktypeint64", int64},
    NamedFormat{"vtktypeuint64", uint64},
    NamedFormat{"float", float32},
    NamedFormat{"double", float64},
};

/// Cells with the number of corners before those of each, as files before version 5 have them.
struct CountedCells {
  std::vector<double> connectivity;
  std::vector<double> ends;
};

/// Reads VTK's legacy files of POLYDATA and UNSTRUCTURED_GRID, text or binary.
class LegacyVtkReader {
 public:
  explicit LegacyVtkReader(const Source& source)
      : source_(source), scanner_(source, Continuation::none), cells_(source) {}

  PolygonSoup run() {
    read_head();
    // The coordinates and colors of points and cells come last, and are not needed.
    for (std::string key = next_keyword();
         !key.empty() && key != "point_data" && key != "cell_data"; key = next_keyword()) {
      read_section(key);
    }
    if (!grid_.ends.empty() && !has_types_) scanner_.fail("CELLS have no CELL_TYPES");
    return cells_.take();
  }

 private:
  std::string next_keyword() {
    return lower_case(std::string(scanner_.word_across_lines().substr(0, 32)));
  }

  void read_head() {
    const std::string_view first = scanner_.raw_line();
    const std::string_view version = first.substr(first.find_last_of(' ') + 1);
    is_counted_ = parse_number(version).value_or(1.0) < 5.0;
    (void)scanner_.raw_line();  // the title
    const std::string encoding = next_keyword();
    if (encoding != "ascii" && encoding != "binary") {
      scanner_.fail(concat(in_quotes(encoding), " stands where ASCII or BINARY should"));
    }
    is_binary_ = encoding == "binary";
  }

  void read_section(const std::string& key) {
    if (key == "dataset") return read_dataset();
    if (key == "points") return read_points();
    if (key == "polygons") return read_cells(VtkCell::polygon);
    if (key == "triangle_strips") return read_cells(VtkCell::strip);
    if (key == "lines") return cells_.leave_out_lines(read_cell_arrays().ends.size());
    if (key == "vertices") return static_cast<void>(read_cell_arrays());
    if (key == "cells") return read_grid_cells();
    if (key == "cell_types") return read_types();
    if (key == "field") return skip_field();
    if (key == "metadata") return scanner_.skip_to_blank_line();
    scanner_.fail(concat(in_quotes(key), " is no part of a VTK file of polygons"));
  }

  void read_dataset() {
    const std::string_view kind = scanner_.word();
    const std::string name = lower_case(std::string(kind.substr(0, 32)));
    if (name == "polydata" || name == "unstructured_grid") return;
    scanner_.fail(concat("it holds ", in_quotes(kind),
                         ", not POLYDATA or an UNSTRUCTURED_GRID; extract its surface in ParaView, "
                         "and save that"));
  }

  std::uint64_t count(std::string_view what) {
    const std::int64_t value = scanner_.integer(what);
    if (value < 0) scanner_.fail("a count is negative");
    return static_cast<std::uint64_t>(value);
  }

  /// Numbers that begin on the line after this one.
  std::vector<double> values(std::string_view type_name, std::uint64_t n) {
    const std::string name = lower_case(std::string(type_name.substr(0, 32)));
    const auto known = find_format(vtk_formats, name);
    if (!known) {
      scanner_.fail(concat(in_quotes(type_name), " is no type of VTK numbers"));
    }
    const NumberFormat format = *known;
    const std::size_t bytes_each = is_binary_ ? format.size : 2;
    check_declared(source_, {"numbers", n, bytes_each}, scanner_.bytes_left() + 1);
    std::vector<double> result;
    result.reserve(n);
    if (!is_binary_) {
      for (std::uint64_t i = 0; i < n; ++i) result.push_back(scanner_.number("a number"));
      return result;
    }
    const std::string_view bytes = scanner_.bytes_after_line(n * format.size);
    for (std::size_t at = 0; at < bytes.size(); at += format.size) {
      result.push_back(number_of(bytes.substr(at, format.size), format, ByteOrder::big_endian));
    }
    return result;
  }

  void read_points() {
    const std::uint64_t n = count("the number of points");
    const std::string type(scanner_.word());
    check_declared(source_, {"points", n, 3}, scanner_.bytes_left());
    cells_.add_points(values(type, 3 * n));
  }

  std::vector<double> named_values(std::string_view name, std::uint64_t n) {
    const std::string found = next_keyword();
    if (found != name) {
      scanner_.fail(concat(in_quotes(found), " stands where '", name, "' should"));
    }
    const std::string type(scanner_.word());
    return values(type, n);
  }

  /// Cells of the sizes that the rest of the line declares.
  CountedCells read_cell_arrays() {
    const std::uint64_t n = count("the number of cells");
    const std::uint64_t size = count("the size of the list of cells");
    CountedCells cells;
    if (!is_counted_) {
      cells.ends = n > 0 ? named_values("offsets", n) : std::vector<double>();
      cells.connectivity = n > 0 ? named_values("connectivity", size) : std::vector<double>();
      if (!cells.ends.empty()) cells.ends.erase(cells.ends.begin());  // the first is 0
      return cells;
    }
    const std::vector<double> list = values("int", size);
    std::size_t at = 0;
    for (std::uint64_t i = 0; i < n; ++i) {
      const double corners = at < list.size() ? list[at] : -1.0;
      if (!(corners >= 0.0 && corners <= static_cast<double>(list.size() - at - 1))) {
        scanner_.fail(concat("cell ", i, " (counted from 0) does not fit into the ", size,
                             " numbers of its list"));
      }
      const auto first = list.begin() + static_cast<std::ptrdiff_t>(at) + 1;
      cells.connectivity.insert(cells.connectivity.end(), first,
                                first + static_cast<std::ptrdiff_t>(corners));
      cells.ends.push_back(static_cast<double>(cells.connectivity.size()));
      at += 1 + static_cast<std::size_t>(corners);
    }
    return cells;
  }

  void add(const CountedCells& cells, const std::vector<double>& types, VtkCell type) {
    cells_.add_cells({cells.connectivity, cells.ends, types, type, 0,
                      [&](std::string_view problem) { scanner_.fail(problem); }});
  }

  void read_cells(VtkCell type) { add(read_cell_arrays(), {}, type); }

  void read_grid_cells() { grid_ = read_cell_arrays(); }

  void read_types() {
    const std::uint64_t n = count("the number of types");
    if (n != grid_.ends.size()) {
      scanner_.fail(concat("there are ", grid_.ends.size(), " cells, but ", n, " types"));
    }
    add(grid_, values("int", n), VtkCell::polygon);
    has_types_ = true;
  }

  void skip_field() {
    (void)scanner_.word();  // its name
    const std::uint64_t arrays = count("the number of arrays");
    for (std::uint64_t i = 0; i < arrays; ++i) {
      std::string name = next_keyword();
      if (name == "metadata") {
        scanner_.skip_to_blank_line();
        name = next_keyword();
      }
      const std::uint64_t components = count("the number of components");
      const std::uint64_t tuples = count("the number of tuples");
      const std::string type(scanner_.word());
      check_declared(source_, {"components", components, 1}, scanner_.bytes_left() + 1);
      check_declared(source_, {"tuples", tuples, 1}, scanner_.bytes_left() + 1);
      if (lower_case(type) == "string") scanner_.fail("strings in FIELD are not read");
      (void)values(type, components * tuples);
    }
  }

  const Source& source_;
  TextScanner scanner_;
  VtkCells cells_;
  CountedCells grid_;
  bool is_counted_ = true;
  bool is_binary_ = false;
  bool has_types_ = false;
};

}  // namespace

PolygonSoup read_vtk(const Source& source) { return LegacyVtkReader(source).run(); }

}  // namespace trivalent::remesh
