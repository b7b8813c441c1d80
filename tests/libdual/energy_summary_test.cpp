#include "trivalent/dual/energy_summary.h"

#include <gtest/gtest.h>

namespace trivalent::dual {
namespace {

TEST(SummarizeEnergies, AddsUpAndFindsTheWorst) {
  const std::vector<double> energies = {-7.0, -5.0, -6.0, -5.0, -8.0};
  const EnergySummary summary = summarize_energies(energies, 3);
  EXPECT_EQ(summary.total, -31.0);
  EXPECT_EQ(summary.mean, -6.2);
  EXPECT_EQ(summary.lowest, -8.0);
  EXPECT_EQ(summary.highest, -5.0);
  EXPECT_EQ(summary.worst, (std::vector<int>{1, 3, 2}));
  EXPECT_NEAR(summary.excess(), graphene_energy * -1 - 6.2, 1e-14);
}

TEST(SummarizeEnergies, ListsNoMoreAtomsThanThereAre) {
  EXPECT_EQ(summarize_energies(std::vector<double>{1.0, 2.0}, 10).worst, (std::vector<int>{1, 0}));
  EXPECT_TRUE(summarize_energies({}, 10).worst.empty());
  EXPECT_EQ(summarize_energies({}, 10).mean, 0.0);
}

}  // namespace
}  // namespace trivalent::dual
