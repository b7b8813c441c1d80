#include "command.h"
#include "files.h"
#include "reports.h"
#include "session.h"
#include "shell_files.h"
#include "size_options.h"
#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/columns.h"
#include "trivalent/formats/lammps_data.h"
#include "trivalent/formats/xyz.h"

namespace trivalent::apps {
namespace {

constexpr std::array<std::string_view, 3> network_extensions = {".extxyz", ".xyz", ".data"};

Grammar grammar_of_dual() {
  Grammar grammar = {.arguments = {"MESH", "OUT"}, .options = po::options_description("Options")};
  add_dual_size_options(grammar.options);
  add_file_options(grammar.options);
  return grammar;
}

void write_network(dual::Structure structure, const Session& session) {
  const std::filesystem::path output = session.get<std::string>("OUT");
  if (extension_of(output) == ".data") {
    dual::write_lammps_data(output, structure,
                            {.style = atom_style(session), .digits = digits(session)});
    return;
  }
  dual::replace_columns(structure, dual::network_columns(structure));
  dual::write_xyz(output, structure, digits(session));
}

int run(const Command& self, std::span<const std::string> arguments) {
  const auto session = start(self, arguments, grammar_of_dual());
  if (!session) return done;
  const dual::DualSize size = dual_size(*session);
  static_cast<void>(digits(*session));
  static_cast<void>(atom_style(*session));
  const auto& output = session->get<std::string>("OUT");
  check_output(output, network_extensions);

  remesh::TriMesh mesh = read_mesh_file(session->get<std::string>("MESH"), session->terminal);
  const double scale = dual::scale_for_size(mesh, size);
  remesh::scale(mesh, scale);
  const dual::Structure structure = dual::build_dual(mesh);
  write_network(structure, *session);

  const dual::NetworkReport report = dual::check_network(structure);
  Result result = {.table = {{"wrote", output}, {"scale [Å per unit]", significant(scale, 6)}},
                   .json = {{"file", output}, {"scale", scale}}};
  append(result.table, network_rows(report));
  result.json["network"] = network_json(report);
  session->terminal.print(result);
  return done;
}

}  // namespace

const Command dual_command = {
    .name = "dual",
    .synopsis = "MESH OUT.extxyz|OUT.data [options]",
    .meaning = "Writes the dual of a triangle mesh: an atom per triangle, a bond per edge",
    .run = run};

}  // namespace trivalent::apps
