"""Every public function says what it does and in which units; defaults are those of the program."""

import inspect
import re
from typing import Any, Callable

import pytest

import trivalent
import trivalent.ase

functions = [getattr(trivalent, name) for name in trivalent.__all__ if inspect.isfunction(getattr(trivalent, name))]
classes = [trivalent.Shell, trivalent.Surface, trivalent.Page, trivalent.Picture]
calculators = [getattr(trivalent.ase, name) for name in trivalent.ase.__all__]

# Of numbers without a unit: counts, names, pictures.
no_unit = {"bonds", "bond_images", "rings", "numbers", "species", "pbc", "notes", "faces", "pixels"}
unit = re.compile(r"\[(Å|eV|degree|pixel|byte|s)|eV/Å|in units? of|in the unit|unit of")


def public_members(cls: type) -> list[tuple[str, Any]]:
    return [(name, member) for name, member in vars(cls).items() if not name.startswith("_")]


@pytest.mark.parametrize("function", functions, ids=lambda f: f.__name__)
def test_functions_say_what_they_do_and_in_which_units(function: Callable[..., Any]) -> None:
    text = inspect.getdoc(function)
    assert text is not None and unit.search(text), text
    options = [name for name in inspect.signature(function).parameters if name not in ("surface", "shell", "shells")]
    explained = text.replace("lj_...", "lj_epsilon lj_sigma lj_cutoff lj_shift")
    others = "The other arguments" in text or "Arguments are those" in text or "arguments are those" in text
    for name in options:
        assert others or re.search(rf"\b{name}\b", explained), name


@pytest.mark.parametrize("cls", [*classes, *calculators], ids=lambda c: c.__name__)
def test_classes_say_what_they_are(cls: type) -> None:
    assert cls.__doc__
    for name, member in public_members(cls):
        if isinstance(member, (property, classmethod)) or inspect.isfunction(member):
            text = inspect.getdoc(member)
            assert text, name
            if isinstance(member, property) and name not in no_unit:
                assert unit.search(text), f"{cls.__name__}.{name}: {text}"


def test_every_public_name_is_documented() -> None:
    assert trivalent.__doc__ and trivalent.ase.__doc__
    for name in trivalent.__all__:
        assert name in ("__version__", "graphene_energy") or getattr(trivalent, name).__doc__


def test_defaults_are_those_of_the_program(program: Callable[..., str]) -> None:
    for command, function in (("build", trivalent.build), ("relax", trivalent.relax), ("render", trivalent.render)):
        shown = dict(re.findall(r"--([a-z-]+) arg \(=([^)]*)\)", program(command, "--help")))
        for name, parameter in inspect.signature(function).parameters.items():
            default = parameter.default
            option = name.replace("_", "-")
            if isinstance(default, (str, float)) and not isinstance(default, bool) and option in shown:
                assert shown[option] == (default if isinstance(default, str) else f"{default:g}"), name


def test_lennard_jones_has_the_defaults_of_the_program(program: Callable[..., str]) -> None:
    shown = dict(re.findall(r"--lj-([a-z]+) arg \(=([^)]*)\)", program("energy", "--help")))
    parameters = inspect.signature(trivalent.ase.LennardJones.__init__).parameters
    for name in ("epsilon", "sigma", "cutoff"):
        assert float(shown[name]) == parameters[name].default
