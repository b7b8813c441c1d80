#include "canvas.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace trivalent::dual {
namespace {

constexpr float nothing = -std::numeric_limits<float>::infinity();

const Eigen::Vector3d light = Eigen::Vector3d(-0.35, -0.55, 0.76).normalized();
const Eigen::Vector3d gleam = Eigen::Vector3d(-0.18, -0.30, 0.94).normalized();

/// Light from the upper left and a small highlight; normals have y down, as pictures have.
Rgb shaded(const Rgb& color, const Eigen::Vector3d& normal) {
  const double diffuse = std::max(0.0, normal.dot(light));
  const double highlight = std::pow(std::max(0.0, normal.dot(gleam)), 40.0);
  const double strength = (0.55 + 0.45 * diffuse) * (0.62 + 0.38 * std::abs(normal.z()));
  constexpr double highlight_strength = 0.12 * 255.0;
  const Rgb lit = static_cast<float>(strength) * color +
                  Rgb::Constant(static_cast<float>(highlight_strength * highlight));
  return lit.cwiseMin(255.0f);
}

}  // namespace

Canvas::Canvas(int width, int height, const Color& background)
    : width_(width * samples_per_side),
      height_(height * samples_per_side),
      background_(rgb(background)),
      clip_({.width = width_, .height = height_}),
      depths_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), nothing),
      colors_(depths_.size(), background_) {}

void Canvas::clip(const Area& area) {
  clip_ = {.left = area.left * samples_per_side,
           .top = area.top * samples_per_side,
           .width = area.width * samples_per_side,
           .height = area.height * samples_per_side};
}

Canvas::Span Canvas::columns(double low, double high) const {
  const double left = clip_.left;
  const double right = clip_.left + clip_.width;
  return {static_cast<int>(std::clamp(std::floor(low), left, right)),
          static_cast<int>(std::clamp(std::ceil(high) + 1.0, left, right))};
}

Canvas::Span Canvas::rows(double low, double high) const {
  const double top = clip_.top;
  const double bottom = clip_.top + clip_.height;
  return {static_cast<int>(std::clamp(std::floor(low), top, bottom)),
          static_cast<int>(std::clamp(std::ceil(high) + 1.0, top, bottom))};
}

void Canvas::put(int x, int y, double depth, const Rgb& color) {
  float& old = depths_[index(x, y)];
  if (static_cast<float>(depth) <= old) return;
  old = static_cast<float>(depth);
  colors_[index(x, y)] = color;
}

void Canvas::draw_ball(const Eigen::Vector3d& center, double radius, const Rgb& color) {
  const Span across = columns(center.x() - radius, center.x() + radius);
  const Span down = rows(center.y() - radius, center.y() + radius);
  for (int y = down.begin; y < down.end; ++y) {
    for (int x = across.begin; x < across.end; ++x) {
      const Eigen::Vector2d at((x - center.x()) / radius, (y - center.y()) / radius);
      const double square = at.squaredNorm();
      if (square > 1.0) continue;
      const double height = std::sqrt(1.0 - square);
      const double depth = center.z() + radius * height;
      if (static_cast<float>(depth) <= depths_[index(x, y)]) continue;
      put(x, y, depth, shaded(color, {at.x(), at.y(), height}));
    }
  }
}

void Canvas::draw_stick(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                        const std::array<Rgb, 2>& colors) {
  const Eigen::Vector3d axis = to - from;
  const double length = axis.head<2>().norm();
  if (length < 1e-9) return;
  const Eigen::Vector2d along = axis.head<2>() / length;
  const Eigen::Vector2d side(-along.y(), along.x());
  const Span across =
      columns(std::min(from.x(), to.x()) - radius, std::max(from.x(), to.x()) + radius);
  const Span down = rows(std::min(from.y(), to.y()) - radius, std::max(from.y(), to.y()) + radius);
  for (int y = down.begin; y < down.end; ++y) {
    for (int x = across.begin; x < across.end; ++x) {
      const Eigen::Vector2d at(x - from.x(), y - from.y());
      const double fraction = at.dot(along) / length;
      const double aside = at.dot(side) / radius;
      if (fraction < 0.0 || fraction > 1.0 || std::abs(aside) > 1.0) continue;
      const double height = std::sqrt(1.0 - aside * aside);
      const Eigen::Vector3d normal(aside * side.x(), aside * side.y(), height);
      put(x, y, from.z() + fraction * axis.z() + radius * height,
          shaded(colors[fraction < 0.5 ? 0 : 1], normal));
    }
  }
}

