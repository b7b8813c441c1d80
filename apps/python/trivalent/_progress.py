"""How far a long call has come: a bar in a terminal or a notebook, or a function of the caller's."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable as _Callable
    #: Called with the step's name, how many parts are done, of how many (None: unknown), and a line of text.
    #: If it returns False, the call ends and returns the best it has.
    _ProgressFunction = _Callable[[str, int, int | None, str], object]
    _Progress = bool | _ProgressFunction | None


def progress_function(progress: _Progress) -> _ProgressFunction | None:
    """The function that a `progress` argument stands for: None shows progress to people only."""
    if callable(progress):
        return progress
    if progress is False or (progress is None and not (_in_notebook() or sys.stderr.isatty())):
        return None
    return _bar() or _Line()


def _in_notebook() -> bool:
    shell = sys.modules.get("IPython")
    ipython = shell.get_ipython() if shell is not None else None
    return ipython is not None and ipython.__class__.__name__ == "ZMQInteractiveShell"


def _bar() -> _ProgressFunction | None:
    """tqdm's, if it is there."""
    try:
        if _in_notebook():
            import ipywidgets  # noqa: F401
            from tqdm.notebook import tqdm
        else:
            from tqdm import tqdm
    except ImportError:
        return None
    return _Bar(tqdm)


class _Bar:
    def __init__(self, tqdm: Any) -> None:
        self._tqdm = tqdm
        self._bar: Any = None
        self._step = ""

    def __call__(self, step: str, done: int, total: int | None, text: str) -> None:
        if step != self._step:
            self.close()
            self._step, self._bar = step, self._tqdm(desc=step, leave=True)
        self._bar.total = total
        self._bar.set_postfix_str(text, refresh=False)
        self._bar.n = done
        self._bar.refresh()

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()
        self._bar = None

    def __del__(self) -> None:
        self.close()


class _Line:
    """A line that replaces itself."""

    def __init__(self) -> None:
        self._is_open = False

    def __call__(self, step: str, done: int, total: int | None, text: str) -> None:
        of = "" if total is None else f"/{total}"
        print(f"\r\x1b[K{step} {done}{of}: {text}", end="", file=sys.stderr, flush=True)
        self._is_open = True

    def __del__(self) -> None:
        if self._is_open:
            print(file=sys.stderr)
