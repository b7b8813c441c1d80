#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <string>

#include "io/mesh_readers.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

/// Statements that say nothing about the shape of a polygon mesh.
constexpr std::array unneeded = {
    "vt",     "vn",     "g",     "o",        "s",        "mg",  "usemtl",     "mtllib",
    "usemap", "maplib", "bevel", "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj"};

class ObjReader {
 public:
  explicit ObjReader(const Source& source)
      : source_(source), scanner_(source, Continuation::backslash) {}

  PolygonSoup run() {
    while (scanner_.next_line()) {
      read_statement(scanner_.word());
      scanner_.skip_rest_of_line();
    }
    check_corners();
    for (const auto& [keyword, count] : ignored_) {
      soup_.notes.push_back(concat("ignored ", counted(count, "statement"), ' ', keyword));
    }
    return std::move(soup_);
  }

 private:
  void read_statement(std::string_view keyword) {
    if (keyword == "v") {
      // A weight or a color may follow.
      soup_.points.push_back(scanner_.position(soup_.points.size(), 1));
    } else if (keyword == "f" || keyword == "fo") {
      read_face();
    } else if (std::find(unneeded.begin(), unneeded.end(), keyword) == unneeded.end()) {
      count_ignored(in_quotes(keyword));
    }
  }

  void count_ignored(const std::string& keyword) {
    constexpr std::size_t max_kinds = 10;
    const bool is_known = ignored_.count(keyword) > 0 || ignored_.size() < max_kinds;
    ++ignored_[is_known ? keyword : "of other kinds"];
  }

  void read_face() {
    for (std::string_view corner = scanner_.word(); !corner.empty(); corner = scanner_.word()) {
      // Of vertex/texture/normal only the vertex matters.
      const auto index = parse_integer(corner.substr(0, corner.find('/')));
      if (!index || *index == 0)
        scanner_.fail(concat(in_quotes(corner), " is no corner of a face"));
      const auto points = static_cast<std::int64_t>(soup_.points.size());
      // From 1, or backwards from the last vertex so far.
      const std::int64_t v = *index > 0 ? *index - 1 : points + *index;
      if (v < 0 || v > std::numeric_limits<int>::max()) {
        scanner_.fail(
            concat("a face refers to vertex ", *index, ", but so far there are ", points));
      }
      soup_.corners.push_back(static_cast<int>(v));
    }
    soup_.ends.push_back(soup_.corners.size());
  }

  /// At the end, because faces may come before their vertices.
  void check_corners() const {
    for (std::size_t i = 0; i < soup_.ends.size(); ++i) {
      for (const int v : soup_.polygon(i)) {
        if (static_cast<std::size_t>(v) < soup_.points.size()) continue;
        fail(source_, concat("face ", i + 1, " refers to vertex ", v + std::int64_t{1}, " of ",
                             soup_.points.size(), " (counted from 1)"));
      }
    }
  }

  const Source& source_;
  TextScanner scanner_;
  PolygonSoup soup_;
  std::map<std::string, std::size_t> ignored_;
};

}  // namespace

PolygonSoup read_obj(const Source& source) { return ObjReader(source).run(); }

}  // namespace trivalent::remesh
