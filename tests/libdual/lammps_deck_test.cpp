#include "trivalent/formats/lammps_deck.h"

#include <gtest/gtest.h>

#include <functional>
#include <sstream>

namespace trivalent::dual {
namespace {

using WriteDeck = std::function<void(std::ostream&, const LammpsDeckOptions&)>;

const std::vector<WriteDeck>& all_decks() {
  static const std::vector<WriteDeck> decks = {
      write_lammps_check, write_lammps_relaxation, write_lammps_dynamics,
      [](std::ostream& out, const LammpsDeckOptions& options) {
        write_lammps_minimization(out, options, {});
      }};
  return decks;
}

std::string text_of(const WriteDeck& write, const LammpsDeckOptions& options) {
  std::ostringstream out;
  write(out, options);
  return out.str();
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(LammpsDeck, KeepsForcesBetweenBondedAtoms) {
  for (const WriteDeck& write : all_decks()) {
    const std::string deck =
        text_of(write, {.data_files = {"a.data"}, .style = AtomStyle::molecular});
    EXPECT_TRUE(has(deck, "special_bonds lj/coul 1.0 1.0 1.0\nbond_style   zero\n"));
    EXPECT_FALSE(has(text_of(write, {.data_files = {"a.data"}}), "bond_"));
  }
}

TEST(LammpsDeck, ReadsTheOneDataFileOrAllParts) {
  for (const WriteDeck& write : all_decks()) {
    EXPECT_TRUE(has(text_of(write, {.data_files = {"a.data"}}), "data index a.data\n"));
    EXPECT_TRUE(has(text_of(write, {.data_files = {"a.1.data", "a.2.data"}}),
                    "read_data    a.1.data\nread_data    a.2.data add merge\n"));
  }
}

TEST(LammpsDeck, KnowsPeriodicDirectionsAndElements) {
  const LammpsDeckOptions options = {
      .data_files = {"a.data"}, .periodic = {true, true, false}, .has_hydrogen = true};
  for (const WriteDeck& write : all_decks()) {
    const std::string deck = text_of(write, options);
    EXPECT_TRUE(has(deck, "boundary     p p m\n"));
    EXPECT_TRUE(has(deck, "${potential} C H\n"));
  }
}

TEST(LammpsDeck, TakesAnyPairStyle) {
  const LammpsDeckOptions options = {
      .data_files = {"a.data"},
      .pair_style =
          PairStyle{.style = "hybrid/overlay lcbop tersoff",
                    .coefficients = {"* * lcbop C.lcbop C", "* * tersoff BNC.tersoff C"}}};
  for (const WriteDeck& write : all_decks()) {
    const std::string deck = text_of(write, options);
    EXPECT_TRUE(has(deck,
                    "pair_style   hybrid/overlay lcbop tersoff\npair_coeff   * * lcbop C.lcbop C\n"
                    "pair_coeff   * * tersoff BNC.tersoff C\n"));
    EXPECT_FALSE(has(deck, "rebo"));
    for (const std::string bad : {"", "a $b", "a \"b\"", "a\nquit", "a # b", "a & b"}) {
      LammpsDeckOptions other = options;
      other.pair_style->coefficients = {bad};
      EXPECT_THROW(text_of(write, other), InvalidOption) << bad;
    }
  }
}

TEST(LammpsDeck, ThrowsWithoutDataFile) {
  for (const WriteDeck& write : all_decks()) EXPECT_THROW(text_of(write, {}), InvalidOption);
}

TEST(LammpsDeck, ThrowsOnFileNamesThatLammpsCannotRead) {
  for (const std::string name : {"", "a\"b", "a$b", "a\nb", "a b"}) {
    for (const WriteDeck& write : all_decks()) {
      EXPECT_THROW(text_of(write, {.data_files = {name}}), InvalidOption) << name;
      EXPECT_THROW(text_of(write, {.data_files = {"a.data"}, .potential_file = name}),
                   InvalidOption)
          << name;
    }
  }
}

}  // namespace
}  // namespace trivalent::dual
