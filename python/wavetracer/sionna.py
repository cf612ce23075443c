# SPDX-License-Identifier: Apache-2.0
"""A sionna.rt.Scene as a configuration of wavetracer: geometry, materials, transmitters, receivers and antennas.

A scene of Sionna RT does not remember its file, and its objects may have been moved since; so the meshes are written as
they are now, in metres. Sionna RT is not imported: what it made is read.
"""
from __future__ import annotations

import os
import pathlib
import tempfile
import warnings
from collections.abc import Mapping
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np

from . import _toml
from .errors import ConfigError
from .simulation import Simulation

_PATTERNS = {"v_iso_pattern": "isotropic", "v_dipole_pattern": "short-dipole", "v_hw_dipole_pattern": "dipole",
             "v_tr38901_pattern": "tr38901"}
_POLARIZATIONS = {(0,): "V", (90,): "H", (0, 90): "VH", (-45, 45): "cross"}


def _numbers(value: Any) -> list[float]:
    """A number, point or array of Dr.Jit as a list of Python's numbers."""
    return [float(each) for each in np.ravel(np.asarray(value, float))]


def _warn(message: str) -> None:
    warnings.warn(message, stacklevel=4)


def _slants_deg(patterns: list[Any], directions: tuple[tuple[float, float], ...]) -> set[tuple[int, ...]]:
    """The angle by which each pattern's field is turned from theta to phi, in each of these directions (theta, phi)."""
    import mitsuba as mi

    out = set()
    for theta, phi in directions:
        fields = [pattern(mi.Float(theta), mi.Float(phi)) for pattern in patterns]
        out.add(tuple(round(np.degrees(np.arctan2(_numbers(h.real)[0], _numbers(v.real)[0]))) for v, h in fields))
    return out


def _antenna(array: Any, side: str) -> dict[str, Any]:
    """The keys `antenna`, `polarization` and `array` of an array whose pattern is one of Sionna RT's own."""
    if array is None:
        raise ConfigError(f"scene.{side}_array is not set: give the scene a sionna.rt.PlanarArray")
    named = {"array": side + "_array"} if array.array_size > 1 else {}
    pattern = array.antenna_pattern
    try:
        # The polarisation model "tr38901_1" turns by other angles in other directions; ours and "tr38901_2" do not.
        (slants,) = _slants_deg(pattern.patterns, ((1.5, 0.1), (1.0, 0.7)))
        return {"antenna": _PATTERNS[pattern.v_pattern.__name__], "polarization": _POLARIZATIONS[slants], **named}
    except (KeyError, ValueError, AttributeError):
        raise ConfigError(f"scene.{side}_array has a pattern or polarisation that is not one of Sionna RT's own (iso, "
                          "dipole, hw_dipole, tr38901; V, H, VH, cross): write it as a pattern file and name it with "
                          "the key antenna (docs/configuration.md)") from None


def _elements(scene: Any) -> list[dict[str, Any]]:
    """The tables [[array]] of arrays of several elements, which keep their places and their order."""
    wavelength_m = _numbers(scene.wavelength)[0]
    return [{"name": side + "_array", "positions_m": np.array(array.positions(wavelength_m)).T.astype(float).tolist()}
            for side, array in (("tx", scene.tx_array), ("rx", scene.rx_array)) if array.array_size > 1]


def _ends(devices: Mapping[str, Any], antenna: dict[str, Any]) -> list[dict[str, Any]]:
    return [{"name": name, "position_m": _numbers(device.position),
             "orientation_deg": np.degrees(_numbers(device.orientation)).tolist(),
             "velocity_m_s": _numbers(device.velocity), **antenna} for name, device in devices.items()]


