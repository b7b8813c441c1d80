"""Arrays pass without copies where they can; whatever else comes in raises or is taken correctly."""

import gc
import random
from typing import Any

import numpy as np
import pytest

import trivalent
from trivalent import _core


def address(array: np.ndarray) -> int:
    return int(array.__array_interface__["data"][0])


def test_arrays_are_views_that_outlive_the_shell() -> None:
    shell = trivalent.energy(trivalent.dual(trivalent.shape("torus", 0.5)))
    for take in (
        lambda: shell.positions,
        lambda: shell.cell,
        lambda: shell.bonds,
        lambda: shell.energies,
        lambda: shell.forces,
        lambda: shell.columns["rings"],
    ):
        assert address(take()) == address(take()), "two views of the same memory"
        with pytest.raises(ValueError, match="read-only"):
            take()[0] = 0
    positions = shell.positions
    before = positions.copy()
    del shell
    gc.collect()
    assert np.array_equal(positions, before)


def test_any_layout_of_the_same_numbers_is_the_same() -> None:
    shell = trivalent.dual(trivalent.shape("torus", 0.5))
    positions = np.array(shell.positions)
    expected = trivalent.energy(trivalent.Shell(positions)).energy
    shifted = np.frombuffer(b"\0" + positions.tobytes(), dtype=np.uint8)[1:].view(np.float64).reshape(-1, 3)
    assert not shifted.flags.aligned
    read_only = positions.copy()
    read_only.flags.writeable = False
    for same in (
        np.asfortranarray(positions),
        np.repeat(positions, 2, axis=0)[::2],
        positions[::-1][::-1],
        positions.astype(">f8"),
        positions.astype(np.longdouble),
        positions.tolist(),
        shifted,
        read_only,
    ):
        assert trivalent.energy(trivalent.Shell(same)).energy == expected


bad_positions = [
    np.zeros((4, 2)),
    np.zeros((3,)),
    np.zeros((2, 3, 1)),
    np.zeros((2, 3), dtype=complex),
    np.zeros((2, 3), dtype=bool),
    np.zeros((2, 3), dtype=object),
    np.zeros((2, 3), dtype="U3"),
    np.zeros((2, 3), dtype="M8[s]"),
    np.full((2, 3), np.nan),
    np.array([[0, 0, np.inf]]),
    [[0, 0], [0]],
    "text",
    None,
    1.0,
    {},
    np.lib.stride_tricks.as_strided(np.zeros(3), shape=(10**13, 3), strides=(0, 8)),
]


@pytest.mark.parametrize("positions", bad_positions, ids=range(len(bad_positions)))
def test_bad_positions_are_refused(positions: Any) -> None:
    with pytest.raises((trivalent.Error, MemoryError)):
        trivalent.Shell(positions)


def test_bad_companions_are_refused() -> None:
    positions = np.eye(3)
    for arguments in (
        {"species": ["C", "O", "C"]},
        {"species": [6, 6]},
        {"species": [6, 6, 7]},
        {"species": [[6, 6, 6]]},
        {"species": np.array([6, 6, 2**64 - 1], dtype=np.uint64)},
        {"cell": np.eye(2)},
        {"cell": np.full((3, 3), np.nan)},
        {"pbc": True},
        {"pbc": [True, False]},
        {"bonds": [[0, 3]]},
        {"bonds": [[-1, 0]]},
        {"bonds": [[0, 1, 2]]},
        {"bonds": [[0.0, 1.0]]},
    ):
        with pytest.raises(trivalent.Error):
            trivalent.Shell(positions, **arguments)  # type: ignore[arg-type]


def test_bad_faces_are_refused() -> None:
    vertices = np.eye(3)
    for faces in (
        [[0, 1, 3]],
        [[0, 1, -1]],
        [[0.0, 1.0, 2.0]],
        [[0, 1]],
        [3, 0, 1],
        [3, 0, 1, 2, 1],
        np.array([[0, 1, 2**40]]),
        np.zeros((0, 3), dtype=int),
        [],
        "text",
    ):
        with pytest.raises(trivalent.Error):
            trivalent.repair((vertices, faces))


class Fuzzer:
    """Arrays of random types, shapes, strides and values."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)

    def shape(self, columns: int) -> tuple[int, ...]:
        n = self.random.choice([0, 1, 2, 3, 7, 20])
        return self.random.choice([(n, columns)] * 6 + [(n,), (), (n, columns + 1), (n, 0), (1, n, columns), (columns, n)])

    def array(self, columns: int, kinds: str, low: int, high: int) -> Any:
        shape = self.shape(columns)
        kind = self.random.choice([*kinds] * 6 + ["f2", "c16", "O", "U4", "?", "M8[s]", "V3", "i1", "u8", ">f8", ">i4"])
        values = np.array([self.random.uniform(low, high) for _ in range(int(np.prod(shape)))]).reshape(shape)
        if values.size and self.random.random() < 0.15:
            values.flat[0] = self.random.choice([np.nan, np.inf, 1e300, -1e300, 1e-300, -1, 2**31, 2**62])
        with np.errstate(all="ignore"):
            try:
                array = values.astype(kind)
            except (TypeError, ValueError):
                array = values
        return self.bend(array)

    def bend(self, array: np.ndarray) -> Any:
        way = self.random.randrange(8)
        if way == 0:
            return array.tolist()
        if way == 1:
            return np.asfortranarray(array)
        if way == 2 and array.ndim:
            return np.repeat(array, 2, axis=0)[::2]
        if way == 3 and array.ndim:
            return array[::-1]
        if way == 4 and array.ndim == 2 and len(array):
            return np.broadcast_to(array[:1], (5, array.shape[1]))
        if way == 5:
            array = array.copy()
            array.flags.writeable = False
        if way == 6 and self.random.random() < 0.2 and array.ndim and array.itemsize:
            return np.lib.stride_tricks.as_strided(array[:0], shape=(10**14, *array.shape[1:]), strides=(0,) * array.ndim)
        return array


def attempt(call: Any) -> bool:
    """Whether it has an answer; what it raises must be of the kinds that are told."""
    try:
        call()
    except (trivalent.Error, MemoryError):
        return False
    return True


def fuzz(rounds: int, seed: int) -> int:
    """Throws random arrays at all doors; returns how many were answered."""
    fuzzer = Fuzzer(seed)
    rebo = _core.Calculator("rebo")
    answers = 0
    for _ in range(rounds):
        positions = fuzzer.array(3, "fi", -4, 4)
        numbers = fuzzer.array(1, "iu", 1, 7)
        cell = fuzzer.random.choice([None, np.eye(3) * 9, fuzzer.array(3, "f", -9, 9)])
        bonds = fuzzer.random.choice([None, fuzzer.array(2, "iu", 0, 5)])
        species = fuzzer.random.choice([None, numbers])
        faces = fuzzer.array(3, "iu", 0, 20)
        answers += attempt(lambda: trivalent.energy(trivalent.Shell(positions, species, cell=cell, bonds=bonds)))
        answers += attempt(lambda: rebo.evaluate(positions, numbers, cell, [False] * 3))
        answers += attempt(lambda: trivalent.repair((positions, faces)))
    return answers


def test_no_array_crashes() -> None:
    assert fuzz(300, seed=1) > 0
