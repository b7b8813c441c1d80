#!/usr/bin/env python3
"""Converts structures into every format, and reads them back by trivalent and by other programs.

usage: formats.py PROGRAM
Structures are free, periodic along one direction, and triclinic, with and without hydrogen. Distances
between all atoms (nearest images), elements, the cell, and bonds where the format has them must come
back to the format's own precision. ASE is needed; gemmi, MDAnalysis and Open Babel are asked where they
are installed, and the last lines say which were. Ends with 1 if anything differs.
"""
import json
import os
import subprocess
import sys
import tempfile

import ase.build
import ase.io
import numpy as np
from ase.geometry import get_distances

# Precision of positions [Å], and whether the format knows free atoms and bonds.
FORMATS = {'.extxyz': (1e-9, True, True), '.data': (1e-9, False, True), '.vasp': (1e-9, False, False),
           '.cif': (1e-9, False, True), '.pdb': (2e-3, True, True), '.gro': (2e-2, True, False),
           '.mol2': (1e-9, True, True), '.gen': (1e-9, True, False), '.pwi': (1e-9, False, False),
           '.inp': (1e-9, True, False)}


def structures():
    c60 = ase.build.molecule('C60')
    benzene = ase.build.molecule('C6H6')
    tube = ase.build.nanotube(6, 3, length=1, vacuum=8)
    tube.pbc = (False, False, True)
    sheet = ase.build.graphene_nanoribbon(3, 2, type='armchair', saturated=True, vacuum=6)
    triclinic = ase.build.bulk('C', 'diamond', a=3.567).repeat((3, 2, 2))
    triclinic.rattle(0.05, seed=1)
    turned = triclinic.copy()
    turned.rotate(37, (1, 2, 3), rotate_cell=True)
    return {'c60': c60, 'benzene': benzene, 'tube': tube, 'ribbon': sheet, 'triclinic': triclinic, 'turned': turned}


def distances(atoms):
    """Sorted distances between all atoms, by pair of elements."""
    periodic = atoms.pbc.any()
    matrix = get_distances(atoms.positions, cell=atoms.cell if periodic else None, pbc=atoms.pbc if periodic else None)[1]
    numbers = np.asarray(atoms.numbers)
    i, j = np.triu_indices(len(atoms), 1)
    kind = numbers[i] * numbers[j]
    return np.concatenate([np.sort(matrix[i, j][kind == k]) for k in (1, 6, 36)])


def cell_lengths(atoms):
    return np.sort([*atoms.cell.cellpar()[:3], atoms.cell.volume ** (1 / 3)])


class Check:
    def __init__(self):
        self.faults = 0
        self.count = {}

    def compare(self, who, name, want, found, precision, has_cell):
        self.count[who] = self.count.get(who, 0) + 1
        problem = None
        if len(want) != len(found) or sorted(want.numbers) != sorted(found.numbers):
            problem = f'{len(found)} atoms or other elements'
        else:
            # The cell of a format with free directions filled up is larger than reach.
            difference = np.abs(distances(want) - distances(found)).max()
            if difference > 4 * precision:
                problem = f'distances differ by {difference:.2e}'
            elif has_cell and np.abs(want.cell.volume - found.cell.volume) > 1e-3 * want.cell.volume:
                problem = 'another volume of the cell'
        if problem:
            self.faults += 1
            print(f'{who}: {name}: {problem}')


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f'{" ".join(command)}: {done.stderr.strip()}')
    return done.stdout


def our_atoms(program, path, folder):
    """A file as trivalent reads it, and the bonds that the file itself gives."""
    copy = os.path.join(folder, 'back.extxyz')
    found = json.loads(run(program, 'convert', path, copy, '--digits', '17', '--json', '--quiet'))
    return ase.io.read(copy), found['bonds']


