#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "trivalent/view/picture.h"

namespace trivalent::dual {

using Rgb = Eigen::Vector3f;  ///< 0 to 255

[[nodiscard]] inline Rgb rgb(const Color& color) {
  return {static_cast<float>(color[0]), static_cast<float>(color[1]), static_cast<float>(color[2])};
}

/// A rectangle of pixels, the upper left corner included.
struct Area {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

/// Samples with color and depth, several to a pixel; larger depth is nearer. Coordinates are
/// samples to the right and down from the upper left corner.
class Canvas {
 public:
  static constexpr int samples_per_side = 3;

  Canvas(int width, int height, const Color& background);

  /// Draws only into this part from now on [pixel].
  void clip(const Area& area);

  void draw_ball(const Eigen::Vector3d& center, double radius, const Rgb& color);
  /// A round stick between two points, half in each color.
  void draw_stick(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                  const std::array<Rgb, 2>& colors);
  void draw_triangle(const std::array<Eigen::Vector3d, 3>& corners, const Rgb& color);

  /// Darkens what lies in hollows and behind edges of what was drawn, and lets the far side fade;
  /// reach is how far neighbors cast shade [sample], near and far the range of depths.
  void add_depth_cues(double reach, double near, double far);

  [[nodiscard]] Picture picture() const;

 private:
  struct Span {
    int begin;
    int end;
  };
  [[nodiscard]] Span columns(double low, double high) const;
  [[nodiscard]] Span rows(double low, double high) const;
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  void put(int x, int y, double depth, const Rgb& color);
  [[nodiscard]] float occlusion(int x, int y, double reach) const;

  int width_;
  int height_;
  Rgb background_;
  Area clip_;
  std::vector<float> depths_;
  std::vector<Rgb> colors_;
};

}  // namespace trivalent::dual
