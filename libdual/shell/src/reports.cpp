#include "trivalent/shell/reports.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "trivalent/remesh/surface_shape.h"
#include "trivalent/shell/number_text.h"

namespace trivalent::shell {
namespace {

double degrees(double radian) { return radian * 180.0 / std::numbers::pi; }

Json one_sided_json(const remesh::SurfaceDistance& distance) {
  return {{"max", distance.max}, {"mean", distance.mean}, {"rms", distance.root_mean_square}};
}

/// Places where carbon cannot follow a net: hardly any sp2 carbon bends more tightly than C60,
/// whose radius is 3.55 Å at a bond of 1.42 Å; edges are √3 bonds long.
remesh::FineParts too_fine_parts(const remesh::TriMesh& net) {
  constexpr double radius_in_bonds = 2.5;
  return remesh::find_fine_parts(
      net, radius_in_bonds / std::numbers::sqrt3 * remesh::mean_edge_length(net));
}

}  // namespace

Json histogram_json(const std::map<int, int>& histogram) {
  Json json = Json::object();
  for (const auto& [key, count] : histogram) json[std::to_string(key)] = count;
  return json;
}

std::string histogram_text(const std::map<int, int>& histogram) {
  std::string text;
  for (const auto& [key, count] : histogram) {
    text += (text.empty() ? "" : ", ") + std::to_string(key) + ": " + std::to_string(count);
  }
  return text.empty() ? "none" : text;
}

Json quality_json(const remesh::MeshQuality& quality) {
  const remesh::Spread& edge = quality.edge_length;
  return {{"vertices", quality.vertices},
          {"edges", quality.edges},
          {"faces", quality.faces},
          {"euler_characteristic", quality.euler_characteristic},
          {"components", quality.components},
          {"boundary_loops", quality.boundary_loops},
          {"edge_length",
           {{"mean", edge.mean},
            {"standard_deviation", edge.standard_deviation},
            {"relative_spread", edge.relative()},
            {"min", edge.min},
            {"max", edge.max}}},
          {"valences", histogram_json(quality.valences)},
          {"regular_fraction", quality.regular_fraction},
          {"smallest_angle_degrees", degrees(quality.smallest_angle)},
          {"largest_angle_degrees", degrees(quality.largest_angle)},
          {"self_intersections", quality.self_intersections},
          {"self_intersections_are_all", quality.self_intersections < remesh::max_crossing_pairs}};
}

Json components_json(const remesh::MeshComponents& components) {
  Json json = Json::array();
  for (const remesh::MeshComponent& part : components.parts) {
    json.push_back({{"faces", part.faces},
                    {"euler_characteristic", part.euler_characteristic()},
                    {"boundary_edges", part.boundary_edges},
                    {"area", part.area},
                    {"volume", part.volume},
                    {"inside_of", part.inside_of ? Json(*part.inside_of) : Json(nullptr)}});
  }
  return json;
}

Json distance_json(const remesh::TwoSidedDistance& distance) {
  return {{"max", distance.max()},
          {"rms", distance.root_mean_square()},
          {"max_of_diagonal", distance.max() / distance.diagonal},
          {"rms_of_diagonal", distance.root_mean_square() / distance.diagonal},
          {"diagonal", distance.diagonal},
          {"to_original", one_sided_json(distance.to_original)},
          {"from_original", one_sided_json(distance.from_original)}};
}

Json network_json(const dual::NetworkReport& network) {
  return {{"atoms", network.atoms},
          {"bonds", network.bonds},
          {"rings", network.rings},
          {"coordinations", histogram_json(network.coordinations)},
          {"ring_sizes", histogram_json(network.ring_sizes)},
          {"hexagon_fraction", network.hexagon_fraction},
          {"ring_excess", network.ring_excess},
          {"is_trivalent", network.is_trivalent()},
          {"bond_length",
           {{"mean", network.bond_mean},
            {"standard_deviation", network.bond_spread},
            {"min", network.bond_min},
            {"max", network.bond_max}}}};
}

Json scale_json(const dual::ColorScale& scale) {
  return {{"low", scale.low}, {"middle", scale.middle()}, {"high", scale.high}};
}

Json net_json(const remesh::RemeshResult& net) {
  const remesh::FineParts fine = too_fine_parts(net.mesh);
  return {{"coarse_start", net.coarse_start},
          {"copies", net.copies},
          {"too_fine",
           {{"vertices", fine.vertices},
            {"growth", fine.growth},
            {"edge_length", remesh::mean_edge_length(net.mesh) / fine.growth},
            {"faces",
             std::lround(static_cast<double>(net.mesh.n_faces()) * fine.growth * fine.growth)}}}};
}

std::vector<TableRow> net_rows(const remesh::RemeshResult& net) {
  const remesh::FineParts fine = too_fine_parts(net.mesh);
  std::vector<TableRow> rows = {
      {"search began", net.coarse_start ? "at twice the edge length" : "at the edge length"}};
  std::string text = std::to_string(fine.vertices) + " vertices bend more tightly than C60";
  if (fine.growth > 1.0) {
    text += "; few would at " + significant(fine.growth, 2) + " times the size (edges of " +
            significant(remesh::mean_edge_length(net.mesh) / fine.growth, 3) + " here, or " +
            std::to_string(
                std::lround(static_cast<double>(net.mesh.n_faces()) * fine.growth * fine.growth)) +
            " atoms)";
  }
  rows.push_back({"too fine", text});
  return rows;
}

std::string tube_text(const remesh::ChiralIndices& tube) {
  return "(" + std::to_string(tube.n) + "," + std::to_string(tube.m) + ")";
}

std::string crossings_text(int pairs) {
  return std::to_string(pairs) + (pairs < remesh::max_crossing_pairs ? "" : " or more");
}

std::vector<TableRow> quality_rows(const remesh::MeshQuality& quality) {
  const remesh::Spread& edge = quality.edge_length;
  return {{"vertices, edges, faces", std::to_string(quality.vertices) + ", " +
                                         std::to_string(quality.edges) + ", " +
                                         std::to_string(quality.faces)},
          {"Euler characteristic", std::to_string(quality.euler_characteristic)},
          {"components", std::to_string(quality.components)},
          {"boundary loops", std::to_string(quality.boundary_loops)},
          {"edge length", "mean " + significant(edge.mean, 6) + ", CV " + percent(edge.relative()) +
                              ", " + significant(edge.min) + " to " + significant(edge.max)},
          {"valence 6", percent(quality.regular_fraction)},
          {"valences", histogram_text(quality.valences)},
          {"angles", decimals(degrees(quality.smallest_angle), 1) + "° to " +
                         decimals(degrees(quality.largest_angle), 1) + "°"},
          {"self-intersections", crossings_text(quality.self_intersections)}};
}

std::vector<TableRow> components_rows(const remesh::MeshComponents& components) {
  constexpr std::size_t max_rows = 10;
  const std::size_t count = components.parts.size();
  if (count < 2) return {};
  std::vector<TableRow> rows;
  for (std::size_t i = 0; i < std::min(count, max_rows); ++i) {
    const remesh::MeshComponent& part = components.parts[i];
    rows.push_back({"component " + std::to_string(i),
                    std::to_string(part.faces) + " faces, " +
                        (part.is_closed() ? "closed" : "open") + ", Euler characteristic " +
                        std::to_string(part.euler_characteristic()) +
                        (part.inside_of ? ", inside of " + std::to_string(*part.inside_of) : "")});
  }
  if (count > max_rows) rows.push_back({"...", std::to_string(count - max_rows) + " more"});
  return rows;
}

std::vector<TableRow> distance_rows(const remesh::TwoSidedDistance& distance) {
  const auto text = [&](const remesh::SurfaceDistance& side) {
    const auto of_diagonal = [&](double value) {
      return decimals(100.0 * value / distance.diagonal, 3) + " %";
    };
    return "rms " + significant(side.root_mean_square) + ", largest " + significant(side.max) +
           " (" + of_diagonal(side.root_mean_square) + ", " + of_diagonal(side.max) +
           " of the diagonal)";
  };
  return {{"from net to surface", text(distance.to_original)},
          {"from surface to net", text(distance.from_original)}};
}

std::vector<TableRow> network_rows(const dual::NetworkReport& network) {
  return {
      {"atoms, bonds, rings", std::to_string(network.atoms) + ", " + std::to_string(network.bonds) +
                                  ", " + std::to_string(network.rings)},
      {"atoms by bonds", histogram_text(network.coordinations)},
      {"rings by size", histogram_text(network.ring_sizes)},
      {"hexagons", percent(network.hexagon_fraction)},
      {"sum of 6 - ring size", std::to_string(network.ring_excess)},
      {"bond length [Å]", "mean " + decimals(network.bond_mean, 4) + ", " +
                              decimals(network.bond_min, 3) + " to " +
                              decimals(network.bond_max, 3)}};
}

void append(std::vector<TableRow>& rows, const std::vector<TableRow>& more) {
  rows.insert(rows.end(), more.begin(), more.end());
}

}  // namespace trivalent::shell
