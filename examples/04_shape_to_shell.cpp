// From a mesh file to a certified carbon shell at rest, as `trivalent build` and `trivalent check`
// do it.
#include <cstdio>
#include <exception>
#include <filesystem>

#include "trivalent/shell/build.h"
#include "trivalent/shell/build_files.h"
#include "trivalent/shell/certify.h"

namespace shell = trivalent::shell;

int main(int argc, char** argv) {
  try {
    shell::BuildOptions options;
    options.shell.size = trivalent::dual::AtomCount{1000};
    // A path to a mesh file, or a built-in shape.
    const char* source = argc > 1 ? argv[1] : "sphere";
    const auto result = shell::build(shell::read_surface(source, options.shell), options);
    std::filesystem::create_directories("shell");
    shell::write_build("shell", result);
    const shell::Certificate certificate = shell::certify(result.structure());
    std::printf("%d atoms, %.4f eV/atom, largest force %.2g eV/Å\n", certificate.shell.atoms,
                certificate.summary.mean, certificate.largest_force);
    for (const auto& problem : certificate.problems) std::printf("wrong: %s\n", problem.c_str());
    return certificate.is_sound() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
