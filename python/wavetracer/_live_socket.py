# SPDX-License-Identifier: Apache-2.0
"""A socket to `wavetracer serve` on which every wait has an end."""
from __future__ import annotations

import socket
import time

from .errors import ConfigError, RunError

_PIECE = 1 << 20
_MOST_BYTES = 1 << 34  # the columns of one answer are smaller


class LiveError(RunError):
    """The server refused a message, or there is no answer. `reason` is the code of the server's message, such as
    "out_of_time" (docs/live.md lists them), or "no_server", "no_answer", "lost", "stale" or "unreadable"."""

    def __init__(self, reason: str, text: str):
        super().__init__(text)
        self.reason = reason


class Lost(Exception):
    """The connection has ended; the client may connect again."""


def how_to_start(server: str) -> str:
    return (f"start one with `wavetracer serve -c configs/live.toml --listen {server}`, or name the address of a server "
            "that runs")


class Line:
    """A connection: lines out, lines and bytes in. server: tcp:ADDRESS:PORT or unix:PATH. timeout_s: the longest wait for
    each answer. Raises LiveError if there is no server."""

    def __init__(self, server: str, timeout_s: float):
        self._server, self._timeout_s, self._in = server, timeout_s, bytearray()
        kind, _, rest = server.partition(":")
        host, _, port = rest.rpartition(":")
        if not rest or kind not in ("tcp", "unix") or kind == "tcp" and not (host and port.isdecimal()):
            raise ConfigError(f'the server "{server}" is neither tcp:ADDRESS:PORT nor unix:PATH')
        try:
            if kind == "unix":
                self._socket = socket.socket(socket.AF_UNIX)
                self._socket.settimeout(timeout_s)
                self._socket.connect(rest)
            else:
                self._socket = socket.create_connection((host.strip("[]"), int(port)), timeout_s)
                self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        except (OSError, OverflowError) as error:
            raise LiveError("no_server", f"no server answers at {server} ({error}): {how_to_start(server)}") from None
        self.begin()

    def begin(self) -> None:
        """The time for the next answer begins."""
        self._end = time.monotonic() + self._timeout_s

    def _wait(self) -> None:
        left_s = self._end - time.monotonic()
        if left_s <= 0:
            raise TimeoutError
        self._socket.settimeout(left_s)

    def send(self, data: bytes) -> None:
        try:
            self._wait()
            self._socket.sendall(data)
        except TimeoutError:
            raise self._no_answer() from None
        except OSError as error:
            raise Lost(str(error)) from None

    def _receive(self) -> None:
        try:
            self._wait()
            piece = self._socket.recv(_PIECE)
        except TimeoutError:
            raise self._no_answer() from None
        except OSError as error:
            raise Lost(str(error)) from None
        if not piece:
            raise Lost("the server has closed the connection")
        self._in += piece

    def line(self) -> bytes:
        """The next line, with its newline."""
        searched = 0
        while (end := self._in.find(b"\n", searched)) < 0:
            searched = len(self._in)
            self._receive()
        return self.bytes(end + 1)

    def bytes(self, count: int) -> bytes:
        if not 0 <= count <= _MOST_BYTES:
            raise Lost(f"an answer of {count} bytes")
        while len(self._in) < count:
            self._receive()
        out = bytes(memoryview(self._in)[:count])
        del self._in[:count]
        return out

    def close(self) -> None:
        self._socket.close()

    def _no_answer(self) -> LiveError:
        return LiveError("no_answer", f"the server at {self._server} has not answered within {self._timeout_s:g} s: allow "
                         "a longer time-out, make its frames faster (trace.max_depth, links.max_distance_m), or look at "
                         "what it has logged")
