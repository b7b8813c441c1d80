#pragma once

#include <cairo.h>

#include <memory>
#include <string>

#include "trivalent/view/picture.h"

namespace trivalent::dual {

/// A part of a picture [pixel].
struct Rectangle {
  double left = 0.0;
  double top = 0.0;
  double width = 0.0;
  double height = 0.0;
};

/// Draws text and flat colors over a picture, by Cairo. Lengths are pixels from the upper left.
class FlatDrawing {
 public:
  explicit FlatDrawing(const Picture& picture);

  /// Draws only into this part from now on.
  void clip(const Rectangle& area);
  void fill(const Rectangle& area, const Color& color);
  /// Fills from left to right with all colors of the scale.
  void fill(const Rectangle& area, const ColorScale& scale);

  /// Letters whose capitals have this height.
  void set_letters(double capital_height);
  [[nodiscard]] double text_width(const std::string& text) const;
  /// UTF-8; what is none becomes question marks.
  void write(const std::string& text, double left, double baseline, const Color& color);
  void write_centered(const std::string& text, double middle, double baseline, const Color& color);

  [[nodiscard]] Picture picture() const;

 private:
  struct Destroy {
    void operator()(cairo_t* context) const;
    void operator()(cairo_surface_t* surface) const;
  };
  std::unique_ptr<cairo_surface_t, Destroy> surface_;
  std::unique_ptr<cairo_t, Destroy> context_;
};

}  // namespace trivalent::dual
