#include "trivalent/remesh/shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "sources/implicit_surface.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

using std::numbers::pi;

/// Area of the equilateral triangle of edge 1, and its height.
constexpr double unit_triangle_area = 0.43301270189221932;
constexpr double unit_triangle_height = 0.86602540378443865;

/// Beyond this a mesh and its neighbor tables no longer fit a large workstation.
constexpr double most_faces = 2e8;

/// Values of one shape's parameters, and the wanted edge length.
struct Request {
  std::string_view shape;
  std::map<std::string, double, std::less<>> values;
  double edge_length = 0.0;

  [[nodiscard]] double at(std::string_view name) const { return values.find(name)->second; }
};

void check_positive(const Request& request, std::initializer_list<std::string_view> names) {
  for (const auto name : names) {
    if (request.at(name) > 0.0) continue;
    throw InvalidOption(concat("make_shape: ", request.shape, ": ", name, " must be > 0, but is ",
                               request.at(name)));
  }
}

void check_face_count(const Request& request, double area) {
  const double faces = area / (unit_triangle_area * request.edge_length * request.edge_length);
  if (faces <= most_faces) return;
  throw InvalidOption(concat("make_shape: ", request.shape, " with edges of ", request.edge_length,
                             " would have about ", faces, " faces, more than ", most_faces,
                             "; take longer edges"));
}

/// Number of pieces that divide `length` into about `wanted`; at least `fewest`, or it throws.
int pieces(const Request& request, double length, double wanted, int fewest) {
  const double count = std::round(length / wanted);
  if (count >= fewest) return static_cast<int>(count);
  throw InvalidOption(concat("make_shape: edges of ", request.edge_length,
                             " are too long for this ", request.shape, "; take shorter ones"));
}

// ---- subdivided icosahedron --------------------------------------------------------------------

struct Triangles {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> corners;
};

