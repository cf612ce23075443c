#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Derivatives of paths in PyTorch: a receiver finds its place, and the permittivity of concrete, from the delays and
coefficients of its paths. The "measured" paths are computed here, at a place and with a concrete that the search does
not know. The concrete is so thick that no wave returns from behind it: a thin slab reflects alike with several
permittivities.

    python3 docs/examples/gradient_torch.py
"""
import torch
import wavetracer as wt

SPEED_OF_LIGHT_M_S = 299792458.0


def paths_at(position_m, permittivity):
    """The paths to a receiver in a street whose concrete has this permittivity, and the surfaces that each one meets."""
    street = {
        "scene": {"generate": "--seed 1 --blocks 2"},
        "transmitter": [{"name": "mast", "position_m": [0, 0, 6]}],
        "receiver": [{"name": "phone", "position_m": [float(x) for x in position_m]}],
        "material": [{"name": "concrete", "permittivity": float(permittivity), "conductivity_s_m": 0.1, "thickness_m": 5.0}],
        "trace": {"rays": 3000, "max_depth": 2},
    }
    with wt.Simulation(street) as simulation:
        paths = simulation.run_frame().paths
        derivatives = paths.gradient(["rx.position", "concrete.permittivity"])
    ends = paths.vertex_offset.astype(int)
    return paths, derivatives, [tuple(paths.vertex_surface[a:b]) for a, b in zip(ends, ends[1:])]


class Channel(torch.autograd.Function):
    """Coefficients and delays (s) of paths as functions of the receiver's position (m) and a permittivity."""

    @staticmethod
    def forward(ctx, position_m, permittivity):
        paths, ctx.derivatives, Channel.surfaces = paths_at(position_m, permittivity)
        return torch.tensor(paths.a[:, 0, 0]), torch.tensor(paths.delay_s)

    @staticmethod
    def backward(ctx, by_a, by_delay):
        place, concrete = (ctx.derivatives[name] for name in ("rx.position", "concrete.permittivity"))
        by_position = (by_a.conj()[:, None] * torch.tensor(place.a[:, 0, 0])).real.sum(0)
        by_position += (by_delay[:, None] * torch.tensor(place.delay_s)).sum(0)
        return by_position, (by_a.conj() * torch.tensor(concrete.a[:, 0, 0])).real.sum()


def main():
    truth_m, concrete = (30.0, 1.0, 2.0), 6.2
    measured, _, surfaces = paths_at(truth_m, concrete)
    known = {key: (measured.a[i, 0, 0], measured.delay_s[i]) for i, key in enumerate(surfaces)}

    position = torch.tensor([28.5, 0.2, 2.6], dtype=torch.float64, requires_grad=True)
    permittivity = torch.tensor(4.5, dtype=torch.float64, requires_grad=True)
    search = torch.optim.LBFGS([position, permittivity], lr=1, max_iter=30, line_search_fn="strong_wolfe",
                               tolerance_grad=1e-12, tolerance_change=1e-14)

    def misfit():
        search.zero_grad()
        a, delay_s = Channel.apply(position, permittivity)
        rows = [i for i, key in enumerate(Channel.surfaces) if key in known]
        a_known, delay_known = (torch.tensor(column) for column in zip(*(known[Channel.surfaces[i]] for i in rows)))
        out = ((SPEED_OF_LIGHT_M_S * (delay_s[rows] - delay_known)) ** 2).sum()
        out = out + ((a[rows] - a_known).abs() ** 2).sum() / (a_known.abs() ** 2).max()
        out.backward()
        return out

    search.step(misfit)
    error_m = (position.detach() - torch.tensor(truth_m)).norm().item()
    print(f"place {position.tolist()} m, {error_m:.1e} m off; permittivity {permittivity.item():.6f} instead of {concrete}")
    if error_m > 1e-4 or abs(permittivity.item() - concrete) > 1e-3:
        raise SystemExit("the search has not found the truth")


if __name__ == "__main__":
    main()
