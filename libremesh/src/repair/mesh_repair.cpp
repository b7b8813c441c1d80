#include "trivalent/remesh/mesh_repair.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/mesh_readers.h"
#include "mesh/edge_table.h"
#include "mesh/geometry.h"
#include "repair/fill_holes.h"
#include "repair/soup_repair.h"
#include "repair/wrap_surface.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_components.h"

namespace trivalent::remesh {

namespace {

/// Flips and collapses may lay other faces flat, so several rounds; beyond these it would go on.
constexpr int max_flattening_rounds = 10;

void note(std::vector<std::string>& notes, std::string_view verb, std::size_t count,
          std::string_view thing) {
  if (count > 0) notes.push_back(concat(verb, ' ', counted(count, thing)));
}

// ---- flat faces --------------------------------------------------------------------------------

bool is_flat(const TriMesh& mesh, FaceHandle face) { return face_area(mesh, face) == 0.0; }

/// Collapses an edge without a length, or flips the longest edge, so that the vertex that lies on
/// it divides the face on its other side. Neither changes the shape.
void remove_flat_face(TriMesh& mesh, FaceHandle face) {
  HalfedgeHandle shortest = mesh.halfedge_handle(face);
  HalfedgeHandle longest = shortest;
  for (const auto h : mesh.fh_range(face)) {
    if (squared_length(mesh, h) < squared_length(mesh, shortest)) shortest = h;
    if (squared_length(mesh, h) > squared_length(mesh, longest)) longest = h;
  }
  if (squared_length(mesh, shortest) == 0.0) {
    if (mesh.is_collapse_ok(shortest)) mesh.collapse(shortest);
    return;
  }
  const EdgeHandle across = mesh.edge_handle(longest);
  if (mesh.is_boundary(across)) {
    // If the vertex on the boundary's edge lies on a boundary itself, two fans would be left there.
    const VertexHandle middle = mesh.to_vertex_handle(mesh.next_halfedge_handle(longest));
    const HalfedgeHandle next = mesh.next_halfedge_handle(longest);
    const HalfedgeHandle previous = mesh.prev_halfedge_handle(longest);
    const bool is_ear =
        mesh.is_boundary(mesh.edge_handle(next)) || mesh.is_boundary(mesh.edge_handle(previous));
    if (!mesh.is_boundary(middle) || is_ear) mesh.delete_face(face);
  } else if (mesh.is_flip_ok(across)) {
    mesh.flip(across);
  }
}

void remove_flat_faces(TriMesh& mesh, std::vector<std::string>& notes) {
  const auto flat_faces = [&mesh] {
    std::vector<FaceHandle> flat;
    for (const auto f : mesh.faces()) {
      if (is_flat(mesh, f)) flat.push_back(f);
    }
    return flat;
  };
  std::vector<FaceHandle> flat = flat_faces();
  const std::size_t before = flat.size();
  for (int round = 0; round < max_flattening_rounds && !flat.empty(); ++round) {
    for (const FaceHandle face : flat) {
      if (!mesh.status(face).deleted() && is_flat(mesh, face)) remove_flat_face(mesh, face);
    }
    mesh.garbage_collection();
    flat = flat_faces();
  }
  note(notes, "removed", before - std::min(before, flat.size()), "flat face");
  note(notes, "left", flat.size(), "flat face");
}

// ---- components --------------------------------------------------------------------------------

/// Component of every face, numbered by their first faces.
struct Components {
  std::vector<std::size_t> of_face;
  std::vector<double> area;
  std::vector<double> volume;  ///< enclosed by the faces and the origin
  std::vector<char> is_closed;
};

Components components_of(const TriangleSoup& soup) {
  DisjointSets sets(soup.triangles.size());
  std::vector<char> has_boundary(soup.triangles.size(), 0);
  const std::vector<EdgeUse> uses = edge_uses(soup.triangles);
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    for (const EdgeUse& use : edge) {
      sets.join(static_cast<std::size_t>(edge[0].face), static_cast<std::size_t>(use.face));
      if (edge.size() == 1) has_boundary[static_cast<std::size_t>(use.face)] = 1;
    }
  });
  Components components;
  components.of_face.resize(soup.triangles.size());
  for (std::size_t f = 0; f < soup.triangles.size(); ++f) {
    const std::size_t first = sets.find(f);
    if (first == f) {
      components.of_face[f] = components.area.size();
      components.area.push_back(0.0);
      components.volume.push_back(0.0);
      components.is_closed.push_back(1);
    }
    const std::size_t c = components.of_face[f] = components.of_face[first];
    const auto at = [&](std::size_t k) {
      return soup.points[static_cast<std::size_t>(soup.triangles[f][k])];
    };
    components.area[c] += 0.5 * doubled_area_vector(at(0), at(1), at(2)).norm();
    components.volume[c] += at(0).dot(at(1).cross(at(2))) / 6.0;
    if (has_boundary[f] != 0) components.is_closed[c] = 0;
  }
  return components;
}

