#include "inspection.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "remesh_options.h"
#include "reports.h"
#include "size_options.h"
#include "surface_input.h"
#include "trivalent/dual/error.h"
#include "trivalent/remesh/error.h"

namespace trivalent::apps {
namespace {

constexpr double feature_degrees = 40.0;

/// Radius of C60 in bond lengths: 3.55 Å to 1.42 Å. Hardly any sp2 carbon bends more tightly.
constexpr double smallest_radius = 2.5;

/// Beyond these, squares and cubes of lengths leave the range of double-precision numbers.
constexpr double smallest_size = 1e-90;
constexpr double largest_size = 1e90;

void measure(const dual::ShellOptions& options, Inspection& result) {
  const remesh::TriMesh& mesh = *result.mesh;
  tbb::parallel_invoke([&] { result.quality = remesh::measure_quality(mesh); },
                       [&] {
                         result.components = remesh::find_components(mesh);
                         result.features = remesh::find_feature_lines(
                             mesh, feature_degrees * std::numbers::pi / 180.0);
                         result.plan = plan_build(mesh, result.components, options);
                         result.tight_fraction = remesh::tightly_curved_fraction(
                             mesh, smallest_radius * options.bond / result.plan->shell.scale);
                       });
}

/// Sets the mesh, or the reason why there is none.
void repair(const remesh::TriangleSoup& soup, const Session& session,
            const dual::ShellOptions& options, Inspection& result) {
  remesh::RepairOptions mending = repair_options(session);
  mending.edge_length_on = [&options](const remesh::TriMesh& mesh) {
    return dual::estimate_shell(mesh, options).edge_length;
  };
  try {
    remesh::RepairResult repaired = remesh::repair(soup, mending, result.diagnosis);
    result.mesh = std::move(repaired.mesh);
    result.repair_notes.assign(
        repaired.notes.begin() + static_cast<std::ptrdiff_t>(soup.notes.size()),
        repaired.notes.end());
  } catch (const remesh::InvalidMesh& error) {
    result.reason = error.what();
  }
}

bool has_size(const Inspection& result) {
  const double size = result.box.diagonal();
  return size >= smallest_size && size <= largest_size;
}

void judge(Inspection& result) {
  if (result.diagnosis.points == 0) {
    result.verdict = Verdict::hopeless;
    result.reason = "it holds neither points nor faces; is it the right file?";
    return;
  }
  if (!has_size(result)) {
    result.verdict = Verdict::hopeless;
    result.reason = "the points span a diagonal of " + significant(result.box.diagonal()) +
                    "; scale them to ordinary numbers";
    return;
  }
  const bool is_clean = result.diagnosis.findings.empty() && result.repair_notes.empty();
  result.verdict = is_clean && result.mesh ? Verdict::sound : Verdict::mendable;
  const bool has_far_points = std::ranges::any_of(
      result.diagnosis.findings,
      [](const remesh::Finding& finding) { return finding.problem == remesh::Problem::far_point; });
  if (has_far_points && result.mesh) {
    result.reason = "points lie far off; remove them unless they are meant";
  } else if (result.verdict == Verdict::sound) {
    result.reason = "it is an oriented surface without self-intersections";
  } else if (result.mesh && result.quality.self_intersections > 0) {
    result.reason = "it intersects itself, and so will its shell; --repair wrap mends that";
  } else if (result.mesh) {
    result.reason = "build mends it without changing the shape";
  }
}

Inspection look_at(const remesh::TriangleSoup& soup, const Session& session) {
  const dual::ShellOptions options = {
      .size = shell_size(session), .bond = session.get<double>("bond"), .method = {}};
  Inspection result;
  result.is_read = true;
  result.reading_notes = soup.notes;
  result.box = soup.points.empty() ? remesh::BoundingBox{} : remesh::bounding_box(soup.points);
  result.diagnosis = remesh::diagnose(soup);
  if (has_size(result)) repair(soup, session, options, result);
  if (result.mesh) measure(options, result);
  if (!result.mesh || result.quality.self_intersections > 0) {
    const remesh::Finding crossing = remesh::find_crossing_faces(soup);
    if (crossing.count > 0) result.diagnosis.findings.push_back(crossing);
  }
  judge(result);
  return result;
}

// ---- for people and programs -------------------------------------------------------------------

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::sound:
      return "sound";
    case Verdict::mendable:
      return "mendable";
    case Verdict::hopeless:
      return "hopeless";
  }
  return {};
}

