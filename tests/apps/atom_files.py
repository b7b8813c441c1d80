#!/usr/bin/env python3
"""Legal and illegal spellings of one structure as extended XYZ and LAMMPS data.

Every legal file must give the energy of the structure, in trivalent and, where they can read it, the
same atoms in ASE and the same energy in LAMMPS. Every illegal one must be refused with a line
number or a key, exit code 1 or 2, and no output.

    atom_files.py TRIVALENT [--lammps lmp]
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy

A = 2.46
CELL = numpy.array([[4 * A, 0, 0], [-2 * A, 2 * A * 3**0.5, 0], [0, 0, 16.0]])


def graphene():
    """32 atoms, moved a little so that a wrong cell or order shows in the energy."""
    primitive = numpy.array([[A, 0, 0], [-A / 2, A / 2 * 3**0.5, 0], [0, 0, 16.0]])
    positions = [
        i * primitive[0] + j * primitive[1] + b * (primitive[0] + 2 * primitive[1]) / 3 + [0, 0, 8]
        for i in range(4)
        for j in range(4)
        for b in (0, 1)
    ]
    return numpy.array(positions) + 0.03 * numpy.random.default_rng(5).standard_normal((32, 3))


POSITIONS = graphene()
N = len(POSITIONS)


def number(x, style="{:.12f}"):
    return style.format(x)


def flat(array, separator=" ", style="{:.12f}"):
    return separator.join(number(x, style) for x in numpy.ravel(array))


# --------------------------------------------------------------------------------- extended XYZ


def xyz(header, row=lambda i, p: "C " + flat(p), count=str(N), end="\n", mark="", tail=""):
    rows = [row(i, p) for i, p in enumerate(POSITIONS)]
    return (mark + end.join([count, header, *rows]) + end + tail).encode()


LATTICE = 'Lattice="' + flat(CELL) + '"'
PROPERTIES = "Properties=species:S:1:pos:R:3"
PBC = 'pbc="T T F"'
NESTED = "[[" + "], [".join(flat(v, ", ") for v in CELL) + "]]"


def legal_xyz():
    """name, bytes, whether ASE 3.22 reads it too"""
    plain = f"{LATTICE} {PROPERTIES} {PBC}"
    yield "plain", xyz(plain), True
    yield "crlf", xyz(plain, end="\r\n"), True
    yield "carriage returns", xyz(plain, end="\r"), False
    yield "byte order mark", xyz(plain, mark="\ufeff"), False
    yield "blank lines at the end", xyz(plain, tail="\n\n"), True
    yield "blanks around the count", xyz(plain, count=f"  {N}\t"), True
    yield "tabs between fields", xyz(plain, row=lambda i, p: "C\t" + flat(p, "\t")), True
    yield "lower case keys", xyz(f'{LATTICE.replace("L", "l", 1)} properties=species:S:1:pos:R:3 {PBC}'), False
    yield "upper case keys", xyz(f'{LATTICE.replace("Lattice", "LATTICE")} {PROPERTIES.replace("Properties", "PROPERTIES")} PBC="T T F"'), False
    yield "blanks around =", xyz(f"{LATTICE.replace('=', ' = ')} {PROPERTIES.replace('=', ' = ')} pbc = \"T T F\""), False
    yield "another order", xyz(f"{PBC} {PROPERTIES} {LATTICE}"), True
    yield "quoted properties", xyz(f'{LATTICE} Properties="species:S:1:pos:R:3" {PBC}'), True
    yield "quoted keys", xyz(f'"Lattice"="{flat(CELL)}" {PROPERTIES} "pbc"="T T F"'), False
    yield "nested lattice", xyz(f"Lattice={NESTED} {PROPERTIES} {PBC}"), False
    yield "nested lattice without blanks", xyz(f"Lattice={NESTED.replace(' ', '')} {PROPERTIES} {PBC}"), False
    yield "flat lattice in brackets", xyz(f"Lattice=[{flat(CELL, ', ')}] {PROPERTIES} {PBC}"), False
    yield "lattice in braces", xyz("Lattice={" + flat(CELL) + f"}} {PROPERTIES} {PBC}"), True
    for name, value, ase in [
        ("pbc true false", '"true true false"', False),
        ("pbc True False", '"True True False"', False),
        ("pbc TRUE FALSE", '"TRUE TRUE FALSE"', False),
        ("pbc in brackets", "[T, T, F]", True),
        ("pbc without blanks", "[T,T,F]", True),
        ("pbc words in brackets", "[true, true, false]", False),
        ("pbc in braces", "{T T F}", True),
        ("pbc numbers", '"1 1 0"', True),
    ]:
        yield name, xyz(f"{LATTICE} {PROPERTIES} pbc={value}"), ase
    yield "D exponents in the lattice", xyz(f'Lattice="{flat(CELL, style="{:.15E}").replace("E", "D")}" {PROPERTIES} {PBC}'), False
    yield "d exponents in positions", xyz(plain, row=lambda i, p: "C " + flat(p, style="{:.15e}").replace("e", "d")), False
    yield "E exponents", xyz(plain, row=lambda i, p: "C " + flat(p, style="{:.15E}")), True
    yield "plus signs", xyz(plain, row=lambda i, p: "C " + flat(p, style="{:+.12f}")), True
    yield "integers for reals", xyz(plain.replace("16.000000000000", "16").replace("0.000000000000", "0")), True
    yield "column Z", xyz(f"{LATTICE} Properties=Z:I:1:pos:R:3 {PBC}", lambda i, p: "6 " + flat(p)), True
    yield "column numbers", xyz(f"{LATTICE} Properties=numbers:I:1:pos:R:3 {PBC}", lambda i, p: "6 " + flat(p)), True
    yield "species and Z", xyz(f"{LATTICE} Properties=species:S:1:pos:R:3:Z:I:1 {PBC}", lambda i, p: f"C {flat(p)} 6"), True
    yield "positions first", xyz(f"{LATTICE} Properties=pos:R:3:species:S:1 {PBC}", lambda i, p: flat(p) + " C"), True
    yield "id first", xyz(f"{LATTICE} Properties=id:I:1:species:S:1:pos:R:3 {PBC}", lambda i, p: f"{i} C {flat(p)}"), True
    yield "forces", xyz(f"{LATTICE} {PROPERTIES}:forces:R:3 {PBC}", lambda i, p: f"C {flat(p)} 0 0 1"), True
    yield "logical column", xyz(f"{LATTICE} {PROPERTIES}:fixed:L:1 {PBC}", lambda i, p: f"C {flat(p)} T"), True
    yield "text column", xyz(f"{LATTICE} {PROPERTIES}:name:S:1 {PBC}", lambda i, p: f"C {flat(p)} a{i}"), True
    yield "wide column", xyz(f"{LATTICE} {PROPERTIES}:stress:R:9 {PBC}", lambda i, p: f"C {flat(p)}" + " 0" * 9), True
    yield "one integer column", xyz(f"{LATTICE} {PROPERTIES}:tags:I:1 {PBC}", lambda i, p: f"C {flat(p)} {i}"), True
    yield "comment keys", xyz(f'{plain} config_type="a b" note="He said \\"hi\\" = x" energy=-1.5 flag'), True
    yield "arrays in other keys", xyz(f"{plain} stress=[1, 0, 0, 0, 1, 0, 0, 0, 1] dipole=[0.1, 0.2, 0.3]"), False
    yield "JSON in another key", xyz(f'{plain} d="_JSON {{\\"a\\": [1, 2]}}"'), True
    yield "origin at zero", xyz(f'{plain} Origin="0 0 0"'), True
    yield "two structures", xyz(plain.replace("16.0", "17.0")) + xyz(plain), True
    yield "blank line between structures", xyz(plain, tail="\n") + xyz(plain), False
    yield "other bonded atoms", xyz(f"{LATTICE} {PROPERTIES}:bonded_atoms:I:1 {PBC}", lambda i, p: f"C {flat(p)} 99"), True
    yield "no properties", xyz(f"{LATTICE} {PBC}"), True
    yield "no properties, more fields", xyz(f"{LATTICE} {PBC}", lambda i, p: f"C {flat(p)} 0.5 x"), False
    yield "symbols in lower case", xyz(plain, lambda i, p: "c " + flat(p)), False


def illegal_xyz():
    plain = f"{LATTICE} {PROPERTIES} {PBC}"

    def with_row(text):
        return xyz(plain, lambda i, p: text if i == 7 else "C " + flat(p))

    yield "no count", xyz(plain, count="")
    yield "count with words", xyz(plain, count=f"{N} atoms")
    yield "count of a real", xyz(plain, count=f"{N}.0")
    yield "negative count", xyz(plain, count="-1")
    yield "count too small", xyz(plain, count=str(N - 1))
    yield "count too large", xyz(plain, count=str(N + 1))
    yield "huge count", xyz(plain, count="2000000000")
    yield "lattice of 8", xyz(plain.replace(" 16.000000000000", ""))
    yield "lattice of 10", xyz(plain.replace("16.000000000000", "16 1"))
    yield "lattice with a word", xyz(plain.replace("16.000000000000", "c"))
    yield "lattice with nan", xyz(plain.replace("16.000000000000", "nan"))
    yield "lattice not closed", xyz(plain.replace('0"', "0", 1).replace('pbc="T T F"', ""))
    yield "bracket not closed", xyz(f"Lattice={NESTED[:-1]} {PROPERTIES} {PBC}")
    yield "brackets of two kinds", xyz(f"Lattice=[{flat(CELL, ', ')}}} {PROPERTIES} {PBC}")
    yield "two lattices", xyz(f"{plain} {LATTICE}")
    yield "two pbc", xyz(f'{plain} PBC="T T T"')
    yield "two properties", xyz(f"{plain} properties=species:S:1:pos:R:3")
    yield "misspelled lattice", xyz(plain.replace("Lattice", "Latice"))
    yield "misspelled lattice alone", xyz(LATTICE.replace("Lattice", "Latttice"))
    yield "misspelled properties", xyz(plain.replace("Properties", "Propertys"))
    yield "cell for lattice", xyz(plain.replace("Lattice", "cell"))
    yield "periodic without lattice", xyz(f"{PROPERTIES} {PBC}")
    yield "periodic along a zero vector", xyz(plain.replace("16.000000000000", "0").replace("T T F", "T T T"))
    yield "pbc of two", xyz(plain.replace("T T F", "T T"))
    yield "pbc of four", xyz(plain.replace("T T F", "T T F F"))
    yield "pbc of other words", xyz(plain.replace("T T F", "yes yes no"))
    yield "pbc without value", xyz(plain.replace('pbc="T T F"', "pbc="))
    yield "no key", xyz(f"{plain} =5")
    yield "no blank after a value", xyz(plain.replace('" Prop', '"Prop'))
    yield "properties of two parts", xyz(plain.replace("pos:R:3", "pos:R"))
    yield "properties of another type", xyz(plain.replace("pos:R:3", "pos:X:3"))
    yield "properties without positions", xyz(plain.replace(":pos:R:3", ":x:R:3"))
    yield "properties of two positions", xyz(plain.replace("pos:R:3", "pos:R:3:pos:R:3"), lambda i, p: f"C {flat(p)} {flat(p)}")
    yield "properties without elements", xyz(plain.replace("species:S:1", "name:S:1"))
    yield "properties of zero components", xyz(plain.replace("pos:R:3", "pos:R:3:x:R:0"))
    yield "properties of too many components", xyz(plain.replace("pos:R:3", "pos:R:3:x:R:2000000000"))
    yield "row too short", with_row("C 1 2")
    yield "row too long", with_row("C 1 2 3 4")
    yield "row without element", with_row("1 2 3")
    yield "blank row", with_row("")
    yield "word in a row", with_row("C 1 2 z")
    yield "nan in a row", with_row("C 1 2 nan")
    yield "inf in a row", with_row("C 1 2 inf")
    yield "comma in a row", with_row("C 1,0 2 3")
    yield "hexadecimal in a row", with_row("C 0x10 2 3")
    yield "two exponents in a row", with_row("C 1D2D3 2 3")
    yield "silicon", with_row("Si 1 2 3")
    yield "a label", with_row("C1 1 2 3")
    yield "integer column of reals", xyz(f"{LATTICE} {PROPERTIES}:tag:I:1 {PBC}", lambda i, p: f"C {flat(p)} 1.5")
    yield "words after the atoms", xyz(plain, tail="the end\n")
    yield "second structure cut short", xyz(plain) + f"{N}\n{plain}\nC 0 0 0\n".encode()
    yield "types of LAMMPS", xyz("Atoms. Timestep: 0", lambda i, p: "1 " + flat(p))
    yield "empty", b""


# ---------------------------------------------------------------------------------- LAMMPS data

SIDES = [f"0 {number(CELL[0, 0])} xlo xhi", f"0 {number(CELL[1, 1])} ylo yhi", "0 16 zlo zhi"]
TILTS = f"{number(CELL[1, 0])} 0 0 xy xz yz"
MASSES = ["Masses", "", "1 12.011"]


def data(header=(), box=(*SIDES, TILTS), sections=(MASSES,), atoms="Atoms # atomic",
         row=lambda i, p: f"{i + 1} 1 {flat(p)}", after=(), title="carbon", count=f"{N} atoms",
         types="1 atom types", end="\n", order=None):
    rows = [row(i, p) for i, p in enumerate(POSITIONS)]
    if order is not None:
        rows = [rows[i] for i in order]
    lines = [title, "", count, types, *header, *box, ""]
    for section in sections:
        lines += [*section, ""]
    lines += [atoms, "", *rows, ""]
    for section in after:
        lines += [*section, ""]
    return end.join(lines).encode()


def bonds():
    pairs = []
    for i in range(N):
        for j in range(i + 1, N):
            shifts = [POSITIONS[j] - POSITIONS[i] + a * CELL[0] + b * CELL[1] for a in (-1, 0, 1) for b in (-1, 0, 1)]
            if min(numpy.linalg.norm(s) for s in shifts) < 1.7:
                pairs.append((i + 1, j + 1))
    return pairs


def legal_data():
    """name, bytes, atom_style for LAMMPS (None: this version of it does not read the file), options"""
    general = [flat(v) + f" {name}" for v, name in zip(CELL, ("avec", "bvec", "cvec"))]
    pairs = bonds()
    bond_rows = ["Bonds", "", *(f"{k + 1} 1 {a} {b}" for k, (a, b) in enumerate(pairs))]
    bond_header = [f"{len(pairs)} bonds", "1 bond types"]
    molecular = lambda i, p: f"{i + 1} 1 1 {flat(p)}"
    charge = lambda i, p: f"{i + 1} 1 0.0 {flat(p)}"
    yield "plain", data(), "atomic", []
    yield "no hint", data(atoms="Atoms"), "atomic", []
    yield "crlf", data(end="\r\n"), "atomic", []
    yield "no masses", data(sections=()), None, []
    yield "elements named", data(sections=()), None, ["--elements", "C"]
    yield "elements named, two types", data(sections=(), types="2 atom types"), None, ["--elements", "C", "H"]
    yield "comment behind a mass", data(sections=(["Masses", "", "1 12.011 # C"],)), "atomic", []
    yield "another mass of carbon", data(sections=(["Masses", "", "1 12"],)), "atomic", []
    yield "comment behind a row", data(row=lambda i, p: f"{i + 1} 1 {flat(p)} # atom {i}"), "atomic", []
    yield "image flags", data(row=lambda i, p: f"{i + 1} 1 {flat(p)} 0 0 0"), "atomic", []
    yield "rows in another order", data(order=list(reversed(range(N)))), "atomic", []
    yield "ids with gaps", data(row=lambda i, p: f"{3 * i + 5} 1 {flat(p)}"), "atomic", []
    yield "masses behind the atoms", data(sections=(), after=(MASSES,)), "atomic", []
    yield "velocities", data(after=(["Velocities", "", *(f"{i + 1} 0 0 0" for i in range(N))],)), "atomic", []
    yield "several blank lines", data(header=("", "", "0 bonds", "")), None, []
    yield "two types", data(types="2 atom types", sections=(["Masses", "", "1 12.011", "2 1.008"],)), "atomic", []
    yield "a type that is not used", data(types="2 atom types", sections=(["Masses", "", "1 12.011", "2 28.0855"],)), None, []
    yield "blanks before words", data(box=["   " + s for s in (*SIDES, TILTS)]), "atomic", []
    yield "exponents", data(row=lambda i, p: f"{i + 1} 1 {flat(p, style='{:.14e}')}"), "atomic", []
    yield "tilts before sides", data(box=(TILTS, *SIDES)), "atomic", []
    yield "box elsewhere", data(box=(*[s.replace("0 ", "0.0 ", 1) for s in SIDES], TILTS)), "atomic", []
    yield "general box", data(box=general), None, []
    yield "general box with its origin", data(box=(*general, "0 0 0 abc origin")), None, []
    yield "type labels", data(sections=(["Atom Type Labels", "", "1 C"], MASSES)), None, []
    yield "rows of type labels", data(sections=(["Atom Type Labels", "", "1 C"], ["Masses", "", "C 12.011"]), row=lambda i, p: f"{i + 1} C {flat(p)}"), None, []
    yield "labels without masses", data(sections=(["Atom Type Labels", "", "1 C"],), row=lambda i, p: f"{i + 1} C {flat(p)}"), None, []
    yield "charge", data(atoms="Atoms # charge", row=charge), "charge", []
    yield "charge without a hint", data(atoms="Atoms", row=charge), "charge", []
    yield "charge with image flags", data(atoms="Atoms", row=lambda i, p: charge(i, p) + " 0 0 0"), "charge", []
    yield "integer charges", data(atoms="Atoms", row=lambda i, p: f"{i + 1} 1 0 {flat(p)}"), "charge", []
    yield "charge named", data(atoms="Atoms", row=lambda i, p: f"{i + 1} 1 1 {flat(p)}"), "charge", ["--atom-style", "charge"]
    yield "molecular", data(bond_header, atoms="Atoms # molecular", row=molecular, after=(bond_rows,)), "molecular", []
    yield "molecular without a hint", data(bond_header, atoms="Atoms", row=molecular, after=(bond_rows,)), "molecular", []
    yield "molecule 0", data(atoms="Atoms", row=lambda i, p: f"{i + 1} 0 1 {flat(p)}"), "molecular", []
    yield "bond", data(bond_header, atoms="Atoms # bond", row=molecular, after=(bond_rows,)), "bond", []
    yield "angle", data(bond_header, atoms="Atoms # angle", row=molecular, after=(bond_rows,)), "angle", []
    yield "full", data(atoms="Atoms # full", row=lambda i, p: f"{i + 1} 1 1 0.5 {flat(p)}"), "full", []
    yield "full without a hint", data(atoms="Atoms", row=lambda i, p: f"{i + 1} 1 1 -0.5 {flat(p)} 0 0 0"), "full", []
    yield "coefficients", data(after=(["Pair Coeffs", "", "1 0.1 3.4"],)), None, []
    yield "extra counts", data(header=("0 bonds", "0 angles", "3 extra bond per atom")), None, []
    yield "title of LAMMPS", data(title="LAMMPS data file via write_data, version 29 Sep 2021, timestep = 0, units = metal"), "atomic", []


def illegal_data():
    def with_row(text):
        return data(row=lambda i, p: text if i == 7 else f"{i + 1} 1 {flat(p)}")

    yield "empty", b""
    yield "title alone", b"title\n"
    yield "no count", data(count="")
    yield "count of a word", data(count="many atoms")
    yield "count too small", data(count=f"{N - 1} atoms")
    yield "count too large", data(count=f"{N + 1} atoms")
    yield "huge count", data(count="2000000000 atoms")
    yield "two counts", data(header=(f"{N} atoms",))
    yield "unknown line in the header", data(header=("3 walls",))
    yield "misspelled side", data(box=(SIDES[0].replace("xlo", "xl0"), *SIDES[1:], TILTS))
    yield "misspelled tilts", data(box=(*SIDES, TILTS.replace("xy xz yz", "xy yz xz")))
    yield "side without extent", data(box=("5 5 xlo xhi", *SIDES[1:], TILTS))
    yield "side turned round", data(box=("5 0 xlo xhi", *SIDES[1:], TILTS))
    yield "side with nan", data(box=("0 nan xlo xhi", *SIDES[1:], TILTS))
    yield "side twice", data(box=(SIDES[0], *SIDES, TILTS))
    yield "general and plain box", data(box=(*SIDES, "1 0 0 avec", "0 1 0 bvec", "0 0 1 cvec"))
    yield "general box cut short", data(box=("1 0 0 avec", "0 1 0 bvec"))
    yield "left-handed general box", data(box=("1 0 0 avec", "0 1 0 bvec", "0 0 -1 cvec"))
    yield "origin without a general box", data(box=(*SIDES, TILTS, "0 0 0 abc origin"))
    yield "unknown section", data(sections=(["Massses", "", "1 12.011"],))
    yield "second section Atoms", data(after=(["Atoms # atomic", "", "1 1 0 0 0"],))
    yield "second section Masses", data(after=(MASSES,))
    yield "no section Atoms", data(atoms="Velocities")
    yield "unknown atom_style", data(atoms="Atoms # dipole")
    yield "hint of another style", data(atoms="Atoms # full")
    yield "atom twice", data(row=lambda i, p: f"{max(i, 1)} 1 {flat(p)}")
    yield "id 0", data(row=lambda i, p: f"{i} 1 {flat(p)}")
    yield "type 0", with_row("8 0 1 2 3")
    yield "type beyond", with_row("8 2 1 2 3")
    yield "label without labels", with_row("8 C 1 2 3")
    yield "row too short", with_row("8 1 1 2")
    yield "row too long", with_row("8 1 1 2 3 4 5 6 7")
    yield "word in a row", with_row("8 1 1 2 z")
    yield "nan in a row", with_row("8 1 1 2 nan")
    yield "D exponent", with_row("8 1 1 2 3D0")
    yield "mass 0", data(sections=(["Masses", "", "1 0"],))
    yield "mass of silicon", data(sections=(["Masses", "", "1 28.0855"],))
    yield "mass against its comment", data(sections=(["Masses", "", "1 12.011 # H"],))
    yield "mass against its label", data(sections=(["Atom Type Labels", "", "1 H"], MASSES))
    yield "mass of type 2", data(sections=(["Masses", "", "2 12.011"],))
    yield "label twice", data(types="2 atom types", sections=(["Atom Type Labels", "", "1 C", "2 C"],))
    yield "two types without masses", data(types="2 atom types", sections=())
    yield "bond of a missing atom", data(("1 bonds",), after=(["Bonds", "", f"1 1 1 {N + 1}"],))
    yield "bond of an atom to itself", data(("1 bonds",), after=(["Bonds", "", "1 1 1 1"],))
    yield "bonds that are declared only", data(("1 bonds",))
    yield "bond of one atom", data(("1 bonds",), after=(["Bonds", "", "1 1 1"],))
    yield "ellipsoids", data(("1 ellipsoids",))
    yield "units of Lennard-Jones", data(title="LAMMPS data file via write_data, timestep = 0, units = lj")
    yield "molecular or charge", data(types="2 atom types", sections=(["Masses", "", "1 12.011", "2 1.008"],), atoms="Atoms", row=lambda i, p: f"{i + 1} 1 2 {flat(p)}")


# --------------------------------------------------------------------------------------- judges


class Judge:
    def __init__(self, trivalent, lammps, folder):
        self.trivalent, self.lammps, self.folder = trivalent, lammps, folder
        self.n = {"legal": 0, "illegal": 0, "ASE": 0, "LAMMPS": 0}
        self.faults = []

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content)
        return path

    def energy(self, path, options):
        command = [self.trivalent, "energy", str(path), "--json", "--periodic", "xy", *options]
        return subprocess.run(command, capture_output=True, text=True, timeout=60)

    def check_energy(self, name, path, options, expected):
        self.n["legal"] += 1
        run = self.energy(path, options)
        if run.returncode != 0:
            self.faults.append(f"{name}: refused: {run.stderr.strip()}")
            return
        found = json.loads(run.stdout)["energy"]
        if abs(found - expected) > 1e-6:
            self.faults.append(f"{name}: energy {found} instead of {expected}")

    def check_ase(self, name, path):
        import ase.io

        self.n["ASE"] += 1
        atoms = ase.io.read(path, format="extxyz")
        same = (
            numpy.allclose(atoms.positions, POSITIONS, atol=1e-9)
            and numpy.allclose(atoms.cell, CELL, atol=1e-9)
            and set(atoms.symbols) == {"C"}
            and list(atoms.pbc) == [True, True, False]
        )
        if not same:
            self.faults.append(f"{name}: ASE reads other atoms")

    def check_lammps(self, name, path, style, expected):
        self.n["LAMMPS"] += 1
        script = ["units metal", "boundary p p f", f"atom_style {style}"]
        if style not in ("atomic", "charge"):
            script += ["special_bonds lj/coul 1 1 1", "bond_style zero"]
        if style in ("angle", "molecular", "full"):
            script += ["angle_style zero"]
        script += [f"read_data {path}", "pair_style rebo"]
        if style not in ("atomic", "charge") and b"1 bond types" in path.read_bytes():
            script += ["bond_coeff *"]
        two = b"2 atom types" in path.read_bytes()
        script += [f"pair_coeff * * CH.rebo C{' H' if two else ''}", "run 0", 'print "energy $(pe:%.15g)"']
        deck = self.write("in.lammps", "\n".join(script + [""]).encode())
        run = subprocess.run([self.lammps, "-in", deck, "-log", "none"], capture_output=True, text=True, cwd=self.folder, timeout=60)
        found = [line.split()[1] for line in run.stdout.splitlines() if line.startswith("energy ")]
        if not found:
            self.faults.append(f"{name}: LAMMPS fails: {run.stdout[-300:]}")
        elif abs(float(found[0]) - expected) > 1e-6:
            self.faults.append(f"{name}: LAMMPS finds {found[0]} instead of {expected}")

    def check_refusal(self, name, path):
        self.n["illegal"] += 1
        output = self.folder / "out.extxyz"
        run = self.energy(path, ["-o", str(output)])
        message = run.stderr.strip()
        if run.returncode not in (1, 2):
            self.faults.append(f"{name}: exit code {run.returncode}, not refused: {message}")
        elif "line " not in message and "cut short" not in message:
            self.faults.append(f"{name}: the message names no line: {message}")
        if output.exists():
            self.faults.append(f"{name}: left an output")


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("trivalent")
    arguments.add_argument("--lammps", help="program of LAMMPS; without it, LAMMPS is not asked")
    arguments = arguments.parse_args()
    arguments.trivalent = str(pathlib.Path(arguments.trivalent).resolve())
    with tempfile.TemporaryDirectory() as folder:
        judge = Judge(arguments.trivalent, arguments.lammps, pathlib.Path(folder))
        plain = judge.write("plain.extxyz", next(legal_xyz())[1])
        run = judge.energy(plain, [])
        expected = json.loads(run.stdout)["energy"]
        for name, content, ase in legal_xyz():
            path = judge.write("a.extxyz", content)
            judge.check_energy(f"xyz, {name}", path, [], expected)
            if ase:
                judge.check_ase(f"xyz, {name}", path)
        for name, content, style, options in legal_data():
            path = judge.write("a.data", content)
            judge.check_energy(f"data, {name}", path, options, expected)
            if style and arguments.lammps:
                judge.check_lammps(f"data, {name}", path, style, expected)
        for name, content in illegal_xyz():
            judge.check_refusal(f"xyz, {name}", judge.write("bad.extxyz", content))
        for name, content in illegal_data():
            judge.check_refusal(f"data, {name}", judge.write("bad.data", content))
    for fault in judge.faults:
        print(fault)
    print(", ".join(f"{key} {count}" for key, count in judge.n.items()), "-", len(judge.faults), "faults")
    return 1 if judge.faults else 0


if __name__ == "__main__":
    sys.exit(main())
