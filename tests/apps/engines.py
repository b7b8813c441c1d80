#!/usr/bin/env python3
"""Has GROMACS and CP2K start from the files that `trivalent convert` writes, for a few steps each.

usage: engines.py PROGRAM
C60, and a nanotube that is periodic along its axis. What is not installed is not asked, and the last line
says so. Ends with 1 if an engine refuses its input or loses atoms.
"""
import os
import shutil
import subprocess
import sys
import tempfile

import ase.build
import ase.io

MDP = ('integrator = {integrator}\nnsteps = 20\nemtol = 1\ncutoff-scheme = Verlet\nrlist = 0.9\nrvdw = 0.9\n'
       'rcoulomb = 0.9\npbc = xyz\nperiodic-molecules = {periodic}\ntcoupl = no\ngen-vel = no\ndt = 0.0005\n')


def run(command, folder):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        tail = '\n'.join((done.stdout + done.stderr).strip().splitlines()[-25:])
        raise RuntimeError(f'{" ".join(command)} failed:\n{tail}')
    return done.stdout + done.stderr


def gromacs(program, source, atoms, folder):
    for name in ('atoms.gro', 'atoms.top'):
        run([program, 'convert', source, name, '--guess-bonds', '--digits', '17'], folder)
    if not atoms.pbc.any():  # GROMACS has no free atoms: they get a box as its users make it
        run(['gmx', 'editconf', '-f', 'atoms.gro', '-o', 'atoms.gro', '-d', '1.2'], folder)
    for integrator in ('steep', 'md'):
        with open(os.path.join(folder, 'run.mdp'), 'w') as file:
            file.write(MDP.format(integrator=integrator, periodic='yes' if atoms.pbc.any() else 'no'))
        run(['gmx', 'grompp', '-f', 'run.mdp', '-c', 'atoms.gro', '-p', 'atoms.top', '-o', 'run.tpr', '-maxwarn', '1'], folder)
        try:
            run(['gmx', 'mdrun', '-s', 'run.tpr', '-deffnm', 'out', '-ntmpi', '1', '-ntomp', '1'], folder)
        except RuntimeError as error:
            if 'not supported by the current hardware' not in str(error):
                raise
            return 'is accepted by grompp; mdrun does not work on this machine'
        found = ase.io.read(os.path.join(folder, 'out.gro'))
        if len(found) != len(atoms):
            raise RuntimeError(f'GROMACS has {len(found)} atoms instead of {len(atoms)}')
    return 'runs'


def cp2k(program, source, atoms, folder):
    run([program, 'convert', source, 'atoms.inp'], folder)
    path = os.path.join(folder, 'atoms.inp')
    with open(path) as file:
        text = file.read()
    with open(path, 'w') as file:
        file.write(text.replace('MAX_ITER 500', 'MAX_ITER 2'))
    out = run(['cp2k', '-i', 'atoms.inp'], folder)
    if 'ENERGY| Total FORCE_EVAL' not in out or 'SCF run NOT converged' in out:
        raise RuntimeError('CP2K found no energy:\n' + '\n'.join(out.splitlines()[-25:]))
    return 'runs'


def main():
    program = os.path.abspath(sys.argv[1])
    tube = ase.build.nanotube(5, 5, length=10, vacuum=10)
    tube.pbc = (False, False, True)
    structures = {'c60': ase.build.molecule('C60', vacuum=12), 'tube': tube}
    structures['c60'].pbc = False
    engines = {'gmx': gromacs, 'cp2k': cp2k}
    asked = {name: engine for name, engine in engines.items() if shutil.which(name)}
    failed = False
    for name, atoms in structures.items():
        for engine, start in asked.items():
            with tempfile.TemporaryDirectory() as folder:
                source = os.path.join(folder, 'atoms.extxyz')
                ase.io.write(source, atoms, format='extxyz')
                try:
                    print(f'{engine}: {name} {start(program, source, atoms, folder)}')
                except RuntimeError as error:
                    failed = True
                    print(f'{engine}: {name}: {error}')
    print('asked:', ', '.join(asked) or 'nobody', '; not installed:', ', '.join(set(engines) - set(asked)) or 'none')
    return failed


if __name__ == '__main__':
    sys.exit(main())
