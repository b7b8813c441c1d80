#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trivalent/dual/structure.h"
#include "trivalent/formats/text_file.h"

namespace trivalent::dual {

/// What a property of an extended XYZ file becomes.
enum class XyzRole { element, position, bonded_atoms, bonded_images, column, left_out };

/// A property: some fields of every atom's row.
struct XyzProperty {
  std::string name;
  XyzRole role = XyzRole::left_out;
  std::size_t first_field = 0;
  std::size_t n_fields = 0;
};

/// The fields of an atom's row.
struct XyzLayout {
  std::vector<XyzProperty> properties = {};  ///< in their order in the file
  std::vector<Column> columns = {};          ///< those with role column, empty, in the same order
  std::size_t n_fields = 0;                  ///< of an atom
  bool may_have_more = false;                ///< plain XYZ: anything may follow the position
  std::vector<std::string> notes = {};       ///< what is not read
};

/// Parses the value of the key Properties: name:type:components, repeated.
///
/// @throws FileError  if it is malformed, or lacks an element or a position.
[[nodiscard]] XyzLayout parse_xyz_layout(std::string_view text, const LineReader& lines);

/// The layout of a file without that key: element, position, and anything behind.
[[nodiscard]] XyzLayout plain_xyz_layout();

}  // namespace trivalent::dual
