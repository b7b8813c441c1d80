#include <ostream>
#include <set>
#include <string_view>

#include "bond_columns.h"
#include "trivalent/dual/check_atoms.h"
#include "trivalent/dual/padded_box.h"
#include "trivalent/formats/elements.h"
#include "trivalent/formats/text_file.h"
#include "trivalent/formats/xyz.h"
#include "trivalent/remesh/whole_file.h"
#include "xyz_names.h"

namespace trivalent::dual {
namespace {

/// Letter and number of components of a column's values in the key Properties.
struct Shape {
  char type;
  int components;
};

Shape shape_of(const Column& column) {
  constexpr Shape shapes[] = {{'R', 1}, {'I', 1}, {'R', 3}, {'I', 3}};
  return shapes[column.values.index()];
}

void check_names(const Structure& structure) {
  std::set<std::string> taken = {"species", "pos", std::string(BondColumns::atoms_name),
                                 std::string(BondColumns::images_name)};
  for (const Column& column : structure.columns) {
    if (!is_xyz_name(column.name) || !taken.insert(column.name).second) {
      throw InvalidOption(
          concat("write_xyz: ", in_quotes(column.name), " is no free name for a column"));
    }
  }
  taken = {"Lattice", "Origin", "Properties", "pbc"};
  for (const HeaderEntry& entry : structure.header) {
    if (!is_xyz_name(entry.key) || !taken.insert(entry.key).second) {
      throw InvalidOption(
          concat("write_xyz: ", in_quotes(entry.key), " is no free name for a key"));
    }
  }
}

void check_structure(const Structure& structure) {
  check_atoms("write_xyz", structure.atoms);
  check_names(structure);
  for (const Column& column : structure.columns) {
    const std::size_t size =
        std::visit([](const auto& values) { return values.size(); }, column.values);
    if (size == structure.atoms.size()) continue;
    throw InvalidNetwork(concat("write_xyz: column ", column.name, " has ", size, " values for ",
                                structure.atoms.size(), " atoms"));
  }
}

void append_row(std::string& line, const Eigen::Vector3d& vector, Digits digits) {
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0) line += ' ';
    append_real(line, vector[axis], digits);
  }
}

/// Whether a text is an array as it stands: [1, 2] or [[1, 2], [3, 4]].
bool is_array(std::string_view text) {
  if (!text.starts_with('[') || text.find_first_of("\"\\\n\r={}") != std::string_view::npos) {
    return false;
  }
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '[') ++depth;
    if (text[i] == ']' && --depth == 0) return i + 1 == text.size();
  }
  return false;
}

void append_text(std::string& line, std::string_view text) {
  if (is_array(text)) {
    line += text;
    return;
  }
  line += '"';
  for (const char character : text) {
    if (character == '"' || character == '\\') line += '\\';
    // The header is one line.
    line += character == '\n' || character == '\r' ? ' ' : character;
  }
  line += '"';
}

void append_box(std::string& line, const potentials::Box& box) {
  line += "Lattice=\"";
  for (int i = 0; i < 3; ++i) {
    if (i > 0) line += ' ';
    append_row(line, box.cell.col(i), Digits::seventeen_significant);
  }
  line += "\" Origin=\"";
  append_row(line, box.origin, Digits::seventeen_significant);
  line += '"';
}

void append_properties(std::string& line, const std::vector<Column>& columns,
                       const BondColumns& bonds) {
  line += " Properties=species:S:1:pos:R:3";
  for (const Column& column : columns) {
    const auto [type, components] = shape_of(column);
    line += concat(':', column.name, ':', type, ':', components);
  }
  if (bonds.width > 0) line += concat(':', BondColumns::atoms_name, ":I:", bonds.width);
  if (!bonds.images.empty()) line += concat(':', BondColumns::images_name, ":I:", 3 * bonds.width);
}

void write_header(std::ostream& out, const Structure& structure, const BondColumns& bonds) {
  const potentials::Box box = box_to_write(structure.atoms);
  std::string line;
  append_box(line, box);
  append_properties(line, structure.columns, bonds);
  line += " pbc=\"";
  for (int i = 0; i < 3; ++i) line += concat(i > 0 ? " " : "", box.periodic[i] ? 'T' : 'F');
  line += '"';
  for (const HeaderEntry& entry : structure.header) {
    line += concat(' ', entry.key, '=');
    if (const double* number = std::get_if<double>(&entry.value)) {
      append_real(line, *number, Digits::seventeen_significant);
    } else {
      append_text(line, std::get<std::string>(entry.value));
    }
  }
  out << structure.atoms.size() << '\n' << line << '\n';
}

void append_value(std::string& line, double value, Digits digits) {
  append_real(line, value, digits);
}
void append_value(std::string& line, int value, Digits) { append_integer(line, value); }
void append_value(std::string& line, const Eigen::Vector3d& value, Digits digits) {
  append_row(line, value, digits);
}
void append_value(std::string& line, const std::array<int, 3>& value, Digits) {
  for (int i = 0; i < 3; ++i) {
    if (i > 0) line += ' ';
    append_integer(line, value[i]);
  }
}

void append_integers(std::string& line, const std::vector<int>& values, std::size_t begin,
                     std::size_t n) {
  for (std::size_t i = begin; i < begin + n && !values.empty(); ++i) {
    line += ' ';
    append_integer(line, values[i]);
  }
}

void write_rows(std::ostream& out, const Structure& structure, const BondColumns& bonds,
                Digits digits) {
  std::string line;
  for (std::size_t i = 0; i < structure.atoms.size(); ++i) {
    line.clear();
    line += symbol_of(structure.atoms.species[i]);
    line += ' ';
    append_row(line, structure.atoms.positions[i], digits);
    for (const Column& column : structure.columns) {
      line += ' ';
      std::visit([&](const auto& values) { append_value(line, values[i], digits); }, column.values);
    }
    append_integers(line, bonds.atoms, i * bonds.width, bonds.width);
    append_integers(line, bonds.images, 3 * i * bonds.width, 3 * bonds.width);
    line += '\n';
    out.write(line.data(), static_cast<std::streamsize>(line.size()));
  }
}

}  // namespace

void write_xyz(std::ostream& out, const Structure& structure, Digits digits) {
  check_structure(structure);
  const BondColumns bonds = structure.bonds.empty() ? BondColumns() : bond_columns(structure);
  write_header(out, structure, bonds);
  write_rows(out, structure, bonds, digits);
}

void write_xyz(const std::filesystem::path& path, const Structure& structure, Digits digits) {
  remesh::write_whole_file(path, [&](std::ostream& out) { write_xyz(out, structure, digits); });
}

}  // namespace trivalent::dual
