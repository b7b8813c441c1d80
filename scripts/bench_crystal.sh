#!/usr/bin/env bash
# Crystal nets of real meshes: quality, distance, energy above graphene after relaxation, seconds and
# peak memory, each beside the paper's method and CGAL's isotropic remeshing (one thread) in the same
# run; the last rows are bunny00 with ten times the vertices, for the growth, which are not relaxed: that
# takes a quarter of an hour for the rough nets. Then shells of carbon as `build` makes them: excess
# energy beside the icosahedral law for spheres, bending energy and 5-7 pairs left over, distances from
# the surface both ways before relaxation and at rest, bonds broken and formed. The last is the bunny of
# 200,000 atoms as it comes from the net. Needs a release build with -DTRIVALENT_BUILD_BENCHMARKS=ON.
#
#   scripts/bench_crystal.sh [MESH EDGE]...    default: meshes of Debian's libcgal-demo
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

program=$PWD/build/release/bin/trivalent
peer=$PWD/build/release/bin/remesh_bench
meshes=$PWD/build/release/data/meshes
[[ $# -gt 0 ]] || set -- "$meshes/bunny00.off" 0.01648791 "$meshes/knot2.off" 0.01394955 \
  "$meshes/elephant.off" 0.01198981 "$meshes/lion-head.off" 0.01491 "$meshes/fandisk.off" 0.0159602 \
  "$meshes/bunny00.off" 0.00521395
mkdir -p results/crystal

python3 - "$program" "$peer" results/crystal "$@" <<'END'
import json
import math
import os
import subprocess
import sys
import time

program, peer, results, *jobs = sys.argv[1:]


def run(*command):
    start = time.time()
    process = subprocess.Popen(command, stdout=subprocess.PIPE)
    out = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status and not out:  # inspect exits with 1 where there is something to mend
        sys.exit(f'{" ".join(command)} failed')
    return json.loads(out or '{}'), time.time() - start, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def trivalent(*arguments):
    return run(program, *arguments, '--json', '--quiet')


def remesh(mesh, net, edge, method):
    if method != 'cgal':
        return trivalent('remesh', mesh, net, '--edge', edge, '--method', method)
    cost = run(peer, 'cgal', mesh, edge, net)[1:]
    return trivalent('inspect', net, '--against', mesh)[0], *cost


print('mesh                  method      V  valence 6    CV     mean/m  crossings  rms dist  relaxed excess   broken'
      '      s  (CPU s)   MiB')
for mesh, edge in zip(jobs[::2], jobs[1::2]):
    name = os.path.splitext(os.path.basename(mesh))[0]
    for method in ('cgal', 'paper', 'crystal'):
        net, relaxed = f'{results}/{name}.{method}.off', f'{results}/{name}.{method}.extxyz'
        result, seconds, cpu, memory = remesh(mesh, net, edge, method)
        quality, edges = result['quality'], result['quality']['edge_length']
        rest = trivalent('relax', net, '-o', relaxed)[0] if quality['vertices'] < 50_000 else None
        energy = (f'{1000 * rest["excess_per_atom"]:8.2f} meV/atom  {len(rest["relaxation"]["bonds_broken"]):6d}'
                  if rest else '       - meV/atom       -')
        print(f'{name:20}  {method:8} {quality["vertices"]:5d}    {100 * quality["regular_fraction"]:5.2f} %'
              f'  {100 * edges["relative_spread"]:5.2f} %  {edges["mean"] / float(edge):.4f}'
              f'  {quality["self_intersections"]:9d}  {100 * result["distance"]["rms_of_diagonal"]:6.3f} %'
              f'  {energy}  {seconds:5.1f}  {cpu:7.1f}  {memory:5.0f}', flush=True)


def shell_row(name, shape, atoms, *options):
    folder = f'{results}/shell.{name}'
    report, seconds, cpu, memory = run(program, 'build', shape, '-o', folder, '--atoms', str(atoms),
                                       *options, '--json', '--quiet')
    count = report['network']['atoms']
    energy = report['energy']
    excess = 1000 * energy['after']['excess_per_atom']
    law = f'{1000 * (9.844 * math.log(count) - 7.52) / count:6.2f}' if shape == 'sphere' else '     -'
    sizes = report['quality']['valences']
    relaxation = report.get('relaxation') or {'distance': report['distance'], 'bonds_broken': [], 'bonds_formed': []}
    budget = energy['budget']
    distances = '  '.join(f'{side["rms"]:5.2f}/{side["max"]:<6.2f}'
                          for distance in (report['distance'], relaxation['distance'])
                          for side in (distance['to_original'], distance['from_original']))
    print(f'{name:24} {count:6d}  {excess:7.2f}  {law}  {sizes.get("5", 0):4d}/{sizes.get("7", 0):<4d}'
          f'  {1000 * budget["bending"] / count:6.2f}  {budget["pentagon_heptagon_pairs"]:5d}  {distances}'
          f'  {report["quality"]["self_intersections"]:9d}  {len(relaxation["bonds_broken"]):6d} {len(relaxation["bonds_formed"]):6d}'
          f'  {seconds:5.1f}  {cpu:7.1f}  {memory:5.0f}', flush=True)


print('\nshell                     atoms   meV/atom  law   5/7 rings  bending  pairs'
      '  to the surface, from it, the same at rest [Å, rms/max]'
      '  crossings  broken formed      s  (CPU s)   MiB')
for atoms in (240, 960, 2160, 6000, 8000, 20000):
    shell_row(f'sphere-{atoms}', 'sphere', atoms)
shapes = {os.path.splitext(os.path.basename(mesh))[0]: mesh for mesh in jobs[::2]}
for name, mesh in shapes.items():
    for follow in ('carbon', 'free'):
        shell_row(f'{name}-{follow}', mesh, 20000, '--follow', follow)
if 'bunny00' in shapes:
    shell_row('bunny00-200000', shapes['bunny00'], 200000, '--no-relax')
END
