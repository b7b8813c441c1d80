#include "flat_drawing.h"

#include <algorithm>
#include <new>
#include <ostream>

#include "trivalent/dual/error.h"
#include "trivalent/remesh/whole_file.h"

namespace trivalent::dual {
namespace {

constexpr double full = 255.0;

void set_color(cairo_t* context, const Color& color) {
  cairo_set_source_rgb(context, color[0] / full, color[1] / full, color[2] / full);
}

void add_rectangle(cairo_t* context, const Rectangle& area) {
  cairo_rectangle(context, area.left, area.top, area.width, area.height);
}

/// A new surface with the picture's pixels: one 32-bit number 0x00rrggbb each.
cairo_surface_t* surface_of(const Picture& picture) {
  cairo_surface_t* surface =
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, picture.width, picture.height);
  if (cairo_surface_status(surface) != CAIRO_STATUS_SUCCESS) throw std::bad_alloc();
  cairo_surface_flush(surface);
  unsigned char* row = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  std::size_t at = 0;
  for (int y = 0; y < picture.height; ++y, row += stride) {
    auto* pixel = reinterpret_cast<std::uint32_t*>(row);
    for (int x = 0; x < picture.width; ++x, at += 3) {
      const auto* rgb = &picture.pixels[at];
      pixel[x] = std::uint32_t{rgb[0]} << 16 | std::uint32_t{rgb[1]} << 8 | rgb[2];
    }
  }
  cairo_surface_mark_dirty(surface);
  return surface;
}

/// Cairo refuses text that is not UTF-8, as names of files may be.
std::string valid_text(std::string text) {
  const int any_size = 1;
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_A8, any_size, any_size);
  cairo_t* context = cairo_create(surface);
  cairo_text_extents_t extents;
  cairo_text_extents(context, text.c_str(), &extents);
  const bool is_valid = cairo_status(context) == CAIRO_STATUS_SUCCESS;
  cairo_destroy(context);
  cairo_surface_destroy(surface);
  if (is_valid) return text;
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) >= 0x80; }, '?');
  return text;
}

cairo_status_t write_bytes(void* out, const unsigned char* bytes, unsigned int size) {
  auto& stream = *static_cast<std::ostream*>(out);
  stream.write(reinterpret_cast<const char*>(bytes), size);
  return stream ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

}  // namespace

void FlatDrawing::Destroy::operator()(cairo_t* context) const { cairo_destroy(context); }

void FlatDrawing::Destroy::operator()(cairo_surface_t* surface) const {
  cairo_surface_destroy(surface);
}

FlatDrawing::FlatDrawing(const Picture& picture)
    : surface_(surface_of(picture)), context_(cairo_create(surface_.get())) {
  cairo_select_font_face(context_.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         CAIRO_FONT_WEIGHT_NORMAL);
}

void FlatDrawing::clip(const Rectangle& area) {
  cairo_reset_clip(context_.get());
  add_rectangle(context_.get(), area);
  cairo_clip(context_.get());
}

void FlatDrawing::fill(const Rectangle& area, const Color& color) {
  set_color(context_.get(), color);
  add_rectangle(context_.get(), area);
  cairo_fill(context_.get());
}

void FlatDrawing::fill(const Rectangle& area, const ColorScale& scale) {
  cairo_pattern_t* gradient =
      cairo_pattern_create_linear(area.left, 0.0, area.left + area.width, 0.0);
  const std::size_t n_steps = scale.colors.size() - 1;
  for (std::size_t i = 0; i <= n_steps; ++i) {
    const auto& [red, green, blue] = scale.colors[i];
    cairo_pattern_add_color_stop_rgb(gradient,
                                     static_cast<double>(i) / static_cast<double>(n_steps),
                                     red / full, green / full, blue / full);
  }
  cairo_set_source(context_.get(), gradient);
  cairo_pattern_destroy(gradient);
  add_rectangle(context_.get(), area);
  cairo_fill(context_.get());
}

void FlatDrawing::set_letters(double capital_height) {
  cairo_set_font_size(context_.get(), 100.0);
  cairo_text_extents_t extents;
  cairo_text_extents(context_.get(), "H", &extents);
  // Without any font there is nothing to be measured, or seen.
  const double height = extents.height > 0.0 ? extents.height : 72.0;
  cairo_set_font_size(context_.get(), 100.0 * capital_height / height);
}

double FlatDrawing::text_width(const std::string& text) const {
  cairo_text_extents_t extents;
  cairo_text_extents(context_.get(), valid_text(text).c_str(), &extents);
  return extents.x_advance;
}

void FlatDrawing::write(const std::string& text, double left, double baseline, const Color& color) {
  set_color(context_.get(), color);
  cairo_move_to(context_.get(), left, baseline);
  cairo_show_text(context_.get(), valid_text(text).c_str());
}

void FlatDrawing::write_centered(const std::string& text, double middle, double baseline,
                                 const Color& color) {
  write(text, middle - 0.5 * text_width(text), baseline, color);
}

Picture FlatDrawing::picture() const {
  cairo_surface_flush(surface_.get());
  Picture picture = {.width = cairo_image_surface_get_width(surface_.get()),
                     .height = cairo_image_surface_get_height(surface_.get()),
                     .pixels = {}};
  picture.pixels.reserve(3 * static_cast<std::size_t>(picture.width) *
                         static_cast<std::size_t>(picture.height));
  const unsigned char* row = cairo_image_surface_get_data(surface_.get());
  const int stride = cairo_image_surface_get_stride(surface_.get());
  for (int y = 0; y < picture.height; ++y, row += stride) {
    const auto* pixel = reinterpret_cast<const std::uint32_t*>(row);
    for (int x = 0; x < picture.width; ++x) {
      for (const int shift : {16, 8, 0}) {
        picture.pixels.push_back(static_cast<std::uint8_t>(pixel[x] >> shift & 0xff));
      }
    }
  }
  return picture;
}

void write_png(std::ostream& out, const Picture& picture) {
  cairo_surface_t* surface = surface_of(picture);
  const cairo_status_t status = cairo_surface_write_to_png_stream(surface, write_bytes, &out);
  cairo_surface_destroy(surface);
  if (status != CAIRO_STATUS_SUCCESS) {
    throw FileError(concat("write_png: ", cairo_status_to_string(status)));
  }
}

void write_png(const std::filesystem::path& path, const Picture& picture) {
  remesh::write_whole_file(path, [&](std::ostream& out) { write_png(out, picture); });
}

}  // namespace trivalent::dual
