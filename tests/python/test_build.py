"""Shells out of shapes: the same as the program makes, whatever form the shape has."""

import json
import os
import pathlib
import signal
import threading
import types
from typing import Any, Callable

import numpy as np
import pytest

import trivalent

quick = {"atoms": 500, "effort": "quick"}


def test_the_bytes_are_those_of_the_program(tmp_path: pathlib.Path, meshes: pathlib.Path, program: Callable[..., str]) -> None:
    mesh = meshes / "eight.off"
    program("build", mesh, "-o", tmp_path / "shell", "--atoms", 500, "--effort", "quick", "--quiet")
    shell = trivalent.build(mesh, **quick)
    shell.write(tmp_path / "own.extxyz")
    shell.surface.write(tmp_path / "own.off")
    assert (tmp_path / "own.extxyz").read_bytes() == (tmp_path / "shell/shell.extxyz").read_bytes()
    assert (tmp_path / "own.off").read_bytes() == (tmp_path / "shell/surface.off").read_bytes()
    report = json.loads((tmp_path / "shell/report.json").read_text())
    for differs in ("seconds", "options", "input"):
        report.pop(differs)
    assert {name: shell.report[name] for name in report} == report


def test_a_shell_knows_its_atoms() -> None:
    shell = trivalent.build("ellipsoid", **quick)
    n = len(shell)
    assert shell.positions.shape == (n, 3) and shell.energies.shape == (n,) and shell.forces.shape == (n, 3)
    assert shell.energies.sum() == pytest.approx(shell.energy, abs=1e-8)
    assert np.abs(shell.forces).max() < 1e-3
    # Closed: three bonds at every atom, and Euler's characteristic is 2.
    assert np.bincount(shell.bonds.ravel(), minlength=n).tolist() == [3] * n
    assert n - len(shell.bonds) + len(shell.rings) == 2
    assert sum(6 - len(ring) for ring in shell.rings) == 12
    assert (shell.species == "C").all() and not shell.pbc.any()
    assert set(shell.columns) >= {"coordination", "rings", "component", "displacement"}
    assert len(shell.surface.faces) == n


def test_a_shape_is_the_same_in_any_form(tmp_path: pathlib.Path) -> None:
    surface = trivalent.shape("ellipsoid", 0.2)
    surface.write(tmp_path / "shape.off")
    vertices, faces = surface.vertices, surface.faces
    block = types.SimpleNamespace(type="triangle", data=faces)
    padded = np.hstack([np.full((len(faces), 1), 3), faces]).ravel()
    forms: list[Any] = [
        (vertices, faces),
        (vertices.tolist(), faces.tolist()),
        (np.asfortranarray(vertices), faces.astype(np.uint64)),
        types.SimpleNamespace(vertices=vertices, faces=faces),
        types.SimpleNamespace(points=vertices, cells=[types.SimpleNamespace(type="line", data=faces[:, :2]), block]),
        types.SimpleNamespace(points=vertices, faces=padded),
        surface,
        tmp_path / "shape.off",
        str(tmp_path / "shape.off"),
    ]
    shells = [trivalent.build(form, relax=False, atoms=200, effort="quick") for form in forms]
    for shell in shells:
        assert np.array_equal(shell.positions, shells[0].positions)


def test_built_in_shapes_and_sizes() -> None:
    sphere = trivalent.build("sphere", length=30.0, effort="quick", relax=False)
    # The corners of a cage stand out of its sphere; its mean radius does not.
    radii = np.linalg.norm(sphere.positions - sphere.positions.mean(axis=0), axis=1)
    assert 2.0 * radii.mean() == pytest.approx(30.0, rel=0.05)
    with pytest.raises(trivalent.InvalidOption, match="both say how large"):
        trivalent.build("sphere", atoms=100, length=30.0)


def test_an_edge_is_capped() -> None:
    shell = trivalent.build("open-tube", cap="hydrogen", **quick)
    assert (shell.species == "H").any()
    assert trivalent.check(shell, max_force=float("inf"))["sound"] is not None


def test_plans_cost_nothing() -> None:
    plan = trivalent.plan("torus:R=3,r=1", atoms=100000)
    assert plan["obstacles"] == [] and plan["atoms"] == pytest.approx(100000, rel=0.1)


def test_progress_is_told_and_can_end_the_call() -> None:
    told: list[tuple[str, int]] = []

    def stop_at_once(step: str, done: int, total: int | None, text: str) -> bool:
        told.append((step, done))
        return False

    shell = trivalent.build("sphere", atoms=2000, progress=stop_at_once)
    assert told and told[0][0] == "remesh"
    assert any("stopped" in note for note in shell.notes)


def test_what_progress_raises_arrives() -> None:
    def fail(*_: object) -> None:
        raise LookupError("mine")

    for method in ("crystal", "paper"):
        with pytest.raises(LookupError, match="mine"):
            trivalent.build("sphere", atoms=500, method=method, progress=fail)


def test_options_of_the_other_method_are_refused() -> None:
    with pytest.raises(trivalent.InvalidOption, match="method='crystal'"):
        trivalent.build("sphere", method="paper", effort="quick")
    with pytest.raises(trivalent.InvalidOption, match="crystal or paper"):
        trivalent.build("sphere", method="other")  # type: ignore[arg-type]


