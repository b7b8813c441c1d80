"""Runs LAMMPS on a structure: energies, forces and virial at full precision, or a relaxation."""
import os
import re
import subprocess
import tempfile

import numpy as np

POTENTIALS = os.environ.get("LAMMPS_POTENTIALS", "/usr/share/lammps/potentials")
STYLES = {
    "rebo": ["pair_style rebo", f"pair_coeff * * {POTENTIALS}/CH.rebo C H"],
    "airebo11": ["pair_style airebo 3.0 1 1", f"pair_coeff * * {POTENTIALS}/CH.airebo C H"],
    "ljcut": ["pair_style lj/cut 10.2", "pair_coeff * * 0.00284 3.4"],
}
BAR_CUBIC_ANGSTROM = 1.6021765e6  # in one eV, as LAMMPS units metal have it
CLUSTER_MARGIN = 50.0  # of the frame around atoms in free space [Å]


def version():
    text = subprocess.run(["lmp", "-h"], capture_output=True, text=True, check=True).stdout
    return re.search(r"Simulator - (.+)", text).group(1).strip()


def write_data(path, atoms):
    """LAMMPS data file, atom style atomic; the cell must be lower triangular if periodic."""
    positions = atoms.get_positions()
    with open(path, "w") as out:
        out.write(f"structure\n\n{len(atoms)} atoms\n2 atom types\n\n")
        if atoms.pbc.any():
            cell = atoms.cell.array
            assert abs(np.triu(cell, 1)).max() < 1e-12
            for k, name in enumerate("xyz"):
                out.write(f"0 {cell[k, k]:.17g} {name}lo {name}hi\n")
            if abs(np.tril(cell, -1)).max() > 0:
                out.write("%.17g %.17g %.17g xy xz yz\n" % (cell[1, 0], cell[2, 0], cell[2, 1]))
        else:
            low, high = positions.min(0) - CLUSTER_MARGIN, positions.max(0) + CLUSTER_MARGIN
            for k, name in enumerate("xyz"):
                out.write(f"{low[k]:.17g} {high[k]:.17g} {name}lo {name}hi\n")
        out.write("\nMasses\n\n1 12.011\n2 1.008\n\nAtoms # atomic\n\n")
        for i, (symbol, x) in enumerate(zip(atoms.get_chemical_symbols(), positions)):
            out.write("%d %d %.17g %.17g %.17g\n" % (i + 1, 1 if symbol == "C" else 2, *x))


def run(atoms, style, commands):
    with tempfile.TemporaryDirectory() as folder:
        write_data(f"{folder}/in.data", atoms)
        boundary = " ".join("p" if p else "f" for p in atoms.pbc)
        lines = ["units metal", "atom_style atomic", "atom_modify map array sort 0 0",
                 f"boundary {boundary}", "box tilt large", f"read_data {folder}/in.data",
                 "neigh_modify one 20000 page 400000", *STYLES[style], *commands]
        lines = [line.replace("FOLDER", folder) for line in lines]
        with open(f"{folder}/in", "w") as out:
            out.write("\n".join(lines) + "\n")
        done = subprocess.run(["lmp", "-in", f"{folder}/in", "-log", "none", "-screen",
                               f"{folder}/screen"], capture_output=True, text=True)
        screen = open(f"{folder}/screen").read()
        if done.returncode != 0:
            raise RuntimeError(screen[-2000:] + done.stderr)
        rows = np.array([line.split() for line in open(f"{folder}/dump").read().split(
            "ITEM: ATOMS")[1].splitlines()[1:]], float)
        return rows[rows[:, 0].argsort()][:, 1:], screen


DUMP = ["dump d all custom 1 FOLDER/dump id x y z c_e fx fy fz",
        'dump_modify d format line "%d %.17g %.17g %.17g %.17g %.17g %.17g %.17g" sort id']


def evaluate(atoms, style):
    """energy [eV], virial [eV] (xx yy zz xy xz yz), energies [eV], forces [eV/Å]"""
    rows, screen = run(atoms, style, [
        "compute e all pe/atom", "compute p all pressure NULL virial",
        "thermo_style custom step pe c_p[1]", *DUMP, "run 0",
        'print "energy $(pe:%.17g)"', 'print "volume $(vol:%.17g)"',
        'print "pressure $(c_p[1]:%.17g) $(c_p[2]:%.17g) $(c_p[3]:%.17g) $(c_p[4]:%.17g) '
        '$(c_p[5]:%.17g) $(c_p[6]:%.17g)"'])
    energy = float(re.findall(r"^energy (\S+)", screen, re.M)[-1])
    volume = float(re.findall(r"^volume (\S+)", screen, re.M)[-1])
    pressure = np.array(re.findall(r"^pressure (.+)", screen, re.M)[-1].split(), float)
    # Positions as LAMMPS read them: the same bits, unless it wrapped them into the cell.
    return energy, pressure * volume / BAR_CUBIC_ANGSTROM, rows[:, 3], rows[:, 4:7]


def relax(atoms, style="rebo"):
    """The same atoms where LAMMPS finds no force on them; tubes also find their length along z."""
    minimize = ["min_style cg", "min_modify line quadratic", "minimize 0 1e-9 20000 100000"]
    is_tube = atoms.info.get("is_tube", False)
    stretch = ["fix length all box/relax z 0.0 vmax 0.001", *minimize, "unfix length"]
    rows, screen = run(atoms, style, [
        "compute e all pe/atom", *(3 * stretch if is_tube else []), *minimize, "min_style fire",
        "minimize 0 1e-9 20000 100000", *DUMP, "run 0", 'print "length $(lz:%.17g)"'])
    relaxed = atoms.copy()
    relaxed.set_positions(rows[:, :3])
    if is_tube:
        relaxed.cell[2, 2] = float(re.findall(r"^length (\S+)", screen, re.M)[-1])
    return relaxed
