// Feeds bytes to the readers of atoms, through a file in memory. Not to that of CIF: clang 14 does
// not compile gemmi's parser as C++20.

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "trivalent/dual/error.h"
#include "trivalent/formats/cp2k.h"
#include "trivalent/formats/dftb_gen.h"
#include "trivalent/formats/espresso.h"
#include "trivalent/formats/gro.h"
#include "trivalent/formats/lammps_data.h"
#include "trivalent/formats/mol2.h"
#include "trivalent/formats/pdb.h"
#include "trivalent/formats/poscar.h"
#include "trivalent/formats/xyz.h"

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
  for (const auto read :
       {dual::read_xyz, dual::read_lammps_data, dual::read_poscar, dual::read_pdb, dual::read_gro,
        dual::read_mol2, dual::read_dftb_gen, dual::read_espresso, dual::read_cp2k}) {
    try_to_read([&] { return read(path, {}).structure.atoms; });
  }
  close(file);
  return 0;
}
