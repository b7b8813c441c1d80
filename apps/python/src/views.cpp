#include <memory>
#include <sstream>

#include "arrays.h"
#include "module.h"
#include "options.h"
#include "trivalent/shell/option_names.h"
#include "trivalent/shell/states.h"
#include "trivalent/shell/surface_source.h"
#include "trivalent/view/picture.h"
#include "trivalent/view/shell_page.h"
#include "viewer_page.h"

namespace trivalent::python {
namespace {

using States = std::vector<std::pair<std::string, std::shared_ptr<dual::Structure>>>;

std::vector<shell::NamedStructure> copies_of(const States& states) {
  std::vector<shell::NamedStructure> copies;
  for (const auto& [name, structure] : states) copies.push_back({name, *structure});
  return copies;
}

/// The page as HTML.
py::bytes page_of_states(const States& states, const std::optional<shell::Surface>& surface,
                         const py::dict& values) {
  const Options given(values);
  const shell::PotentialChoice potential = potential_choice(given);
  const auto title = given.find<std::string>("title");
  std::ostringstream out;
  {
    const py::gil_scoped_release released;
    dual::ShellPage page =
        shell::page_of(shell::evaluate_states(copies_of(states), potential), potential);
    page.title = title.value_or(page.title);
    page.program = "trivalent " TRIVALENT_VERSION;
    if (surface) page.surface = surface->mesh;
    dual::write_shell_page(out, page, apps::viewer_page);
  }
  return py::bytes(out.str());
}

dual::PictureOptions picture_options(const Options& given) {
  dual::PictureOptions options;
  given.set("color", options.map);
  given.set("style", options.style, shell::picture_style_names);
  given.set("width", options.width);
  given.set("height", options.height);
  given.set("azimuth", options.azimuth);
  given.set("elevation", options.elevation);
  given.set("roll", options.roll);
  given.set("zoom", options.zoom);
  options.low = given.find<double>("low");
  options.high = given.find<double>("high");
  bool is_dark = false;
  given.set("dark", is_dark);
  if (is_dark) options.background = dual::night;
  return options;
}

std::shared_ptr<dual::Picture> render(const States& states, const py::dict& values) {
  const Options given(values);
  const shell::PotentialChoice potential = potential_choice(given);
  const dual::PictureOptions options = picture_options(given);
  const py::gil_scoped_release released;
  return std::make_shared<dual::Picture>(
      dual::draw_states(shell::evaluate_states(copies_of(states), potential), options));
}

py::array pixels_of(const py::object& self) {
  const auto& picture = self.cast<const dual::Picture&>();
  const py::ssize_t row = 3 * py::ssize_t{picture.width};
  return python::view(picture.pixels.data(), {picture.height, picture.width, 3}, {row, 3, 1}, self);
}

py::bytes png_of(const dual::Picture& picture) {
  std::ostringstream out;
  dual::write_png(out, picture);
  return py::bytes(out.str());
}

}  // namespace

void add_views(py::module_& module) {
  py::class_<dual::Picture, std::shared_ptr<dual::Picture>>(module, "Picture", "Pixels")
      .def_property_readonly("pixels", &pixels_of, "Red, green, blue, shape (height, width, 3)")
      .def("png", &png_of, "The picture as the bytes of a PNG file");
  module.def("view", &page_of_states, py::arg("states"), py::arg("surface"), py::arg("options"));
  module.def("render", &render, py::arg("states"), py::arg("options"));
}

}  // namespace trivalent::python
