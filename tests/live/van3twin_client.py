# SPDX-License-Identifier: Apache-2.0
"""A client that speaks as VaN3Twin's ns-3 modules do, to the byte: numbers have six digits after the point, one datagram
is sent at a time, and its answer, of at most 99 bytes, is waited for."""
import socket


class Van3twinClient:
    """server: udp:ADDRESS:PORT."""

    def __init__(self, server, timeout_s=30):
        host, port = server.removeprefix("udp:").rsplit(":", 1)
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.connect((host, int(port)))
        self.socket.settimeout(timeout_s)

    def send(self, text):
        self.socket.send(text if isinstance(text, bytes) else text.encode())

    def ask(self, text):
        self.send(text)
        return self.socket.recv(1000).decode()

    def move(self, name, x, y, z=0.0, bearing_deg=0.0, velocity=(0.0, 0.0, 0.0)):
        """Returns when the server has confirmed the place, as the client of VaN3Twin waits for it."""
        numbers = ",".join(f"{value:f}" for value in (x, y, z, bearing_deg, *velocity))
        self.send(f"LOC_UPDATE:{name},{numbers}")
        while self.socket.recv(1000).decode() != "LOC_CONFIRM:" + name:
            pass

    def figure(self, kind, a, b):
        """kind: PATHGAIN, DELAY or LOS. Returns the text after the colon."""
        answer = self.ask(f"CALC_REQUEST_{kind}:{a},{b}")
        begin = f"CALC_DONE_{kind}:"
        if not answer.startswith(begin) or len(answer) > 99:
            raise ValueError(f"answer {answer!r} to {kind} of {a} and {b}")
        return answer[len(begin):]

    def close(self):
        self.socket.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
