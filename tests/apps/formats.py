#!/usr/bin/env python3
"""Converts structures into every format, and reads them back by trivalent and by other programs.

usage: formats.py PROGRAM [--large]
Structures are free, periodic along one direction, and triclinic, with and without hydrogen. Distances
between all atoms (nearest images), elements, the cell, and bonds where format and reader have them must
come back to the format's own precision. With --large, a sheet of 100,800 atoms is read back instead,
atom by atom. ASE is needed; gemmi, MDAnalysis, Open Babel, pymatgen and xtb are asked where they are
installed. A table says how many files each reader took of each format. Ends with 1 if anything
differs.
"""
import argparse
import collections
import json
import os
import shutil
import subprocess
import sys
import tempfile
import warnings

import ase.build
import ase.io
import numpy as np
from ase.geometry import get_distances

warnings.simplefilter('ignore')  # of readers that miss atom types, masses, ...

# Precision of positions [Å], and whether the format has bonds.
FORMATS = {'.extxyz': (1e-9, True), '.data': (1e-9, True), '.vasp': (1e-9, False), '.cif': (1e-9, True),
           '.mmcif': (1e-9, False),
           '.pdb': (2e-3, True), '.gro': (2e-2, False), '.mol2': (1e-9, True), '.gen': (1e-9, False),
           '.pwi': (1e-9, False), '.inp': (1e-9, False)}
SINGLE_PRECISION = 1e-4  # of readers that keep positions so, at 500 Å

Read = collections.namedtuple('Read', 'atoms bonds')  # bonds: their number, or None where the reader has none


def run(*command, folder=None):
    done = subprocess.run(command, capture_output=True, text=True, cwd=folder)
    if done.returncode != 0:
        raise RuntimeError(f'{" ".join(command)}: {done.stderr.strip()[-300:]}')
    return done.stdout


# Readers: functions of a path that return a Read. Their imports fail where they are not installed.

def by_ase(form, **options):
    return lambda path: Read(ase.io.read(path, format=form, **options), None)


def by_ase_data(path):
    # ASE takes the types 1 and 2 for hydrogen and helium.
    atoms = ase.io.read(path, format='lammps-data', style='molecular')
    atoms.numbers = np.where(atoms.get_masses() > 5, 6, 1) if 'masses' in atoms.arrays else np.full(len(atoms), 6)
    return Read(atoms, None)


def by_gemmi(path):
    import gemmi
    if path.endswith('.cif'):
        small = gemmi.read_small_structure(path)
        cell, sites = small.cell, small.get_all_unit_cell_sites()
        points = [cell.orthogonalize(site.fract).tolist() for site in sites]
        numbers = [site.element.atomic_number for site in sites]
    else:
        whole = gemmi.read_structure(path, format=gemmi.CoorFormat.Pdb if path.endswith('.pdb') else gemmi.CoorFormat.Mmcif)
        cell = whole.cell
        atoms = [cra.atom for cra in whole[0].all()]
        points = [atom.pos.tolist() for atom in atoms]
        numbers = [atom.element.atomic_number for atom in atoms]
    is_crystal = cell.is_crystal()
    parameters = [cell.a, cell.b, cell.c, cell.alpha, cell.beta, cell.gamma] if is_crystal else None
    return Read(ase.Atoms(numbers, points, pbc=is_crystal, cell=parameters), None)


def by_mdanalysis(path):
    import MDAnalysis
    is_data = path.endswith('.data')
    universe = MDAnalysis.Universe(path, **({'atom_style': 'id resid type x y z'} if is_data else {}))
    if is_data:
        numbers = np.where(universe.atoms.masses > 5, 6, 1)
    else:
        numbers = [{'C': 6, 'H': 1}[name[0]] for name in universe.atoms.names]
    box = universe.dimensions
    periodic = box is not None and box[:3].min() > 1e-3
    bonds = len(universe.bonds) if hasattr(universe, 'bonds') else None
    cell = box.astype(float) if periodic else None
    return Read(ase.Atoms(numbers, universe.atoms.positions.astype(float), pbc=periodic, cell=cell), bonds)


def by_openbabel(path):
    form = {'.vasp': 'vasp', '.extxyz': 'xyz'}.get(os.path.splitext(path)[1], os.path.splitext(path)[1][1:])
    copy = path + '.obabel.mol2'
    run('obabel', '-i' + form, path, '-omol2', '-O', copy)
    text = open(copy).read()
    rows = [line.split() for line in text.split('@<TRIPOS>ATOM')[1].split('@<TRIPOS>')[0].strip().splitlines()]
    bonds = len(text.split('@<TRIPOS>BOND')[1].split('@<TRIPOS>')[0].strip().splitlines())
    has_bonds = form in ('mol2', 'pdb')  # it guesses them elsewhere
    atoms = ase.Atoms([row[5].split('.')[0] for row in rows], [[float(x) for x in row[2:5]] for row in rows])
    return Read(atoms, bonds if has_bonds else None)


