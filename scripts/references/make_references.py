"""Writes one extended XYZ file per structure and pair style: see make_references.sh."""
import re
import sys

import lammps
import structures

LARGE = 130  # atoms; beyond, only REBO is kept, to keep the set small


def text(values):
    return " ".join("%.17g" % v for v in values)


def write(path, atoms, style):
    energy, virial, energies, forces = lammps.evaluate(atoms, style)
    header = [f'Lattice="{text(atoms.cell.array.ravel())}"'] if atoms.pbc.any() else []
    header += ["Properties=species:S:1:pos:R:3:energies:R:1:forces:R:3", "energy=%.17g" % energy,
               f'virial_xx_yy_zz_xy_xz_yz="{text(virial)}"',
               'pbc="%s"' % " ".join("T" if p else "F" for p in atoms.pbc), f'style="{style}"']
    with open(path, "w") as out:
        out.write(f"{len(atoms)}\n{' '.join(header)}\n")
        for row in zip(atoms.get_chemical_symbols(), atoms.get_positions(), energies, forces):
            symbol, x, e, f = row
            out.write(f"{symbol} {text(x)} {e:.17g} {text(f)}\n")


def write_all(folder, name, atoms, styles):
    for style in styles:
        write(f"{folder}/{name}.{style}.extxyz", atoms, style)
    print(name, len(atoms), flush=True)


def main(folder):
    families = (structures.molecules, structures.sheets, structures.crystals, structures.gases,
                structures.shells)
    for family in families:
        for name, atoms in family():
            styles = lammps.STYLES if len(atoms) <= LARGE else ["rebo"]
            write_all(folder, re.sub(r"\W", "_", name), atoms, styles)
    for name, atoms in structures.relaxed():
        write_all(folder, f"relaxed_{name}", lammps.relax(atoms), ["rebo"])
    for name, atoms in structures.layers():
        write_all(folder, name, atoms, ["airebo11"] if len(atoms) > LARGE else lammps.STYLES)
    with open(f"{folder}/VERSION", "w") as out:
        out.write(f"LAMMPS {lammps.version()}\n")


if __name__ == "__main__":
    main(sys.argv[1])
