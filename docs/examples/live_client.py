#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A client of `wavetracer serve` in Python: two cars meet at a crossing, and their channel is printed frame by frame.

    wavetracer serve -c configs/live.toml &
    python3 docs/examples/live_client.py [--server tcp:127.0.0.1:7710] [--frames N]

wavetracer.live does the work (in the source tree: PYTHONPATH=python); docs/live.md has every field. It needs NumPy.
"""
import argparse
import sys

import numpy as np

from wavetracer import live


def print_links(channels, most=5):
    """The strongest links of an instant, one per line."""
    links = channels.links
    heard = int(np.count_nonzero(links["paths"]))
    print(f"{channels.time_s:.3f} s: {heard} of {len(channels)} links have paths, "
          f"solved in {1e3 * channels.answer['seconds']['solve']:.1f} ms")
    gains_db = np.where(links["paths"] > 0, links["path_gain_db"], -np.inf)
    for row in np.argsort(-gains_db, kind="stable")[:min(most, heard)]:
        print(f"  {' -> '.join(channels.names(row))}: {links['path_gain_db'][row]:.2f} dB "
              f"(narrowband {links['narrowband_gain_db'][row]:.2f} dB), {links['paths'][row]} paths, "
              f"delay spread {1e9 * links['rms_delay_spread_s'][row]:.1f} ns, LOS {'yes' if links['los'][row] else 'no'}")


def main():
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    live.add_arguments(parser, detail="paths")
    parser.add_argument("--frames", type=int, default=20)
    options = parser.parse_args()
    step_s, speed_m_s = 0.1, 14.0
    with live.connect(options) as client:
        print(f"{client.world['server']} on {client.world['device']}")
        for k in range(options.frames):
            way_m = speed_m_s * k * step_s
            print_links(client.channels(k * step_s, [
                {"id": "eastwards", "type": "passenger", "position_m": [-60 + way_m, -3, 0], "yaw_deg": 0},
                {"id": "northwards", "type": "passenger", "position_m": [3, -60 + way_m, 0], "yaw_deg": 90}]), 3)


if __name__ == "__main__":
    try:
        main()
    except live.Error as error:
        sys.exit(f"live_client: {error}")
