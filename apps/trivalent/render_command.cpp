#include <algorithm>
#include <charconv>

#include "command.h"
#include "files.h"
#include "report_page.h"
#include "session.h"
#include "states.h"
#include "trivalent/shell/number_text.h"
#include "trivalent/shell/option_names.h"
#include "trivalent/shell/reports.h"
#include "trivalent/view/picture.h"

namespace trivalent::apps {
namespace {

constexpr std::array<std::string_view, 1> picture_extensions = {".png"};

Grammar grammar_of_render() {
  const dual::PictureOptions defaults;
  Grammar grammar = {.arguments = {}, .options = po::options_description("Options")};
  grammar.options.add_options()  //
      ("output,o", po::value<std::string>(), "the picture, .png; must be given")(
          "color", with_default(defaults.map),
          "energy, excess_energy, ring_size, coordination, bond_strain, pyramidalization, "
          "displacement")("style", with_default_name(defaults.style, shell::picture_style_names),
                          "atoms: balls and sticks; rings: polygons")(
          "size", with_default(std::string("1200x900")), "width x height [pixel]")(
          "azimuth", with_default(defaults.azimuth), "turn about the vertical y axis [degree]")(
          "elevation", with_default(defaults.elevation), "then tilt towards the viewer [degree]")(
          "roll", with_default(defaults.roll), "then turn in the picture [degree]")(
          "zoom", with_default(defaults.zoom), "1 fits the whole shell")(
          "low", po::value<double>(), "lower end of the color scale; default: from the values")(
          "high", po::value<double>(), "upper end of the color scale; default: from the values")(
          "dark", "draw on a dark background");
  add_states_options(grammar);
  return grammar;
}

/// "1200x900" as width and height.
std::array<int, 2> picture_size(const Session& session) {
  const auto& text = session.get<std::string>("size");
  std::array<int, 2> size = {0, 0};
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size[0]);
  const bool goes_on = width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x';
  const auto height = goes_on ? std::from_chars(width.ptr + 1, end, size[1]) : width;
  if (!goes_on || height.ec != std::errc{} || height.ptr != end) {
    throw UsageError("--size is width x height in pixels, as in 1200x900, not '" + text + "'");
  }
  return size;
}

dual::PictureOptions picture_options(const Session& session) {
  const auto [width, height] = picture_size(session);
  dual::PictureOptions options = {
      .width = width,
      .height = height,
      .map = session.get<std::string>("color"),
      .style = named_value(session, "style", shell::picture_style_names),
      .azimuth = session.get<double>("azimuth"),
      .elevation = session.get<double>("elevation"),
      .roll = session.get<double>("roll"),
      .zoom = session.get<double>("zoom"),
      .low = session.find<double>("low"),
      .high = session.find<double>("high")};
  if (session.has("dark")) options.background = dual::night;
  return options;
}

int run_render(const Command& self, std::span<const std::string> arguments) {
  const auto session = start(self, arguments, grammar_of_render());
  if (!session) return done;
  if (!session->has("output")) throw UsageError("-o must say where the picture goes");
  const std::filesystem::path output = session->get<std::string>("output");
  check_output(output, picture_extensions);
  const StatesRequest request = states_request(*session);
  const dual::PictureOptions options = picture_options(*session);

  const auto states = read_states(request, session->terminal);
  dual::write_png(output, dual::draw_states(states, options));
  const dual::AtomMap& map = *states.back().find(options.map);
  Result result = {.table = {{"picture", output.string()}}, .json = {{"picture", output.string()}}};
  if (map.categories.empty()) {
    dual::ColorScale scale = map.scale;
    scale.low = options.low.value_or(scale.low);
    scale.high = options.high.value_or(scale.high);
    result.table.push_back({map.title, shell::significant(scale.low, 6) + " to " +
                                           shell::significant(scale.high, 6) + ' ' + map.unit});
    result.json["scale"] = shell::scale_json(scale);
  }
  session->terminal.print(result);
  return done;
}

}  // namespace

const Command render_command = {
    .name = "render",
    .synopsis = "FILE... -o PICTURE.png [--color energy] [--style atoms|rings] [options]",
    .meaning = "Draws atoms as a picture, colored by energy and more; needs no screen",
    .run = run_render};

}  // namespace trivalent::apps
