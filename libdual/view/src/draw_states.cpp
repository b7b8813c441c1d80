#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "canvas.h"
#include "draw_legend.h"
#include "flat_drawing.h"
#include "trivalent/view/picture.h"

namespace trivalent::dual {
namespace {

constexpr int samples = Canvas::samples_per_side;

void check_options(std::span<const ShellState> states, const PictureOptions& options) {
  constexpr int smallest = 100;
  constexpr int largest = 10000;
  for (const int side : {options.width, options.height}) {
    if (side < smallest || side > largest) {
      throw InvalidOption(concat("draw_states: a picture has ", smallest, " to ", largest,
                                 " pixels a side, not ", side));
    }
  }
  if (!(options.zoom > 0.0) || !std::isfinite(options.zoom)) {
    throw InvalidOption("draw_states: the zoom must be > 0");
  }
  if (states.empty()) throw InvalidNetwork("draw_states: there is no state to draw");
  for (const ShellState& state : states) {
    check_state("draw_states", state);
    if (state.find(options.map) == nullptr) {
      std::string known;
      for (const AtomMap& map : state.maps) known += (known.empty() ? "" : ", ") + map.name;
      throw InvalidOption(concat("draw_states: '", options.map, "' is not known of ", state.name,
                                 "; it has ", known));
    }
  }
}

/// The last state's map decides how all are colored.
AtomMap reference_map(std::span<const ShellState> states, const PictureOptions& options) {
  const AtomMap& map = *states.back().find(options.map);
  AtomMap reference = {.name = map.name,
                       .title = map.title,
                       .unit = map.unit,
                       .values = {},
                       .scale = map.scale,
                       .categories = map.categories};
  if (!map.categories.empty()) return reference;
  reference.scale.low = options.low.value_or(map.scale.low);
  reference.scale.high = options.high.value_or(map.scale.high);
  if (!(reference.scale.high > reference.scale.low)) {
    throw InvalidOption(concat("draw_states: the color scale ends at ", reference.scale.high,
                               ", not above its beginning ", reference.scale.low));
  }
  return reference;
}

/// From Å to samples: turned, sized and moved into the middle of a panel.
struct Projection {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double samples_per_length = 1.0;

