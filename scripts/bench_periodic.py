#!/usr/bin/env python3
"""Nets of periodic surfaces: energy above graphene, rings, bonds and seconds over several seeds.

usage: bench_periodic.py [--seeds N] [SHAPE:ATOMS...]

Builds each shape with so many atoms, at default effort with every seed from 0 on, the cell relaxed
with the atoms. Needs a release build.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT / 'build/release/bin/trivalent'
SHAPES = ['schwarz-p:144', 'schwarz-p:192', 'schwarz-p:432', 'schwarz-p:768', 'schwarz-p:1200',
          'schwarz-d:576', 'schwarz-d:768', 'gyroid:288', 'gyroid:384', 'gyroid:1536']


def build(shape, atoms, seed):
    with tempfile.TemporaryDirectory() as folder:
        start = time.time()
        command = [PROGRAM, 'build', shape, '--atoms', atoms, '--seed', str(seed), '-o', os.path.join(folder, 'out'),
                   '--json', '--quiet']
        done = subprocess.run(command, capture_output=True, text=True)
        seconds = time.time() - start
    if done.returncode:
        sys.exit(f'{shape} with {atoms} atoms: {done.stderr.strip()}')
    return json.loads(done.stdout), seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--seeds', type=int, default=5)
    parser.add_argument('shapes', nargs='*', default=SHAPES)
    options = parser.parse_args()
    print('shape           seed  atoms  eV/atom      meV/atom  rings                     bonds [Å]    a [Å]     s')
    for text in options.shapes:
        shape, atoms = text.rsplit(':', 1)
        for seed in range(options.seeds):
            report, seconds = build(shape, atoms, seed)
            network, energy = report['network'], report['energy']['after']
            rings = ' '.join(f'{size}:{count}' for size, count in sorted(network['ring_sizes'].items()))
            bonds = network['bond_length']
            print(f'{shape:15} {seed:4} {network["atoms"]:6}  {energy["energy_per_atom"]:.8f}  '
                  f'{1000 * energy["excess_per_atom"]:8.3f}  {rings:24}  {bonds["min"]:.3f}-{bonds["max"]:.3f}  '
                  f'{report["cell"]["lengths"][0]:8.4f}  {seconds:4.0f}', flush=True)


if __name__ == '__main__':
    main()
