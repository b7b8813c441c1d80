// Feeds bytes to the readers of all formats of atoms, through a file in memory.

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "trivalent/dual/error.h"
#include "trivalent/formats/structure_format.h"

namespace {

using namespace trivalent;  // NOLINT(google-build-using-namespace)

/// Calls a reader, which gives as many species as positions or says what is wrong.
template <typename Read>
void try_to_read(const Read& read) {
  try {
    const potentials::Atoms atoms = read();
    if (atoms.species.size() != atoms.positions.size()) std::abort();
  } catch (const dual::FileError& error) {
    if (std::string(error.what()).empty()) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const int file = memfd_create("atoms", 0);
  if (file < 0 || write(file, data, size) != static_cast<ssize_t>(size)) std::abort();
  const std::filesystem::path path = "/proc/self/fd/" + std::to_string(file);
  for (const dual::StructureFormat& format : dual::structure_formats()) {
    if (format.read == nullptr) continue;
    try_to_read([&] { return format.read(path, {}).structure.atoms; });
  }
  close(file);
  return 0;
}
