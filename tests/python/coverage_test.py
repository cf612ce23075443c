# SPDX-License-Identifier: Apache-2.0
"""Maps of wavetracer.coverage against Friis' formula, the links of the run, and its refusals. Usage:
coverage_test.py FOLDER."""
import json
import pathlib
import shutil
import sys

import numpy as np
import wavetracer as wt

# Two antennas over a plane, without reflections.
PLANE = "v -200 -200 0\nv 300 -200 0\nv 300 300 0\nv -200 300 0\nf 1 2 3 4\n"
folder = pathlib.Path(sys.argv[1]).absolute()
shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
(folder / "plane.obj").write_text(PLANE)
config = {
    "scene": {"file": str(folder / "plane.obj"), "default_material": "concrete"},
    "trace": {"max_depth": 0},
    "radio": {"frequency_hz": 3.5e9, "transmit_power_dbm": 43, "bandwidth_hz": 20e6},
    "transmitter": [{"name": "west", "position_m": [10, 30, 25]}, {"name": "east", "position_m": [100, 40, 25]}],
    "receiver_grid": [{"name": "g", "x_min_m": 0, "x_max_m": 120, "y_min_m": 0, "y_max_m": 60, "step_m": 5}],
}
run = wt.Simulation(config).run(folder / "run")

hidden = {name: sys.modules.pop(name) for name in list(sys.modules) if name.split(".")[0] == "xarray"}
sys.modules["xarray"] = None  # as if it were not installed
try:
    wt.coverage(run)
    raise AssertionError("no ImportError")
except ImportError as error:
    assert "extra `notebook` of the wheel" in str(error), error
del sys.modules["xarray"]
sys.modules.update(hidden)
try:
    import xarray
except ImportError:
    print("skipped: no xarray")
    sys.exit(77)

maps = wt.coverage(run)
assert isinstance(maps, xarray.Dataset) and dict(maps.sizes) == {"y": 12, "x": 24}
assert maps.x.values[0] == 2.5 and maps.x.values[-1] == 117.5 and maps.y.values[-1] == 57.5 and (maps.z == 1.5).all()
assert set(maps.coords) == {"x", "y", "z"} and maps.x.units == "m"
assert maps.attrs["transmitters"] == ["west", "east"] and maps.attrs["grid"] == "g" and "tx" not in maps.attrs
for name, unit in (("path_gain_db", "dB"), ("interference_dbm", "dBm"), ("delay_spread_ns", "ns"), ("paths", "1")):
    assert maps[name].dims == ("y", "x") and maps[name].units == unit and maps[name].long_name, name
gain = [20 * np.log10(299792458 / 3.5e9 / (4 * np.pi) / np.sqrt((maps.x - x) ** 2 + (maps.y - y) ** 2 + 23.5 ** 2)).T
        for x, y in ((10, 30), (100, 40))]
assert np.allclose(maps.path_gain_db, np.maximum(*gain), atol=1e-6)
assert np.array_equal(maps.best_server, gain[1] > gain[0])
assert np.allclose(maps.margin_db, abs(gain[0] - gain[1]), atol=1e-5)
noise_mw = 1.380649e-23 * 290 * 20e6 * 1e3
assert np.allclose(maps.sinr_db, 43 + np.maximum(*gain) - 10 * np.log10(noise_mw + 10 ** (4.3 + np.minimum(*gain) / 10)),
                   atol=1e-5)
at = maps.sel(x=22, y=41, method="nearest")
row = (run.links["rx"] == run.receivers.index("g/4,8")) & (run.links["tx"] == 0)
assert at.path_gain_db == run.links["path_gain_db"][row][0]

# One transmitter and some layers; a folder, a simulation and a configuration give the same.
west = wt.coverage(folder / "run", grid="g", tx="west", frame=0, layers=["path_gain_db", "margin_db"])
assert list(west) == ["path_gain_db", "margin_db"] and west.attrs["tx"] == "west"
assert np.allclose(west.path_gain_db, gain[0], atol=1e-6) and (west.margin_db < 0).any()
with wt.Simulation(config) as simulation:
    assert wt.coverage(simulation, tx="west", layers=["path_gain_db", "margin_db"]).identical(west)
    assert len(simulation) == 1  # it is still open
assert wt.coverage(config, tx="west", layers=["path_gain_db", "margin_db"]).identical(west)

(folder / "georeference.json").write_text(json.dumps({"projection": "+proj=utm +zone=32 +ellps=WGS84 +units=m",
                                                      "offset_m": [-690000, -5330000]}))
placed = wt.coverage(run)
assert set(placed.coords) == {"x", "y", "z", "lon", "lat"} and placed.lon.dims == ("y", "x")
assert (abs(placed.lon - 11.55) < 0.05).all() and (abs(placed.lat - 48.09) < 0.05).all()
assert placed.attrs["projection"].startswith("+proj=utm") and placed.attrs["offset_m"] == [-690000, -5330000]