void keep_largest_component(TriangleSoup& soup, std::vector<std::string>& notes) {
  const Components components = components_of(soup);
  const auto largest = static_cast<std::size_t>(
      std::max_element(components.area.begin(), components.area.end()) - components.area.begin());
  std::size_t face = 0;
  std::erase_if(soup.triangles, [&](const auto&) { return components.of_face[face++] != largest; });
  note(notes, "dropped", components.area.size() - 1, "smaller component");
}

void turn_inside_out_components(TriangleSoup& soup, std::vector<std::string>& notes) {
  const Components components = components_of(soup);
  const auto is_inside_out = [&](std::size_t c) {
    return components.is_closed[c] != 0 && components.volume[c] < 0.0;
  };
  for (std::size_t f = 0; f < soup.triangles.size(); ++f) {
    if (is_inside_out(components.of_face[f])) std::swap(soup.triangles[f][1], soup.triangles[f][2]);
  }
  std::size_t turned = 0;
  for (std::size_t c = 0; c < components.area.size(); ++c) turned += is_inside_out(c) ? 1 : 0;
  note(notes, "turned", turned, "inside-out component");
}

// ---- the methods -------------------------------------------------------------------------------

RepairResult build(TriangleSoup soup) {
  if (soup.triangles.empty()) throw InvalidMesh("repair: no faces are left");
  return {make_mesh(soup.points, soup.triangles), std::move(soup.notes), 0.0};
}

/// Whether nothing but the positions of points may be wrong.
bool is_clean(const MeshDiagnosis& diagnosis) {
  return std::ranges::all_of(diagnosis.findings, [](const Finding& finding) {
    return finding.problem == Problem::far_point;
  });
}

/// Makes an oriented surface of the faces.
void mend_faces(TriangleSoup& soup) {
  std::vector<std::string>& notes = soup.notes;
  const std::size_t faces = soup.triangles.size();
  note(notes, "joined", join_coincident_points(soup), "coincident point");
  note(notes, "dropped", faces - soup.triangles.size(), "degenerate face");
  note(notes, "dropped", drop_repeated_faces(soup), "repeated face");
  note(notes, "turned", orient_faces(soup), "disagreeing face");
  if (const std::size_t count = count_disagreeing_edges(soup); count > 0) {
    throw InvalidMesh(concat("repair: along ", counted(count, "edge"),
                             " the surface has only one side, as a Moebius strip; wrap it (repair "
                             "method wrap)"));
  }
  note(notes, "split points where surfaces meet: added", separate_fans(soup), "point");
}

RepairResult mend(TriangleSoup soup, const RepairOptions& options, const MeshDiagnosis& diagnosis) {
  if (soup.triangles.empty() && !soup.points.empty()) {
    throw InvalidMesh(concat("repair: there are ", counted(soup.points.size(), "point"),
                             " but no faces; wrap them (repair method wrap)"));
  }
  if (soup.triangles.empty()) throw InvalidMesh("repair: there are neither points nor faces");
  std::vector<std::string>& notes = soup.notes;
  note(notes, "set to zero", drop_vanishing_coordinates(soup), "vanishing coordinate");
  const bool was_clean = is_clean(diagnosis);
  if (!was_clean) mend_faces(soup);
  if (options.components == ComponentPolicy::keep_largest) keep_largest_component(soup, notes);
  turn_inside_out_components(soup, notes);
  note(notes, "dropped", drop_isolated_points(soup), "isolated point");
  if (!was_clean && !diagnose(soup).is_oriented_manifold()) {
    throw InvalidMesh(
        "repair: faces are left that form no oriented surface; wrap it (repair method wrap)");
  }
  RepairResult result = build(std::move(soup));
  remove_flat_faces(result.mesh, result.notes);
  if (options.holes == HolePolicy::fill) {
    note(result.notes, "filled", static_cast<std::size_t>(fill_holes(result.mesh)), "hole");
  }
  return result;
}

