#include "trivalent/view/shell_page.h"
#include "trivalent/remesh/polygon_soup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <ostream>

#include "packed_integers.h"
#include "trivalent/dual/energy_summary.h"
#include "trivalent/remesh/whole_file.h"

namespace trivalent::dual {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view place_of_data = "<!--shell-data-->";
constexpr double position_step = 0.001;  // [Å]

/// Writes JSON that may stand inside a <script>: nothing in it can end the element, whatever a file
/// is called. Bytes that are not UTF-8 are replaced.
void write_in_script(std::ostream& out, const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  // Such characters occur in JSON's strings only.
  constexpr std::string_view markup = "<>&'";
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = std::min(text.find_first_of(markup, begin), text.size());
    out << std::string_view(text).substr(begin, end - begin);
    if (end == text.size()) return;
    constexpr std::array escapes = {"\\u003c", "\\u003e", "\\u0026", "\\u0027"};
    out << escapes[markup.find(text[end])];
    begin = end + 1;
  }
}

Json json_color(const Color& color) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t channel : color) {
    text += digits[channel >> 4];
    text += digits[channel & 15];
  }
  return text;
}

Json json_rows(const std::vector<TableRow>& rows) {
  Json json = Json::array();
  for (const TableRow& row : rows) json.push_back(Json::array({row.name, row.value}));
  return json;
}

/// The nearest multiple of a step, as far as 32 bits reach.
std::int32_t rounded(double value, double step) {
  constexpr double limit = 1e9;
  return static_cast<std::int32_t>(std::lround(std::clamp(value / step, -limit, limit)));
}

Json packed_points(std::span<const Eigen::Vector3d> points) {
  std::vector<std::int32_t> coordinates;
  coordinates.reserve(3 * points.size());
  for (const Eigen::Vector3d& point : points) {
    for (const double coordinate : point) coordinates.push_back(rounded(coordinate, position_step));
  }
  return packed_integers(coordinates, 3);
}

/// The atoms a page shows: all of them, or a sample.
struct Shown {
  std::vector<int> atoms;
  bool is_sample = false;
};

/// Every so many atoms, and the worst ones, whom nobody should miss.
Shown shown_atoms(const ShellState& state) {
  Shown shown;
  const std::size_t n_atoms = state.structure.atoms.size();
  if (n_atoms <= max_page_atoms) {
    shown.atoms.resize(n_atoms);
    std::iota(shown.atoms.begin(), shown.atoms.end(), 0);
    return shown;
  }
  shown.is_sample = true;
  const double step = static_cast<double>(n_atoms) / static_cast<double>(max_page_atoms);
  for (std::size_t i = 0; i < max_page_atoms; ++i) {
    shown.atoms.push_back(static_cast<int>(std::floor(step * static_cast<double>(i))));
  }
  if (const AtomMap* energy = state.find("energy")) {
    constexpr int n_worst = 100;
    const auto worst = summarize_energies(energy->values, n_worst).worst;
    shown.atoms.insert(shown.atoms.end(), worst.begin(), worst.end());
    std::sort(shown.atoms.begin(), shown.atoms.end());
    const auto end = std::unique(shown.atoms.begin(), shown.atoms.end());
    shown.atoms.erase(end, shown.atoms.end());
  }
  return shown;
}

/// Values as multiples of a step; 0 stands for an atom without one.
Json packed_values(const AtomMap& map, const std::vector<int>& atoms, double step) {
  std::vector<std::int32_t> values;
  values.reserve(atoms.size());
  for (const int atom : atoms) {
    const double value = map.values[atom];
    const std::int32_t multiple = std::isnan(value) ? 0 : rounded(value, step);
    values.push_back(std::isnan(value) ? 0 : multiple + (multiple >= 0 ? 1 : 0));
  }
  return packed_integers(values, 0);
}

Json json_map(const AtomMap& map, const ColorScale& scale, const std::vector<int>& atoms) {
  const bool counts = !map.categories.empty();
  const double step =
      counts ? 1.0 : std::pow(10.0, std::floor(std::log10((scale.high - scale.low) / 10000.0)));
  Json json = {{"name", map.name}, {"title", map.title}, {"unit", map.unit}, {"step", step}};
  if (counts) {
    json["categories"] = Json::array();
    for (const Category& category : map.categories) {
      json["categories"].push_back({{"value", category.value},
                                    {"label", category.label},
                                    {"color", json_color(category.color)}});
    }
  } else {
    json["scale"] = {{"low", scale.low}, {"high", scale.high}, {"colors", Json::array()}};
    for (const Color& color : scale.colors) json["scale"]["colors"].push_back(json_color(color));
  }
  json["values"] = packed_values(map, atoms, step);
  return json;
}

