"""The steps of the whole way, each by itself."""

import pathlib
import types
from typing import Callable

import ase.build
import ase.io
import numpy as np
import pytest

import trivalent


def test_remesh_makes_edges_of_one_length() -> None:
    net = trivalent.remesh(trivalent.shape("sphere", 0.1), 0.2, method="paper")
    assert net.report["target_edge_length"] == 0.2
    edges = net.vertices[net.faces] - net.vertices[np.roll(net.faces, 1, axis=1)]
    assert np.linalg.norm(edges, axis=2).mean() == pytest.approx(0.2, rel=0.1)


def test_the_dual_of_an_icosahedron_is_c20() -> None:
    golden = (1 + 5**0.5) / 2
    corners = [(0, i, j * golden) for i in (1, -1) for j in (1, -1)]
    vertices = np.array([np.roll(corner, k) for corner in corners for k in range(3)], dtype=float)
    distance = np.linalg.norm(vertices[:, None] - vertices[None], axis=2)
    near = np.abs(distance - 2) < 1e-9
    faces = [(i, j, k) for i in range(12) for j in range(i) for k in range(j) if near[i, j] and near[j, k] and near[i, k]]
    shell = trivalent.dual((vertices, faces))
    assert len(shell) == 20 and len(shell.bonds) == 30 and [len(ring) for ring in shell.rings] == [5] * 12
    vectors = shell.positions[shell.bonds[:, 0]] - shell.positions[shell.bonds[:, 1]]
    assert np.linalg.norm(vectors, axis=1) == pytest.approx(1.42)


def test_inspect_says_what_is_wrong(meshes: pathlib.Path) -> None:
    assert trivalent.inspect(trivalent.shape("sphere"))["verdict"] == "sound"
    sphere = trivalent.shape("sphere")
    torn = trivalent.inspect((sphere.vertices, np.vstack([sphere.faces, sphere.faces[:1]])))
    assert torn["verdict"] == "mendable" and torn["problems"]
    assert trivalent.inspect(meshes / "missing.off")["verdict"] == "hopeless"


def test_repair_wraps_points() -> None:
    sphere = trivalent.shape("sphere", 0.3)
    wrap = trivalent.repair((sphere.vertices, sphere.faces[::2]), repair="wrap", wrap_alpha=0.5, atoms=1000)
    assert wrap.wrap_offset > 0
    with pytest.raises(trivalent.InvalidMesh):
        trivalent.repair((sphere.vertices, sphere.faces[:, [0, 0, 1]]))


def test_energy_is_that_of_the_program(tmp_path: pathlib.Path, program: Callable[..., str]) -> None:
    shell = trivalent.dual(trivalent.shape("sphere", 0.3))
    shell.write(tmp_path / "a.extxyz", digits="17")
    for potential in ("rebo", "airebo", "lj"):
        found = trivalent.energy(tmp_path / "a.extxyz", potential=potential)
        printed = program("energy", tmp_path / "a.extxyz", "--potential", potential, "--json")
        assert f'"energy": {found.energy!r}' in printed


def test_relax_brings_atoms_to_rest_and_check_says_so() -> None:
    rough = trivalent.dual(trivalent.remesh(trivalent.shape("sphere"), 0.3))
    rest = trivalent.relax(rough)
    assert rest.report["relaxation"]["converged"]
    assert np.linalg.norm(rest.forces, axis=1).max() < 1e-3
    assert rest.positions - rough.positions == pytest.approx(rest.columns["displacement"])
    report = trivalent.check(rest)
    assert report["sound"] and report["problems"] == []
    assert not trivalent.check(rough)["sound"]


def test_some_atoms_stay() -> None:
    rough = trivalent.dual(trivalent.shape("sphere", 0.3))
    rest = trivalent.relax(rough, fix=["ids:1-3"], max_steps=20)
    assert np.array_equal(rest.positions[:3], rough.positions[:3])
    with pytest.raises(trivalent.InvalidOption):
        trivalent.relax(rough, fix=["ids:1-100000"])


