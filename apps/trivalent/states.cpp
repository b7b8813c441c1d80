#include "states.h"

#include <filesystem>

#include "potential_options.h"
#include "structure.h"

namespace trivalent::apps {
namespace {

dual::ShellState read_state(const std::string& path, const Session& session) {
  dual::ShellState state = dual::shell_state(std::filesystem::path(path).filename().string(),
                                             read_structure(path, session));
  dual::add_energies(state, evaluate(state.structure.atoms, session).energies,
                     graphene_reference(session));
  return state;
}

}  // namespace

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

void check_states_options(const Session& session) {
  check_structure_options(session);
  check_potential(session);
  const auto names = session.find<std::vector<std::string>>("name");
  if (names && names->size() != session.get<std::vector<std::string>>("FILE").size()) {
    throw UsageError("--name must be given once for every file, or not at all");
  }
}

std::vector<dual::ShellState> read_states(const Session& session) {
  std::vector<dual::ShellState> states;
  for (const auto& path : session.get<std::vector<std::string>>("FILE")) {
    states.push_back(read_state(path, session));
  }
  if (const auto names = session.find<std::vector<std::string>>("name")) {
    for (std::size_t i = 0; i < states.size(); ++i) states[i].name = (*names)[i];
  }
  const potentials::Atoms& first = states.front().structure.atoms;
  const potentials::Atoms& last = states.back().structure.atoms;
  if (states.size() > 1 && first.species == last.species) {
    states.back().maps.push_back(dual::displacement_map(first.positions, last.positions));
  }
  return states;
}

}  // namespace trivalent::apps
