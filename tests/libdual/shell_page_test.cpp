#include "trivalent/view/shell_page.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "packed_integers.h"
#include "small_meshes.h"
#include "temporary_folder.h"
#include "trivalent/dual/build_dual.h"

namespace trivalent::dual {
namespace {

constexpr std::string_view viewer = "<html><!--shell-data--></html>";

ShellState small_state() {
  ShellState state = shell_state("C20", build_dual(testing_support::icosahedron()));
  add_energies(state, std::vector<double>(20, -6.0), -7.0);
  return state;
}

std::string page_text(const ShellPage& page) {
  std::ostringstream out;
  write_shell_page(out, page, viewer);
  return out.str();
}

std::string value_of(const std::string& json, const std::string& key) {
  const std::size_t at = json.find("\"" + key + "\":") + key.size() + 3;
  const bool is_text = json[at] == '"';
  return is_text ? json.substr(at + 1, json.find('"', at + 1) - at - 1)
                 : json.substr(at, json.find_first_of(",}", at) - at);
}

std::vector<unsigned char> from_base64(const std::string& text) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> bytes;
  for (std::size_t i = 0; i < text.size(); i += 4) {
    unsigned word = 0;
    int n = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const bool is_filler = text[i + k] == '=';
      word = word << 6 | (is_filler ? 0u : static_cast<unsigned>(letters.find(text[i + k])));
      n += is_filler ? 0 : 1;
    }
    for (int k = 0; k < n - 1; ++k)
      bytes.push_back(static_cast<unsigned char>(word >> (16 - 8 * k)));
  }
  return bytes;
}

/// What the page does, written once more.
std::vector<std::int32_t> unpacked(const std::string& json) {
  const std::size_t count = std::stoul(value_of(json, "count"));
  const std::size_t stride = std::stoul(value_of(json, "stride"));
  const std::size_t planes = std::stoul(value_of(json, "bytes"));
  const auto packed = from_base64(value_of(json, "data"));
  std::vector<unsigned char> bytes(count * planes + 1);
  uLongf size = bytes.size();
  EXPECT_EQ(uncompress(bytes.data(), &size, packed.data(), packed.size()), Z_OK);
  EXPECT_EQ(size, count * planes);
  std::vector<std::int32_t> values;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t word = 0;
    for (std::size_t p = 0; p < planes; ++p) word |= std::uint32_t{bytes[p * count + i]} << (8 * p);
    std::uint32_t value = (word >> 1) ^ (0u - (word & 1u));
    if (stride > 0 && i >= stride) value += static_cast<std::uint32_t>(values[i - stride]);
    values.push_back(static_cast<std::int32_t>(value));
  }
  return values;
}

TEST(Base64, EncodesTheExamplesOfItsStandard) {
  const auto encoded = [](const std::string& text) {
    return base64(std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()));
  };
  // [RFC 4648, section 10]
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

TEST(PackedIntegers, UnpackToTheSame) {
  using Limits = std::numeric_limits<std::int32_t>;
  const std::vector<std::vector<std::int32_t>> lists = {
      {},
      {0},
      {-1},
      {1, 2, 3, -4, 500, -70000, 8000000},
      {Limits::max(), Limits::min(), 0, Limits::min(), Limits::max(), 7}};
  for (const auto& values : lists) {
    for (const std::size_t stride : {0, 1, 3}) {
      EXPECT_EQ(unpacked(packed_integers(values, stride).dump()), values);
    }
  }
}

TEST(WriteShellPage, PutsTheDataInTheirPlace) {
  const std::string text = page_text({.title = "a shell", .states = {small_state()}});
  EXPECT_TRUE(text.starts_with("<html><script type=\"application/json\" id=\"shell-data\">{"));
  EXPECT_TRUE(text.ends_with("}</script></html>"));
  const std::string species = text.substr(text.find("\"species\":"));
  EXPECT_EQ(unpacked(species), std::vector<std::int32_t>(20, 6));
}

TEST(WriteShellPage, LetsNoTextBecomeMarkup) {
  const std::string evil = "</script><img src=x onerror=\"alert('1')\">&\\\n";
  ShellState state = small_state();
  state.name = evil;
  const std::string text = page_text({.title = evil,
                                      .states = {state},
                                      .notes = {evil},
                                      .parameters = {{evil, evil}},
                                      .results = {{evil, evil}}});
  const std::string data = text.substr(viewer.find("<!--"));
  EXPECT_EQ(data.find("<img"), std::string::npos);
  EXPECT_EQ(data.find("</script>"), data.rfind("</script>"));
  EXPECT_NE(data.find("\\u003cimg src=x"), std::string::npos);
}

TEST(WriteShellPage, KeepsTheOrderOfStatesAndTheScaleOfTheLast) {
  ShellState last = small_state();
  last.name = "last";
  add_energies(last, std::vector<double>(20, -6.5), -7.0);
  last.maps.erase(last.maps.begin() + 2, last.maps.begin() + 4);
  const std::string text = page_text({.title = "", .states = {small_state(), last}});
  EXPECT_LT(text.find("\"C20\""), text.find("\"last\""));
  const std::string high = "\"high\":-6.5,";
  EXPECT_NE(text.find(high), text.rfind(high));  // in both states
}

TEST(WriteShellPage, ShowsASampleOfManyAtomsAndTheWorst) {
  const std::size_t many = max_page_atoms + 500000;
  ShellState state = {.name = "gas", .structure = {}, .maps = {}};
  std::vector<double> energies(many, -1.0);
  const std::size_t worst = 1000003;
  energies[worst] = 5.0;
  for (std::size_t i = 0; i < many; ++i) {
    state.structure.atoms.positions.emplace_back(static_cast<double>(i % 1000),
                                                 static_cast<double>(i / 1000), 0);
  }
  state.structure.atoms.species.assign(many, potentials::Species::carbon);
  add_energies(state, energies, 0.0);
  const std::string text = page_text({.title = "", .states = {state}});
  const auto sample = unpacked(text.substr(text.find("\"sample\":")));
  EXPECT_GE(sample.size(), max_page_atoms);
  EXPECT_LT(sample.size(), max_page_atoms + 200);
  EXPECT_TRUE(std::is_sorted(sample.begin(), sample.end()));
  EXPECT_TRUE(std::binary_search(sample.begin(), sample.end(), static_cast<std::int32_t>(worst)));
  EXPECT_NE(text.find("\"total_atoms\":1500000"), std::string::npos);
}

TEST(WriteShellPage, ThrowsOnWhatCannotBeShown) {
  EXPECT_THROW(page_text({.title = "", .states = {}}), InvalidNetwork);
  ShellState broken = small_state();
  broken.structure.atoms.positions[3].x() = std::nan("");
  EXPECT_THROW(page_text({.title = "", .states = {broken}}), InvalidNetwork);
  broken = small_state();
  broken.maps.front().values.pop_back();
  EXPECT_THROW(page_text({.title = "", .states = {broken}}), InvalidNetwork);
  std::ostringstream out;
  EXPECT_THROW(write_shell_page(out, {.title = "", .states = {small_state()}}, "<html></html>"),
               InvalidOption);
  EXPECT_THROW(
      write_shell_page("/nonexistent/a.html", {.title = "", .states = {small_state()}}, viewer),
      FileError);
}

}  // namespace
}  // namespace trivalent::dual
