#include "trivalent/view/picture.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "picture/stroke_font.h"
#include "small_meshes.h"
#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/dual_size.h"

namespace trivalent::dual {
namespace {

ShellState shell_with_energies(double low, double high) {
  remesh::TriMesh mesh = testing_support::icosahedron();
  remesh::scale(mesh, scale_for_size(mesh, MeanBond{1.42}));
  ShellState state = shell_state("C20", build_dual(mesh));
  std::vector<double> energies;
  for (const Eigen::Vector3d& position : state.structure.atoms.positions) {
    energies.push_back(position.x() < 0.0 ? low : high);
  }
  add_energies(state, energies, -7.0);
  return state;
}

PictureOptions small_picture(const std::string& map = "energy") {
  PictureOptions options;
  options.width = 300;
  options.height = 240;
  options.azimuth = 0.0;
  options.elevation = 0.0;
  options.map = map;
  return options;
}

Picture draw(const ShellState& state, const PictureOptions& options) {
  return draw_states(std::span(&state, 1), options);
}

std::array<int, 3> pixel(const Picture& picture, int x, int y) {
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * picture.width + x);
  return {picture.pixels[at], picture.pixels[at + 1], picture.pixels[at + 2]};
}

/// Sum over a part of the picture of how much more red than blue it is.
double redness(const Picture& picture, int left, int right) {
  double sum = 0.0;
  for (int y = 0; y < picture.height * 3 / 4; ++y) {
    for (int x = left; x < right; ++x) sum += pixel(picture, x, y)[0] - pixel(picture, x, y)[2];
  }
  return sum;
}

TEST(DrawStates, ColorsAtomsByTheirEnergy) {
  const Picture picture = draw(shell_with_energies(-8.0, -6.0), small_picture());
  ASSERT_EQ(picture.pixels.size(), 3u * 300 * 240);
  EXPECT_LT(redness(picture, 0, 120), -1000.0);  // blue: below the center
  EXPECT_GT(redness(picture, 180, 300), 1000.0);
  EXPECT_EQ(pixel(picture, 0, 0), (std::array<int, 3>{255, 255, 255}));
}

TEST(DrawStates, TurnsTheShell) {
  PictureOptions options = small_picture();
  options.azimuth = 180.0;
  const Picture picture = draw(shell_with_energies(-8.0, -6.0), options);
  EXPECT_GT(redness(picture, 0, 120), 1000.0);
  EXPECT_LT(redness(picture, 180, 300), -1000.0);
}

TEST(DrawStates, IsTheSameEveryTime) {
  const ShellState state = shell_with_energies(-8.0, -6.0);
  EXPECT_EQ(draw(state, small_picture()).pixels, draw(state, small_picture()).pixels);
}

TEST(DrawStates, FillsTheSurfaceWithRings) {
  PictureOptions options = small_picture("ring_size");
  options.style = PictureStyle::rings;
  const Picture picture = draw(shell_with_energies(-8.0, -6.0), options);
  // All rings are pentagons, which are blue; the middle is covered by them.
  const auto [red, green, blue] = pixel(picture, 150, 100);
  EXPECT_GT(blue, red + 30);
}

TEST(DrawStates, TakesTheScaleOfTheLastStateForAll) {
  // Alone, the first would span its own energies; beside the second, all of it is beyond the end.
  const std::vector<ShellState> states = {shell_with_energies(-4.0, -3.0),
                                          shell_with_energies(-7.2, -6.8)};
  const Picture both = draw_states(states, small_picture());
  EXPECT_GT(redness(both, 0, 75), 300.0);
  EXPECT_GT(redness(both, 75, 150), 300.0);
}

TEST(DrawStates, ThrowsOnOptionsThatMakeNoSense) {
  const ShellState state = shell_with_energies(-8.0, -6.0);
  PictureOptions options = small_picture("color");
  EXPECT_THROW(static_cast<void>(draw(state, options)), InvalidOption);
  options = small_picture();
  options.width = 99;
  EXPECT_THROW(static_cast<void>(draw(state, options)), InvalidOption);
  options = small_picture();
  options.zoom = 0.0;
  EXPECT_THROW(static_cast<void>(draw(state, options)), InvalidOption);
  options = small_picture();
  options.low = 1.0;
  options.high = 1.0;
  EXPECT_THROW(static_cast<void>(draw(state, options)), InvalidOption);
  EXPECT_THROW(static_cast<void>(draw_states({}, small_picture())), InvalidNetwork);
}

TEST(StrokeText, WritesOnTheBaseline) {
  for (const char* text : {"A", "energy [eV]", "Å", "−7.39", "20°", "\xff\xfe", ""}) {
    const StrokedText strokes = stroke_text(text);
    for (const Polyline& stroke : strokes.strokes) {
      for (const Eigen::Vector2d& point : stroke) {
        EXPECT_GE(point.x(), 0.0) << text;
        EXPECT_LE(point.x(), strokes.width + 1e-9) << text;
        EXPECT_GE(point.y(), -0.35) << text;
        EXPECT_LE(point.y(), 1.35) << text;
      }
    }
  }
  EXPECT_GT(stroke_text("WWW").width, stroke_text("iii").width);
  EXPECT_EQ(stroke_text("Å").strokes.size(), 3u);
}

TEST(StrokeText, KnowsAllOfAscii) {
  const auto box = stroke_text("\xc3\xbf").strokes;
  for (char c = '!'; c <= '~'; ++c) {
    const auto strokes = stroke_text(std::string(1, c)).strokes;
    EXPECT_FALSE(strokes.empty()) << c;
    EXPECT_NE(strokes, box) << c;
  }
}

}  // namespace
}  // namespace trivalent::dual
