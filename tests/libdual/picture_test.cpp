#include "trivalent/view/picture.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>

#include "flat_drawing.h"
#include "small_meshes.h"
#include "temporary_folder.h"
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

/// Pixels that are not as the background.
int inked(const Picture& picture) {
  int count = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      count += pixel(picture, x, y) != std::array<int, 3>{255, 255, 255} ? 1 : 0;
    }
  }
  return count;
}

/// What is written in black on white, in letters of 20 pixels.
Picture written(const std::string& text) {
  Picture blank = {.width = 400, .height = 60, .pixels = {}};
  blank.pixels.assign(3u * 400 * 60, 255);
  FlatDrawing drawing(blank);
  drawing.set_letters(20.0);
  drawing.write(text, 10.0, 40.0, {0, 0, 0});
  return drawing.picture();
}

TEST(FlatDrawing, WritesOnTheBaseline) {
  const Picture picture = written("H");
  int top = picture.height;
  int bottom = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (pixel(picture, x, y)[0] > 127) continue;
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
  }
  EXPECT_NEAR(top, 20, 1);
  EXPECT_NEAR(bottom, 39, 1);
}

TEST(FlatDrawing, WritesAnyText) {
  for (const char* text : {"energy [eV]", "Å", "−7.39", "20°", "broken \xff\xfe"}) {
    EXPECT_GT(inked(written(text)), 20) << text;
  }
  EXPECT_EQ(inked(written("")), 0);
}

TEST(FlatDrawing, FillsWithTheColorsOfAScale) {
  Picture blank = {.width = 101, .height = 10, .pixels = {}};
  blank.pixels.assign(3u * 101 * 10, 255);
  const ColorScale scale = {
      .low = 0.0, .high = 1.0, .colors = {{255, 0, 0}, {0, 0, 0}, {0, 0, 255}}};
  FlatDrawing drawing(blank);
  drawing.fill({.left = 0.0, .top = 0.0, .width = 101.0, .height = 5.0}, scale);
  const Picture picture = drawing.picture();
  for (int x = 0; x < picture.width; ++x) {
    const Color wanted = scale.color((x + 0.5) / 101.0);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(pixel(picture, x, 2)[channel], wanted[channel], 3) << x;
    }
    EXPECT_EQ(pixel(picture, x, 7), (std::array<int, 3>{255, 255, 255}));
  }
}

TEST(WritePng, WritesAFileThatStartsAsAPng) {
  const testing_support::TemporaryFolder folder;
  const auto path = folder.path() / "a.png";
  write_png(path, written("text"));
  std::ifstream in(path, std::ios::binary);
  std::string start(8, ' ');
  in.read(start.data(), 8);
  EXPECT_EQ(start, "\x89PNG\r\n\x1a\n");
  EXPECT_THROW(write_png("/nonexistent/a.png", written("text")), FileError);
}

}  // namespace
}  // namespace trivalent::dual
