#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "mesh/geometry.h"
#include "sources/built_in_shapes.h"
#include "sources/implicit_surface.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/tube_ends.h"

namespace trivalent::remesh {

namespace {

using std::numbers::pi;

/// A tube, with hemispheres at its ends.
struct Segment {
  Eigen::Vector3d from;  ///< of its center line
  Eigen::Vector3d to;
  double radius;
};

/// Distance to a tube, < 0 inside.
double distance_to(const Segment& segment, const Eigen::Vector3d& p) {
  const Eigen::Vector3d along = segment.to - segment.from;
  const double t = std::clamp((p - segment.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - segment.from - t * along).norm() - segment.radius;
}

/// Distance to tubes that are joined smoothly: a soft minimum of the distances to each. Its
/// gradient is a weighted mean of gradients of length 1, no longer than 1.
class JoinedTubes {
 public:
  /// @param neck  about the radius of the fillets between tubes
  JoinedTubes(std::vector<Segment> segments, double neck)
      : segments_(std::move(segments)), blend_(0.25 * neck) {}

  double operator()(const Eigen::Vector3d& p) const {
    // Of the hundreds of tubes in a lattice few are near enough to count.
    constexpr double negligible = -50.0;  // exp() of it
    thread_local std::vector<double> distances;
    distances.clear();
    for (const Segment& segment : segments_) distances.push_back(distance_to(segment, p));
    const double nearest = *std::ranges::min_element(distances);
    double sum = 0.0;
    for (const double distance : distances) {
      const double exponent = (nearest - distance) / blend_;
      if (exponent > negligible) sum += std::exp(exponent);
    }
    return nearest - blend_ * std::log(sum);
  }

  /// The tube that a point belongs to.
  [[nodiscard]] std::size_t nearest(const Eigen::Vector3d& p) const {
    const auto distance = [&](const Segment& segment) { return distance_to(segment, p); };
    return static_cast<std::size_t>(std::ranges::min_element(segments_, {}, distance) -
                                    segments_.begin());
  }

 private:
  std::vector<Segment> segments_;
  double blend_;
};

/// Takes away what lies beyond a plane across the end of a tube.
void cut_off(TriMesh& mesh, const JoinedTubes& tubes, std::size_t tube, const Segment& segment) {
  const Eigen::Vector3d along = (segment.to - segment.from).normalized();
  const auto height = [&](const Eigen::Vector3d& p) { return (p - segment.to).dot(along); };
  const auto belongs = [&](const Eigen::Vector3d& p) { return tubes.nearest(p) == tube; };
  // Vertices next to the plane move onto it, so that no edge is cut near its end.
  constexpr double close = 0.25;
  for (const auto v : mesh.vertices()) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const auto h : v.outgoing_halfedges()) {
      shortest = std::min(shortest, std::sqrt(squared_length(mesh, h)));
    }
    const double above = height(mesh.point(v));
    if (belongs(mesh.point(v)) && std::abs(above) < close * shortest) {
      mesh.point(v) -= above * along;
    }
  }
  const double flat = 1e-9 * segment.to.norm();
  const std::size_t n_edges = mesh.n_edges();
  for (std::size_t i = 0; i < n_edges; ++i) {
    const EdgeHandle e(static_cast<int>(i));
    const HalfedgeHandle h = mesh.halfedge_handle(e, 0);
    const Eigen::Vector3d a = mesh.point(mesh.from_vertex_handle(h));
    const Eigen::Vector3d b = mesh.point(mesh.to_vertex_handle(h));
    const double from = height(a);
    const double to = height(b);
    if (!belongs(a) || std::min(from, to) > -flat || std::max(from, to) < flat) continue;
    mesh.split(e, Eigen::Vector3d(a + from / (from - to) * (b - a)));
  }
  for (const auto f : mesh.faces()) {
    const Eigen::Vector3d middle = face_centroid(mesh, f);
    if (belongs(middle) && height(middle) > 0.0) mesh.delete_face(f, true);
  }
  mesh.garbage_collection();
}

/// A tube that leaves the origin.
struct Arm {
  Eigen::Vector3d direction;
  double length;
  double radius;
  std::optional<ChiralIndices> tube = {};
};

/// Says which tube ends at the open end of an arm.
void mark_tube_end(TriMesh& mesh, const JoinedTubes& tubes, std::size_t arm, ChiralIndices tube) {
  for (const auto v : mesh.vertices()) {
    if (v.is_boundary() && tubes.nearest(mesh.point(v)) == arm) set_tube_end(mesh, v, tube);
  }
}

/// @throws InvalidOption if two arms are one, or an open one ends within the others.
void check_arms(const Request& request, const std::vector<Arm>& arms) {
  double widest = 0.0;
  for (const Arm& arm : arms) widest = std::max(widest, arm.radius);
  for (std::size_t i = 0; i < arms.size(); ++i) {
    if (request.at("open") == 1.0 && arms[i].length <= widest) {
      throw InvalidOption(concat("make_shape: ", request.shape, ": arm ", i + 1, " is ",
                                 arms[i].length, " long, which ends within a tube of radius ",
                                 widest));
    }
    for (std::size_t j = 0; j < i; ++j) {
      constexpr double close = 0.996;  // cosine: 5 degrees
      if (arms[i].direction.normalized().dot(arms[j].direction.normalized()) < close) continue;
      throw InvalidOption(concat("make_shape: ", request.shape, ": arms ", j + 1, " and ", i + 1,
                                 " go the same way"));
    }
  }
}

/// @throws InvalidOption if only some arms are tubes of given indices, or closed ones are.
void check_tubes(const Request& request, const std::vector<Arm>& arms) {
  const auto given =
      std::ranges::count_if(arms, [](const Arm& arm) { return arm.tube.has_value(); });
  if (given == 0) return;
  if (request.at("open") != 1.0) {
    throw InvalidOption(
        concat("make_shape: ", request.shape, ": arms with chiral indices are open: add open=1"));
  }
  if (given < static_cast<std::ptrdiff_t>(arms.size())) {
    throw InvalidOption(
        concat("make_shape: ", request.shape, ": give chiral indices to all arms or to none"));
  }
}

TriMesh junction_of(const Request& request, const std::vector<Arm>& arms) {
  check_positive(request, {"radius", "length", "neck"});
  const double open = request.at("open");
  if (open != 0.0 && open != 1.0) {
    throw InvalidOption(concat("make_shape: ", request.shape, ": open is 0 or 1, not ", open));
  }
  check_arms(request, arms);
  check_tubes(request, arms);
  double area = 0.0;
  double reach = 0.0;
  std::vector<Segment> segments;
  std::vector<Segment> ends;
  for (const auto& [direction, length, radius, tube] : arms) {
    area += 2.0 * pi * radius * (length + radius);
    (void)pieces(request, 2.0 * pi * radius, request.edge_length, 6);
    // Tubes that are to be cut go on for a while.
    const double end = length + open * 4.0 * request.edge_length;
    const Eigen::Vector3d unit = direction.normalized();
    segments.push_back({Eigen::Vector3d::Zero(), end * unit, radius});
    ends.push_back({Eigen::Vector3d::Zero(), length * unit, radius});
    reach = std::max(reach, end + radius);
  }
  check_face_count(request, area);
  const JoinedTubes tubes(std::move(segments), request.at("neck"));
  const double room = reach + request.at("neck") + 2.0 * request.edge_length;
  const BoundingBox box = {.low = Eigen::Vector3d::Constant(-room),
                           .high = Eigen::Vector3d::Constant(room)};
  TriMesh mesh = polygonize({.value = tubes, .box = box}, request.edge_length);
  for (std::size_t k = 0; open == 1.0 && k < ends.size(); ++k) cut_off(mesh, tubes, k, ends[k]);
  for (std::size_t k = 0; k < arms.size(); ++k) {
    if (arms[k].tube) mark_tube_end(mesh, tubes, k, *arms[k].tube);
  }
  return mesh;
}

/// @throws InvalidOption if these are no chiral indices of a tube.
ChiralIndices tube_of(const Request& request, double n, double m) {
  constexpr double most = 1000.0;
  if (n != std::round(n) || m != std::round(m) || n < 1.0 || m < 0.0 || std::max(n, m) > most) {
    throw InvalidOption(concat("make_shape: ", request.shape, ": n = ", n, ", m = ", m,
                               "; chiral indices are whole numbers, n from 1 and m from 0 to ",
                               most));
  }
  const ChiralIndices tube = {static_cast<int>(n), static_cast<int>(m)};
  if (circumference_of(tube) < 3.0) {
    throw InvalidOption(concat("make_shape: ", request.shape, ": a (", n, ",", m,
                               ") tube is too thin; (3,0) is the thinnest"));
  }
  return tube;
}

/// Tubes of one radius and length.
TriMesh junction_towards(const Request& request, const std::vector<Eigen::Vector3d>& directions) {
  std::vector<Arm> arms;
  arms.reserve(directions.size());
  std::optional<ChiralIndices> tube;
  if (request.at("n") != 0.0 || request.at("m") != 0.0) {
    tube = tube_of(request, request.at("n"), request.at("m"));
  }
  for (const Eigen::Vector3d& direction : directions) {
    arms.push_back({direction, request.at("length"), request.at("radius"), tube});
  }
  return junction_of(request, arms);
}

Arm arm_of(const Request& request, const std::vector<double>& numbers) {
  const std::size_t n = numbers.size();
  constexpr std::size_t with_tube = 6;
  if (n < 3 || n > with_tube) {
    throw InvalidOption(concat("make_shape: ", request.shape,
                               ": an arm is x y z [length [radius]] or x y z length n m, ",
                               "three to six numbers, not ", n));
  }
  Arm arm = {.direction = {numbers[0], numbers[1], numbers[2]},
             .length = n > 3 ? numbers[3] : request.at("length"),
             .radius = n == 5 ? numbers[4] : request.at("radius")};
  if (arm.direction.isZero(0.0) || !(arm.length > 0.0) || !(arm.radius > 0.0)) {
    throw InvalidOption(concat("make_shape: ", request.shape,
                               ": an arm needs a direction, and a length and radius > 0"));
  }
  if (n == with_tube) arm.tube = tube_of(request, numbers[4], numbers[5]);
  return arm;
}

/// Tubes along segments that repeat with a lattice.
TriMesh network(const Request& request, const Lattice& lattice, const std::vector<Segment>& edges) {
  check_positive(request, {"a", "radius", "neck"});
  const double radius = request.at("radius");
  double length = 0.0;
  for (const Segment& edge : edges) length += (edge.to - edge.from).norm();
  check_face_count(request, 2.0 * pi * radius * length);
  (void)pieces(request, 2.0 * pi * radius, request.edge_length, 6);
  // All images that a point of the cell may be near to.
  std::vector<Segment> images = edges;
  const double reach = 2.0 * (radius + request.at("neck")) + request.at("a");
  for (const Eigen::Vector3d& shift : lattice.translations_within(reach)) {
    for (const Segment& edge : edges) {
      images.push_back({edge.from + shift, edge.to + shift, radius});
    }
  }
  const JoinedTubes tubes(std::move(images), request.at("neck"));
  return polygonize({.value = tubes, .box = {}, .lattice = lattice}, request.edge_length);
}

}  // namespace

