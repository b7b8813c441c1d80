#include <algorithm>
#include <cmath>
#include <numbers>

#include "sources/built_in_shapes.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

using std::numbers::pi;

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

}  // namespace

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

}  // namespace trivalent::remesh