for arguments, kind, said in (({"grid": "h"}, wt.ConfigError, 'did you mean "g"'), ({"tx": "est"}, wt.ConfigError, '"east"'),
                              ({"frame": 7}, wt.ConfigError, "frames 0 to 0"), ({"grid": 3}, TypeError, "grid is a name"),
                              ({"layers": ["snr"]}, wt.ConfigError, "snr_db"), ({"layers": "snr_db"}, TypeError, "in a list")):
    try:
        wt.coverage(run, **arguments)
        raise AssertionError(f"{arguments} was not refused")
    except kind as error:
        assert said in str(error), (arguments, error)
# A vertical plane: dimensions z and along, over which x and y lie.
plane = dict(config, receiver_grid=[{"name": "wall", "from_m": [20, 30], "to_m": [26, 22], "z_min_m": 0, "z_max_m": 6,
                                     "step_m": 2}])
maps = wt.coverage(plane)
assert dict(maps.sizes) == {"along": 5, "z": 3} and maps.path_gain_db.dims == ("z", "along")
assert np.allclose(maps.along, [1, 3, 5, 7, 9]) and np.allclose(maps.z, [1, 3, 5])
assert maps.x.dims == maps.y.dims == maps.lon.dims == maps.lat.dims == ("along",) and maps.attrs["to_m"] == [26, 22]
assert np.allclose(maps.x, 20 + .6 * maps.along) and np.allclose(maps.y, 30 - .8 * maps.along)
assert np.allclose(maps.path_gain_db, (20 * np.log10(299792458 / 3.5e9 / (4 * np.pi) / np.sqrt(
    (maps.x - 10) ** 2 + (maps.y - 30) ** 2 + (maps.z - 25) ** 2))).transpose("z", "along"), atol=1e-6)
with wt.Simulation(plane) as simulation:
    over_time = wt.coverage(simulation, frames="all")
    assert over_time.path_gain_db.dims == ("time", "z", "along") and over_time.z.dims == ("z",)
# A drive: its maps have a dimension of time, and are those of single frames; two that differ are both where they belong.
drive = dict(config, time={"step_s": 0.25}, track=[{"id": "bus", "waypoints": [[0, 10, 20, 0], [1, 50, 20, 0]]}],
             vehicle_type=[{"name": "passenger", "model": "none"}],
             mount=[{"name": "roof", "role": "transmitter", "offset_m": [0, 0, 4]}])
moving = wt.Simulation(drive).run(folder / "drive")
maps = wt.coverage(moving, frames="all", tx="bus/roof")
assert dict(maps.sizes) == {"time": 5, "y": 12, "x": 24} and maps.path_gain_db.dims == ("time", "y", "x")
assert maps.time.values.tolist() == [0, 0.25, 0.5, 0.75, 1] and maps.time.units == "s"
assert maps.frame.values.tolist() == [0, 1, 2, 3, 4] and "time_s" not in maps.attrs and maps.z.dims == ("y", "x")
distance = np.sqrt((maps.x - (10 + 40 * maps.time)) ** 2 + (maps.y - 20) ** 2 + 2.5 ** 2).transpose("time", "y", "x")
assert np.allclose(maps.path_gain_db, 20 * np.log10(299792458 / 3.5e9 / (4 * np.pi) / distance), atol=1e-5)
one = wt.coverage(moving, frame=3, tx="bus/roof")
assert np.array_equal(one.path_gain_db, maps.path_gain_db[3]) and one.attrs["frame"] == 3
some = wt.coverage(moving, frames=[3, 1], tx="bus/roof")
assert some.identical(maps.isel(time=[3, 1])) and some.time.values.tolist() == [0.75, 0.25]
assert wt.coverage(drive, frames=np.array([1, 3]), tx="bus/roof").identical(maps.isel(time=[1, 3]))
with wt.Simulation(drive) as simulation:
    assert wt.coverage(simulation, frames="all", tx="bus/roof").identical(maps)
part = wt.Simulation(drive).run(folder / "part", [0, 2, 4])
for arguments, kind, said in (({"frames": [0, 2, 3]}, wt.ConfigError, "the run has no frame 3"),
                              ({"frames": [5]}, wt.ConfigError, "0 to 4"), ({"frames": [-1, 2]}, wt.ConfigError, "--frames"),
                              ({"frames": "some"}, TypeError, '"all"'), ({"frames": []}, wt.ConfigError, "at least one"),
                              ({"frames": [0], "frame": 0}, wt.ConfigError, "not both"),
                              ({"frames": [0.5]}, TypeError, "is an integer")):
    try:
        wt.coverage(part, **arguments)
        raise AssertionError(f"{arguments} was not refused")
    except kind as error:
        assert said in str(error), (arguments, error)

try:
    wt.coverage(folder / "nothing")
    raise AssertionError("a folder that does not exist was not refused")
except wt.InputError as error:
    assert "there is no such file" in str(error), error
print("coverage ok")
