#include "states.h"

#include <filesystem>

#include "potential_options.h"
#include "structure_options.h"
#include "trivalent/shell/states.h"

namespace trivalent::apps {

void add_states_options(Grammar& grammar) {
  grammar.list = "FILE";
  grammar.options.add_options()  //
      ("name", po::value<std::vector<std::string>>(),
       "what to call a file; once per file, in their order; default: its name");
  add_potential_options(grammar.options);
  add_structure_options(grammar.options);
  grammar.epilog =
      "FILE is extended XYZ, LAMMPS data or a mesh, whose dual is meant. Several files are states "
      "of\n"
      "one shell, first to last: they are compared in the colors of the last.\n";
}

StatesRequest states_request(const Session& session) {
  StatesRequest request = {
      .files = session.get<std::vector<std::string>>("FILE"),
      .names = session.find<std::vector<std::string>>("name").value_or(std::vector<std::string>{}),
      .reading = structure_options(session),
      .potential = potential_choice(session)};
  if (request.names.empty()) {
    for (const std::string& file : request.files) {
      request.names.push_back(std::filesystem::path(file).filename().string());
    }
  }
  if (request.names.size() == request.files.size()) return request;
  throw UsageError("--name must be given once for every file, or not at all");
}

std::vector<dual::ShellState> read_states(const StatesRequest& request, const Terminal& terminal) {
  std::vector<shell::NamedStructure> structures;
  for (std::size_t i = 0; i < request.files.size(); ++i) {
    structures.push_back(
        {request.names[i], read_structure(request.files[i], request.reading, terminal)});
  }
  return shell::evaluate_states(std::move(structures), request.potential);
}

}  // namespace trivalent::apps
