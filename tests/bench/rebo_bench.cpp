// Time per atom and evaluation of the potentials: rebo_bench [--benchmark_filter=...]

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include "bench_structures.h"
#include "rebo/parameters.h"
#include "rebo/plain_rebo.h"
#include "trivalent/potentials/airebo.h"
#include "trivalent/potentials/lennard_jones.h"
#include "trivalent/potentials/rebo.h"

namespace {

using namespace trivalent;  // NOLINT(google-build-using-namespace): a program of one page

void report(benchmark::State& state, const potentials::Atoms& atoms) {
  state.counters["s_per_atom"] = benchmark::Counter(
      static_cast<double>(atoms.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void evaluate_again(benchmark::State& state, const potentials::Atoms& atoms, std::size_t threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  potentials::Rebo potential;
  potentials::EnergyForces result = potential.evaluate(atoms);
  for (auto _ : state) {
    result = potential.evaluate(atoms, std::move(result));
    benchmark::DoNotOptimize(result.energy);
  }
  report(state, atoms);
}

// Flat from ten thousand atoms to ten million.
void rebo_by_size(benchmark::State& state) {
  evaluate_again(state, bench::graphene_of(static_cast<int>(state.range(0))), 1);
}
BENCHMARK(rebo_by_size)->Arg(50)->Arg(158)->Arg(500)->Arg(1580)->UseRealTime();

void rebo_by_threads(benchmark::State& state) {
  evaluate_again(state, bench::graphene_100k(), static_cast<std::size_t>(state.range(0)));
}
BENCHMARK(rebo_by_threads)->Arg(1)->Arg(2)->UseRealTime();

void rebo_shell(benchmark::State& state) { evaluate_again(state, bench::shell_50k(), 1); }
BENCHMARK(rebo_shell)->UseRealTime();

void rebo_diamond(benchmark::State& state) {
  auto atoms = testing_support::diamond(16, 3.567);
  testing_support::displace(atoms, 0.05, 1);
  evaluate_again(state, atoms, 1);
}
BENCHMARK(rebo_diamond)->UseRealTime();

template <typename Potential>
void evaluate_once(benchmark::State& state, const Potential& potential) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  const auto atoms = bench::shell_50k();
  for (auto _ : state) benchmark::DoNotOptimize(potential(atoms));
  report(state, atoms);
}

// With the search for neighbors.
void one_rebo(benchmark::State& state) {
  evaluate_once(state, [](const auto& atoms) { return potentials::rebo(atoms).energy; });
}
BENCHMARK(one_rebo)->UseRealTime();

void one_plain_rebo(benchmark::State& state) {
  evaluate_once(state, [](const auto& atoms) {
    return potentials::rebo_detail::plain_rebo(atoms, potentials::rebo_detail::brenner_2002).energy;
  });
}
BENCHMARK(one_plain_rebo)->UseRealTime();

void one_airebo(benchmark::State& state) {
  evaluate_once(state, [](const auto& atoms) { return potentials::airebo(atoms).energy; });
}
BENCHMARK(one_airebo)->UseRealTime();

void one_lennard_jones(benchmark::State& state) {
  evaluate_once(state, [](const auto& atoms) { return potentials::lennard_jones(atoms).energy; });
}
BENCHMARK(one_lennard_jones)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
