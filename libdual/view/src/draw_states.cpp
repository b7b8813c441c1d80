#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <numeric>

#include "canvas.h"
#include "stroke_font.h"
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
Projection fit(const ShellState& state, const PictureOptions& options, const Area& panel) {
  Projection projection = {.turn = turn_of(options)};
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& position : state.structure.atoms.positions)
    bounds.extend(projection.turn * position);
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
  for (const auto& [first, second] : drawable_bonds(structure)) {
    lengths.push_back((atoms.positions[first] - atoms.positions[second]).norm());
    for (const int atom : {first, second}) {
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

void draw_atoms(Canvas& canvas, const ShellState& state, const Projection& projection,
                const std::vector<Rgb>& colors) {
  const potentials::Atoms& atoms = state.structure.atoms;
  const std::vector<std::array<int, 2>> bonds = drawable_bonds(state.structure);
  const std::vector<double> radii = ball_radii(state.structure);
  const double mean = mean_of(radii) * projection.samples_per_length;
  // Sticks need some pixels; before that, balls that touch make a closed surface.
  constexpr double room_for_sticks = 5.0 * samples;
  const bool has_sticks = mean > room_for_sticks && !bonds.empty();
  const double ball = has_sticks ? 0.55 : 1.15;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    canvas.draw_ball(projection(atoms.positions[i]),
                     ball * radii[i] * projection.samples_per_length, colors[i]);
  }
  if (!has_sticks) return;
  for (const auto& [first, second] : bonds) {
    canvas.draw_stick(projection(atoms.positions[first]), projection(atoms.positions[second]),
                      0.2 * mean, {colors[first], colors[second]});
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

void draw_rings(Canvas& canvas, const ShellState& state, const Projection& projection,
                const AtomMap& map) {
  const AtomMap& values = *state.find(map.name);
  const std::vector<Eigen::Vector3d>& positions = state.structure.atoms.positions;
  for (const auto& ring : drawable_rings(state.structure)) {
    const Rgb color = rgb(ring_color(map, values, ring));
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    for (const int atom : ring) center += positions[atom];
    center /= static_cast<double>(ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) {
      canvas.draw_triangle({projection(center), projection(positions[ring[i]]),
                            projection(positions[ring[(i + 1) % ring.size()]])},
                           color);
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
  const Projection projection = fit(state, options, panel);
  if (options.style == PictureStyle::rings) {
    draw_rings(canvas, state, projection, map);
  } else {
    draw_atoms(canvas, state, projection, atom_colors(map, state));
  }
  double near = -std::numeric_limits<double>::infinity();
  double far = -near;
  for (const Eigen::Vector3d& position : state.structure.atoms.positions) {
    const double depth = projection(position).z();
    near = std::max(near, depth);
    far = std::min(far, depth);
  }
  if (near > far) {
    const double reach = 1.6 * mean_of(ball_radii(state.structure)) * projection.samples_per_length;
    canvas.add_depth_cues(std::max(reach, 3.0 * samples), near, far);
  }
}

/// As many decimals as the scale's ends need to be told apart.
std::string number(double value, const ColorScale& scale) {
  const int decimals =
      static_cast<int>(std::clamp(2.0 - std::floor(std::log10(scale.high - scale.low)), 0.0, 6.0));
  char text[512];  // the largest double has 309 digits
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

/// Letters and colors of what is written beside the shells.
struct Pen {
  double size;  ///< height of capitals [sample]
  Rgb ink;
};

void draw_centered(Canvas& canvas, const std::string& text, double x, double y, const Pen& pen) {
  canvas.draw_text(text, x - 0.5 * pen.size * stroke_text(text).width, y, pen.size, pen.ink);
}

void draw_scale(Canvas& canvas, const ColorScale& scale, const Pen& pen,
                const Eigen::Vector3d& bar) {
  const double left = bar.x();
  const double top = bar.y();
  const double width = bar.z();
  for (int i = 0; i < static_cast<int>(width); ++i) {
    const double value = scale.low + (scale.high - scale.low) * (i + 0.5) / width;
    canvas.fill(left + i, top, 1.0, 1.1 * pen.size, rgb(scale.color(value)));
  }
  const double baseline = top + 2.7 * pen.size;
  const double values[] = {scale.low, scale.middle(), scale.high};
  for (int i = 0; i < 3; ++i) {
    const double x = left + 0.5 * i * width;
    canvas.fill(x - 0.04 * pen.size, top, 0.08 * pen.size, 1.4 * pen.size, pen.ink);
    draw_centered(canvas, number(values[i], scale), x, baseline, pen);
  }
}

void draw_swatches(Canvas& canvas, const std::vector<Category>& categories, const Pen& pen,
                   const Eigen::Vector2d& middle) {
  double width = 0.0;
  const auto width_of = [&](const Category& category) {
    return pen.size * (3.2 + stroke_text(category.label).width);
  };
  for (const Category& category : categories) width += width_of(category);
  double x = middle.x() - 0.5 * width;
  for (const Category& category : categories) {
    canvas.fill(x, middle.y(), 1.2 * pen.size, 1.2 * pen.size, pen.ink);
    const double rim = 0.08 * pen.size;
    canvas.fill(x + rim, middle.y() + rim, 1.2 * pen.size - 2.0 * rim, 1.2 * pen.size - 2.0 * rim,
                rgb(category.color));
    canvas.draw_text(category.label, x + 1.7 * pen.size, middle.y() + 1.1 * pen.size, pen.size,
                     pen.ink);
    x += width_of(category);
  }
}

void draw_legend(Canvas& canvas, const AtomMap& map, const Pen& pen, const Area& area) {
  canvas.clip(area);
  const double middle = samples * (area.left + 0.5 * area.width);
  const double top = samples * area.top;
  const std::string title = map.unit.empty() ? map.title : map.title + " [" + map.unit + "]";
  draw_centered(canvas, title, middle, top + 1.6 * pen.size, pen);
  if (map.categories.empty()) {
    const double width = std::min(0.7 * samples * area.width, 26.0 * pen.size);
    draw_scale(canvas, map.scale, pen, {middle - 0.5 * width, top + 2.6 * pen.size, width});
  } else {
    draw_swatches(canvas, map.categories, pen, {middle, top + 3.0 * pen.size});
  }
}

}  // namespace

Picture draw_states(std::span<const ShellState> states, const PictureOptions& options) {
  check_options(states, options);
  const AtomMap map = reference_map(states, options);
  Canvas canvas(options.width, options.height, options.background);

  const int brightness = options.background[0] + options.background[1] + options.background[2];
  const double letter = std::clamp(0.019 * std::min(options.width, options.height), 7.0, 60.0);
  const Pen pen = {.size = letter * samples,
                   .ink = brightness > 3 * 127 ? Rgb(30, 34, 42) : Rgb(235, 238, 243)};
  const int legend_height = static_cast<int>(6.0 * letter);
  const int title_height = states.size() > 1 ? static_cast<int>(2.6 * letter) : 0;
  const auto n_states = static_cast<int>(states.size());
  for (int i = 0; i < n_states; ++i) {
    const int left = i * options.width / n_states;
    const int width = (i + 1) * options.width / n_states - left;
    const Area panel = {.left = left,
                        .top = title_height,
                        .width = width,
                        .height = options.height - legend_height - title_height};
    draw_state(canvas, states[i], options, map, panel);
    if (title_height == 0) continue;
    canvas.clip({.left = left, .top = 0, .width = width, .height = title_height});
    draw_centered(canvas, states[i].name, samples * (left + 0.5 * width), samples * 2.0 * letter,
                  pen);
  }
  draw_legend(canvas, map, pen,
              {.left = 0,
               .top = options.height - legend_height,
               .width = options.width,
               .height = legend_height});
  return canvas.picture();
}

}  // namespace trivalent::dual