Json packed_bonds(const std::vector<std::array<int, 2>>& bonds) {
  std::vector<std::int32_t> ends;
  ends.reserve(2 * bonds.size());
  // The second end as a step from the first; the page adds it up again.
  std::int32_t before = 0;
  for (const auto& [first, second] : bonds) {
    ends.push_back(first - before);
    ends.push_back(second - first);
    before = first;
  }
  return packed_integers(ends, 0);
}

Json packed_rings(const std::vector<std::vector<int>>& rings) {
  std::vector<std::int32_t> sizes;
  std::vector<std::int32_t> atoms;
  for (const auto& ring : rings) {
    sizes.push_back(static_cast<std::int32_t>(ring.size()));
    atoms.insert(atoms.end(), ring.begin(), ring.end());
  }
  return {{"sizes", packed_integers(sizes, 0)}, {"atoms", packed_integers(atoms, 1)}};
}

Json packed_species(const potentials::Atoms& atoms, const std::vector<int>& shown) {
  std::vector<std::int32_t> numbers;
  numbers.reserve(shown.size());
  for (const int atom : shown) {
    numbers.push_back(atoms.species[atom] == potentials::Species::carbon ? 6 : 1);
  }
  return packed_integers(numbers, 1);
}

/// Maps of one name share the scale of the last state, so that colors can be compared.
const ColorScale& shared_scale(const ShellPage& page, const AtomMap& map) {
  for (auto state = page.states.rbegin(); state != page.states.rend(); ++state) {
    const AtomMap* same = state->find(map.name);
    if (same != nullptr) return same->scale;
  }
  return map.scale;
}

Json json_state(const ShellState& state, const ShellPage& page) {
  const Shown shown = shown_atoms(state);
  // A sample of the atoms would leave torn bonds and rings.
  const Drawing drawing = shown.is_sample ? Drawing{} : drawing_of(state.structure);
  std::vector<Eigen::Vector3d> positions = drawing.positions;
  if (shown.is_sample) {
    for (const int atom : shown.atoms) positions.push_back(state.structure.atoms.positions[atom]);
  }

  Json json = {{"name", state.name},
               {"total_atoms", state.structure.atoms.size()},
               {"step", position_step},
               {"positions", packed_points(positions)},
               {"images", packed_integers(drawing.images, 1)},
               {"species", packed_species(state.structure.atoms, shown.atoms)},
               {"bonds", packed_bonds(drawing.bonds)},
               {"rings", packed_rings(drawing.rings)}};
  if (shown.is_sample) {
    const std::vector<std::int32_t> ids(shown.atoms.begin(), shown.atoms.end());
    json["sample"] = packed_integers(ids, 1);
  }
  json["maps"] = Json::array();
  for (const AtomMap& map : state.maps) {
    json["maps"].push_back(json_map(map, shared_scale(page, map), shown.atoms));
  }
  return json;
}

Json json_surface(const remesh::TriMesh& mesh) {
  const remesh::TriangleSoup soup = remesh::soup_of(mesh);
  std::vector<std::int32_t> corners;
  for (const auto& triangle : soup.triangles) {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  return {{"step", position_step},
          {"points", packed_points(soup.points)},
          {"triangles", packed_integers(corners, 1)}};
}

Json json_page(const ShellPage& page) {
  Json json = {{"title", page.title},
               {"program", page.program},
               {"notes", page.notes},
               {"parameters", json_rows(page.parameters)},
               {"results", json_rows(page.results)},
               {"states", Json::array()}};
  for (const ShellState& state : page.states) json["states"].push_back(json_state(state, page));
  if (!page.surface) return json;
  if (page.surface->n_faces() <= max_ghost_faces) {
    json["surface"] = json_surface(*page.surface);
  } else {
    json["notes"].push_back(concat("the input surface has ", page.surface->n_faces(),
                                   " triangles, too many to be shown here"));
  }
  return json;
}

}  // namespace

void write_shell_page(std::ostream& out, const ShellPage& page, std::string_view viewer) {
  if (page.states.empty()) throw InvalidNetwork("write_shell_page: there is no state to show");
  for (const ShellState& state : page.states) check_state("write_shell_page", state);
  const std::size_t place = viewer.find(place_of_data);
  if (place == std::string_view::npos) {
    throw InvalidOption(concat("write_shell_page: the viewer has no ", place_of_data));
  }
  out << viewer.substr(0, place);
  out << R"(<script type="application/json" id="shell-data">)";
  write_in_script(out, json_page(page));
  out << "</script>";
  out << viewer.substr(place + place_of_data.size());
}

void write_shell_page(const std::filesystem::path& path, const ShellPage& page,
                      std::string_view viewer) {
  remesh::write_whole_file(path, [&](std::ostream& out) { write_shell_page(out, page, viewer); });
}

}  // namespace trivalent::dual