def by_pymatgen(path):
    from pymatgen.io.ase import AseAtomsAdaptor
    if path.endswith('.vasp'):
        from pymatgen.io.vasp import Poscar
        return Read(AseAtomsAdaptor.get_atoms(Poscar.from_file(path).structure), None)
    if path.endswith('.pwi'):
        from pymatgen.io.pwscf import PWInput
        return Read(AseAtomsAdaptor.get_atoms(PWInput.from_file(path).structure), None)
    from pymatgen.io.cp2k.inputs import Cp2kInput
    subsystem = Cp2kInput.from_file(path)['FORCE_EVAL']['SUBSYS']
    rows = [row for kind in subsystem['COORD'].keywords.values() for row in getattr(kind, 'keywords', [kind])]
    rows[:2] = rows[1::-1]  # it lists the second of equal keywords first
    cell = [[float(x) for x in subsystem['CELL'].keywords[k].values] for k in 'ABC']
    periodic = subsystem['CELL'].keywords['PERIODIC'].values[0] == 'XYZ'
    return Read(ase.Atoms([row.name for row in rows], [row.values for row in rows], cell=cell, pbc=periodic), None)


def by_xtb(path):
    """Free structures only: GFN2-xTB writes what it has read to a Molden file."""
    folder = path + '.xtb'
    os.mkdir(folder)
    run('xtb', path, '--gfn', '2', '--molden', '--cycles', '1', folder=folder)
    rows = [line.split() for line in open(os.path.join(folder, 'molden.input')).read().split('AU\n')[1].split('[')[0].splitlines()]
    bohr = 0.52917726  # Å, of xtb
    return Read(ase.Atoms([int(row[2]) for row in rows], bohr * np.array([[float(x) for x in row[3:6]] for row in rows])), None)


def readers_by_format():
    """Of each format: names of readers, the readers, the least difference that they can tell, and whether
    they read the cell."""
    def has(module):
        return subprocess.run([sys.executable, '-c', f'import {module}'], capture_output=True).returncode == 0

    ase_forms = {'.extxyz': 'extxyz', '.vasp': 'vasp', '.cif': 'cif', '.pdb': 'proteindatabank', '.gro': 'gromacs',
                 '.gen': 'gen', '.pwi': 'espresso-in'}
    table = {extension: [('ASE', by_ase(form), 1e-9, True)] for extension, form in ase_forms.items()}
    table['.data'] = [('ASE', by_ase_data, 1e-9, True)]
    groups = [('gemmi', has('gemmi'), by_gemmi, 1e-9, True, ['.cif', '.mmcif', '.pdb']),
              # It does not read CRYSIN of MOL2.
              ('MDAnalysis', has('MDAnalysis'), by_mdanalysis, SINGLE_PRECISION, True, ['.data', '.pdb', '.gro']),
              ('MDAnalysis', has('MDAnalysis'), by_mdanalysis, SINGLE_PRECISION, False, ['.mol2']),
              # Positions to four decimals and no cell: its MOL2 is where they come from.
              ('Open Babel', shutil.which('obabel'), by_openbabel, 2e-4, False, ['.mol2', '.pdb', '.gro', '.vasp', '.extxyz', '.mmcif']),
              ('pymatgen', has('pymatgen'), by_pymatgen, 1e-9, True, ['.vasp', '.pwi', '.inp']),
              ('xtb', shutil.which('xtb'), by_xtb, 1e-6, False, ['.gen'])]
    for name, is_there, read, precision, has_cell, extensions in groups:
        for extension in extensions if is_there else []:
            table.setdefault(extension, []).append((name, read, precision, has_cell))
    return table


def structures():
    c60 = ase.build.molecule('C60')
    benzene = ase.build.molecule('C6H6')
    tube = ase.build.nanotube(6, 3, length=1, vacuum=8)
    tube.pbc = (False, False, True)
    ribbon = ase.build.graphene_nanoribbon(3, 2, type='armchair', saturated=True, vacuum=6)
    triclinic = ase.build.bulk('C', 'diamond', a=3.567).repeat((3, 2, 2))
    triclinic.rattle(0.05, seed=1)
    turned = triclinic.copy()
    turned.rotate(37, (1, 2, 3), rotate_cell=True)
    return {'c60': c60, 'benzene': benzene, 'tube': tube, 'ribbon': ribbon, 'triclinic': triclinic, 'turned': turned}


def large_sheet():
    """Graphene, wavy, of more atoms than five columns can number, in a box along the axes."""
    bond = 1.42
    cell = np.array([3 ** 0.5 * bond, 3 * bond, 30.0])
    base = bond * np.array([[0, 0, 0], [0, 1, 0], [3 ** 0.5 / 2, 1.5, 0], [3 ** 0.5 / 2, 2.5, 0]])
    n = (200, 126)
    corners = cell * np.array([(i, j, 0.5) for i in range(n[0]) for j in range(n[1])])
    points = (corners[:, None, :] + base).reshape(-1, 3)
    points[:, 2] += 2.0 * np.sin(2 * np.pi * points[:, 0] / (n[0] * cell[0]))
    return ase.Atoms(f'C{len(points)}', points, cell=cell * [*n, 1], pbc=True)


