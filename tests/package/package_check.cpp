// An outside program that uses the whole way: shape, shell at rest, certificate, files.
#include <cstdio>
#include <filesystem>

#include "trivalent/shell/build.h"
#include "trivalent/shell/build_files.h"
#include "trivalent/shell/certify.h"

int main() {
  namespace shell = trivalent::shell;
  shell::BuildOptions options;
  options.shell.size = trivalent::dual::AtomCount{500};
  const auto result = shell::build(shell::read_surface("sphere", options.shell), options);
  std::filesystem::create_directories("shell");
  shell::write_build("shell", result);
  const auto certificate = shell::certify(result.structure());
  std::printf("%d atoms, %.4f eV/atom\n", certificate.shell.atoms, certificate.summary.mean);
  const bool is_written = std::filesystem::exists("shell/shell.extxyz");
  return certificate.is_sound() && is_written && certificate.summary.mean < -7.0 ? 0 : 1;
}
