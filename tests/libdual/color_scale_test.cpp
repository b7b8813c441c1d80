#include "trivalent/view/color_scale.h"

#include <gtest/gtest.h>

#include <cmath>

namespace trivalent::dual {
namespace {

int brightness(const Color& color) { return color[0] + color[1] + color[2]; }

TEST(DivergingScale, IsWhiteAtTheCenterAndDarkensToBothSides) {
  const ColorScale scale = diverging_scale(std::vector<double>{-7.5, -6.5}, -7.0);
  EXPECT_EQ(scale.color(-7.0), (Color{247, 247, 247}));
  EXPECT_GT(scale.color(-7.3)[2], scale.color(-7.3)[0]);  // blue below
  EXPECT_GT(scale.color(-6.7)[0], scale.color(-6.7)[2]);  // red above
  for (double step = 0.0; step < 0.45; step += 0.05) {
    EXPECT_GT(brightness(scale.color(-7.0 + step)), brightness(scale.color(-7.0 + step + 0.05)));
    EXPECT_GT(brightness(scale.color(-7.0 - step)), brightness(scale.color(-7.0 - step - 0.05)));
  }
  EXPECT_EQ(scale.color(0.0), scale.color(-6.5));
  EXPECT_EQ(scale.color(-100.0), scale.color(-7.5));
}

TEST(DivergingScale, IgnoresAFewOutliers) {
  std::vector<double> energies(1000, -7.0);
  energies[5] = 1e6;
  energies[6] = -6.0;
  for (int i = 100; i < 200; ++i) energies[i] = -6.8;
  const ColorScale scale = diverging_scale(energies, -7.4);
  EXPECT_NEAR(scale.middle(), -7.4, 1e-12);
  EXPECT_NEAR(scale.high, -6.8, 1e-12);
}

TEST(SequentialScale, GetsLighterAllTheWayUp) {
  const ColorScale scale = sequential_scale(std::vector<double>{0.0, 2.0}, 0.0);
  EXPECT_EQ(scale.high, 2.0);
  for (double value = 0.0; value < 1.95; value += 0.05) {
    // Weights of red, green and blue in what the eye takes for light [ITU-R BT.709].
    const auto light = [](const Color& c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; };
    EXPECT_LT(light(scale.color(value)), light(scale.color(value + 0.05)) + 0.6) << value;
  }
}

TEST(ColorScales, HaveAWidthForEqualOrNoValues) {
  for (const std::vector<double>& values :
       {std::vector<double>{}, {-7.0, -7.0}, {std::nan(""), std::nan("")}}) {
    for (const ColorScale& scale :
         {diverging_scale(values, -7.0), sequential_scale(values, -7.0)}) {
      EXPECT_GT(scale.high, scale.low);
    }
  }
}

TEST(ColorScales, ThrowOnInfiniteValues) {
  EXPECT_THROW(static_cast<void>(diverging_scale(std::vector<double>{HUGE_VAL}, 0.0)),
               InvalidOption);
  EXPECT_THROW(static_cast<void>(sequential_scale(std::vector<double>{1.0}, NAN)), InvalidOption);
}

}  // namespace
}  // namespace trivalent::dual