def distances(atoms):
    """Sorted distances between all atoms, by pair of elements."""
    periodic = atoms.pbc.any()
    matrix = get_distances(atoms.positions, cell=atoms.cell if periodic else None, pbc=atoms.pbc if periodic else None)[1]
    numbers = np.asarray(atoms.numbers)
    i, j = np.triu_indices(len(atoms), 1)
    kind = numbers[i] * numbers[j]
    return np.concatenate([np.sort(matrix[i, j][kind == k]) for k in (1, 6, 36)])


def difference(want, found):
    """Largest difference of distances; in large structures of positions from the first atom on."""
    if len(want) < 1000:
        return np.abs(distances(want) - distances(found)).max()
    apart = (found.positions - found.positions[0]) - (want.positions - want.positions[0])
    apart -= np.round(apart @ np.linalg.inv(want.cell)) @ want.cell
    return np.abs(apart).max()


def fault(want, found, precision, has_cell):
    """What is wrong with a structure that came back, or None."""
    if len(want) != len(found) or sorted(want.numbers) != sorted(found.numbers):
        return f'{len(found)} atoms or other elements'
    far = difference(want, found)
    if not far <= 4 * precision:
        return f'differs by {far:.2e} Å'
    if has_cell and want.pbc.all():
        # A cell of a format with free directions filled up is larger than this.
        for quantity, a, b in (('volume', want.cell.volume, found.cell.volume),
                               ('lengths', np.sort(want.cell.lengths()), np.sort(found.cell.lengths()))):
            if not np.allclose(a, b, rtol=1e-3):
                return f'another {quantity} of the cell'
        if not found.pbc.all():
            return 'it is not periodic any more'
    return None


class Table:
    def __init__(self):
        self.faults = 0
        self.counts = collections.Counter()

    def add(self, who, name, extension, problem):
        self.counts[who, extension] += 1
        if problem:
            self.faults += 1
            print(f'{who}: {name}{extension}: {problem}', flush=True)

    def show(self):
        names = sorted({who for who, _ in self.counts})
        print('files read '.ljust(12) + ''.join(name.rjust(12) for name in names))
        for extension in FORMATS:
            cells = ''.join(str(self.counts[name, extension] or '-').rjust(12) for name in names)
            print(extension.ljust(12) + cells)
        print(f'{self.faults} faults')


def check_format(program, table, name, atoms, bonded, n_bonds, extension, folder, others):
    precision, has_bonds = FORMATS[extension]
    path = os.path.join(folder, 'out-' + name + extension)
    style = ['--atom-style', 'molecular'] if extension == '.data' else []
    run(program, 'convert', bonded, path, *style, '--digits', 'decimals' if extension == '.gro' else '17', '--quiet')
    copy = os.path.join(folder, 'back.extxyz')
    back = json.loads(run(program, 'convert', path, copy, '--digits', '17', '--json', '--quiet'))
    loses_bonds = extension == '.pdb' and len(atoms) > 99999  # CONECT has five columns for a number
    keeps_bonds = has_bonds and not loses_bonds
    problem = fault(atoms, ase.io.read(copy), precision, True)
    if not problem and keeps_bonds and back['bonds'] != n_bonds:
        problem = f'{back["bonds"]} bonds instead of {n_bonds}'
    table.add('trivalent', name, extension, problem)
    for who, read, least, has_cell in others:
        if who == 'xtb' and (atoms.pbc.any() or len(atoms) > 100):
            continue
        if who == 'Open Babel' and len(atoms) > 1000 and extension != '.mol2':
            continue  # it searches for bonds for minutes
        found, bonds = read(path)
        if not has_cell and atoms.pbc.any() and len(atoms) < 1000:
            # Distances to nearest images cannot be told.
            problem = None if len(found) == len(atoms) else f'{len(found)} atoms'
        else:
            problem = fault(atoms, found, max(precision, least), has_cell)
        if not problem and keeps_bonds and bonds is not None and bonds != n_bonds:
            problem = f'{bonds} bonds instead of {n_bonds}'
        table.add(who, name, extension, problem)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('program')
    parser.add_argument('--large', action='store_true')
    options = parser.parse_args()
    program = os.path.abspath(options.program)
    others = readers_by_format()
    table = Table()
    with tempfile.TemporaryDirectory() as folder:
        for name, atoms in ({'sheet': large_sheet()} if options.large else structures()).items():
            source = os.path.join(folder, name + '.extxyz')
            bonded = os.path.join(folder, name + '-bonded.extxyz')
            ase.io.write(source, atoms, format='extxyz')
            atoms = ase.io.read(source)  # it has eight decimals
            found = json.loads(run(program, 'convert', source, bonded, '--guess-bonds', '--digits', '17', '--json', '--quiet'))
            for extension in FORMATS:
                if options.large and extension == '.cif':
                    others['.cif'] = [row for row in others['.cif'] if row[0] != 'ASE']  # it takes minutes
                check_format(program, table, name, atoms, bonded, found['bonds'], extension, folder, others.get(extension, []))
    table.show()
    return table.faults > 0


if __name__ == '__main__':
    sys.exit(main())
