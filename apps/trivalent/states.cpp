#include "states.h"

#include <filesystem>

#include "potential_options.h"
#include "structure_options.h"
#include "trivalent/shell/evaluate.h"

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
  std::vector<dual::ShellState> states;
  for (std::size_t i = 0; i < request.files.size(); ++i) {
    states.push_back(shell::evaluate(read_structure(request.files[i], request.reading, terminal),
                                     {.potential = request.potential})
                         .state);
    states.back().name = request.names[i];
  }
  const potentials::Atoms& first = states.front().structure.atoms;
  const potentials::Atoms& last = states.back().structure.atoms;
  if (states.size() > 1 && first.species == last.species) {
    states.back().maps.push_back(dual::displacement_map(first.positions, last.positions));
  }
  return states;
}

}  // namespace trivalent::apps
