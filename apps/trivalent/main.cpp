#include <array>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "command.h"
#include "commit.h"
#include "interruption.h"
#include "session.h"
#include "trivalent/dual/error.h"
#include "trivalent/potentials/error.h"
#include "trivalent/remesh/error.h"

namespace trivalent::apps {
namespace {

const std::array commands = {&build_command,   &remesh_command, &dual_command,   &energy_command,
                             &relax_command,   &check_command,  &lammps_command, &convert_command,
                             &inspect_command, &shape_command,  &view_command,   &render_command};

int print_help() {
  std::cout << "Usage: trivalent COMMAND ...\n\nTurns a triangle surface into a carbon shell.\n\n";
  for (const Command* command : commands) {
    std::cout << "  trivalent " << command->name << ' ' << command->synopsis << "\n      "
              << command->meaning << '\n';
  }
  std::cout
      << "\nEvery command explains itself with --help; trivalent --version tells the version.\n"
      << "Exit codes: 0 done, 1 failed, 2 wrong usage; inspect: 0 sound, 1 mendable, 3 hopeless;\n"
         "relax: 3 not at rest.\n";
  return done;
}

int run(const std::vector<std::string>& words) {
  if (words.empty()) throw UsageError("no command; see trivalent --help");
  const std::string& name = words.front();
  if (name == "--help" || name == "-h" || name == "help") return print_help();
  if (name == "--version") {
    std::cout << "trivalent " TRIVALENT_VERSION << (commit.empty() ? "" : " (") << commit
              << (commit.empty() ? "\n" : ")\n");
    return done;
  }
  for (const Command* command : commands) {
    if (command->name != name) continue;
    return command->run(*command, std::span(words).subspan(1));
  }
  throw UsageError("there is no command '" + name + "'; see trivalent --help");
}

int complain(const char* message, int exit_code) {
  std::cerr << "trivalent: " << message << '\n';
  return exit_code;
}

int run_and_report(const std::vector<std::string>& words) {
  try {
    const int exit_code = run(words);
    std::cout.flush();
    if (!std::cout) return complain("cannot write to standard output", failed);
    return exit_code;
  } catch (const UsageError& error) {
    return complain(error.what(), wrong_usage);
  } catch (const boost::program_options::error& error) {
    return complain(error.what(), wrong_usage);
  } catch (const remesh::InvalidOption& error) {
    return complain(error.what(), wrong_usage);
  } catch (const dual::InvalidOption& error) {
    return complain(error.what(), wrong_usage);
  } catch (const potentials::InvalidOption& error) {
    return complain(error.what(), wrong_usage);
  } catch (const remesh::Stopped&) {
    return complain("stopped before anything was finished; nothing is kept",
                    interruption_exit_code());
  } catch (const std::bad_alloc&) {
    return complain("out of memory", failed);
  } catch (const std::exception& error) {
    return complain(error.what(), failed);
  }
}

}  // namespace
}  // namespace trivalent::apps

int main(int argc, char** argv) {
  trivalent::apps::handle_interruptions();
  return trivalent::apps::run_and_report(std::vector<std::string>(argv + 1, argv + argc));
}
