"""The reference structures: one function a family, each yields (name, ase.Atoms)."""
import itertools

import numpy as np
from ase import Atoms
from ase.build import molecule

BOND = 1.42039010727  # of graphene at its minimum [Å]


def displaced(atoms, deviation, seed):
    moved = atoms.copy()
    noise = np.random.default_rng(seed).normal(0.0, deviation, (len(atoms), 3))
    moved.set_positions(atoms.get_positions() + noise)
    return moved


def graphene(nx, ny, bond=BOND, height=20.0):
    width = np.sqrt(3.0) * bond
    basis = np.array([(0, 0, 0), (width / 2, bond / 2, 0), (width / 2, 1.5 * bond, 0),
                      (0, 2 * bond, 0)])
    corners = [(x * width, y * 3 * bond, height / 2) for x in range(nx) for y in range(ny)]
    positions = np.concatenate([basis + corner for corner in corners])
    return Atoms("C" * len(positions), positions, cell=(nx * width, ny * 3 * bond, height),
                 pbc=True)


def lattice(basis, a, n):
    cells = np.array(list(itertools.product(range(n), repeat=3)), float)
    positions = a * (cells[:, None, :] + np.array(basis, float)).reshape(-1, 3)
    return Atoms("C" * len(positions), positions, cell=3 * [n * a], pbc=True)


FCC = [(0, 0, 0), (0, .5, .5), (.5, 0, .5), (.5, .5, 0)]
DIAMOND = FCC + [(x + .25, y + .25, z + .25) for x, y, z in FCC]


def icosahedron():
    golden = (1 + np.sqrt(5)) / 2
    vertices = np.array([p for s, t in itertools.product((1, -1), repeat=2)
                         for p in ((0, s, t * golden), (s, t * golden, 0), (t * golden, 0, s))])
    vertices = vertices / np.linalg.norm(vertices[0])
    near = lambda i, j: i != j and np.linalg.norm(vertices[i] - vertices[j]) < 1.1
    faces = [f for f in itertools.combinations(range(12), 3)
             if all(near(i, j) for i, j in itertools.combinations(f, 2))]
    return vertices, faces


def geodesic(frequency):
    """Vertices on the unit sphere and triangles of the icosahedron cut frequency times."""
    corners, icosahedron_faces = icosahedron()
    number, vertices, faces = {}, [], []

    def vertex(face, i, j):
        a, b, c = corners[list(face)]
        x = (a * (frequency - i - j) + b * i + c * j) / frequency
        x = x / np.linalg.norm(x)
        key = tuple(np.round(x, 6) + 0.0)
        if key not in number:
            number[key] = len(vertices)
            vertices.append(x)
        return number[key]

    for face in icosahedron_faces:
        for i, j in ((i, j) for i in range(frequency) for j in range(frequency - i)):
            faces.append((vertex(face, i, j), vertex(face, i + 1, j), vertex(face, i, j + 1)))
            if i + j < frequency - 1:
                faces.append((vertex(face, i + 1, j), vertex(face, i + 1, j + 1),
                              vertex(face, i, j + 1)))
    return np.array(vertices), faces


def sphere_of_carbon(directions):
    area = 0.75 * np.sqrt(3.0) * BOND ** 2  # of an atom in graphene
    radius = np.sqrt(len(directions) * area / (4 * np.pi))
    unit = directions / np.linalg.norm(directions, axis=1)[:, None]
    return Atoms("C" * len(unit), radius * unit)


def fullerene_20(frequency):
    """Dual of the geodesic sphere: 20 f² atoms."""
    vertices, faces = geodesic(frequency)
    return sphere_of_carbon(np.array([vertices[list(f)].mean(0) for f in faces]))


def fullerene_60(frequency):
    """Leapfrog of fullerene_20: 60 f² atoms, two to each edge of the geodesic sphere."""
    vertices, faces = geodesic(frequency)
    of_edge = {}
    for f in faces:
        for edge in itertools.combinations(sorted(f), 2):
            of_edge.setdefault(edge, []).append(vertices[list(f)].mean(0))
    return sphere_of_carbon(np.array([(vertices[end] + sum(centers)) / 3
                                      for edge, centers in of_edge.items() for end in edge]))


def nanotube(n, m, cells):
    """Armchair (m = n) or zigzag (m = 0) tube along z, periodic there."""
    sheet = graphene(n, cells) if m == 0 else graphene(cells, n)
    width, height = sheet.cell[0, 0], sheet.cell[1, 1]
    around, along = (0, 1) if m == 0 else (1, 0)
    circumference, length = (width, height) if m == 0 else (height, width)
    angle = 2 * np.pi * sheet.get_positions()[:, around] / circumference
    radius = circumference / (2 * np.pi)
    box = 2 * radius + 20
    positions = np.stack([radius * np.cos(angle) + box / 2, radius * np.sin(angle) + box / 2,
                          sheet.get_positions()[:, along]], axis=1)
    return Atoms("C" * len(sheet), positions, cell=(box, box, length), pbc=True,
                 info={"is_tube": True})


