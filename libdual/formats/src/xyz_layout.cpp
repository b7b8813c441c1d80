#include "xyz_layout.h"

#include <algorithm>
#include <array>

#include "bond_columns.h"
#include "trivalent/formats/elements.h"
#include "xyz_names.h"

namespace trivalent::dual {
namespace {

using Role = XyzRole;

/// The names under which programs write what every atom needs.
struct RoleName {
  std::string_view name;  ///< in lower case
  char type;
  std::size_t n_fields;
  Role role;
};
constexpr std::array role_names = {
    RoleName{"species", 'S', 1, Role::element}, RoleName{"element", 'S', 1, Role::element},
    RoleName{"symbols", 'S', 1, Role::element}, RoleName{"z", 'I', 1, Role::element},
    RoleName{"numbers", 'I', 1, Role::element}, RoleName{"atomic_numbers", 'I', 1, Role::element},
    RoleName{"pos", 'R', 3, Role::position},    RoleName{"positions", 'R', 3, Role::position},
};

Role role_of(std::string_view name, char type, std::size_t n_fields) {
  if (type == 'I' && name == BondColumns::atoms_name) return Role::bonded_atoms;
  if (type == 'I' && name == BondColumns::images_name) return Role::bonded_images;
  const std::string lower = lower_case(name);
  const auto found = std::ranges::find_if(role_names, [&](const RoleName& role) {
    return role.name == lower && role.type == type && role.n_fields == n_fields;
  });
  return found == role_names.end() ? Role::column : found->role;
}

bool has_column(const XyzLayout& layout, const std::string& name) {
  return std::ranges::find(layout.columns, name, &Column::name) != layout.columns.end();
}

void add_column(XyzLayout& layout, XyzProperty& property, char type) {
  const bool is_real = type == 'R';
  const bool has_shape = property.n_fields == 1 || property.n_fields == 3;
  if (!has_shape || !(is_real || type == 'I') || !is_xyz_name(property.name) ||
      has_column(layout, property.name)) {
    property.role = Role::left_out;
    layout.notes.push_back(concat("column ", in_quotes(property.name), " is not read (type ", type,
                                  ", ", property.n_fields, " components)"));
    return;
  }
  Column column = {.name = property.name, .values = {}};
  if (is_real && property.n_fields == 3) column.values = std::vector<Eigen::Vector3d>();
  if (!is_real && property.n_fields == 1) column.values = std::vector<int>();
  if (!is_real && property.n_fields == 3) column.values = std::vector<std::array<int, 3>>();
  layout.columns.push_back(std::move(column));
}

std::vector<std::string_view> split_at_colons(std::string_view text) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = std::min(text.find(':'), text.size());
    parts.push_back(text.substr(0, end));
    if (end == text.size()) return parts;
    text.remove_prefix(end + 1);
  }
}

std::ptrdiff_t count(const XyzLayout& layout, Role role) {
  return std::ranges::count(layout.properties, role, &XyzProperty::role);
}

/// Where both symbols and atomic numbers stand, the first of them says the element.
void check_roles(XyzLayout& layout, const LineReader& lines) {
  bool has_element = false;
  for (XyzProperty& property : layout.properties) {
    if (property.role != Role::element) continue;
    if (has_element) property.role = Role::left_out;
    has_element = true;
  }
  if (!has_element) lines.fail("Properties has no element: species:S:1 or Z:I:1");
  if (count(layout, Role::position) != 1) lines.fail("Properties needs one pos:R:3");
  if (count(layout, Role::bonded_atoms) > 1 || count(layout, Role::bonded_images) > 1) {
    lines.fail("Properties names the bonds twice");
  }
}

char parse_type(std::string_view name, std::string_view type, const LineReader& lines) {
  constexpr std::string_view known = "RISL";
  if (type.size() == 1 && known.find(type.front()) != std::string_view::npos) return type.front();
  lines.fail("Properties: the type of ", in_quotes(name), " is ", in_quotes(type),
             "; types are R, I, S and L");
}

}  // namespace

XyzLayout parse_xyz_layout(std::string_view text, const LineReader& lines) {
  const auto parts = split_at_colons(text);
  if (parts.size() % 3 != 0) {
    lines.fail("Properties must be name:type:components, repeated; found ", in_quotes(text));
  }
  XyzLayout layout;
  for (std::size_t i = 0; i < parts.size(); i += 3) {
    const char type = parse_type(parts[i], parts[i + 1], lines);
    const auto n_fields = static_cast<std::size_t>(lines.integer(parts[i + 2], 1, 1000));
    XyzProperty property = {.name = std::string(parts[i]),
                            .role = role_of(parts[i], type, n_fields),
                            .first_field = layout.n_fields,
                            .n_fields = n_fields};
    if (property.role == Role::column) add_column(layout, property, type);
    layout.n_fields += n_fields;
    layout.properties.push_back(std::move(property));
  }
  check_roles(layout, lines);
  return layout;
}

XyzLayout plain_xyz_layout() {
  return {.properties = {{.name = "species", .role = Role::element, .n_fields = 1},
                         {.name = "pos", .role = Role::position, .first_field = 1, .n_fields = 3}},
          .n_fields = 4,
          .may_have_more = true};
}

}  // namespace trivalent::dual