/// Fine enough to keep the shape; among points coarse enough to close the gaps between them, which
/// are about as wide as if the points lay evenly on the bounding box.
double default_alpha(const TriangleSoup& soup) {
  const BoundingBox box = bounding_box(soup.points);
  const double fine = box.diagonal() / 100.0;
  if (!soup.triangles.empty()) return fine;
  constexpr double gaps = 3.0;
  const Eigen::Vector3d side = box.high - box.low;
  const double area = 2.0 * (side.x() * side.y() + side.y() * side.z() + side.z() * side.x());
  return std::max(fine, gaps * std::sqrt(area / static_cast<double>(soup.points.size())));
}

void check_wrap_length(double length) {
  if (length > 0.0 && std::isfinite(length)) return;
  throw InvalidOption(
      concat("repair: the lengths of a wrap must be > 0 and finite, but one is ", length));
}

/// That of a thin plate; two thirds of the radius of a ball.
double mean_thickness(const TriMesh& closed) {
  double volume = 0.0;
  double area = 0.0;
  for (const MeshComponent& part : find_components(closed).parts) {
    volume += part.volume;
    area += part.area;
  }
  return 2.0 * volume / area;
}

RepairResult wrap_at(const TriangleSoup& soup, const RepairOptions& options,
                     const WrapLengths& lengths) {
  TriangleSoup wrapped = wrap_surface(soup, lengths);
  wrapped.notes = soup.notes;
  wrapped.notes.push_back(concat("wrapped with alpha ", lengths.alpha, " at a distance of ",
                                 lengths.offset, "; what lies inside is lost"));
  if (options.components == ComponentPolicy::keep_largest)
    keep_largest_component(wrapped, wrapped.notes);
  drop_isolated_points(wrapped);
  RepairResult result = build(std::move(wrapped));
  result.offset = lengths.offset;
  return result;
}

/// The edge length of the net to come, if a wrap close to the input would be thinner than that.
std::optional<double> edge_of_thin_wrap(const TriangleSoup& soup, const RepairOptions& options,
                                        double alpha) {
  if (!options.edge_length_on) return std::nullopt;
  // So far off that it is fast; close wraps take many times as long.
  const TriMesh probe = wrap_at(soup, options, {alpha, alpha}).mesh;
  const double edge_length = options.edge_length_on(probe);
  return mean_thickness(probe) - 2.0 * alpha < edge_length ? std::optional(edge_length)
                                                           : std::nullopt;
}

RepairResult wrap(const TriangleSoup& soup, const RepairOptions& options) {
  if (soup.points.empty()) throw InvalidMesh("repair: there is nothing to wrap");
  const double alpha = options.wrap_alpha.value_or(default_alpha(soup));
  check_wrap_length(alpha);
  if (options.wrap_offset) {
    check_wrap_length(*options.wrap_offset);
    return wrap_at(soup, options, {alpha, *options.wrap_offset});
  }
  const auto edge_length = edge_of_thin_wrap(soup, options, alpha);
  RepairResult result = wrap_at(soup, options, {alpha, edge_length.value_or(alpha / 30.0)});
  if (edge_length)
    result.notes.emplace_back("its distance is one edge, as its sides would meet otherwise");
  return result;
}

}  // namespace

RepairResult repair(const TriangleSoup& soup, const RepairOptions& options) {
  return repair(soup, options,
                options.method == RepairMethod::safe ? diagnose(soup) : MeshDiagnosis());
}

RepairResult repair(const TriangleSoup& soup, const RepairOptions& options,
                    const MeshDiagnosis& diagnosis) {
  switch (options.method) {
    case RepairMethod::none:
      return build(soup);
    case RepairMethod::safe:
      return mend(soup, options, diagnosis);
    case RepairMethod::wrap:
      break;
  }
  return wrap(soup, options);
}

}  // namespace trivalent::remesh
