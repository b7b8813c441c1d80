#include "command.h"
#include "file_options.h"
#include "files.h"
#include "session.h"
#include "size_options.h"
#include "trivalent/dual/network_checks.h"
#include "trivalent/formats/structure_format.h"
#include "trivalent/shell/mesh_dual.h"
#include "trivalent/shell/number_text.h"
#include "trivalent/shell/reports.h"

namespace trivalent::apps {
namespace {

Grammar grammar_of_dual() {
  Grammar grammar = {.arguments = {"MESH", "OUT"}, .options = po::options_description("Options")};
  add_dual_size_options(grammar.options);
  add_file_options(grammar.options);
  return grammar;
}

int run_dual(const Command& self, std::span<const std::string> arguments) {
  const auto session = start(self, arguments, grammar_of_dual());
  if (!session) return done;
  const dual::DualSize size = dual_size(*session).value_or(dual::MeanBond());
  const dual::WriteOptions options = {.digits = digits(*session),
                                      .atom_style = atom_style(*session)};
  const auto& output = session->get<std::string>("OUT");
  check_structure_output(output);

  remesh::TriMesh mesh = read_mesh_file(session->get<std::string>("MESH"), session->terminal);
  const double scale = dual::scale_for_size(mesh, size);
  const dual::Structure structure = shell::structure_of(std::move(mesh), size);
  session->terminal.notes(dual::write_structure(output, structure, options));

  const dual::NetworkReport report = dual::check_network(structure);
  Result result = {
      .table = {{"wrote", output}, {"scale [Å per unit]", shell::significant(scale, 6)}},
      .json = {{"file", output}, {"scale", scale}}};
  shell::append(result.table, shell::network_rows(report));
  result.json["network"] = shell::network_json(report);
  session->terminal.print(result);
  return done;
}

}  // namespace

const Command dual_command = {
    .name = "dual",
    .synopsis = "MESH OUT.extxyz|OUT.data [options]",
    .meaning = "Writes the dual of a triangle mesh: an atom per triangle, a bond per edge",
    .run = run_dual};

}  // namespace trivalent::apps
