# SPDX-License-Identifier: Apache-2.0
"""A simulation of the library while it is open; threads use it in turns."""
from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from ._library import library
from .errors import ConfigError, RunError


class Session:
    """The library's simulation. Threads take turns; processes that are forked from this one have none."""

    def __init__(self, handle: int):
        self._handle: int | None = handle
        self._process = os.getpid()
        self._turn = threading.RLock()
        self._used = False  # by the thread that has its turn

    @contextmanager
    def use(self, why: str) -> Iterator[int]:
        """Waits for the other threads and returns the handle. why: what needs it, for messages."""
        # This is checked before the lock is taken, since the lock may belong to a thread that was not forked with this
        # process.
        if os.getpid() != self._process:
            raise RunError(f"{why}: this process was forked from the one that has opened the simulation, and the threads "
                           "of OpenCL are not in it: start processes with multiprocessing.get_context(\"spawn\"), and "
                           "let each open its own simulation")
        with self._turn:
            if self._used:
                raise ConfigError(f"{why}: the simulation is solving a frame, and what watches its progress cannot use "
                                  "it; do it when the frame is there")
            if self._handle is None:
                raise ConfigError(f"{why}: the simulation was closed, and its device was given back")
            self._used = True
            try:
                yield self._handle
            finally:
                self._used = False

    def close(self) -> None:
        """Waits for the other threads, and gives the device back."""
        if os.getpid() != self._process:
            return  # it is the parent's
        with self._turn:
            if self._used:
                raise ConfigError("close: the simulation is solving a frame, and what watches its progress cannot end it")
            handle, self._handle = self._handle, None
            if handle is not None:
                library.wavetracer_close(handle)