Json vector_json(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

std::string vector_text(const Eigen::Vector3d& p) {
  return "(" + significant(p.x()) + ", " + significant(p.y()) + ", " + significant(p.z()) + ")";
}

Json places_json(const std::vector<remesh::Place>& places) {
  Json json = Json::array();
  for (const remesh::Place& place : places) {
    json.push_back({{"elements", place.elements}, {"position", vector_json(place.position)}});
  }
  return json;
}

std::string places_text(const std::vector<remesh::Place>& places) {
  std::ostringstream text;
  for (const remesh::Place& place : places) {
    if (&place != &places.front()) text << "; ";
    for (std::size_t k = 0; k < place.elements.size(); ++k) {
      text << (k > 0 ? "-" : "") << place.elements[k];
    }
    text << " at " << vector_text(place.position);
  }
  return text.str();
}

std::string count_text(const remesh::Finding& finding) {
  return finding.problem == remesh::Problem::crossing_faces
             ? crossings_text(static_cast<int>(finding.count))
             : std::to_string(finding.count);
}

Json problems_json(const remesh::MeshDiagnosis& diagnosis) {
  Json json = Json::array();
  for (const remesh::Finding& finding : diagnosis.findings) {
    json.push_back({{"problem", remesh::name_of(finding.problem)},
                    {"count", finding.count},
                    {"first", places_json(finding.first)}});
  }
  return json;
}

void add_file(const Inspection& inspection, Result& result) {
  const remesh::MeshDiagnosis& diagnosis = inspection.diagnosis;
  append(result.table, {{"as it is in the file (counted from 0)"},
                        {"points, faces",
                         std::to_string(diagnosis.points) + ", " + std::to_string(diagnosis.faces)},
                        {"components", std::to_string(diagnosis.components)},
                        {"boundary loops, edges", std::to_string(diagnosis.boundary_loops) + ", " +
                                                      std::to_string(diagnosis.boundary_edges)},
                        {"bounding box", vector_text(inspection.box.low) + " to " +
                                             vector_text(inspection.box.high) + ", diagonal " +
                                             significant(inspection.box.diagonal())}});
  if (!diagnosis.first_boundaries.empty()) {
    result.table.push_back({"first boundary edges", places_text(diagnosis.first_boundaries)});
  }
  for (const remesh::Finding& finding : diagnosis.findings) {
    result.table.push_back({std::string(remesh::name_of(finding.problem)),
                            count_text(finding) + ", first " + places_text(finding.first)});
  }
  result.json["points"] = diagnosis.points;
  result.json["faces"] = diagnosis.faces;
  result.json["components"] = diagnosis.components;
  result.json["boundary"] = {{"loops", diagnosis.boundary_loops},
                             {"edges", diagnosis.boundary_edges},
                             {"first", places_json(diagnosis.first_boundaries)}};
  result.json["box"] = {{"low", vector_json(inspection.box.low)},
                        {"high", vector_json(inspection.box.high)},
                        {"diagonal", inspection.box.diagonal()}};
  result.json["problems"] = problems_json(diagnosis);
}

void add_mesh(const Inspection& inspection, Result& result) {
  result.table.push_back({"as build reads it"});
  for (const std::string& note : inspection.repair_notes) result.table.push_back({"repair", note});
  append(result.table, quality_rows(inspection.quality));
  append(result.table, components_rows(inspection.components));
  const std::string angle = significant(feature_degrees) + "°";
  append(result.table,
         {{"edges sharper than " + angle, std::to_string(inspection.features.edges) + ", length " +
                                              significant(inspection.features.length)},
          {"bent more tightly than C60", percent(inspection.tight_fraction) + " of the area"}});
  append(result.table, plan_rows(*inspection.plan));
  result.json["quality"] = quality_json(inspection.quality);
  result.json["parts"] = components_json(inspection.components);
  result.json["features"] = {{"angle_degrees", feature_degrees},
                             {"edges", inspection.features.edges},
                             {"length", inspection.features.length}};
  result.json["tightly_curved_fraction"] = inspection.tight_fraction;
  result.json["build"] = plan_json(*inspection.plan);
}

}  // namespace

Inspection inspect(const std::string& path, const Session& session) {
  remesh::TriangleSoup soup;
  try {
    soup = read_soup(path);
  } catch (const remesh::Error& error) {
    return {.reason = error.what()};
  }
  return look_at(soup, session);
}

Result describe(const Inspection& inspection) {
  Result result;
  result.json = {{"verdict", name_of(inspection.verdict)},
                 {"reason", inspection.reason},
                 {"notes", inspection.reading_notes},
                 {"repair", inspection.repair_notes}};
  result.table.push_back(
      {"verdict", std::string(name_of(inspection.verdict)) + ": " + inspection.reason});
  if (inspection.is_read) add_file(inspection, result);
  if (inspection.plan) add_mesh(inspection, result);
  return result;
}

}  // namespace trivalent::apps
