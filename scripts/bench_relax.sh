#!/usr/bin/env bash
# Relaxes the dual of each mesh here and with LAMMPS's minimizers (cg and fire), one core each, one after
# the other, and prints energies, atoms without three bonds, bonds torn, and processor seconds.
#
#   scripts/bench_relax.sh MESH...        STEPS=N: at most so many steps of LAMMPS, default 2000
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
mkdir -p results/relax
export OMP_NUM_THREADS=1

python3 - "$PWD/build/release/bin/trivalent" results/relax "${STEPS:-2000}" "$@" <<'END'
import json
import os
import subprocess
import sys

program, results, steps, *meshes = sys.argv[1:]


def relax(mesh, name, *options):
    """The result and the processor seconds of the program with all it started."""
    process = subprocess.Popen([program, 'relax', mesh, '-o', f'{results}/{name}.extxyz', '--threads', '1', '--json',
                                '--quiet', *options], stdout=subprocess.PIPE)
    out = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status:
        return None, 0.0
    return json.loads(out), usage.ru_utime + usage.ru_stime


print('mesh                    engine         meV/atom above graphene  odd atoms  torn  largest force      s  times ours')
for mesh in meshes:
    name = os.path.splitext(os.path.basename(mesh))[0]
    ours = None
    for engine, options in (('own', []), ('LAMMPS cg', ['--engine', 'lammps', '--minimizer', 'cg', '--max-steps', steps]),
                            ('LAMMPS fire', ['--engine', 'lammps', '--minimizer', 'fire', '--max-steps', steps])):
        result, seconds = relax(mesh, f'{name}.{engine.replace(" ", "-")}', *options)
        if result is None:
            print(f'{name:22}  {engine:12}  failed', flush=True)
            continue
        ours = ours or seconds
        relaxation = result['relaxation']
        odd = result['atoms'] - relaxation['coordinations'].get('3', 0)
        print(f'{name:22}  {engine:12}  {1000 * result["excess_per_atom"]:23.3f}  {odd:9d}  '
              f'{len(relaxation["bonds_broken"]):4d}  {relaxation["largest_force"]:13.2g}  {seconds:5.1f}  '
              f'{seconds / ours:10.1f}', flush=True)
END
