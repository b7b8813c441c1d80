#include "trivalent/view/shell_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <ostream>

#include "packed_integers.h"
#include "trivalent/dual/energy_summary.h"
#include "trivalent/remesh/whole_file.h"

namespace trivalent::dual {
namespace {

constexpr std::string_view place_of_data = "<!--shell-data-->";
constexpr double position_step = 0.001;  // [Å]

/// Text as JSON that may stand inside a <script>: nothing in it can end the element, whatever a
/// file is called. Bytes that are not ASCII pass as they are; the browser repairs broken UTF-8.
std::string json_text(std::string_view text) {
  std::string json = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x20 && code != 0x7f &&
        std::string_view("\"\\<>&'").find(c) == std::string_view::npos) {
      json += c;
      continue;
    }
    char escape[8];
    std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned>(code));
    json += escape;
  }
  return json + '"';
}

std::string json_number(double value) {
  if (!std::isfinite(value)) return "null";
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

/// The elements of a list, each turned into JSON.
template <typename List, typename ToJson>
std::string json_list(const List& list, const ToJson& to_json) {
  std::string json = "[";
  for (const auto& element : list) {
    if (json.size() > 1) json += ',';
    json += to_json(element);
  }
  return json + ']';
}

std::string json_color(const Color& color) {
  char text[16];
  std::snprintf(text, sizeof text, "\"#%02x%02x%02x\"", color[0], color[1], color[2]);
  return text;
}

std::string json_rows(const std::vector<PageRow>& rows) {
  return json_list(rows, [](const PageRow& row) {
    return '[' + json_text(row.name) + ',' + json_text(row.value) + ']';
  });
}

/// The nearest multiple of a step, as far as 32 bits reach.
std::int32_t rounded(double value, double step) {
  constexpr double limit = 1e9;
  return static_cast<std::int32_t>(std::lround(std::clamp(value / step, -limit, limit)));
}

std::string packed_points(std::span<const Eigen::Vector3d> points) {
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
  if (n_atoms <= most_page_atoms) {
    shown.atoms.resize(n_atoms);
    std::iota(shown.atoms.begin(), shown.atoms.end(), 0);
    return shown;
  }
  shown.is_sample = true;
  const double step = static_cast<double>(n_atoms) / static_cast<double>(most_page_atoms);
  for (std::size_t i = 0; i < most_page_atoms; ++i) {
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
std::string packed_values(const AtomMap& map, const std::vector<int>& atoms, double step) {
  std::vector<std::int32_t> values;
  values.reserve(atoms.size());
  for (const int atom : atoms) {
    const double value = map.values[atom];
    const std::int32_t multiple = std::isnan(value) ? 0 : rounded(value, step);
    values.push_back(std::isnan(value) ? 0 : multiple + (multiple >= 0 ? 1 : 0));
  }
  return packed_integers(values, 0);
}

std::string json_map(const AtomMap& map, const ColorScale& scale, const std::vector<int>& atoms) {
  const bool counts = !map.categories.empty();
  const double step =
      counts ? 1.0 : std::pow(10.0, std::floor(std::log10((scale.high - scale.low) / 10000.0)));
  std::string json = "{\"name\":" + json_text(map.name) + ",\"title\":" + json_text(map.title) +
                     ",\"unit\":" + json_text(map.unit) + ",\"step\":" + json_number(step);
  if (counts) {
    json += ",\"categories\":" + json_list(map.categories, [](const Category& category) {
              return "{\"value\":" + std::to_string(category.value) +
                     ",\"label\":" + json_text(category.label) +
                     ",\"color\":" + json_color(category.color) + '}';
            });
  } else {
    json += ",\"scale\":{\"low\":" + json_number(scale.low) +
            ",\"high\":" + json_number(scale.high) +
            ",\"colors\":" + json_list(scale.colors, json_color) + '}';
  }
  return json + ",\"values\":" + packed_values(map, atoms, step) + '}';
}

std::string packed_bonds(const std::vector<std::array<int, 2>>& bonds) {
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

std::string packed_rings(const std::vector<std::vector<int>>& rings) {
  std::vector<std::int32_t> sizes;
  std::vector<std::int32_t> atoms;
  for (const auto& ring : rings) {
    sizes.push_back(static_cast<std::int32_t>(ring.size()));
    atoms.insert(atoms.end(), ring.begin(), ring.end());
  }
  return "{\"sizes\":" + packed_integers(sizes, 0) + ",\"atoms\":" + packed_integers(atoms, 1) +
         '}';
}

std::string packed_species(const potentials::Atoms& atoms, const std::vector<int>& shown) {
  std::vector<std::int32_t> numbers;
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

std::string json_state(const ShellState& state, const ShellPage& page) {
  const Shown shown = shown_atoms(state);
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(shown.atoms.size());
  for (const int atom : shown.atoms) positions.push_back(state.structure.atoms.positions[atom]);
  // Half of the atoms would leave torn bonds and rings.
  const Structure drawn = shown.is_sample ? Structure{} : state.structure;

  std::string json = "{\"name\":" + json_text(state.name) +
                     ",\"total_atoms\":" + std::to_string(state.structure.atoms.size()) +
                     ",\"step\":" + json_number(position_step) +
                     ",\"positions\":" + packed_points(positions) +
                     ",\"species\":" + packed_species(state.structure.atoms, shown.atoms) +
                     ",\"bonds\":" + packed_bonds(drawable_bonds(drawn)) +
                     ",\"rings\":" + packed_rings(drawable_rings(drawn));
  if (shown.is_sample) {
    const std::vector<std::int32_t> ids(shown.atoms.begin(), shown.atoms.end());
    json += ",\"sample\":" + packed_integers(ids, 1);
  }
  return json + ",\"maps\":" +
         json_list(state.maps,
                   [&](const AtomMap& map) {
                     return json_map(map, shared_scale(page, map), shown.atoms);
                   }) +
         '}';
}

std::string json_surface(const remesh::TriMesh& mesh) {
  std::vector<Eigen::Vector3d> points;
  for (const auto vertex : mesh.vertices()) points.push_back(mesh.point(vertex));
  std::vector<std::int32_t> corners;
  for (const auto& triangle : remesh::triangles_of(mesh)) {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  return "{\"step\":" + json_number(position_step) + ",\"points\":" + packed_points(points) +
         ",\"triangles\":" + packed_integers(corners, 1) + '}';
}

void write_data(std::ostream& out, const ShellPage& page) {
  std::vector<std::string> notes = page.notes;
  const bool has_ghost = page.surface && page.surface->n_faces() <= most_ghost_faces;
  if (page.surface && !has_ghost) {
    notes.push_back(concat("the input surface has ", page.surface->n_faces(),
                           " triangles, too many to be shown here"));
  }
  out << "<script type=\"application/json\" id=\"shell-data\">{\"title\":" << json_text(page.title)
      << ",\"program\":" << json_text(page.program) << ",\"notes\":" << json_list(notes, json_text)
      << ",\"parameters\":" << json_rows(page.parameters)
      << ",\"results\":" << json_rows(page.results) << ",\"states\":[";
  for (std::size_t i = 0; i < page.states.size(); ++i) {
    out << (i > 0 ? "," : "") << json_state(page.states[i], page);
  }
  out << ']';
  if (has_ghost) out << ",\"surface\":" << json_surface(*page.surface);
  out << "}</script>";
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
  write_data(out, page);
  out << viewer.substr(place + place_of_data.size());
}

void write_shell_page(const std::filesystem::path& path, const ShellPage& page,
                      std::string_view viewer) {
  remesh::write_whole_file(path, [&](std::ostream& out) { write_shell_page(out, page, viewer); });
}

}  // namespace trivalent::dual
