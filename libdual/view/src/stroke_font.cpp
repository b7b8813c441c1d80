#include "stroke_font.h"

#include <algorithm>
#include <cstdint>

namespace trivalent::dual {
namespace {

/// Strokes of a character: words of two letters per point, x and y, on a grid where 4 is the
/// baseline, c the height of small letters and g that of capitals. A word that begins with ~ is
/// bent into a curve.
struct Glyph {
  char32_t character;
  std::string_view strokes;
};

constexpr Glyph glyphs[] = {{U' ', ""},
                            {U'!', "1g19 1415"},
                            {U'"', "0g0d 3g3d"},
                            {U'#', "1424 2g04 6g44 0878 0c8c"},
                            {U'$', "~7e7g0g0a7a740406 3i32"},
                            {U'%', "~0b3b3g0g0b 047g ~4474794944"},
                            {U'&', "~840c0g5g5c0a04644 ~64848a"},
                            {U'\'', "0g0d"},
                            {U'(', "~3h0f0433"},
                            {U')', "~0h3f3403"},
                            {U'*', "4g48 0e8a 8e0a"},
                            {U'+', "0a8a 4e46"},
                            {U',', "1512"},
                            {U'-', "0a5a"},
                            {U'.', "1415"},
                            {U'/', "026g"},
                            {U'0', "~04848g0g04"},
                            {U'1', "0d3g34 0464"},
                            {U'2', "~0d0g8g8b04 0484"},
                            {U'3', "~0f0g8g8a3a ~3a8a840405"},
                            {U'4', "646g0888"},
                            {U'5', "7g0g0b ~0b8d840405"},
                            {U'6', "~7g0g04848b0b08"},
                            {U'7', "0g8g34"},
                            {U'8', "~1a7a7g1g1a ~04848a0a04"},
                            {U'9', "~14848g0g098989"},
                            {U':', "1415 1b1a"},
                            {U';', "1512 1b1a"},
                            {U'<', "7e0a76"},
                            {U'=', "0c7c 0878"},
                            {U'>', "0e7a06"},
                            {U'?', "~0e0g7g7b3b39 3435"},
                            {U'@', "~84040g8g86565c8c"},
                            {U'A', "044g84 1979"},
                            {U'B', "040g ~0g7g7a0a ~0a8a8404"},
                            {U'C', "~8d8g0g048487"},
                            {U'D', "040g ~0g3g9g94040404"},
                            {U'E', "8g0g0484 0a6a"},
                            {U'F', "8g0g04 0a6a"},
                            {U'G', "~8d8g0g048489 8949"},
                            {U'H', "0g04 8g84 0a8a"},
                            {U'I', "1g14"},
                            {U'J', "~6g640407"},
                            {U'K', "0g04 8g09 2b84"},
                            {U'L', "0g0484"},
                            {U'M', "040g58aga4"},
                            {U'N', "040g848g"},
                            {U'O', "~04949g0g04"},
                            {U'P', "040g ~0g8g8909"},
                            {U'Q', "~04949g0g04 5894"},
                            {U'R', "040g ~0g8g8909 4984"},
                            {U'S', "~8e8g0g0a8a840406"},
                            {U'T', "0g8g 4g44"},
                            {U'U', "~0g04848g"},
                            {U'V', "0g448g"},
                            {U'W', "0g245e84ag"},
                            {U'X', "0g84 8g04"},
                            {U'Y', "0g4a8g 4a44"},
                            {U'Z', "0g8g0484"},
                            {U'[', "3h0h0232"},
                            {U'\\', "0g62"},
                            {U']', "0h3h3202"},
                            {U'^', "0c4g8c"},
                            {U'_', "0282"},
                            {U'`', "0g2d"},
                            {U'a', "~04747c0c04 7c74"},
                            {U'b', "0g04 ~04747c0c04"},
                            {U'c', "~7a7c0c047476"},
                            {U'd', "7g74 ~04747c0c04"},
                            {U'e', "0878 ~787c0c047475"},
                            {U'f', "~5g2g2b24 0c5c"},
                            {U'g', "7c72 ~7270000001 ~04747c0c04"},
                            {U'h', "0g04 ~090c7c74"},
                            {U'i', "1c14 1f1g"},
                            {U'j', "~2c2000 2f2g"},
                            {U'k', "0g04 6c07 2974"},
                            {U'l', "1g14"},
                            {U'm', "0c04 ~090c5c54 ~595cacacaca4"},
                            {U'n', "0c04 ~090c7c74"},
                            {U'o', "~04747c0c04"},
                            {U'p', "0c00 ~04747c0c04"},
                            {U'q', "7c70 ~04747c0c04"},
                            {U'r', "0c04 ~080c5c5b"},
                            {U's', "~6b6c0c086864040505"},
                            {U't', "~2f2454 0c5c"},
                            {U'u', "~0c047478 7c74"},
                            {U'v', "0c347c"},
                            {U'w', "0c244b648c"},
                            {U'x', "0c64 6c04"},
                            {U'y', "0c34 6c10"},
                            {U'z', "0c6c0464"},
                            {U'{', "~4h2h2a0a ~0a2a2242"},
                            {U'|', "1h12"},
                            {U'}', "~0h2h2a4a ~4a2a2202"},
                            {U'~', "~090c4c49797c"},
                            {U'°', "~0c4c4g0g0c"},
                            {U'−', "0a8a"},
                            {U'Å', "044g84 1979 ~3g5g5k3k3g"}};

constexpr std::string_view unknown = "040g8g8404";
constexpr double baseline = 4.0;
constexpr double capital = 12.0;  // from the baseline
constexpr double gap = 3.6;       // between characters
constexpr double blank = 5.0;

/// The character that begins at a byte of UTF-8, and the byte after it.
char32_t next_character(std::string_view text, std::size_t& at) {
  const auto lead = static_cast<unsigned char>(text[at++]);
  if (lead < 0x80) return lead;
  const int n_more = lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : lead >= 0xc0 ? 1 : 0;
  char32_t character = lead & (0x3fu >> n_more);
  for (int i = 0; i < n_more && at < text.size(); ++i, ++at) {
    character = character << 6 | (static_cast<unsigned char>(text[at]) & 0x3fu);
  }
  return character;
}

std::string_view strokes_of(char32_t character) {
  for (const Glyph& glyph : glyphs) {
    if (glyph.character == character) return glyph.strokes;
  }
  return unknown;
}

double grid_value(char letter) { return letter >= 'a' ? letter - 'a' + 10 : letter - '0'; }

/// Cuts the corners of a line, again and again, until it is a curve [Chaikin1974].
Polyline bent(const Polyline& line) {
  constexpr int rounds = 4;
  Polyline curve = line;
  const bool is_closed = line.size() > 2 && line.front() == line.back();
  for (int round = 0; round < rounds; ++round) {
    Polyline cut;
    if (!is_closed) cut.push_back(curve.front());
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
      cut.push_back(0.75 * curve[i] + 0.25 * curve[i + 1]);
      cut.push_back(0.25 * curve[i] + 0.75 * curve[i + 1]);
    }
    cut.push_back(is_closed ? cut.front() : curve.back());
    curve = std::move(cut);
  }
  return curve;
}

Polyline stroke_of(std::string_view word) {
  const bool is_curve = word.front() == '~';
  Polyline line;
  for (std::size_t i = is_curve ? 1 : 0; i + 1 < word.size(); i += 2) {
    line.emplace_back(grid_value(word[i]), grid_value(word[i + 1]) - baseline);
  }
  return is_curve ? bent(line) : line;
}

std::vector<Polyline> strokes_of_words(std::string_view words) {
  std::vector<Polyline> strokes;
  while (!words.empty()) {
    const std::size_t end = std::min(words.find(' '), words.size());
    strokes.push_back(stroke_of(words.substr(0, end)));
    words.remove_prefix(std::min(end + 1, words.size()));
  }
  return strokes;
}

}  // namespace

StrokedText stroke_text(std::string_view text) {
  StrokedText result;
  double x = 0.0;
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view words = strokes_of(next_character(text, at));
    double width = 0.0;
    for (Polyline& stroke : strokes_of_words(words)) {
      for (Eigen::Vector2d& point : stroke) {
        width = std::max(width, point.x());
        point = (point + Eigen::Vector2d(x, 0.0)) / capital;
      }
      result.strokes.push_back(std::move(stroke));
    }
    x += (words.empty() ? blank : width) + gap;
  }
  result.width = std::max(0.0, x - gap) / capital;
  return result;
}

}  // namespace trivalent::dual
