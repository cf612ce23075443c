#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A client of `wavetracer serve` in Python: two cars meet at a crossing, and their channel is printed frame by frame.

    wavetracer serve -c configs/live.toml &
    python3 docs/examples/live_client.py [tcp:127.0.0.1:7710 | unix:PATH] [--frames N] [--token-file FILE]

`Server` is all that a driving simulator needs: hello, then a frame of poses for a frame of channels; docs/live.md has
every field. It needs Python 3.9 and nothing else.
"""
import argparse
import json
import socket
import sys


class LiveError(Exception):
    """An error message of the server: .code, and its text."""

    def __init__(self, message):
        super().__init__(message["text"])
        self.code = message["code"]


def read_columns(data):
    """Decodes the data after an answer with encoding="cbor": a dict, whose columns are memoryviews of `data`, which
    numpy takes without a copy (numpy.asarray). It reads only the parts of CBOR that the server writes: maps, arrays,
    texts, and typed arrays of uint8, uint32 and float64."""
    view, place = memoryview(data), 0

    def head():
        nonlocal place
        first = view[place]
        size = 0 if first & 31 < 24 else 1 << (first & 31) - 24
        value = int.from_bytes(view[place + 1:place + 1 + size], "big") if size else first & 31
        place += 1 + size
        return first >> 5, value

    def item():
        nonlocal place
        kind, value = head()
        if kind == 4:
            return [item() for _ in range(value)]
        if kind == 5:
            return {item(): item() for _ in range(value)}
        form = 64
        if kind == 6:
            form = value
            kind, value = head()
        part = view[place:place + value]
        place += value
        if kind == 3:
            return str(part, "utf-8")
        return part.cast("I") if form == 70 else part.cast("d") if form == 86 else part

    return item()


def connect(name):
    """A socket to tcp:ADDRESS:PORT or unix:PATH."""
    kind, _, rest = name.partition(":")
    if kind == "unix":
        out = socket.socket(socket.AF_UNIX)
        out.connect(rest)
        return out
    host, port = rest.rsplit(":", 1)
    out = socket.create_connection((host.strip("[]"), int(port)))
    out.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return out


class Server:
    """A connection to a server at tcp:ADDRESS:PORT or unix:PATH; .world is its answer to hello."""

    def __init__(self, name="tcp:127.0.0.1:7710", token=None, **hello):
        try:
            self.socket = connect(name)
        except OSError as error:
            raise ConnectionError(f"no server answers at {name} ({error.strerror or error}); this starts one: wavetracer "
                                  f"serve -c configs/live.toml --listen {name}") from None
        self.lines = self.socket.makefile("rb")
        self.frames = 0
        if token:
            hello["token"] = token
        self.world = self.ask({"message": "hello", "protocol": 1, **hello})

    def ask(self, message):
        self.socket.sendall(json.dumps(message, separators=(",", ":")).encode() + b"\n")
        line = self.lines.readline()
        if not line:
            raise ConnectionError("the server has closed the connection")
        answer = json.loads(line)
        if answer["message"] == "error":
            raise LiveError(answer)
        if "bytes" in answer:
            answer.update(read_columns(self.lines.read(answer["bytes"])))
        return answer

    def channels(self, time_s, vehicles, **more):
        """The channels of these poses, a list of dicts with id, type, position_m and yaw_deg or orientation."""
        self.frames += 1
        return self.ask({"message": "frame", "frame": self.frames, "time_s": time_s, "vehicles": vehicles, **more})

    def at(self, time_s, **more):
        """The channels at a time between the last two frames of poses."""
        self.frames += 1
        return self.ask({"message": "at", "frame": self.frames, "time_s": time_s, **more})

    def close(self):
        self.lines.close()
        self.socket.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def read_token(path):
    if not path:
        return None
    with open(path, encoding="ascii") as file:
        return file.read().strip()


def links_of(answer):
    """The links of an answer in either encoding, each as a dict."""
    links = answer["links"]
    if isinstance(links, list):
        return links
    rows = [dict(zip(links, values)) for values in zip(*links.values())]
    return [{**row, "tx": answer["transmitters"][row["tx"]], "rx": answer["receivers"][row["rx"]]} for row in rows]


def print_links(answer, most=5):
    """The strongest links of a frame, one per line."""
    links = links_of(answer)
    heard = sorted((link for link in links if link["paths"]), key=lambda link: -(link["path_gain_db"] or -999))
    print(f"{answer['time_s']:.3f} s: {len(heard)} of {len(links)} links have paths, "
          f"solved in {1e3 * answer['seconds']['solve']:.1f} ms")
    for link in heard[:most]:
        print(f"  {link['tx']} -> {link['rx']}: {link['path_gain_db']:.2f} dB "
              f"(narrowband {link['narrowband_gain_db']:.2f} dB), {link['paths']} paths, "
              f"delay spread {1e9 * link['rms_delay_spread_s']:.1f} ns, LOS {'yes' if link['los'] else 'no'}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("server", nargs="?", default="tcp:127.0.0.1:7710")
    parser.add_argument("--frames", type=int, default=20)
    parser.add_argument("--token-file")
    options = parser.parse_args()
    step_s, speed_m_s = 0.1, 14.0
    with Server(options.server, read_token(options.token_file), detail="paths") as server:
        print(f"{server.world['server']} on {server.world['device']}")
        for k in range(options.frames):
            way_m = speed_m_s * k * step_s
            answer = server.channels(k * step_s, [
                {"id": "eastwards", "type": "passenger", "position_m": [-60 + way_m, -3, 0], "yaw_deg": 0},
                {"id": "northwards", "type": "passenger", "position_m": [3, -60 + way_m, 0], "yaw_deg": 90}])
            print_links(answer, 3)


if __name__ == "__main__":
    try:
        main()
    except ConnectionError as error:
        sys.exit(f"live_client: {error}")
