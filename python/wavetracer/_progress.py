# SPDX-License-Identifier: Apache-2.0
"""Progress of frames through tqdm's interface, and Ctrl-C while the library computes."""
from __future__ import annotations

import importlib
import importlib.util
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Union

from .errors import ArgumentError, ConfigError

# None: a bar if the output is interactive and tqdm is installed; or a class with tqdm's interface.
Wanted = Union[bool, None, Callable[..., Any]]


def _in_notebook() -> bool:
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    return shell is not None and "IPKernelApp" in getattr(shell, "config", {})


def _has_widgets() -> bool:
    return importlib.util.find_spec("ipywidgets") is not None


def bar(wanted: Wanted, total: int) -> Any | None:
    """An object of tqdm's interface that counts frames; None if no bar is wanted."""
    if wanted is not None and not callable(wanted) and not isinstance(wanted, bool):
        raise ArgumentError(f"progress is True, False, None or a class with tqdm's interface, not {wanted!r}")
    make: Any = wanted if callable(wanted) else None
    if make is None and (wanted or (wanted is None and (_in_notebook() or sys.stderr.isatty()))):
        try:
            make = importlib.import_module("tqdm.notebook" if _in_notebook() and _has_widgets() else "tqdm").tqdm
        except ImportError:
            if wanted:
                raise ConfigError("progress = True needs the package tqdm: pip install tqdm") from None
    return make(total=total, unit="frame", miniters=0) if make else None


def watcher(progress: Any | None, stopped: Callable[[], bool]) -> Callable[[str, int, int], bool]:
    """The function that the library calls between its steps: it updates the bar and returns whether to go on."""
    def watch(stage: str, done: int, total: int) -> bool:
        if progress is not None:
            progress.set_postfix_str(f"{stage} {done / max(total, 1):.0%}", refresh=False)
            progress.update(0)
        return not stopped()
    return watch


@contextmanager
def interruptible() -> Iterator[Callable[[], bool]]:
    """Ctrl-C is noted, and raised as KeyboardInterrupt at the end of the block, which asks whether it was noted.

    Python would raise it in the middle of the library's call, where it cannot. A handler that somebody else has set
    stays as it is, and threads other than the first receive no signals."""
    noted: list[bool] = []
    ours = (threading.current_thread() is threading.main_thread()
            and signal.getsignal(signal.SIGINT) is signal.default_int_handler)
    if ours:
        signal.signal(signal.SIGINT, lambda *_: noted.append(True))
    try:
        yield lambda: bool(noted)
    finally:
        if ours:
            signal.signal(signal.SIGINT, signal.default_int_handler)
        if noted:
            raise KeyboardInterrupt
