# SPDX-License-Identifier: Apache-2.0
"""A client of `wavetracer serve`: poses of vehicles in, channels out as columns of NumPy.

    from wavetracer.live import LiveClient

    with LiveClient("tcp:127.0.0.1:7710", detail="paths") as client:
        channels = client.channels(0.0, [{"id": "ego", "type": "passenger", "position_m": [3, -60, 0], "yaw_deg": 90}])
        print(channels.links["path_gain_db"], channels.paths["delay_s"])

docs/live.md has the protocol, and says what a vehicle is made of.
"""
from __future__ import annotations

import argparse
import json
import pathlib
import time
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from ._live_columns import Channels, columns_of, read_cbor
from ._live_socket import Line, LiveError, Lost
from ._radar_row import Radar
from .errors import ConfigError, Error, InputError

__all__ = ["Channels", "Error", "LiveClient", "LiveError", "Radar", "add_arguments", "connect", "read_token"]

Message = dict[str, Any]
DEFAULT_SERVER = "tcp:127.0.0.1:7710"
_FIRST_PAUSE_S, _LONGEST_PAUSE_S = 0.1, 2.0


class LiveClient:
    """A connection to a server. `world` is the server's answer to hello: vehicle types, antennas, limits.

    server: tcp:ADDRESS:PORT or unix:PATH. token: the secret, if the server asks for one. encoding: "cbor" (columns, the
    fast one) or "json". detail: "links", "paths" or "vertices". radar: "none", "detections" or "cubes", what answers say of
    the [[radar]] tables of the server's configuration. timeout_s: the longest wait for one answer, and for a
    connection. retries: how often it connects again after a connection was lost, with pauses that grow from 0.1 s to 2 s.

    After a lost connection it says hello again, sends the last frame of poses, since the server has forgotten it, and
    asks again what was not answered. The first connection is tried once. If the server does not answer in time, the
    client closes the connection and raises LiveError, so a late answer is never taken for that of a later question; the
    next call connects again. A client is for one thread.
    """

    def __init__(self, server: str = DEFAULT_SERVER, *, token: str | None = None, encoding: str = "cbor",
                 detail: str = "links", radar: str = "none", timeout_s: float = 30.0, retries: int = 5):
        if not timeout_s > 0 or retries < 0:
            raise ConfigError(f"timeout_s is more than 0 and retries is 0 or more, not {timeout_s} and {retries}")
        self._server, self._timeout_s, self._retries = server, timeout_s, retries
        self._hello: Message = {"message": "hello", "protocol": 1, "encoding": encoding, "detail": detail}
        if radar != "none":
            self._hello["radar"] = radar
        if token:
            self._hello["token"] = token
        self._number = 0
        self._frames: list[Message] = []  # the last two frames of poses: a server that starts again needs them
        self._line: Line | None = None
        self.world: dict[str, Any] = {}
        self.connections = 0
        self._connect()

    def channels(self, time_s: float, vehicles: Iterable[Message], **more: Any) -> Channels:
        """The channels of these poses: dicts with `id`, `type`, `position_m`, `yaw_deg` or `orientation`, and perhaps
        velocities. more: other keys of a frame, `cold`, `detail` and `radar`."""
        message = {"message": "frame", "time_s": time_s, "vehicles": list(vehicles), **more}
        answer = self._ask([message])[0]
        self._frames = [*self._frames[-1:], message]
        return answer

    def at(self, time_s: float, **more: Any) -> Channels:
        """The channels at a time between the last two frames of poses."""
        return self.at_each([time_s], **more)[0]

    def at_each(self, times_s: Sequence[float], **more: Any) -> list[Channels]:
        """The channels at many times between the last two frames of poses. The questions are sent together, as many as
        the server lets wait, so that none waits for the way of an answer."""
        return self._ask([{"message": "at", "time_s": float(time_s), **more} for time_s in times_s])

    def close(self) -> None:
        """Closes the connection; the next question would open it again."""
        if self._line:
            self._line.close()
        self._line = None

    def __enter__(self) -> LiveClient:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _ask(self, messages: list[Message]) -> list[Channels]:
        """The answers to these messages, in their order. Answers that came before a connection was lost are kept."""
        answers: list[Channels] = []
        self._connected(lambda: self._exchange(messages, answers))
        return answers

    def _connected(self, work: Callable[[], None]) -> None:
        """Does the work on a connection, and again on a new one as long as connections are lost."""
        lost = ""
        for attempt in range(self._retries + 1):
            if attempt:
                time.sleep(min(_FIRST_PAUSE_S * 2 ** (attempt - 1), _LONGEST_PAUSE_S))
            try:
                if not self._line:
                    self._connect()
                    self._replay()
                return work()
            except Lost as error:
                lost = str(error)
            except LiveError as error:
                if error.reason != "no_server":
                    raise
                lost = str(error)
            self.close()
        raise LiveError("lost", f"the connection to the server at {self._server} was lost, and {self._retries} tries to "
                        f"connect again have failed; the last one: {lost}")

    def _connect(self) -> None:
        self._line = Line(self._server, self._timeout_s)
        try:
            self._line.send(_bytes(self._hello))
            self.world = self._read(self._line, "world")
        except Lost as error:
            self.close()
            raise LiveError("no_server", f"what listens at {self._server} has closed the connection before it answered "
                            f"hello ({error}): it is no server, or it stops") from None
        except _Refused as refusal:
            self.close()
            raise refusal.error from None
        except BaseException:
            self.close()
            raise
        self.connections += 1

    def _replay(self) -> None:
        """Sends the last frames of poses, as a server needs them that has just heard hello."""
        if self._frames:
            self._exchange(self._frames, [])

    def _exchange(self, messages: list[Message], answers: list[Channels]) -> None:
        """Appends the answers to the messages that have none yet. Closes the connection where an answer may still come
        that nobody waits for."""
        assert self._line
        line, numbers = self._line, range(self._number + 1, self._number + 1 + len(messages) - len(answers))
        first, window = len(answers), max(1, int(self.world["limits"]["max_pending_frames"]))
        self._number += len(numbers)
        sent = 0
        try:
            for place, number in enumerate(numbers):
                while sent < min(place + window, len(numbers)):
                    line.begin()
                    line.send(_bytes({**messages[first + sent], "frame": numbers[sent]}))
                    sent += 1
                line.begin()
                answers.append(self._channels(line, number))
        except _Refused as refusal:
            if refusal.fatal or len(answers) - first + 1 < sent:
                self.close()
            raise refusal.error from None
        except BaseException:
            self.close()
            raise

    def _channels(self, line: Line, number: int) -> Channels:
        answer = self._read(line, "channels", number)
        data = line.bytes(answer["bytes"]) if "bytes" in answer else None
        try:
            return Channels(answer, columns_of(answer) if data is None else read_cbor(data))
        except (ValueError, KeyError, TypeError) as error:
            raise LiveError("unreadable", f"the server at {self._server} has sent channels that cannot be read ({error}): "
                            "client and server must have the same version") from None

    def _read(self, line: Line, wanted: str, number: int | None = None) -> Message:
        """The next message, which must be the one that is wanted, with the number of the question."""
        text = line.line()
        try:
            answer: Message = json.loads(text)
            kind, its_number = answer["message"], answer.get("frame")
        except (ValueError, KeyError, TypeError, AttributeError):
            raise LiveError("unreadable", f"what listens at {self._server} does not speak the protocol of `wavetracer "
                            f"serve`; it said {text[:60]!r}") from None
        if kind == "bye" or kind == "error" and answer["fatal"] and answer["code"] == "timeout":
            raise Lost(answer["text"])
        if kind == "error" and its_number in (None, number):
            raise _Refused(answer)
        if kind != wanted or its_number != number:
            raise LiveError("stale", f"the server at {self._server} has sent {kind} {its_number}, but the client has asked "
                            f"for {wanted} {number}: the answer is dropped, and the connection is closed")
        return answer