def test_files_bring_back_the_same(tmp_path: pathlib.Path) -> None:
    shell = trivalent.energy(trivalent.dual(trivalent.shape("torus", 0.5)))
    shell.write(tmp_path / "a.extxyz", digits="17")
    again = trivalent.read(tmp_path / "a.extxyz")
    assert np.array_equal(again.positions, shell.positions)
    assert np.array_equal(again.energies, shell.energies)
    shell.write(tmp_path / "a.data", atom_style="molecular", digits="17")
    molecular = trivalent.read(tmp_path / "a.data", periodic=False)
    assert np.array_equal(molecular.positions, shell.positions)
    assert len(molecular.bonds) == len(shell.bonds)
    (tmp_path / "frames").write_text((tmp_path / "a.extxyz").read_text() * 2)
    assert len(trivalent.read(tmp_path / "frames", format="extxyz", frame=1)) == len(shell)
    with pytest.raises(trivalent.InvalidOption, match="elements"):
        trivalent.read(tmp_path / "a.data", elements=["O"])
    with pytest.raises(trivalent.InvalidOption, match="extension"):
        shell.write(tmp_path / "a.unknown")
    with pytest.raises(trivalent.FileError):
        trivalent.read(tmp_path / "missing.extxyz")


def test_ase_and_back(tmp_path: pathlib.Path) -> None:
    shell = trivalent.energy(trivalent.dual(trivalent.shape("torus", 0.5)))
    atoms = shell.to_ase()
    assert atoms.get_potential_energy() == shell.energy
    assert np.array_equal(atoms.get_forces(), shell.forces)
    assert np.array_equal(atoms.arrays["rings"], shell.columns["rings"])
    back = trivalent.Shell.from_ase(atoms)
    assert np.array_equal(back.positions, shell.positions) and np.array_equal(back.cell, shell.cell)
    assert np.array_equal(back.columns["coordination"], shell.columns["coordination"])
    ase.io.write(tmp_path / "a.extxyz", atoms)
    assert trivalent.read(tmp_path / "a.extxyz").energy == pytest.approx(shell.energy)


def test_periodic_atoms_keep_their_cell() -> None:
    sheet = ase.build.graphene(size=(4, 4, 1), vacuum=5.0)
    shell = trivalent.energy(sheet)
    assert shell.pbc.tolist() == [True, True, False]
    assert shell.report["coordinations"] == {"3": 32}
    assert np.array_equal(shell.cell, sheet.cell.array)


def test_a_lammps_package_is_complete(tmp_path: pathlib.Path) -> None:
    shell = trivalent.dual(trivalent.shape("sphere", 0.3))
    names = trivalent.lammps_package(shell, tmp_path / "deep" / "run", atom_style="molecular", angles=True)
    assert {"in.check", "in.relax", "in.md"} <= set(names)
    assert all((tmp_path / "deep" / "run" / name).exists() for name in names)


def test_pages_and_pictures(tmp_path: pathlib.Path) -> None:
    shell = trivalent.dual(trivalent.shape("sphere", 0.3))
    rest = trivalent.relax(shell)
    page = trivalent.view(shell, rest, names=["before", "after"], title="A sphere")
    page.write(tmp_path / "a.html")
    assert "A sphere" in (tmp_path / "a.html").read_text() and "<iframe" in page._repr_html_()
    picture = trivalent.render(shell, rest, size=(300, 200), color="ring_size")
    assert picture.pixels.shape == (200, 300, 3) and picture.pixels.std() > 0
    picture.write(tmp_path / "a.png")
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    with pytest.raises(trivalent.InvalidOption):
        trivalent.render(shell, size=(1, 1))
    with pytest.raises(trivalent.InvalidOption, match="names"):
        trivalent.view()


def test_notebooks_show_shells() -> None:
    shell = trivalent.dual(trivalent.shape("sphere", 0.3))
    assert "<iframe" in shell._repr_html_()
    assert shell._repr_png_().startswith(b"\x89PNG")
    assert "20" in repr(trivalent.Shell(np.eye(20, 3)))


def test_other_libraries_meshes_are_understood() -> None:
    quads = types.SimpleNamespace(
        points=np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float),
        cells=[
            types.SimpleNamespace(
                type="quad",
                data=np.array([(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]),
            )
        ],
    )
    cube = trivalent.repair(quads)
    assert cube.faces.shape == (12, 3)
    with pytest.raises(trivalent.InvalidArray, match="no triangles"):
        trivalent.repair(types.SimpleNamespace(points=np.eye(3), cells=[types.SimpleNamespace(type="tetra", data=[])]))
    with pytest.raises(trivalent.InvalidOption, match="a surface is"):
        trivalent.repair(42)
