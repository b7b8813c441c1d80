#include <filesystem>

#include "command.h"
#include "files.h"
#include "report_page.h"
#include "session.h"
#include "states.h"
#include "trivalent/dual/energy_summary.h"
#include "trivalent/shell/number_text.h"
#include "trivalent/shell/reports.h"
#include "trivalent/shell/states.h"
#include "trivalent/view/shell_page.h"

namespace trivalent::apps {
namespace {

constexpr std::array<std::string_view, 1> page_extensions = {".html"};

Grammar grammar_of_view() {
  Grammar grammar = {.arguments = {}, .options = po::options_description("Options")};
  grammar.options.add_options()  //
      ("output,o", po::value<std::string>(), "the page, .html; must be given")(
          "title", po::value<std::string>(),
          "heading of the page; default: the name of the last file")(
          "surface", po::value<std::string>(), "mesh file to be shown as a ghost, in Å");
  add_states_options(grammar);
  return grammar;
}

Result describe(const std::vector<dual::ShellState>& states, const std::filesystem::path& page) {
  const auto bytes = std::filesystem::file_size(page);
  Result result = {.table = {},
                   .json = {{"page", page.string()}, {"bytes", bytes}, {"states", Json::array()}}};
  for (const dual::ShellState& state : states) {
    const auto summary = dual::summarize_energies(state.find("energy")->values, 0);
    result.table.push_back({state.name, std::to_string(state.structure.atoms.size()) +
                                            " atoms, mean " + shell::decimals(summary.mean, 4) +
                                            " eV"});
    result.json["states"].push_back({{"name", state.name},
                                     {"atoms", state.structure.atoms.size()},
                                     {"energy", summary.total},
                                     {"highest", summary.highest}});
  }
  result.json["scale"] = shell::scale_json(states.back().find("energy")->scale);
  result.table.push_back(
      {"page",
       page.string() + ", " + shell::decimals(1e-6 * static_cast<double>(bytes), 2) + " MB"});
  return result;
}

int run_view(const Command& self, std::span<const std::string> arguments) {
  const auto session = start(self, arguments, grammar_of_view());
  if (!session) return done;
  if (!session->has("output")) throw UsageError("-o must say where the page goes");
  const std::filesystem::path output = session->get<std::string>("output");
  check_output(output, page_extensions);
  const StatesRequest request = states_request(*session);

  dual::ShellPage page = shell::page_of(read_states(request, session->terminal), request.potential);
  page.title = session->find<std::string>("title").value_or(page.title);
  if (const auto surface = session->find<std::string>("surface")) {
    page.surface = read_mesh_file(*surface, session->terminal);
  }
  write_page(output, page);
  session->terminal.print(describe(page.states, output));
  return done;
}

}  // namespace

const Command view_command = {
    .name = "view",
    .synopsis = "FILE... -o PAGE.html [--potential rebo|airebo|lj] [options]",
    .meaning = "Writes a page that shows atoms in 3D, colored by energy and more",
    .run = run_view};

}  // namespace trivalent::apps
