#include <nlohmann/json.hpp>
#include <sstream>

#include "trivalent/shell/inspect.h"
#include "trivalent/shell/names.h"
#include "trivalent/shell/number_text.h"
#include "trivalent/shell/reports.h"

namespace trivalent::shell {
namespace {

std::string vector_text(const Eigen::Vector3d& p) {
  return "(" + significant(p.x()) + ", " + significant(p.y()) + ", " + significant(p.z()) + ")";
}

Json places_json(const std::vector<remesh::ProblemPlace>& places) {
  Json json = Json::array();
  for (const remesh::ProblemPlace& place : places) {
    json.push_back({{"elements", place.elements}, {"position", vector_json(place.position)}});
  }
  return json;
}

std::string places_text(const std::vector<remesh::ProblemPlace>& places) {
  std::ostringstream text;
  for (const remesh::ProblemPlace& place : places) {
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

std::vector<TableRow> file_rows(const Inspection& inspection) {
  const remesh::MeshDiagnosis& diagnosis = inspection.diagnosis;
  std::vector<TableRow> rows = {
      {"as it is in the file (counted from 0)"},
      {"points, faces", std::to_string(diagnosis.points) + ", " + std::to_string(diagnosis.faces)},
      {"components", std::to_string(diagnosis.components)},
      {"boundary loops, edges",
       std::to_string(diagnosis.boundary_loops) + ", " + std::to_string(diagnosis.boundary_edges)},
      {"bounding box", vector_text(inspection.box.low) + " to " + vector_text(inspection.box.high) +
                           ", diagonal " + significant(inspection.box.diagonal())}};
  if (!diagnosis.first_boundaries.empty()) {
    rows.push_back({"first boundary edges", places_text(diagnosis.first_boundaries)});
  }
  for (const remesh::Finding& finding : diagnosis.findings) {
    rows.push_back({std::string(remesh::name_of(finding.problem)),
                    count_text(finding) + ", first " + places_text(finding.first)});
  }
  return rows;
}

void add_file(const Inspection& inspection, Json& json) {
  const remesh::MeshDiagnosis& diagnosis = inspection.diagnosis;
  json["points"] = diagnosis.points;
  json["faces"] = diagnosis.faces;
  json["components"] = diagnosis.components;
  json["boundary"] = {{"loops", diagnosis.boundary_loops},
                      {"edges", diagnosis.boundary_edges},
                      {"first", places_json(diagnosis.first_boundaries)}};
  json["box"] = {{"low", vector_json(inspection.box.low)},
                 {"high", vector_json(inspection.box.high)},
                 {"diagonal", inspection.box.diagonal()}};
  json["problems"] = problems_json(diagnosis);
}

std::vector<TableRow> mesh_rows(const Inspection& inspection) {
  std::vector<TableRow> rows = {{"as build reads it"}};
  for (const std::string& note : inspection.repair_notes) rows.push_back({"repair", note});
  append(rows, quality_rows(inspection.quality));
  append(rows, components_rows(inspection.components));
  append(rows,
         {{"edges sharper than " + significant(inspected_feature_angle) + "°",
           std::to_string(inspection.features.edges) + ", length " +
               significant(inspection.features.length)},
          {"bent more tightly than C60", percent(inspection.tight_fraction) + " of the area"}});
  append(rows, inspection.plan->rows());
  return rows;
}

void add_mesh(const Inspection& inspection, Json& json) {
  json["quality"] = quality_json(inspection.quality);
  json["parts"] = components_json(inspection.components);
  json["features"] = {{"angle_degrees", inspected_feature_angle},
                      {"edges", inspection.features.edges},
                      {"length", inspection.features.length}};
  json["tightly_curved_fraction"] = inspection.tight_fraction;
  json["build"] = inspection.plan->json();
}

}  // namespace

std::string_view name_of(Verdict verdict) {
  constexpr Names<Verdict, 3> names = {{{"sound", Verdict::sound},
                                        {"mendable", Verdict::mendable},
                                        {"hopeless", Verdict::hopeless}}};
  return name_of(verdict, names);
}

Json Inspection::json() const {
  Json json = {{"verdict", name_of(verdict)},
               {"reason", reason},
               {"notes", reading_notes},
               {"repair", repair_notes}};
  if (is_read) add_file(*this, json);
  if (plan) add_mesh(*this, json);
  return json;
}

std::vector<TableRow> Inspection::rows() const {
  std::vector<TableRow> rows = {{"verdict", std::string(name_of(verdict)) + ": " + reason}};
  if (is_read) append(rows, file_rows(*this));
  if (plan) append(rows, mesh_rows(*this));
  return rows;
}

}  // namespace trivalent::shell