  [[nodiscard]] Eigen::Vector3d operator()(const Eigen::Vector3d& position) const {
    const Eigen::Vector3d turned = samples_per_length * (turn * (position - center));
    return {middle.x() + turned.x(), middle.y() - turned.y(), turned.z()};
  }
};

Eigen::Matrix3d turn_of(const PictureOptions& options) {
  const double degree = std::numbers::pi / 180.0;
  return (Eigen::AngleAxisd(options.roll * degree, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(options.elevation * degree, Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(options.azimuth * degree, Eigen::Vector3d::UnitY()))
      .toRotationMatrix();
}

/// Fits what is seen of the state, with its balls, into the panel.
Projection fit(std::span<const Eigen::Vector3d> positions, const PictureOptions& options,
               const Area& panel) {
  Projection projection = {.turn = turn_of(options)};
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& position : positions) bounds.extend(projection.turn * position);
  if (bounds.isEmpty()) bounds.extend(Eigen::Vector3d::Zero());
  constexpr double ball = 1.0;  // [Å] beyond the centers
  constexpr double margin = 1.04;
  const Eigen::Vector3d size = (bounds.sizes() + Eigen::Vector3d::Constant(2.0 * ball)) * margin;
  projection.center = projection.turn.transpose() * bounds.center();
  projection.samples_per_length =
      options.zoom * samples * std::min(panel.width / size.x(), panel.height / size.y());
  projection.middle = {samples * (panel.left + 0.5 * panel.width),
                       samples * (panel.top + 0.5 * panel.height)};
  return projection;
}

/// Radii that fill the net whatever the lengths of its bonds: half an atom's mean bond, nearly [Å].
std::vector<double> ball_radii(const Structure& structure) {
  const potentials::Atoms& atoms = structure.atoms;
  constexpr double lone = 1.42;
  std::vector<double> sums(atoms.size(), 0.0);
  std::vector<int> counts(atoms.size(), 0);
  std::vector<double> lengths;
  for (const potentials::Bond& bond : structure.bonds) {
    lengths.push_back(potentials::bond_length(atoms, bond));
    for (const std::uint32_t atom : {bond.first, bond.second}) {
      sums[atom] += lengths.back();
      ++counts[atom];
    }
  }
  std::sort(lengths.begin(), lengths.end());
  const double typical = lengths.empty() ? lone : lengths[lengths.size() / 2];
  std::vector<double> radii;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double mean = counts[i] > 0 ? sums[i] / counts[i] : typical;
    const double size = atoms.species[i] == potentials::Species::hydrogen ? 0.32 : 0.5;
    radii.push_back(size * std::clamp(mean, 0.4 * typical, 2.5 * typical));
  }
  return radii;
}

double mean_of(const std::vector<double>& values) {
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

/// One of each for every atom.
struct Balls {
  std::vector<double> radii;  ///< [Å]
  std::vector<Rgb> colors;
};

void draw_atoms(Canvas& canvas, const Drawing& drawing, const Projection& projection,
                const Balls& balls) {
  const auto& [radii, colors] = balls;
  const double mean = mean_of(radii) * projection.samples_per_length;
  // Sticks need some pixels; before that, balls that touch make a closed surface.
  constexpr double room_for_sticks = 5.0 * samples;
  const bool has_sticks = mean > room_for_sticks && !drawing.bonds.empty();
  const double ball = has_sticks ? 0.55 : 1.15;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    canvas.draw_ball(projection(drawing.positions[i]),
                     ball * radii[i] * projection.samples_per_length, colors[i]);
  }
  if (!has_sticks) return;
  for (const auto& [first, second] : drawing.bonds) {
    canvas.draw_stick(projection(drawing.positions[first]), projection(drawing.positions[second]),
                      0.2 * mean, {colors[drawing.atom(first)], colors[drawing.atom(second)]});
  }
}

Color ring_color(const AtomMap& map, const AtomMap& values, const std::vector<int>& ring) {
  if (map.name == "ring_size") {
    return category_color(map.categories, static_cast<int>(ring.size()));
  }
  double sum = 0.0;
  for (const int atom : ring) sum += values.values[atom];
  AtomMap mean = map;
  const double value = sum / static_cast<double>(ring.size());
  mean.values = {map.categories.empty() ? value : std::round(value)};
  return mean.color(0);
}

std::vector<Rgb> ring_colors(const AtomMap& map, const ShellState& state) {
  const AtomMap& values = *state.find(map.name);
  std::vector<Rgb> colors;
  colors.reserve(state.structure.rings.size());
  for (const Ring& ring : state.structure.rings) {
    colors.push_back(rgb(ring_color(map, values, ring.atoms)));
  }
  return colors;
}

/// @param colors  One for each ring.
void draw_rings(Canvas& canvas, const Drawing& drawing, const Projection& projection,
                const std::vector<Rgb>& colors) {
  const std::vector<Eigen::Vector3d>& positions = drawing.positions;
  for (std::size_t k = 0; k < drawing.rings.size(); ++k) {
    const std::vector<int>& ring = drawing.rings[k];
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    for (const int atom : ring) center += positions[atom];
    center /= static_cast<double>(ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) {
      canvas.draw_triangle({projection(center), projection(positions[ring[i]]),
                            projection(positions[ring[(i + 1) % ring.size()]])},
                           colors[k]);
    }
  }
}

std::vector<Rgb> atom_colors(const AtomMap& map, const ShellState& state) {
  AtomMap colored = map;
  colored.values = state.find(map.name)->values;
  for (std::size_t i = 0; i < colored.values.size(); ++i) {
    // The scale of energies is carbon's.
    const bool is_carbon = state.structure.atoms.species[i] == potentials::Species::carbon;
    if (map.name == "energy" && !is_carbon) colored.values[i] = std::nan("");
  }
  std::vector<Rgb> colors;
  for (std::size_t i = 0; i < colored.values.size(); ++i) colors.push_back(rgb(colored.color(i)));
  return colors;
}

void draw_state(Canvas& canvas, const ShellState& state, const PictureOptions& options,
                const AtomMap& map, const Area& panel) {
  canvas.clip(panel);
  const Drawing drawing = drawing_of(state.structure);
  const Projection projection = fit(drawing.positions, options, panel);
  const std::vector<double> radii = ball_radii(state.structure);
  if (options.style == PictureStyle::rings) {
    draw_rings(canvas, drawing, projection, ring_colors(map, state));
  } else {
    draw_atoms(canvas, drawing, projection, {radii, atom_colors(map, state)});
  }
  double near = -std::numeric_limits<double>::infinity();
  double far = -near;
  for (const Eigen::Vector3d& position : drawing.positions) {
    const double depth = projection(position).z();
    near = std::max(near, depth);
    far = std::min(far, depth);
  }
  if (near > far) {
    const double reach = 1.6 * mean_of(radii) * projection.samples_per_length;
    canvas.add_depth_cues(std::max(reach, 3.0 * samples), near, far);
  }
}

/// How pictures are divided [pixel].
struct Layout {
  double letter = 0.0;  ///< height of capitals
  int title_height = 0;
  int legend_height = 0;
};

Layout layout_of(const PictureOptions& options, std::size_t n_states) {
  const double letter = std::clamp(0.019 * std::min(options.width, options.height), 7.0, 60.0);
  return {.letter = letter,
          .title_height = n_states > 1 ? static_cast<int>(2.6 * letter) : 0,
          .legend_height = static_cast<int>(6.0 * letter)};
}

/// The part of the picture for one of several states.
Area panel_of(int i, int n_states, const Layout& layout, const PictureOptions& options) {
  const int left = i * options.width / n_states;
  return {.left = left,
          .top = layout.title_height,
          .width = (i + 1) * options.width / n_states - left,
          .height = options.height - layout.legend_height - layout.title_height};
}

Picture draw_shells(std::span<const ShellState> states, const PictureOptions& options,
                    const AtomMap& map, const Layout& layout) {
  Canvas canvas(options.width, options.height, options.background);
  const auto n_states = static_cast<int>(states.size());
  for (int i = 0; i < n_states; ++i) {
    draw_state(canvas, states[i], options, map, panel_of(i, n_states, layout, options));
  }
  return canvas.picture();
}

void write_titles(FlatDrawing& drawing, std::span<const ShellState> states, const Pen& pen,
                  const std::vector<Area>& panels) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double left = panels[i].left;
    const double width = panels[i].width;
    drawing.clip({.left = left, .top = 0.0, .width = width, .height = 1.0 * panels[i].top});
    drawing.write_centered(states[i].name, left + 0.5 * width, 2.0 * pen.size, pen.ink);
  }
}

}  // namespace

Picture draw_states(std::span<const ShellState> states, const PictureOptions& options) {
  check_options(states, options);
  const AtomMap map = reference_map(states, options);
  const Layout layout = layout_of(options, states.size());
  FlatDrawing drawing(draw_shells(states, options, map, layout));

  const int brightness = options.background[0] + options.background[1] + options.background[2];
  const Pen pen = {.size = layout.letter,
                   .ink = brightness > 3 * 127 ? Color{30, 34, 42} : Color{235, 238, 243}};
  drawing.set_letters(pen.size);
  if (states.size() > 1) {
    std::vector<Area> panels;
    const auto n_states = static_cast<int>(states.size());
    panels.reserve(states.size());
    for (int i = 0; i < n_states; ++i) panels.push_back(panel_of(i, n_states, layout, options));
    write_titles(drawing, states, pen, panels);
  }
  draw_legend(drawing, map, pen,
              {.left = 0.0,
               .top = 1.0 * (options.height - layout.legend_height),
               .width = 1.0 * options.width,
               .height = 1.0 * layout.legend_height});
  return drawing.picture();
}

}  // namespace trivalent::dual