TriMesh y_junction(const Request& request) {
  const double sine = 0.5 * std::sqrt(3.0);
  return junction_towards(request, {{1.0, 0.0, 0.0}, {-0.5, sine, 0.0}, {-0.5, -sine, 0.0}});
}

TriMesh t_junction(const Request& request) {
  return junction_towards(request, {{1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}});
}

TriMesh x_junction(const Request& request) {
  return junction_towards(request,
                          {{1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}});
}

TriMesh tetrapod(const Request& request) {
  return junction_towards(
      request, {{1.0, 1.0, 1.0}, {1.0, -1.0, -1.0}, {-1.0, 1.0, -1.0}, {-1.0, -1.0, 1.0}});
}

TriMesh six_arm_junction(const Request& request) {
  return junction_towards(request, {{1.0, 0.0, 0.0},
                                    {-1.0, 0.0, 0.0},
                                    {0.0, 1.0, 0.0},
                                    {0.0, -1.0, 0.0},
                                    {0.0, 0.0, 1.0},
                                    {0.0, 0.0, -1.0}});
}

TriMesh junction(const Request& request) {
  if (request.lists.empty()) {
    throw InvalidOption(
        "make_shape: junction needs arms, as in 'junction:arm=1 0 0,arm=-1 0 0,arm=0 1 1'");
  }
  std::vector<Arm> arms;
  arms.reserve(request.lists.size());
  for (const std::vector<double>& numbers : request.lists) arms.push_back(arm_of(request, numbers));
  // Tubes are as thick as they are around; the first has the radius of all.
  for (Arm& arm : arms) {
    if (!arm.tube || !arms.front().tube) continue;
    arm.radius *= circumference_of(*arm.tube) / circumference_of(*arms.front().tube);
  }
  return junction_of(request, arms);
}