def _material(name: str, material: Any) -> dict[str, Any]:
    """The values at the scene's frequency, whichever edition of ITU-R P.2040 they are from."""
    row: dict[str, Any] = {"name": name, "permittivity": _numbers(material.relative_permittivity)[0],
                           "conductivity_s_m": _numbers(material.conductivity)[0],
                           "thickness_m": _numbers(material.thickness)[0],
                           "scattering": _numbers(material.scattering_coefficient)[0]}
    if row["scattering"] > 0:
        row["scattering_cross_polar"] = _numbers(material.xpd_coefficient)[0]
        kind, pattern = type(material.scattering_pattern).__name__, material.scattering_pattern
        if kind == "DirectivePattern":
            row["scattering_lobe"] = int(_numbers(pattern.alpha_r)[0])
        elif kind != "LambertianPattern":
            _warn(f"material {name}: its scattering pattern {kind} is not known here, and is taken for Lambert's law")
    return row


def _write_scene(scene: Any, folder: pathlib.Path) -> dict[str, Any]:
    """Meshes and a Mitsuba file that names them; returns the materials that they use, by their names."""
    used: dict[str, Any] = {}
    shapes = ""
    for i, (name, thing) in enumerate(scene.objects.items()):
        material = thing.radio_material
        used[material.name] = material
        file = folder / f"mesh{i}.ply"
        thing.mi_mesh.write_ply(str(file))
        if any(_numbers(thing.velocity)):
            _warn(f"object {name} has a velocity, and stands still here: vehicles move by [[track]] or [trajectories]")
        shapes += (f'<shape type="ply" id={quoteattr("mesh-" + name)}><string name="filename" value="{file.name}"/>'
                   f'<ref id={quoteattr("mat-" + material.name)} name="bsdf"/></shape>\n')
    bsdfs = "".join(f'<bsdf type="diffuse" id={quoteattr("mat-" + name)}/>\n' for name in used)
    (folder / "scene.xml").write_text(f'<scene version="2.1.0">\n{bsdfs}{shapes}</scene>\n', encoding="utf-8")
    return used


def sionna_config(scene: Any, folder: str | os.PathLike[str]) -> dict[str, Any]:
    """Writes the scene's meshes into a folder, and returns the configuration of it as a dict, whose paths start there.

    Carried over: meshes as they are, materials with their values at the scene's frequency, transmitters and receivers
    with positions, orientations and velocities, the arrays' pattern, polarisation and elements.

    Depth, and which interactions are computed, are arguments of Sionna RT's solver and not part of its scene: set
    [trace] for them. Its synthetic arrays are radio.wavefront = "plane"; "spherical", the default here, computes the
    way between every two elements. The ports of polarisation "cross" are +45 and -45 degrees here, -45 and +45 there.
    """
    where = pathlib.Path(folder)
    where.mkdir(parents=True, exist_ok=True)
    for device, side in ((scene.transmitters, "transmitter"), (scene.receivers, "receiver")):
        if not device:
            raise ConfigError(f"the scene has no {side}: add one with scene.add(sionna.rt.{side.capitalize()}(...))")
    materials = _write_scene(scene, where)
    return {"scene": {"file": "scene.xml"}, "radio": {"frequency_hz": _numbers(scene.frequency)[0]},
            "material": [_material(name, material) for name, material in materials.items()],
            "transmitter": _ends(scene.transmitters, _antenna(scene.tx_array, "tx")),
            "receiver": _ends(scene.receivers, _antenna(scene.rx_array, "rx")), "array": _elements(scene)}


def from_sionna(scene: Any, *, folder: str | os.PathLike[str] | None = None, device: str | int | None = None,
                **sets: Any) -> Simulation:
    """A simulation of a sionna.rt.Scene as it is now; see sionna_config() for what is carried over.

    folder: where its meshes and wavetracer.toml are kept; None: nowhere. sets: keys that are set over the
    configuration, such as trace={"max_depth": 5, "diffraction": True}.
    """
    if folder is None:
        with tempfile.TemporaryDirectory(prefix="wavetracer-sionna-") as work:
            return Simulation(sionna_config(scene, work), folder=work, device=device, **sets)
    config = sionna_config(scene, folder)
    (pathlib.Path(folder) / "wavetracer.toml").write_text(_toml.document(config), encoding="utf-8")
    return Simulation(config, folder=folder, device=device, **sets)
