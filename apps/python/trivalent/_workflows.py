"""The workflows of the program, with its names and defaults. None means: the program's default."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Literal

from . import _core
from ._progress import progress_function
from ._shell import Shell, ShellLike, _pbc_of, shell_of
from ._surface import CellLike, Surface, SurfaceLike, cell_of, name_of, source_of

if TYPE_CHECKING:
    from collections.abc import Sequence as _Sequence
    from ._progress import _Progress
    from ._shell import _AtomStyle, _Digits, _Periodic

    _Method = Literal["crystal", "paper"]
    _Effort = Literal["quick", "normal", "thorough"]
    _Follow = Literal["close", "carbon", "free"]
    _Restriction = Literal["hard", "least-squares"]
    _Repair = Literal["none", "safe", "wrap"]
    _Holes = Literal["keep", "fill"]
    _Components = Literal["all", "largest"]
    _Cap = Literal["none", "hydrogen"]
    _Side = Literal["outwards", "inwards"]
    _Potential = Literal["rebo", "airebo", "lj"]
    _Engine = Literal["own", "lammps"]
    _OnInterrupt = Literal["raise", "keep"]


def build(
    surface: SurfaceLike,
    *,
    atoms: int | None = None,
    length: float | None = None,
    scale: float | None = None,
    bond: float | None = None,
    method: _Method = "crystal",
    effort: _Effort | None = None,
    follow: _Follow | float | None = None,
    seed: int | None = None,
    feature_angle: float | None = None,
    iterations: int | None = None,
    rings: int | None = None,
    sigma: float | None = None,
    restriction: _Restriction | None = None,
    repair: _Repair = "safe",
    holes: _Holes = "keep",
    components: _Components = "all",
    wrap_alpha: float | None = None,
    wrap_offset: float | None = None,
    cap: _Cap = "none",
    walls: int = 1,
    spacing: float = 3.4,
    side: _Side = "outwards",
    cell: CellLike | None = None,
    box: CellLike | None = None,
    level: float | None = None,
    pbc: _Periodic | None = None,
    raw: str | None = None,
    supercell: _Sequence[int] | None = None,
    potential: Literal["rebo", "airebo"] | None = None,
    relax: bool = True,
    fix_box: bool = False,
    progress: _Progress = None,
    on_interrupt: _OnInterrupt = "raise",
) -> Shell:
    """Turns a surface into a carbon shell with energies: the whole way.

    surface: a path of a mesh or a volume, a built-in shape ("torus:R=3,r=1"), a Surface, (vertices, faces), or an
        object with .vertices and .faces (trimesh) or .points and .faces or .cells (PyVista, meshio)
    atoms, length, scale: one of them: about so many atoms (10,000 if none is given); the longest side of the
        bounding box [Å]; or [Å per unit of the input]
    bond: mean bond length wanted [Å], 1.42, or 1.397 under AIREBO
    method: "crystal" (few defects, where curvature wants them) or "paper" (split, collapse, flip, relax, project)
    effort: crystal: how long to search, "quick", "normal" (default) or "thorough"
    follow: crystal: how strongly the net is held to the surface, "close", "carbon" (default) or "free", or a
        stiffness in eV/Å² for each ring
    seed: crystal: of the random moves, 0
    feature_angle: edges sharper than this [degree] are creases and stay; None: none are
    iterations, rings, sigma, restriction: paper: n (20), k (2), σ (0.2), "hard" (default) or "least-squares"
    repair, holes, components, wrap_alpha, wrap_offset: as in `repair`
    cap: "hydrogen" puts H on the atoms at the edge of an open shell
    walls: so many shells around each other; atoms counts those of all, length and scale are of the given surface
    spacing, side: from wall to wall [Å], and where further walls are: "outwards" of the given surface, or "inwards"
    cell: periodic cell of a formula, or of a mesh that shows one cell and is open where it goes on in the next, in
        the surface's unit: a, (a, b, c), (a, b, c, alpha, beta, gamma), three rows of vectors, or a text ("2*pi")
    box: in its place, the box around the origin that holds the closed surface of a formula
    level: value of the formula or volume on the surface, 0; it is lower inside, but for a volume that is not
        periodic
    pbc: axes along which a volume repeats, a bool or three of them; None: it does not
    raw: what a .raw volume holds: "nx,ny,nz,type", with the spacing of its points behind, as in "64,64,64,uint16,0.5"
    supercell: three numbers: so many cells along each cell vector
    fix_box: keep the cell of a periodic shell while its atoms relax
    potential: under which the atoms relax and have their energies; None: "rebo", of several walls "airebo"
    relax: bring the atoms to rest; False: they stay where the dual puts them
    progress: None shows a bar to people (terminal, notebook), False never, True always; or a function of
        (step, done, total or None, text), which ends the call by returning False
    on_interrupt: what Ctrl-C does: "raise" KeyboardInterrupt, or "keep": return the best so far, if there is a net
    """
    cell, box = cell_of(surface, cell), cell_of(None, box)
    pbc = None if pbc is None else _pbc_of(pbc, has_cell=False)
    options = _given(locals())
    watch = _core.Watch(progress_function(progress), on_interrupt)
    core, core_surface, found = _core.build(source_of(surface), options, watch)
    report = {
        "program": "trivalent",
        "version": _core.version,
        "input": name_of(surface),
        "options": {name.replace("_", "-"): value for name, value in options.items()},
        **found,
    }
    return Shell._of(core, report, found["notes"], Surface(core_surface))


def plan(
    surface: SurfaceLike,
    *,
    atoms: int | None = None,
    length: float | None = None,
    scale: float | None = None,
    bond: float | None = None,
    method: _Method = "crystal",
    effort: _Effort | None = None,
    repair: _Repair = "safe",
    holes: _Holes = "keep",
    components: _Components = "all",
    walls: int = 1,
    spacing: float = 3.4,
    side: _Side = "outwards",
    cell: CellLike | None = None,
    box: CellLike | None = None,
    level: float | None = None,
    pbc: _Periodic | None = None,
    raw: str | None = None,
    supercell: _Sequence[int] | None = None,
) -> dict[str, Any]:
    """What a build would come to, without building: atoms, scale [Å per unit], memory [byte], time [s], obstacles.

    Arguments are those of `build`.
    """
    cell, box = cell_of(surface, cell), cell_of(None, box)
    pbc = None if pbc is None else _pbc_of(pbc, has_cell=False)
    return _core.plan(source_of(surface), _given(locals()))


def shape(name: str, edge: float = 0.05) -> Surface:
    """A built-in shape.

    name: "sphere", "torus", ...; with parameters as in "torus:R=3,r=1"
    edge: edge length of the triangles, in units of the shape
    """
    return Surface(_core.shape(name, edge))


def repair(
    surface: SurfaceLike,
    *,
    repair: _Repair = "safe",
    holes: _Holes = "keep",
    components: _Components = "all",
    wrap_alpha: float | None = None,
    wrap_offset: float | None = None,
    atoms: int | None = None,
) -> Surface:
    """Turns triangles into an oriented 2-manifold; notes say what was changed.

    repair: "safe" does what leaves the shape as it is; "none" refuses what is not sound; "wrap" puts a new closed
        surface a small distance outside of everything, for scans, soups and points
    holes: "keep" leaves holes open, "fill" closes all of them
    components: "all", or only the "largest"
    wrap_alpha: size of the gaps that a wrap closes, in units of the input; 1/100 of its diagonal
    wrap_offset: distance of a wrap from the input, in its units; 1/30 of alpha, or an edge of the net where the wrap
        would be thinner than that
    atoms: of the shell to come, whose edges a wrap is to have room for; 10,000
    """
    return Surface(_core.repair(source_of(surface), _given(locals())))


def remesh(
    surface: SurfaceLike,
    edge: float,
    *,
    method: _Method = "crystal",
    effort: _Effort | None = None,
    follow: _Follow | float | None = None,
    seed: int | None = None,
    feature_angle: float | None = None,
    iterations: int | None = None,
    rings: int | None = None,
    sigma: float | None = None,
    restriction: _Restriction | None = None,
    repair: _Repair = "safe",
    holes: _Holes = "keep",
    components: _Components = "all",
    wrap_alpha: float | None = None,
    wrap_offset: float | None = None,
    progress: _Progress = None,
    on_interrupt: _OnInterrupt = "raise",
) -> Surface:
    """Remeshes a surface until all edges come close to one length; the report says how it came out.

    edge: the wanted edge length, in units of the surface

    The other arguments are those of `build`.
    """
    options = _given(locals())
    watch = _core.Watch(progress_function(progress), on_interrupt)
    core, report = _core.remesh(source_of(surface), edge, options, watch)
    return Surface(core, report)


def inspect(
    surface: SurfaceLike,
    *,
    atoms: int | None = None,
    length: float | None = None,
    scale: float | None = None,
    bond: float | None = None,
    repair: _Repair = "safe",
    holes: _Holes = "keep",
    components: _Components = "all",
    wrap_alpha: float | None = None,
    wrap_offset: float | None = None,
) -> dict[str, Any]:
    """All about a surface: what is wrong with it, what `build` would do, how regular it is.

    "verdict" is "sound", "mendable" or "hopeless". Lengths are in the unit of the input; arguments are those of
    `build`.
    """
    return _core.inspect(source_of(surface), _given(locals()))


def dual(
    surface: SurfaceLike, *, bond: float | None = None, length: float | None = None, scale: float | None = None
) -> Shell:
    """The dual of a triangle mesh as it is: an atom per triangle, a bond per edge.

    bond, length, scale: one of them: the mean bond length [Å] (1.42 if none is given), the longest side of the
        bounding box [Å], or [Å per unit of the mesh]
    """
    options = _given(locals())
    mesh = surface if isinstance(surface, Surface) else _repair(surface)
    return Shell._of(_core.dual(mesh._core, options))


def energy(
    shell: ShellLike,
    *,
    potential: _Potential = "rebo",
    lj_epsilon: float | None = None,
    lj_sigma: float | None = None,
    lj_cutoff: float | None = None,
    lj_shift: bool | None = None,
    engine: _Engine = "own",
    ranks: int | None = None,
    potential_file: str | os.PathLike[str] | None = None,
    worst: int = 5,
    periodic: _Periodic | None = None,
) -> Shell:
    """Evaluates atoms: the shell that comes back has energies [eV], forces [eV/Å], coordinations and rings.

    shell: a Shell, a path to a file of atoms or a mesh (whose dual is taken), a Surface, or ASE's Atoms
    potential: "rebo", "airebo" or "lj"
    lj_epsilon, lj_sigma, lj_cutoff, lj_shift: of "lj": depth of the well [eV], distance of zero energy [Å], range [Å],
        and whether energies are shifted to 0 at the cutoff
    engine: who computes, "own" or "lammps" (its program lmp)
    ranks, potential_file: of LAMMPS: MPI processes, and CH.rebo or CH.airebo where it does not find them itself
    worst: how many atoms of highest energy the report lists
    periodic: which cell vectors are periodic, instead of what the file says
    """
    options = _given(locals())
    given = _shell_argument(shell, periodic)
    core, report = _core.energy(given._core, options)
    return Shell._of(core, report, given.notes, given._surface)


def relax(
    shell: ShellLike,
    *,
    potential: _Potential = "rebo",
    max_force: float | None = None,
    energy_change: float | None = None,
    max_steps: int | None = None,
    minimizer: str | None = None,
    fix: _Sequence[str] | None = None,
    relax_box: bool = False,
    trajectory: str | os.PathLike[str] | None = None,
    every: int | None = None,
    lj_epsilon: float | None = None,
    lj_sigma: float | None = None,
    lj_cutoff: float | None = None,
    lj_shift: bool | None = None,
    engine: _Engine = "own",
    ranks: int | None = None,
    potential_file: str | os.PathLike[str] | None = None,
    periodic: _Periodic | None = None,
    progress: _Progress = None,
    on_interrupt: _OnInterrupt = "raise",
) -> Shell:
    """Brings atoms to rest: the shell that comes back has energies [eV], forces [eV/Å] and displacements [Å].

    max_force: done once no atom has a larger force [eV/Å], 0.001
    energy_change: or once ten steps together gain less than this [eV per atom]; 0: never
    max_steps: or after so many steps, 20,000
    minimizer: "lbfgs" (default) or "fire"; with LAMMPS one of its min_styles, "cg" (default)
    fix: groups of atoms that stay: "edge", "ids:1-9,12", "sphere:x,y,z,radius" or "box:x0,y0,z0,x1,y1,z1" [Å]
    relax_box: let the periodic cell vectors relax too, until no stress is left
    trajectory: file for the structures on the way, .extxyz; every: steps from one to the next, 10

    The other arguments are those of `energy` and `build`. Known bonds are kept; guessed ones may break and form.
    """
    options = _given(locals())
    given = _shell_argument(shell, periodic)
    watch = _core.Watch(progress_function(progress), on_interrupt)
    core, report, notes = _core.relax(given._core, options, watch)
    return Shell._of(core, report, [*given.notes, *notes], given._surface)


def check(
    shell: ShellLike,
    *,
    potential: _Potential | None = None,
    max_force: float | None = None,
    open: bool = False,
    surface: SurfaceLike | None = None,
    lammps: bool = False,
    ranks: int | None = None,
    potential_file: str | os.PathLike[str] | None = None,
    lj_epsilon: float | None = None,
    lj_sigma: float | None = None,
    lj_cutoff: float | None = None,
    lj_shift: bool | None = None,
    periodic: _Periodic | None = None,
) -> dict[str, Any]:
    """Certifies a shell: topology, bonds [Å], angles [degree], energies [eV], forces [eV/Å]. "sound" says it in a word.

    potential: None is what the shell's header names, else REBO
    max_force: atoms are at rest if none has a larger force [eV/Å], 0.01; inf: not looked at
    open: the shell has an edge: atoms with two bonds are meant
    surface: a surface in Å, from which the distances of the atoms are measured
    lammps: let LAMMPS compute energies and forces too, and compare them atom by atom

    The other arguments are those of `energy`.
    """
    options = _given(locals())
    given = _shell_argument(shell, periodic)
    mesh = None if surface is None else surface if isinstance(surface, Surface) else _repair(surface)
    return _core.check(given._core, None if mesh is None else mesh._core, options | {"notes": given.notes})


def lammps_package(
    shell: ShellLike,
    folder: str | os.PathLike[str],
    *,
    atom_style: _AtomStyle = "atomic",
    angles: bool = False,
    gzip: bool = False,
    digits: _Digits = "decimals",
    atoms_per_file: int | None = None,
    potential_file: str | os.PathLike[str] | None = None,
    periodic: _Periodic | None = None,
) -> list[str]:
    """Writes a folder with which LAMMPS can start: data [Å], and scripts that check, relax and run it.

    folder: made if it is missing
    atom_style: "atomic", or "molecular" with the bonds (found by distance if unknown), and with the angles if `angles`
    gzip: compress the data
    digits: "decimals" for ten decimals, "17" for 17 significant digits, which keep every bit
    atoms_per_file: write data of more atoms in parts
    potential_file: CH.rebo, if LAMMPS does not find it itself
    periodic: which cell vectors are periodic, instead of what the file says

    Returns the names of the files.
    """
    options = _given(locals())
    given = _shell_argument(shell, periodic)
    return _core.lammps_package(given._core, os.fspath(folder), options)


def read(
    path: str | os.PathLike[str],
    *,
    format: str | None = None,
    frame: int | None = None,
    elements: _Sequence[str] | None = None,
    atom_style: str | None = None,
    periodic: _Periodic | None = None,
    bond: float | None = None,
    length: float | None = None,
    scale: float | None = None,
) -> Shell:
    """Reads atoms [Å] from a file.

    path: extended XYZ, LAMMPS data, ..., or a mesh, whose dual is taken
    format: of the file, whatever its name
    frame: which of several structures, from 1; None: the last
    elements: symbols of LAMMPS's types 1, 2, ... where the file does not tell them
    atom_style: of LAMMPS data where it does not tell it: "atomic", "charge", "molecular", "full"
    periodic: which cell vectors are periodic, instead of what the file says
    bond, length, scale: size of the dual, as in `dual`
    """
    options = _given(locals())
    if periodic is not None:
        options["periodic"] = _pbc_of(periodic, True)
    return shell_of(path, options)


def _shell_argument(shell: ShellLike, periodic: _Periodic | None) -> Shell:
    if periodic is None:
        return shell_of(shell, {})
    return shell_of(shell, {"periodic": _pbc_of(periodic, True)})


#: Arguments that are not options of the library.
_others = {"surface", "shell", "shells", "names", "size", "progress", "on_interrupt", "edge", "folder", "path", "periodic"}


def _given(arguments: dict[str, Any]) -> dict[str, Any]:
    """The options among a function's arguments that are not None."""
    return {name: value for name, value in arguments.items() if name not in _others and value is not None}


_repair = repair  # where an argument hides the function