def test_two_threads_give_the_same_bytes() -> None:
    shells: dict[int, trivalent.Shell] = {}

    def work(i: int) -> None:
        shells[i] = trivalent.build("torus", **quick)

    threads = [threading.Thread(target=work, args=(i,)) for i in (0, 1)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    work(2)
    for i in (0, 1):
        assert shells[i].positions.tobytes() == shells[2].positions.tobytes()
        assert shells[i].forces.tobytes() == shells[2].forces.tobytes()


def interrupt_soon() -> threading.Timer:
    timer = threading.Timer(0.7, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    return timer


def test_an_interrupt_raises_or_keeps_the_best_so_far() -> None:
    timer = interrupt_soon()
    with pytest.raises(KeyboardInterrupt):
        trivalent.build("torus", atoms=20000, effort="thorough")
    timer.join()

    timers: list[threading.Timer] = []

    def interrupt(*_: object) -> None:  # once there is a net to keep
        if not timers:
            timers.append(interrupt_soon())

    shell = trivalent.build("torus", atoms=20000, effort="thorough", on_interrupt="keep", progress=interrupt)
    assert any("stopped" in note for note in shell.notes)


def test_an_interrupt_before_the_first_net_raises() -> None:
    timer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        trivalent.build("torus", atoms=100000, on_interrupt="keep")
    timer.join()


def test_a_cell_without_periodic_directions_is_refused() -> None:
    with pytest.raises(trivalent.InvalidOption, match="no use for cell"):
        trivalent.build("sheet.off", cell=10.0, pbc=False)


def test_chiral_indices_of_arms_are_not_lost() -> None:
    surface = trivalent.shape("y-junction:open=1,n=6,m=0", 0.3)
    with pytest.raises(trivalent.InvalidOption, match="by its name"):
        trivalent.build(surface)


def test_other_interrupts_are_refused() -> None:
    with pytest.raises(trivalent.InvalidOption, match="raise or keep"):
        trivalent.build("torus", on_interrupt="other")  # type: ignore[arg-type]


def test_a_periodic_surface_has_a_cell() -> None:
    surface = trivalent.shape("schwarz-p", 0.05)
    assert surface.pbc.all() and surface.cell == pytest.approx(np.eye(3))
    shell = trivalent.build(surface, atoms=432, effort="quick")
    assert shell.pbc.all() and sum(6 - len(ring) for ring in shell.rings) == -24
    assert shell.report["cell"]["genus"] == 3
    with pytest.raises(trivalent.InvalidOption, match="build, plan and dual"):
        trivalent.remesh(surface, 0.1)


def test_formulas_and_cells_are_taken_in_any_form() -> None:
    formula = "formula:cos(x)+cos(y)+cos(z)"
    cells: list[Any] = ["2*pi", 2.0 * np.pi, [2.0 * np.pi] * 3, 2.0 * np.pi * np.eye(3)]
    plans = [trivalent.plan(formula, cell=cell, scale=3.0) for cell in cells]
    for other in plans[1:]:
        assert other["atoms"] == pytest.approx(plans[0]["atoms"])
    twice = trivalent.plan(formula, cell="2*pi", scale=3.0, supercell=(2, 1, 1))
    assert twice["atoms"] == pytest.approx(2.0 * plans[0]["atoms"], rel=0.01)
    with pytest.raises(trivalent.InvalidOption, match="cell is a, "):
        trivalent.plan(formula, cell=[1.0, 2.0])
    with pytest.raises(trivalent.InvalidOption, match="supercell"):
        trivalent.plan(formula, cell="2*pi", supercell=(2, 1))
    with pytest.raises(trivalent.InvalidOption, match="position"):
        trivalent.plan("formula:cos(x", cell="2*pi")
    with pytest.raises(trivalent.Error, match="leaves the box"):
        trivalent.plan("formula:x^2+y^2+z^2-1", box=1.5)


def test_arrays_of_one_cell_are_joined() -> None:
    # A flat sheet of two triangles goes on in four directions.
    vertices = np.array([[0.0, 0.0, 0.0], [6.0, 0.0, 0.0], [6.0, 5.0, 0.0], [0.0, 5.0, 0.0]])
    faces = [[0, 1, 2], [0, 2, 3]]
    cell = [6.0, 5.0, 20.0]
    expected = 30.0 * 9.0 / (np.sqrt(3.0) / 4.0 * 3.0 * 1.42**2)
    assert trivalent.plan((vertices, faces, cell), scale=3.0)["atoms"] == pytest.approx(expected, rel=1e-6)
    with pytest.raises(trivalent.InvalidMesh, match="no partner"):
        trivalent.plan((vertices, faces, [7.0, 5.0, 20.0]), scale=3.0)


def test_walls_are_one_shell() -> None:
    shell = trivalent.build("sphere", walls=3, atoms=900, effort="quick")
    assert shell.report["energy"]["potential"] == "airebo"
    assert shell.header["potential"] == "airebo"
    assert trivalent.check(shell)["potential"] == "airebo"
    assert trivalent.check(shell, potential="rebo")["potential"] == "rebo"
    walls = shell.columns["wall"]
    assert sorted(set(walls)) == [0, 1, 2]
    # No bond leads from one to another.
    assert (walls[shell.bonds[:, 0]] == walls[shell.bonds[:, 1]]).all()
    radii = [np.linalg.norm(shell.positions[walls == wall], axis=1).mean() for wall in range(3)]
    assert np.diff(radii) == pytest.approx([3.4, 3.4], abs=0.2)
    assert trivalent.plan("sphere", walls=3, atoms=900)["atoms"] == 900
    with pytest.raises(trivalent.Error, match="fit"):
        trivalent.build("sphere", walls=5, side="inwards", atoms=200, effort="quick")
    with pytest.raises(trivalent.Error):
        trivalent.build("sphere", walls=2, side="upwards", atoms=200)
    held = trivalent.build("sphere", follow=0.3, potential="airebo", relax=False, **quick)
    assert held.report["network"]["bond_length"]["mean"] == pytest.approx(1.397, abs=1e-9)
