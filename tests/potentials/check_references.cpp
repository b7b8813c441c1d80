// Compares a potential with LAMMPS on all references under a folder: check_references STYLE FOLDER.
// Beside the test suite, for sets of references that are not committed.

#include <cstdio>
#include <exception>
#include <map>
#include <string>

#include "reference_structure.h"
#include "trivalent/potentials/airebo.h"
#include "trivalent/potentials/lennard_jones.h"
#include "trivalent/potentials/rebo.h"

namespace {

using namespace trivalent;  // NOLINT(google-build-using-namespace): a program of one page

using Evaluate = potentials::EnergyForces (*)(const potentials::Atoms&);

const std::map<std::string, Evaluate>& styles() {
  static const std::map<std::string, Evaluate> table = {
      {"airebo11", [](const potentials::Atoms& atoms) { return potentials::airebo(atoms); }},
      {"rebo", [](const potentials::Atoms& atoms) { return potentials::rebo(atoms); }},
      {"ljcut", [](const potentials::Atoms& atoms) { return potentials::lennard_jones(atoms); }},
  };
  return table;
}

int check(const std::string& style, const std::string& folder) {
  int failures = 0;
  for (const auto& reference : testing_support::read_references(folder, style)) {
    const auto result = styles().at(style)(reference.atoms);
    const auto off =
        testing_support::deviation(reference, result, testing_support::tolerance_of(reference));
    const bool is_good = off.worst() <= 1.0;
    failures += is_good ? 0 : 1;
    std::printf(
        "%-4s %-45s %7zu atoms  of what is allowed: energy %.1e  atoms %.1e  forces %.1e"
        "  virial %.1e\n",
        is_good ? "ok" : "FAIL", reference.name.c_str(), reference.atoms.size(), off.energy,
        off.energies, off.forces, off.virial);
  }
  std::printf("%d failures\n", failures);
  return failures == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: check_references STYLE FOLDER\n");
    return 2;
  }
  return check(argv[1], argv[2]);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