TriMesh cubic_network(const Request& request) {
  const double a = request.at("a");
  const Eigen::Vector3d node = Eigen::Vector3d::Zero();
  std::vector<Segment> edges;
  edges.reserve(3);
  const double radius = request.at("radius");
  for (int k = 0; k < 3; ++k) edges.push_back({node, a * Eigen::Vector3d::Unit(k), radius});
  return network(request, Lattice(a * Eigen::Matrix3d::Identity(), {true, true, true}), edges);
}

TriMesh diamond_network(const Request& request) {
  const double a = request.at("a");
  std::vector<Segment> edges;
  for (const Eigen::Vector3d& corner :
       {Eigen::Vector3d(0.0, 0.0, 0.0), Eigen::Vector3d(0.0, 0.5, 0.5),
        Eigen::Vector3d(0.5, 0.0, 0.5), Eigen::Vector3d(0.5, 0.5, 0.0)}) {
    const Eigen::Vector3d node = a * (corner + Eigen::Vector3d::Constant(0.25));
    for (const Eigen::Vector3d& step :
         {Eigen::Vector3d(1.0, 1.0, 1.0), Eigen::Vector3d(1.0, -1.0, -1.0),
          Eigen::Vector3d(-1.0, 1.0, -1.0), Eigen::Vector3d(-1.0, -1.0, 1.0)}) {
      edges.push_back({node, node + 0.25 * a * step, request.at("radius")});
    }
  }
  return network(request, Lattice(a * Eigen::Matrix3d::Identity(), {true, true, true}), edges);
}

TriMesh honeycomb_network(const Request& request) {
  const double a = request.at("a");
  const double height =
      2.0 * (request.at("radius") + request.at("neck")) + 8.0 * request.edge_length;
  Lattice::Cell cell;
  cell << a, 0.5 * a, 0.0,                 //
      0.0, 0.5 * std::sqrt(3.0) * a, 0.0,  //
      0.0, 0.0, height;
  const Lattice lattice(cell, {true, true, false});
  const Eigen::Vector3d first = Eigen::Vector3d::Zero();
  const Eigen::Vector3d second = (cell.col(0) + cell.col(1)) / 3.0;
  const double radius = request.at("radius");
  const std::vector<Segment> edges = {{first, second, radius},
                                      {first, second - cell.col(0), radius},
                                      {first, second - cell.col(1), radius}};
  return network(request, lattice, edges);
}

}  // namespace trivalent::remesh
