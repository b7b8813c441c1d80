// Times force evaluations of one structure, for comparison with other programs:
//   rebo_time graphene|shell|FILE.xyz [threads [evaluations [rebo|airebo|moving]]]
//     microseconds per atom and evaluation; AIREBO's with the search for neighbors; moving: REBO's
//     of atoms that move a little from one evaluation to the next
//   rebo_time graphene|shell|FILE.xyz data FILE
//     writes it for LAMMPS

#include <sys/resource.h>
#include <tbb/global_control.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <string>

#include "bench_structures.h"
#include "trivalent/potentials/airebo.h"
#include "trivalent/potentials/rebo.h"

namespace {

using namespace trivalent;  // NOLINT(google-build-using-namespace): a program of one page

void write_lammps_data(const potentials::Atoms& atoms, const std::string& path) {
  std::FILE* out = std::fopen(path.c_str(), "w");
  if (out == nullptr) throw std::runtime_error("cannot write " + path);
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d high = atoms.box.cell.diagonal();
  constexpr double margin = 10.0;  // LAMMPS loses atoms on the face of a box [Å]
  for (const Eigen::Vector3d& x : atoms.positions) {
    for (int k = 0; k < 3; ++k) {
      if (atoms.box.periodic[static_cast<std::size_t>(k)]) continue;
      low[k] = std::min(low[k], x[k] - margin);
      high[k] = std::max(high[k], x[k] + margin);
    }
  }
  std::fprintf(out, "structure\n\n%zu atoms\n2 atom types\n\n", atoms.size());
  for (int k = 0; k < 3; ++k) {
    std::fprintf(out, "%.17g %.17g %clo %chi\n", low[k], high[k], 'x' + k, 'x' + k);
  }
  std::fprintf(out, "\nMasses\n\n1 12.011\n2 1.008\n\nAtoms # atomic\n\n");
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    const Eigen::Vector3d& x = atoms.positions[i];
    std::fprintf(out, "%zu %d %.17g %.17g %.17g\n", i + 1,
                 atoms.species[i] == potentials::Species::carbon ? 1 : 2, x[0], x[1], x[2]);
  }
  std::fclose(out);
}

// Calls evaluate() once and then, timed, some more times.
void time_evaluations(const potentials::Atoms& atoms, int evaluations, const auto& evaluate) {
  const auto now = [] { return std::chrono::steady_clock::now(); };
  const double energy = evaluate();
  const auto begin = now();
  for (int k = 0; k < evaluations; ++k) (void)evaluate();
  const double seconds = std::chrono::duration<double>(now() - begin).count();
  const auto n = static_cast<double>(atoms.size());
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("%.5f us per atom and evaluation, %zu atoms, %.12g eV, %.0f bytes per atom\n",
              1e6 * seconds / (n * evaluations), atoms.size(), energy,
              1024.0 * static_cast<double>(usage.ru_maxrss) / n);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::fprintf(stderr,
                 "usage: rebo_time graphene|shell|FILE.xyz "
                 "[threads [evaluations [rebo|airebo|moving]]]\n");
    return 2;
  }
  const auto atoms = bench::structure(argv[1]);
  if (argc == 4 && std::string(argv[2]) == "data") {
    write_lammps_data(atoms, argv[3]);
    return 0;
  }
  const std::size_t threads = argc > 2 ? std::stoul(argv[2]) : 1;
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  const int evaluations = argc > 3 ? std::stoi(argv[3]) : 50;
  if (argc > 4 && std::string(argv[4]) == "airebo") {
    time_evaluations(atoms, evaluations, [&] { return potentials::airebo(atoms).energy; });
  } else {
    const bool is_moving = argc > 4 && std::string(argv[4]) == "moving";
    potentials::Atoms moved = atoms;
    if (is_moving) {
      for (Eigen::Vector3d& x : moved.positions) x *= 1.0 + 1e-6;
    }
    potentials::Rebo potential;
    potentials::EnergyForces result;
    bool is_odd = false;
    time_evaluations(atoms, evaluations, [&] {
      is_odd = !is_odd;
      result = potential.evaluate(is_odd ? atoms : moved, std::move(result));
      return result.energy;
    });
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