class _Refused(Exception):
    """An error message of the server."""

    def __init__(self, answer: Message):
        self.fatal = bool(answer["fatal"])
        self.error = LiveError(answer["code"], f"{answer['code']}: {answer['text']}")


def _bytes(message: Message) -> bytes:
    return json.dumps(message, separators=(",", ":")).encode() + b"\n"


def read_token(path: str | None) -> str | None:
    """The secret in a file, as `wavetracer serve --token-file` takes it; None without a file."""
    try:
        return pathlib.Path(path).read_text("ascii").strip() if path else None
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"the token file {path} cannot be read: {error}") from None


def add_arguments(parser: argparse.ArgumentParser, *, encoding: str = "cbor", detail: str = "links") -> None:
    """Adds the arguments of a client, which connect() takes. encoding, detail: their defaults."""
    parser.add_argument("--server", default=DEFAULT_SERVER, help="tcp:ADDRESS:PORT or unix:PATH (default: %(default)s)")
    parser.add_argument("--token-file", help="file with the server's secret")
    parser.add_argument("--detail", choices=["links", "paths", "vertices"], default=detail,
                        help="how much the answers contain (default: %(default)s)")
    parser.add_argument("--encoding", choices=["json", "cbor"], default=encoding,
                        help="form of the channels (default: %(default)s)")
    parser.add_argument("--timeout", type=float, default=30.0, metavar="SECONDS",
                        help="longest wait for an answer (default: %(default)s)")
    parser.add_argument("--retries", type=int, default=5, metavar="N",
                        help="how often to connect again after a connection was lost (default: %(default)s)")


def connect(options: argparse.Namespace) -> LiveClient:
    """A client as the arguments of add_arguments() say."""
    return LiveClient(options.server, token=read_token(options.token_file), encoding=options.encoding,
                      detail=options.detail, timeout_s=options.timeout, retries=options.retries)