Triangles icosahedron() {
  constexpr double g = std::numbers::phi;
  return {{{-1, g, 0},
           {1, g, 0},
           {-1, -g, 0},
           {1, -g, 0},
           {0, -1, g},
           {0, 1, g},
           {0, -1, -g},
           {0, 1, -g},
           {g, 0, -1},
           {g, 0, 1},
           {-g, 0, -1},
           {-g, 0, 1}},
          {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
           {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
           {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
}

/// Divides every edge of a triangle mesh into `frequency` parts and every face into frequency².
class Subdivision {
 public:
  Subdivision(const Triangles& coarse, int frequency) : coarse_(coarse), frequency_(frequency) {
    fine_.points = coarse.points;
    for (const auto& corners : coarse.corners) divide(corners);
  }
  [[nodiscard]] const Triangles& result() const { return fine_; }

 private:
  [[nodiscard]] Eigen::Vector3d corner(int v) const {
    return coarse_.points[static_cast<std::size_t>(v)];
  }

  int add_point(const Eigen::Vector3d& p) {
    fine_.points.push_back(p);
    return static_cast<int>(fine_.points.size()) - 1;
  }

  /// The vertex at k/frequency of the way from a to b.
  int on_edge(int a, int b, int k) {
    if (k == 0) return a;
    if (k == frequency_) return b;
    if (a > b) return on_edge(b, a, frequency_ - k);
    const auto [found, is_new] = first_on_edge_.try_emplace({a, b}, fine_.points.size());
    if (is_new) {
      for (int i = 1; i < frequency_; ++i)
        add_point(corner(a) + (corner(b) - corner(a)) * i / frequency_);
    }
    return static_cast<int>(found->second) + k - 1;
  }

  /// Vertices of the face in row `row` (0 at corner a, parallel to bc).
  std::vector<int> row_of(const std::array<int, 3>& face, int row) {
    const auto [a, b, c] = face;
    std::vector<int> vertices = {on_edge(a, b, row)};
    if (row == 0) return vertices;
    for (int k = 1; k < row; ++k) {
      if (row == frequency_)
        vertices.push_back(on_edge(b, c, k));
      else
        vertices.push_back(add_point(corner(a) + (corner(b) - corner(a)) * row / frequency_ +
                                     (corner(c) - corner(b)) * k / frequency_));
    }
    vertices.push_back(on_edge(a, c, row));
    return vertices;
  }

  void divide(const std::array<int, 3>& face) {
    std::vector<int> above = row_of(face, 0);
    for (int row = 1; row <= frequency_; ++row) {
      const std::vector<int> below = row_of(face, row);
      for (std::size_t k = 0; k < above.size(); ++k) {
        fine_.corners.push_back({above[k], below[k], below[k + 1]});
        if (k + 1 < above.size()) fine_.corners.push_back({above[k], below[k + 1], above[k + 1]});
      }
      above = below;
    }
  }

  const Triangles& coarse_;
  int frequency_;
  Triangles fine_;
  std::map<std::pair<int, int>, std::size_t> first_on_edge_;
};

/// Geodesic subdivision of the unit sphere, stretched along the axes.
TriMesh stretched_sphere(const Request& request, const Eigen::Vector3d& radii) {
  // Thomsen's formula, within 1.1 % of an ellipsoid's area.
  const double p = 1.6075;
  const Eigen::Array3d r = radii.array().pow(p);
  const double area = 4.0 * pi * std::pow((r[0] * r[1] + r[0] * r[2] + r[1] * r[2]) / 3.0, 1.0 / p);
  check_face_count(request, area);
  const double icosahedron_edge = std::sqrt(area / (20.0 * unit_triangle_area));
  const Triangles base = icosahedron();
  const Subdivision subdivision(base, pieces(request, icosahedron_edge, request.edge_length, 1));
  Triangles fine = subdivision.result();
  for (Eigen::Vector3d& point : fine.points) point = point.normalized().cwiseProduct(radii);
  return make_mesh(fine.points, fine.corners);
}

TriMesh sphere(const Request& request) {
  check_positive(request, {"radius"});
  return stretched_sphere(request, Eigen::Vector3d::Constant(request.at("radius")));
}

TriMesh ellipsoid(const Request& request) {
  check_positive(request, {"a", "b", "c"});
  return stretched_sphere(request, {request.at("a"), request.at("b"), request.at("c")});
}

// ---- rows of vertices --------------------------------------------------------------------------

/// Vertices along a line and where they lie on it, in [0, 1] or a little beyond; a ring repeats its
/// first vertex at the end, a pole has one vertex.
struct Row {
  std::vector<int> vertices;
  std::vector<double> at;
};

/// Fills the strip between two rows, always with the diagonal that leans less.
void stitch(const Row& lower, const Row& upper, Triangles& mesh) {
  std::size_t i = 0;
  std::size_t j = 0;
  const std::size_t last_lower = lower.vertices.size() - 1;
  const std::size_t last_upper = upper.vertices.size() - 1;
  while (i < last_lower || j < last_upper) {
    const bool along_lower =
        j == last_upper || (i < last_lower && std::abs(lower.at[i + 1] - upper.at[j]) <=
                                                  std::abs(upper.at[j + 1] - lower.at[i]));
    if (along_lower) {
      mesh.corners.push_back({lower.vertices[i], lower.vertices[i + 1], upper.vertices[j]});
      ++i;
    } else {
      mesh.corners.push_back({lower.vertices[i], upper.vertices[j + 1], upper.vertices[j]});
      ++j;
    }
  }
}

/// A point of the curve that is turned around the z axis.
struct ProfilePoint {
  double radius = 0.0;
  double z = 0.0;
};

/// Every second row is shifted by half an edge, which makes the triangles nearly equilateral.
Row add_ring(const ProfilePoint& p, double edge_length, double shift, Triangles& mesh) {
  const int first = static_cast<int>(mesh.points.size());
  if (p.radius == 0.0) {
    mesh.points.emplace_back(0.0, 0.0, p.z);
    return {{first}, {0.0}};
  }
  const int count = std::max(3, static_cast<int>(std::round(2.0 * pi * p.radius / edge_length)));
  Row ring;
  for (int k = 0; k <= count; ++k) {
    const double turn = (k + shift) / count;
    ring.vertices.push_back(k == count ? first : first + k);
    ring.at.push_back(turn);
    if (k == count) continue;
    mesh.points.emplace_back(p.radius * std::cos(2.0 * pi * turn),
                             p.radius * std::sin(2.0 * pi * turn), p.z);
  }
  return ring;
}

enum class Profile { open, closed };

/// Turns a profile around the z axis; seen along the profile, the outside lies to the right.
TriMesh revolve(const std::vector<ProfilePoint>& profile, Profile kind, double edge_length) {
  Triangles mesh;
  std::vector<Row> rings;
  for (std::size_t k = 0; k < profile.size(); ++k) {
    rings.push_back(add_ring(profile[k], edge_length, k % 2 == 0 ? 0.0 : 0.5, mesh));
    if (k > 0) stitch(rings[k - 1], rings[k], mesh);
  }
  if (kind == Profile::closed) stitch(rings.back(), rings.front(), mesh);
  return make_mesh(mesh.points, mesh.corners);
}

/// Appends the points of a profile's straight piece, without its start.
void append_line(std::vector<ProfilePoint>& profile, const ProfilePoint& end, int count) {
  const ProfilePoint start = profile.back();
  for (int k = 1; k < count; ++k) {
    const double t = static_cast<double>(k) / count;
    profile.push_back(
        {start.radius + t * (end.radius - start.radius), start.z + t * (end.z - start.z)});
  }
  profile.push_back(end);
}

TriMesh torus(const Request& request) {
  check_positive(request, {"R", "r"});
  const double R = request.at("R");
  const double r = request.at("r");
  if (r >= R) {
    throw InvalidOption(concat("make_shape: torus: r = ", r, " must be smaller than R = ", R));
  }
  check_face_count(request, 4.0 * pi * pi * R * r);
  const double row_height = unit_triangle_height * request.edge_length;
  // An even number of rows, so that the shift by half an edge closes up.
  const int rows = 2 * pieces(request, pi * r, row_height, 2);
  std::vector<ProfilePoint> profile;
  for (int k = 0; k < rows; ++k) {
    const double angle = 2.0 * pi * k / rows;
    profile.push_back({R + r * std::cos(angle), r * std::sin(angle)});
  }
  return revolve(profile, Profile::closed, request.edge_length);
}

TriMesh capsule(const Request& request) {
  check_positive(request, {"radius", "length"});
  const double radius = request.at("radius");
  const double length = request.at("length");
  check_face_count(request, 2.0 * pi * radius * (2.0 * radius + length));
  const double row_height = unit_triangle_height * request.edge_length;
  const int cap_rows = pieces(request, 0.5 * pi * radius, row_height, 2);
  std::vector<ProfilePoint> profile = {{0.0, -0.5 * length - radius}};
  for (int k = 1; k <= cap_rows; ++k) {
    const double angle = 0.5 * pi * k / cap_rows;
    profile.push_back({radius * std::sin(angle), -0.5 * length - radius * std::cos(angle)});
  }
  append_line(profile, {radius, 0.5 * length}, std::max(1, pieces(request, length, row_height, 0)));
  for (int k = cap_rows - 1; k >= 0; --k) {
    profile.push_back(
        {profile[static_cast<std::size_t>(k)].radius, -profile[static_cast<std::size_t>(k)].z});
  }
  return revolve(profile, Profile::open, request.edge_length);
}

TriMesh tube(const Request& request) {
  check_positive(request, {"radius", "length"});
  const double radius = request.at("radius");
  const double length = request.at("length");
  check_face_count(request, 2.0 * pi * radius * (radius + length));
  const double row_height = unit_triangle_height * request.edge_length;
  const int cap_rows = pieces(request, radius, row_height, 1);
  std::vector<ProfilePoint> profile = {{0.0, -0.5 * length}};
  append_line(profile, {radius, -0.5 * length}, cap_rows);
  append_line(profile, {radius, 0.5 * length}, pieces(request, length, row_height, 1));
  append_line(profile, {0.0, 0.5 * length}, cap_rows);
  return revolve(profile, Profile::open, request.edge_length);
}

TriMesh open_tube(const Request& request) {
  check_positive(request, {"radius", "length"});
  const double radius = request.at("radius");
  const double length = request.at("length");
  check_face_count(request, 2.0 * pi * radius * length);
  const int around = pieces(request, 2.0 * pi * radius, request.edge_length, 3);
  std::vector<ProfilePoint> profile = {{radius, -0.5 * length}};
  append_line(profile, {radius, 0.5 * length},
              pieces(request, length, unit_triangle_height * request.edge_length, 1));
  return revolve(profile, Profile::open, 2.0 * pi * radius / around);
}

// ---- wavy sheet --------------------------------------------------------------------------------

struct Waves {
  double amplitude = 0.0;
  double wave_number = 0.0;
  [[nodiscard]] double height(double x, double y) const {
    return amplitude * std::sin(wave_number * x) * std::sin(wave_number * y);
  }
  /// Area over one wavelength squared, relative to the flat one.
  [[nodiscard]] double stretch() const {
    constexpr int samples = 64;
    double sum = 0.0;
    for (int i = 0; i < samples; ++i) {
      for (int j = 0; j < samples; ++j) {
        const double u = 2.0 * pi * (i + 0.5) / samples;
        const double v = 2.0 * pi * (j + 0.5) / samples;
        const double slope = amplitude * wave_number;
        sum +=
            std::hypot(1.0, slope * std::cos(u) * std::sin(v), slope * std::sin(u) * std::cos(v));
      }
    }
    return sum / (samples * samples);
  }
};

/// A row of the sheet; shifted rows have half an edge at both ends.
std::vector<double> sheet_row(int columns, bool shifted) {
  std::vector<double> at;
  for (int k = 0; k <= columns; ++k) at.push_back((shifted ? k - 0.5 : k) / columns);
  if (!shifted) return at;
  at.front() = 0.0;
  at.push_back(1.0);
  return at;
}

TriMesh wavy_sheet(const Request& request) {
  check_positive(request, {"width", "depth", "wavelength"});
  const double width = request.at("width");
  const double depth = request.at("depth");
  const Waves waves{request.at("amplitude"), 2.0 * pi / request.at("wavelength")};
  const double stretch = waves.stretch();
  check_face_count(request, width * depth * stretch);
  const double flat_edge = request.edge_length / std::sqrt(stretch);
  const int columns = pieces(request, width, flat_edge, 1);
  const int rows = pieces(request, depth, unit_triangle_height * flat_edge, 1);
  Triangles mesh;
  Row below;
  for (int j = 0; j <= rows; ++j) {
    Row row{{}, sheet_row(columns, j % 2 == 1)};
    const double y = depth * (static_cast<double>(j) / rows - 0.5);
    for (const double at : row.at) {
      const double x = width * (at - 0.5);
      row.vertices.push_back(static_cast<int>(mesh.points.size()));
      mesh.points.emplace_back(x, y, waves.height(x, y));
    }
    if (j > 0) stitch(below, row, mesh);
    below = std::move(row);
  }
  return make_mesh(mesh.points, mesh.corners);
}

// ---- double torus ------------------------------------------------------------------------------

double distance_to_torus(const Eigen::Vector3d& p, double R, double r) {
  return std::hypot(std::hypot(p.x(), p.y()) - R, p.z()) - r;
}

TriMesh double_torus(const Request& request) {
  check_positive(request, {"R", "r"});
  const double R = request.at("R");
  const double r = request.at("r");
  // Thicker tubes, blended, would close the holes.
  if (r > 0.6 * R) {
    throw InvalidOption(
        concat("make_shape: double-torus: r = ", r, " must be at most 0.6 R = ", 0.6 * R));
  }
  check_face_count(request, 8.0 * pi * pi * R * r);
  // The tubes must be resolved by the lattice.
  (void)pieces(request, 2.0 * pi * r, request.edge_length, 6);
  // Two tori that touch along their center lines, joined by a smooth minimum of their distances. A
  // weighted mean of gradients of length 1 is no longer than 1, as polygonize() demands.
  const double blend = 0.25 * r;
  const auto value = [=](const Eigen::Vector3d& p) {
    const Eigen::Vector3d center(R, 0.0, 0.0);
    const double a = distance_to_torus(p - center, R, r);
    const double b = distance_to_torus(p + center, R, r);
    return std::min(a, b) - blend * std::log1p(std::exp(-std::abs(a - b) / blend));
  };
  const double room = r + blend + 2.0 * request.edge_length;
  const Eigen::Vector3d high(2.0 * R + room, R + room, room);
  return polygonize({value, {-high, high}}, request.edge_length);
}

// ---- names -------------------------------------------------------------------------------------

struct BuiltInShape {
  ShapeDescription description;
  TriMesh (*make)(const Request&);
};

const std::vector<BuiltInShape>& shape_table() {
  static const ShapeParameter radius{"radius", 1.0, "radius"};
  static const ShapeParameter major{"R", 1.0, "radius of the center line"};
  static const ShapeParameter minor{"r", 0.4, "radius of the tube"};
  static const std::vector<BuiltInShape> table = {
      {{"sphere", "sphere", {radius}}, sphere},
      {{"ellipsoid",
        "ellipsoid; its triangles stretch with the axes",
        {{"a", 1.5, "semi-axis along x"},
         {"b", 1.0, "semi-axis along y"},
         {"c", 0.75, "semi-axis along z"}}},
       ellipsoid},
      {{"torus", "torus around the z axis", {major, minor}}, torus},
      {{"double-torus",
        "two tori side by side, joined smoothly: genus 2; r at most 0.6 R",
        {major, {"r", 0.4, "radius of the tubes"}}},
       double_torus},
      {{"capsule",
        "cylinder along z with hemispheres at both ends",
        {radius, {"length", 3.0, "length of the cylinder between the hemispheres"}}},
       capsule},
      {{"tube", "cylinder along z, closed by flat discs", {radius, {"length", 4.0, "length"}}},
       tube},
      {{"open-tube", "cylinder along z, open at both ends", {radius, {"length", 4.0, "length"}}},
       open_tube},
      {{"wavy-sheet",
        "open sheet z = amplitude sin(2π x/wavelength) sin(2π y/wavelength)",
        {{"width", 2.0, "extent along x"},
         {"depth", 2.0, "extent along y"},
         {"amplitude", 0.1, "height of the waves; may be 0 or negative"},
         {"wavelength", 1.0, "wavelength along x and y"}}},
       wavy_sheet}};
  return table;
}

std::string names_of(const std::vector<ShapeParameter>& parameters) {
  std::string names;
  for (const auto& parameter : parameters) names += (names.empty() ? "" : ", ") + parameter.name;
  return names;
}

const BuiltInShape& find_shape(std::string_view name) {
  std::string known;
  for (const BuiltInShape& shape : shape_table()) {
    if (shape.description.name == name) return shape;
    known += (known.empty() ? "" : ", ") + shape.description.name;
  }
  throw InvalidOption(concat("make_shape: no shape is called '", name, "'; there are ", known));
}

Request request_for(const ShapeDescription& shape, const std::vector<ShapeArgument>& arguments) {
  Request request{shape.name, {}, 0.0};
  for (const ShapeParameter& parameter : shape.parameters) {
    request.values[parameter.name] = parameter.default_value;
  }
  for (const ShapeArgument& argument : arguments) {
    const auto found = request.values.find(argument.name);
    if (found == request.values.end()) {
      throw InvalidOption(concat("make_shape: ", shape.name, " has no parameter '", argument.name,
                                 "'; it has ", names_of(shape.parameters)));
    }
    if (!std::isfinite(argument.value)) {
      throw InvalidOption(
          concat("make_shape: ", shape.name, ": ", argument.name, " must be a finite number"));
    }
    found->second = argument.value;
  }
  return request;
}

}  // namespace

const std::vector<ShapeDescription>& built_in_shapes() {
  static const std::vector<ShapeDescription> descriptions = [] {
    std::vector<ShapeDescription> all;
    for (const BuiltInShape& shape : shape_table()) all.push_back(shape.description);
    return all;
  }();
  return descriptions;
}

TriMesh make_shape(std::string_view name, const std::vector<ShapeArgument>& arguments,
                   double edge_length) {
  const BuiltInShape& shape = find_shape(name);
  Request request = request_for(shape.description, arguments);
  if (!(edge_length > 0.0) || !std::isfinite(edge_length)) {
    throw InvalidOption(
        concat("make_shape: edge_length must be > 0 and finite, but is ", edge_length));
  }
  request.edge_length = edge_length;
  return shape.make(request);
}

}  // namespace trivalent::remesh
