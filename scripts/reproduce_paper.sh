#!/usr/bin/env bash
# Prints Tables 1 and 2 and the models of Figures 4 and 5 of Pecanha et al. (ICCS 2013) beside what
# `trivalent remesh` makes.
# usage: scripts/reproduce_paper.sh [FOLDER]   FOLDER: holds igea-8k.off and rocker-arm-x50.off, two public
#        models that are not part of this project (default: ../shared/meshes). What is missing is said.
# The bunny is bunny00 of libcgal-demo, coarsened to the 9,002 vertices of the paper's.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
models=$(realpath -m "${1:-../shared/meshes}")

scripts/install_deps.sh
cmake --preset release -DTRIVALENT_BUILD_BENCHMARKS=ON >/dev/null
cmake --build --preset release --target trivalent coarsen_mesh >/dev/null
bin=build/release/bin
results=results/paper
mkdir -p "$results"
"$bin/coarsen_mesh" build/release/data/meshes/bunny00.off "$results/bunny-9k.off" 9002

MODELS=$models BIN=$bin RESULTS=$results python3 - <<'END'
import json, os, subprocess

models, program, results = os.environ['MODELS'], os.environ['BIN'] + '/trivalent', os.environ['RESULTS']


def run(*arguments):
    done = subprocess.run([program, *map(str, arguments), '--json', '--quiet'], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(done.stderr)
    return json.loads(done.stdout)


def model(name):
    path = f'{models}/{name}'
    if os.path.exists(path):
        return path
    print(f'  left out: {path} is not there')


def compare(label, options, paper, path, m):
    mean, deviation, vertices, regular = paper
    paper_cv = 100 * deviation / mean
    quality = run('remesh', path, f'{results}/last.off', '--edge', repr(m), '--method', 'paper', *options)['quality']
    edge = quality['edge_length']
    cv, six = 100 * edge['relative_spread'], 100 * quality['regular_fraction']
    holds = cv <= paper_cv and six >= regular and abs(edge['mean'] / m - 1) <= 0.02
    print(f'  {label}   paper: CV {paper_cv:5.2f} %, valence 6 {regular:4.1f} %, mean/m {mean / paper_m:.4f}, {vertices:6d} V'
          f'   here: CV {cv:5.2f} %, valence 6 {six:4.1f} %, mean/m {edge["mean"] / m:.4f}, {quality["vertices"]:6d} V'
          f'   {"holds" if holds else "MISSED"}')


print('Table 1: bunny, sigma 0.2, k = 2')
bunny = f'{results}/bunny-9k.off'
start = run('inspect', bunny)['quality']
print(f'  start   paper: CV 41.00 %, valence 6 36.6 %, 9002 V   here: CV {100 * start["edge_length"]["relative_spread"]:.2f} %,'
      f' valence 6 {100 * start["regular_fraction"]:.1f} %, {start["vertices"]} V')
paper_m = 0.5
m = paper_m / 0.6019 * start['edge_length']['mean']  # the same ratio to the input's average
for n, paper in ((5, (.5008, .0546, 10404, 77.8)), (10, (.5076, .0454, 9924, 82.4)),
                 (20, (.5108, .0397, 9578, 86.1)), (30, (.5124, .0380, 9394, 86.8))):
    compare(f'n = {n:2d}', ['--iterations', n], paper, bunny, m)

print('Table 2: Egea (Igea), m = 0.8, n = 20, sigma 0.2')
paper_m = 0.8
if igea := model('igea-8k.off'):
    for k, paper in ((1, (.792564, .076465, 10447, 80.1)), (2, (.801297, .073887, 10282, 81.7)),
                     (3, (.814370, .071990, 9921, 84.0)), (4, (.825473, .073180, 9617, 84.8))):
        compare(f'k = {k}', ['--rings', k], paper, igea, paper_m)

print('Figures 4 and 5: rocker-arm, sigma 0.2, k = 2, n = 30')
if rocker := model('rocker-arm-x50.off'):
    euler = run('inspect', rocker)['quality']['euler_characteristic']
    for m in (0.3, 0.5, 0.8, 1.2, 1.6):
        result = run('remesh', rocker, f'{results}/rocker-arm-{m}.off', '--edge', m,
                     '--method', 'paper', '--iterations', 30)
        quality, distance = result['quality'], result['distance']
        genus = 'kept' if quality['euler_characteristic'] == euler else 'CHANGED'
        print(f'  m = {m}   {quality["vertices"]:6d} V, genus {genus}, {quality["self_intersections"]} self-intersections,'
              f' rms distance {100 * distance["rms_of_diagonal"]:.3f} % of the diagonal,'
              f' CV {100 * quality["edge_length"]["relative_spread"]:.2f} %,'
              f' valence 6 {100 * quality["regular_fraction"]:.1f} %')
END