def readers():
    """Other programs, by name: functions of a path that return Atoms, and the extensions they read."""
    by_name = {'ASE': (ase.io.read, {'.extxyz': None, '.vasp': 'vasp', '.cif': None, '.pdb': None, '.gro': 'gromacs',
                                     '.gen': 'gen', '.pwi': 'espresso-in'})}
    try:
        import gemmi

        def read_gemmi(path, _):
            if path.endswith('.cif'):
                small = gemmi.read_small_structure(path)
                cell, sites = small.cell, small.get_all_unit_cell_sites()
                points = [cell.orthogonalize(site.fract).tolist() for site in sites]
                numbers = [site.element.atomic_number for site in sites]
            else:
                whole = gemmi.read_pdb(path)
                cell = whole.cell
                atoms = [cra.atom for cra in whole[0].all()]
                points = [atom.pos.tolist() for atom in atoms]
                numbers = [atom.element.atomic_number for atom in atoms]
            is_crystal = cell.is_crystal()
            return ase.Atoms(numbers, points, pbc=is_crystal,
                             cell=[cell.a, cell.b, cell.c, cell.alpha, cell.beta, cell.gamma] if is_crystal else None)

        by_name['gemmi'] = (read_gemmi, {'.cif': None, '.pdb': None})
    except ImportError:
        pass
    try:
        import warnings

        import MDAnalysis

        def read_mdanalysis(path, _):
            with warnings.catch_warnings():
                warnings.simplefilter('ignore')
                universe = MDAnalysis.Universe(path)
                symbols = [name[0] for name in universe.atoms.names]
                box = universe.dimensions
            periodic = box is not None and box[:3].min() > 1e-3
            return ase.Atoms(symbols, universe.atoms.positions.astype(float), pbc=periodic,
                             cell=box.astype(float) if periodic else None)

        by_name['MDAnalysis'] = (read_mdanalysis, {'.pdb': None, '.gro': None, '.mol2': None})
    except ImportError:
        pass
    if subprocess.run(['sh', '-c', 'command -v obabel'], capture_output=True).returncode == 0:
        def read_openbabel(path, _):
            copy = path + '.obabel.xyz'
            run('obabel', path, '-O', copy)
            return ase.io.read(copy)

        by_name['Open Babel'] = (read_openbabel, {'.mol2': None, '.pdb': None})
    return by_name


def main():
    program = os.path.abspath(sys.argv[1])
    check = Check()
    others = readers()
    with tempfile.TemporaryDirectory() as folder:
        for name, atoms in structures().items():
            source = os.path.join(folder, name + '.extxyz')
            ase.io.write(source, atoms, format='extxyz')
            atoms = ase.io.read(source)  # it has eight decimals
            bonds = json.loads(run(program, 'convert', source, os.path.join(folder, 'bonded.extxyz'), '--guess-bonds',
                                   '--json', '--quiet'))['bonds']
            for extension, (precision, knows_free, knows_bonds) in FORMATS.items():
                path = os.path.join(folder, 'out-' + name + extension)
                style = ['--atom-style', 'molecular'] if extension == '.data' else []
                run(program, 'convert', os.path.join(folder, 'bonded.extxyz'), path, *style, '--digits',
                    'decimals' if extension == '.gro' else '17', '--quiet')
                found, bonds_back = our_atoms(program, path, folder)
                is_periodic = atoms.pbc.all()
                check.compare('trivalent', name + extension, atoms, found, precision, is_periodic)
                if knows_bonds and bonds_back != bonds:
                    check.faults += 1
                    print(f'trivalent: {name}{extension}: {bonds_back} bonds instead of {bonds}')
                for who, (read, extensions) in others.items():
                    if extension not in extensions:
                        continue
                    form = extensions[extension]
                    other = read(path, form) if who != 'ASE' else ase.io.read(path, format=form)
                    if atoms.pbc.any() and (who == 'Open Babel' or (who, extension) == ('MDAnalysis', '.mol2')):
                        continue  # the cell is lost in XYZ, and MDAnalysis does not read CRYSIN
                    check.compare(who, name + extension, atoms, other, max(precision, 1e-4), is_periodic)
    for who, count in check.count.items():
        print(f'{who}: {count} files read')
    print(f'{check.faults} faults')
    return check.faults > 0


if __name__ == '__main__':
    sys.exit(main())
