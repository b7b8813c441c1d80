#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "io/text_scanner.h"
#include "trivalent/remesh/polygon_soup.h"

namespace trivalent::remesh {

/// VTK's numbers for the kinds of cells that data sets of polygons hold.
enum class VtkCell : int { line = 3, strip = 6, polygon = 7 };

/// Cells of one piece of a file, as VTK stores them. Cell i has the corners connectivity[ends[i-1]]
/// to connectivity[ends[i] - 1].
struct VtkCellArrays {
  std::span<const double> connectivity;
  std::span<const double> ends;
  std::span<const double> types;               ///< one per cell; empty: all are `type`
  VtkCell type = VtkCell::polygon;             ///< if there are no types
  std::size_t first_point = 0;                 ///< of the piece, among all points
  std::function<void(std::string_view)> fail;  ///< throws FileError with the place of the arrays
};

/// Collects points and cells of VTK's data sets as a polygon soup.
class VtkCells {
 public:
  explicit VtkCells(const Source& source) : source_(source) {}

  [[nodiscard]] std::size_t points() const { return soup_.points.size(); }

  /// Adds points, three coordinates each.
  /// @throws FileError if one is not finite, or there are more than can be counted.
  void add_points(std::span<const double> coordinates);

  /// @throws FileError if a cell has a corner out of range, or is of no known kind.
  void add_cells(const VtkCellArrays& arrays);

  void leave_out_lines(std::uint64_t count) { lines_ += count; }

  /// What was collected, and notes about the rest.
  /// @throws FileError if there are cells of volumes.
  PolygonSoup take();

 private:
  void add_cell(double type, std::span<const int> corners, const VtkCellArrays& arrays);
  void add_polygon(std::span<const int> corners);

  const Source& source_;
  PolygonSoup soup_;
  std::uint64_t lines_ = 0;
  std::uint64_t volumes_ = 0;
  std::uint64_t curved_ = 0;
};

}  // namespace trivalent::remesh
