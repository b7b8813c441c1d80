#include "command.h"
#include "files.h"
#include "reports.h"
#include "session.h"
#include "trivalent/remesh/mesh_quality.h"

namespace trivalent::apps {
namespace {

void add_target(const remesh::MeshQuality& quality, double target, Result& result) {
  if (!(target > 0.0)) throw UsageError("--edge must be > 0");
  const double ratio = quality.edge_length.mean / target;
  result.table.push_back({"mean edge / wanted", decimals(ratio, 4)});
  result.json["target_edge_length"] = target;
  result.json["mean_over_target"] = ratio;
}

int run(const Command& self, std::span<const std::string> arguments) {
  Grammar grammar = {.arguments = {"MESH"}, .options = po::options_description("Options")};
  grammar.options.add_options()                                                     //
      ("against", po::value<std::string>(), "mesh file to measure distances from")  //
      ("edge", po::value<double>(), "wanted edge length to compare with, in units of the mesh");
  const auto session = start(self, arguments, grammar);
  if (!session) return done;

  const auto& path = session->get<std::string>("MESH");
  const remesh::TriMesh mesh = read_mesh_file(path, session->terminal);
  const remesh::MeshQuality quality = remesh::measure_quality(mesh);
  Result result = {.table = quality_rows(quality), .json = {{"file", path}}};
  result.json["quality"] = quality_json(quality);
  if (const auto target = session->find<double>("edge")) add_target(quality, *target, result);
  if (const auto original = session->find<std::string>("against")) {
    const auto distance =
        remesh::measure_distance(mesh, read_mesh_file(*original, session->terminal));
    append(result.table, distance_rows(distance));
    result.json["against"] = *original;
    result.json["distance"] = distance_json(distance);
  }
  session->terminal.print(result);
  return done;
}

}  // namespace

const Command inspect_command = {
    .name = "inspect",
    .synopsis = "MESH [--against ORIGINAL] [--edge m]",
    .meaning = "Measures how regular a mesh is, and how far from another",
    .run = run};

}  // namespace trivalent::apps