void Canvas::draw_triangle(const std::array<Eigen::Vector3d, 3>& corners, const Rgb& color) {
  const auto& [a, b, c] = corners;
  const Eigen::Vector3d cross = (b - a).cross(c - a);
  if (std::abs(cross.z()) < 1e-12) return;
  const Eigen::Vector3d normal = cross.normalized() * (cross.z() < 0.0 ? -1.0 : 1.0);
  const Rgb lit = shaded(color, normal);
  const Span across = columns(std::min({a.x(), b.x(), c.x()}), std::max({a.x(), b.x(), c.x()}));
  const Span down = rows(std::min({a.y(), b.y(), c.y()}), std::max({a.y(), b.y(), c.y()}));
  for (int y = down.begin; y < down.end; ++y) {
    for (int x = across.begin; x < across.end; ++x) {
      // Barycentric coordinates of the sample.
      const double along_b =
          ((x - a.x()) * (c.y() - a.y()) - (y - a.y()) * (c.x() - a.x())) / cross.z();
      const double along_c =
          ((b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x())) / cross.z();
      if (along_b < 0.0 || along_c < 0.0 || along_b + along_c > 1.0) continue;
      put(x, y, a.z() + along_b * (b.z() - a.z()) + along_c * (c.z() - a.z()), lit);
    }
  }
}

float Canvas::occlusion(int x, int y, double reach) const {
  // Two rings of samples; how far each rises above this one, as the sine of an angle.
  constexpr std::array<std::array<double, 2>, 12> directions = {{{1, 0},
                                                                 {0, 1},
                                                                 {-1, 0},
                                                                 {0, -1},
                                                                 {0.7, 0.7},
                                                                 {-0.7, 0.7},
                                                                 {-0.7, -0.7},
                                                                 {0.7, -0.7},
                                                                 {0.46, 0.19},
                                                                 {-0.19, 0.46},
                                                                 {-0.46, -0.19},
                                                                 {0.19, -0.46}}};
  const double here = depths_[index(x, y)];
  double sum = 0.0;
  for (const auto& [dx, dy] : directions) {
    const int other_x = x + static_cast<int>(std::lround(reach * dx));
    const int other_y = y + static_cast<int>(std::lround(reach * dy));
    if (other_x < 0 || other_y < 0 || other_x >= width_ || other_y >= height_) continue;
    const double rise = depths_[index(other_x, other_y)] - here;
    if (!(rise > 0.0)) continue;
    const double away = reach * std::hypot(dx, dy);
    // What is far in front hides, but throws no shade.
    const double relevance = 1.0 / (1.0 + rise / (6.0 * reach));
    sum += rise / std::hypot(rise, away) * relevance;
  }
  return static_cast<float>(sum / static_cast<double>(directions.size()));
}

void Canvas::add_depth_cues(double reach, double near, double far) {
  constexpr float shade = 0.62f;
  constexpr double fading = 0.22;
  std::vector<float> factors(depths_.size(), 1.0f);
  for (int y = clip_.top; y < clip_.top + clip_.height; ++y) {
    for (int x = clip_.left; x < clip_.left + clip_.width; ++x) {
      if (depths_[index(x, y)] == nothing) continue;
      factors[index(x, y)] = 1.0f - shade * occlusion(x, y, reach);
    }
  }
  for (int y = clip_.top; y < clip_.top + clip_.height; ++y) {
    for (int x = clip_.left; x < clip_.left + clip_.width; ++x) {
      const std::size_t i = index(x, y);
      if (depths_[i] == nothing) continue;
      const double distance = std::clamp((near - depths_[i]) / (near - far), 0.0, 1.0);
      const auto fade = static_cast<float>(fading * distance * distance);
      colors_[i] = (1.0f - fade) * factors[i] * colors_[i] + fade * background_;
    }
  }
}

Picture Canvas::picture() const {
  Picture picture = {
      .width = width_ / samples_per_side, .height = height_ / samples_per_side, .pixels = {}};
  picture.pixels.reserve(3 * static_cast<std::size_t>(picture.width * picture.height));
  constexpr float share = 1.0f / (samples_per_side * samples_per_side);
  for (int y = 0; y < height_; y += samples_per_side) {
    for (int x = 0; x < width_; x += samples_per_side) {
      Rgb sum = Rgb::Zero();
      for (int dy = 0; dy < samples_per_side; ++dy) {
        for (int dx = 0; dx < samples_per_side; ++dx) sum += colors_[index(x + dx, y + dy)];
      }
      for (const float channel : sum) {
        picture.pixels.push_back(
            static_cast<std::uint8_t>(std::lround(std::clamp(share * channel, 0.0f, 255.0f))));
      }
    }
  }
  return picture;
}

}  // namespace trivalent::dual