def stone_wales(sheet):
    """Turns a bond in the middle of a sheet, one across its cells, by a right angle and lets springs
    settle the rest, so that a relaxation breaks no bond. Then bends the sheet up on one side and
    down on the other: how the defect buckles."""
    positions = sheet.get_positions()
    distance = sheet.get_all_distances(mic=True)
    bonds = {(i, j) for i in range(len(sheet)) for j in np.flatnonzero(distance[i] < 1.6) if i < j}
    middle = positions.mean(0)
    inside = [p for p in bonds if np.linalg.norm(positions[p[0]] - positions[p[1]]) < 1.6
              and abs(positions[p[0]][0] - positions[p[1]][0]) > 0.1]
    i, j = min(inside, key=lambda p: np.linalg.norm((positions[p[0]] + positions[p[1]]) / 2 - middle))
    center = (positions[i] + positions[j]) / 2
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    for k in (i, j):
        positions[k] = center + turn @ (positions[k] - center)
    around = {k for bond in bonds if {i, j} & set(bond) for k in bond} - {i, j}
    bonds = {bond for bond in bonds if not {i, j} & set(bond)} | {(i, j)}
    for k in around:
        nearer = min((i, j), key=lambda end: np.linalg.norm(positions[k] - positions[end]))
        bonds.add((min(k, nearer), max(k, nearer)))
    turned = sheet.copy()
    positions = settled(positions, bonds, sheet.cell.lengths())
    from_center = positions - positions[[i, j]].mean(0)
    distance = np.linalg.norm(from_center, axis=1)
    positions[:, 2] += 0.6 * np.sin(2 * np.pi * from_center[:, 0] / 12) * np.exp(-distance**2 / 72)
    turned.set_positions(positions)
    return turned


def settled(positions, bonds, lengths):
    """Steepest descent of springs along bonds and between atoms with a common neighbor."""
    partners = {}
    for a, b in bonds:
        partners.setdefault(a, []).append(b)
        partners.setdefault(b, []).append(a)
    angles = {tuple(sorted(p)) for ends in partners.values() for p in itertools.combinations(ends, 2)}
    springs = np.array([*bonds, *angles])
    rest = np.array([BOND] * len(bonds) + [np.sqrt(3) * BOND] * len(angles))
    stiffness = np.array([1.0] * len(bonds) + [0.2] * len(angles))
    x = positions.copy()
    for _ in range(4000):
        d = x[springs[:, 1]] - x[springs[:, 0]]
        d -= lengths * np.round(d / lengths)
        r = np.linalg.norm(d, axis=1)
        pull = (stiffness * (r - rest) / r)[:, None] * d
        step = np.zeros_like(x)
        np.add.at(step, springs[:, 0], pull)
        np.add.at(step, springs[:, 1], -pull)
        x += 0.15 * step
    return x


def gas(count, width, apart, hydrogens, seed):
    rng = np.random.default_rng(seed)
    positions = []
    while len(positions) < count:
        x = rng.random(3) * width
        gaps = [np.linalg.norm((x - y + width / 2) % width - width / 2) for y in positions]
        if not gaps or min(gaps) > apart:
            positions.append(x)
    symbols = rng.permutation(["H"] * hydrogens + ["C"] * (count - hydrogens))
    return Atoms(list(symbols), positions, cell=3 * [width], pbc=True)


def molecules():
    for name in ("CH4", "C2H2", "C2H4", "C2H6", "C3H8", "C6H6", "trans-butane", "isobutane",
                 "butadiene", "bicyclobutane", "cyclobutene", "C3H4_C2v", "CH2_s1A1d", "CH", "C2H3"):
        if name == "trans-butane":
            continue  # its name is not a good file name
        single = molecule(name)
        yield name, single
        yield f"{name}_bent", displaced(single, 0.08, len(name))
    yield "C2_180", Atoms("C2", [(0, 0, 0), (0, 0, 1.8)])
    yield "H2_145", Atoms("H2", [(0, 0, 0), (0, 0, 1.45)])
    yield "CH_155", Atoms("CH", [(0, 0, 0), (0, 0, 1.55)])
    yield "C3_straight", Atoms("C3", [(0, 0, 0), (0, 0.01, 1.35), (0, 0, 2.7)])
    yield "C3_ring", Atoms("C3", [(0, 0, 0), (1.4, 0, 0), (0.7, 1.2, 0)])
    yield "C8_chain", displaced(Atoms("C8", [(0, 0, 1.33 * k) for k in range(8)]), 0.1, 1)


