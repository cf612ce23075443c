#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Derivatives of paths in JAX: the antenna of a mast is turned until four phones in a street receive most.

    python3 docs/examples/gradient_jax.py
"""
import jax
import jax.numpy as jnp
import numpy as np
import wavetracer as wt

jax.config.update("jax_enable_x64", True)


def paths_at(angles_rad):
    """The paths from a mast whose antenna has this yaw and pitch, and their derivatives by small turns of the antenna."""
    yaw_deg, pitch_deg = np.degrees(np.asarray(angles_rad, float))
    street = {
        "scene": {"generate": "--seed 1 --blocks 4x4"},
        "radio": {"frequency_hz": 28e9},
        "transmitter": [{"name": "mast", "position_m": [8, 8, 12], "antenna": "tr38901",
                         "orientation_deg": [yaw_deg, pitch_deg, 0]}],
        "receiver": [{"name": f"phone{i}", "position_m": [40 + 10 * i, 3, 1.5]} for i in range(4)],
        "trace": {"rays": 20_000, "max_depth": 2},
    }
    with wt.Simulation(street) as simulation:
        paths = simulation.run_frame().paths
        return paths, paths.gradient("tx.orientation")["tx.orientation"]


@jax.custom_vjp
def coefficients(angles_rad):
    """Coefficients of all paths, as a function of yaw and pitch."""
    return jnp.asarray(paths_at(angles_rad)[0].a[:, 0, 0])


def forward(angles_rad):
    """The coefficients, and their derivatives by yaw and pitch: yaw turns about z, and pitch about the antenna's y."""
    paths, turned = paths_at(angles_rad)
    yaw = float(angles_rad[0])
    axes = np.array([[0, 0, 1], [-np.sin(yaw), np.cos(yaw), 0]])
    return jnp.asarray(paths.a[:, 0, 0]), jnp.asarray(turned.a[:, 0, 0] @ axes.T)


def backward(by_angles, by_a):
    return (jnp.real(by_a @ by_angles),)


coefficients.defvjp(forward, backward)


def power_db(angles_rad):
    """Power that all phones receive together, dB of the power that is sent."""
    return 10 * jnp.log10(jnp.sum(jnp.abs(coefficients(angles_rad)) ** 2))


def main():
    start = jnp.array([0.9, 0.0])
    value_and_slope = jax.value_and_grad(power_db)
    step = 1e-4
    difference = [(power_db(start + step * axis) - power_db(start - step * axis)) / (2 * step) for axis in jnp.eye(2)]
    print("slopes, dB/rad:", value_and_slope(start)[1], "and by differences:", jnp.stack(difference))
    if not jnp.allclose(value_and_slope(start)[1], jnp.stack(difference), rtol=1e-5):
        raise SystemExit("the slopes differ")
    angles = start
    for _ in range(12):
        angles = angles + 0.01 * value_and_slope(angles)[1]
    value = power_db(angles)
    print(f"yaw {np.degrees(angles[0]):.1f} degrees, pitch {np.degrees(angles[1]):.1f} degrees: {value:.2f} dB instead of "
          f"{power_db(start):.2f} dB")
    if value < power_db(start) + 3:
        raise SystemExit("the antenna was not turned to the phones")


if __name__ == "__main__":
    main()