def sheets():
    yield "graphene", graphene(3, 2)
    yield "graphene_disp_005", displaced(graphene(4, 3), 0.05, 1)
    yield "graphene_disp_020", displaced(graphene(4, 3), 0.20, 2)
    for stretch in (0.85, 1.10, 1.20, 1.30, 1.38):
        sheet = graphene(3, 2, BOND * stretch)
        yield f"graphene_strain_{round(100 * stretch)}", displaced(sheet, 0.03, 3)
    yield "graphene_cell_4", displaced(graphene(1, 1), 0.05, 4)
    yield "graphene_cell_2", triclinic_graphene()
    sheared = displaced(graphene(3, 2), 0.05, 5)
    cell = sheared.cell.array.copy()
    cell[1, 0] = 0.3 * cell[0, 0]
    sheared.set_cell(cell, scale_atoms=True)
    yield "graphene_sheared", sheared
    holed = displaced(graphene(4, 3), 0.04, 6)
    del holed[20]
    yield "graphene_vacancy", holed
    adatom = displaced(graphene(4, 3), 0.04, 7)
    adatom.append("C")
    adatom.positions[-1] = adatom.positions[22] + (0.7, 0.1, 1.3)
    yield "graphene_adatom", adatom
    hydrogenated = displaced(graphene(3, 2), 0.04, 8)
    for k in range(0, 8, 3):
        hydrogenated.append("H")
        hydrogenated.positions[-1] = hydrogenated.positions[k] + (0.05, 0.02, 1.12)
    yield "graphene_hydrogens", hydrogenated


def triclinic_graphene():
    a = np.sqrt(3.0) * BOND
    atoms = Atoms("C2", [(0.03, 0.01, 10), (a / 2, BOND / 2, 10.1)],
                  cell=[(a, 0, 0), (a / 2, 1.5 * BOND, 0), (0, 0, 20)], pbc=True)
    return atoms


def crystals():
    yield "diamond", lattice(DIAMOND, 3.56571570992, 1)
    yield "diamond_disp_010", displaced(lattice(DIAMOND, 3.567, 2), 0.06, 1)
    # LAMMPS leaves out dihedral factors |T| <= 1e-9 here, and with them forces of 6e-6 eV/Å.
    yield "diamond_dropped_terms", displaced(lattice(DIAMOND, 3.567, 2), 0.10, 1)
    yield "diamond_compressed", displaced(lattice(DIAMOND, 3.0, 1), 0.15, 2)
    yield "diamond_stretched", displaced(lattice(DIAMOND, 4.1, 1), 0.10, 3)
    yield "simple_cubic", displaced(lattice([(0, 0, 0)], 1.78, 3), 0.05, 4)
    yield "bcc", displaced(lattice([(0, 0, 0), (.5, .5, .5)], 2.1, 2), 0.08, 5)
    yield "fcc", displaced(lattice(FCC, 2.5, 2), 0.10, 6)


def gases():
    for seed in range(3):
        yield f"gas_c_{seed}", gas(50, 7.0 + seed, 0.9, 0, seed)
        yield f"gas_ch_{seed}", gas(60, 7.0 + seed, 0.8, 25, 10 + seed)
    yield "gas_dense", gas(60, 5.0, 0.75, 20, 20)
    # As with diamond_dropped_terms: LAMMPS's forces are off by 5e-5 eV/Å, its energy by 1e-8 eV.
    yield "amorphous_dropped_terms", gas(96, 9.68, 1.19, 0, 12)


def shells():
    yield "dual_C80", fullerene_20(2)
    yield "dual_C180_disp", displaced(fullerene_20(3), 0.07, 1)
    yield "dual_C320_squeezed", Atoms("C320", 0.9 * fullerene_20(4).get_positions())


def relaxed():
    """To be relaxed before they are evaluated; their energies are published in the tests."""
    yield "C60", fullerene_60(1)
    yield "C180", fullerene_20(3)
    yield "C240", fullerene_60(2)
    yield "C540", fullerene_60(3)
    yield "tube_5_5", nanotube(5, 5, 4)
    yield "tube_10_0", nanotube(10, 0, 2)
    yield "tube_10_10", nanotube(10, 10, 3)
    yield "stone_wales_960", stone_wales(graphene(30, 8))


def layers():
    """With distances between molecules, for terms that reach further than bonds."""
    onion = fullerene_60(1) + displaced(fullerene_60(2), 0.03, 1)
    yield "C60_in_C240", onion
    two = displaced(graphene(3, 2), 0.05, 2)
    upper = displaced(graphene(3, 2), 0.05, 3)
    upper.positions += (0, BOND, 3.2)
    yield "bilayer", two + upper
    pair = molecule("C6H6")
    other = displaced(molecule("C6H6"), 0.03, 4)
    other.positions += (0.6, 0.3, 3.3)
    yield "benzene_pair", pair + other
    near = molecule("CH4")
    second = displaced(molecule("CH4"), 0.03, 5)
    second.positions += (2.6, 0.4, 0.1)
    yield "methane_pair", near + second
    yield "gas_loose", gas(40, 11.0, 1.9, 15, 21)
