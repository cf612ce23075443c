# SPDX-License-Identifier: Apache-2.0
"""Tables of pandas and xarray against the columns that they are made of. Usage, with the Python of the environment:
tables_test.py FOLDER, where api_test.py has left a run."""
import sys

import numpy as np
import wavetracer as wt

run = wt.open(sys.argv[1])
frame = run[0]
paths = frame.paths
table = paths.to_pandas()
assert len(table) == len(paths) and np.array_equal(table.delay_s, paths.delay_s)
assert list(table.tx.unique()) == ["rsu"] and table.rx[0] == run.receivers[paths.rx[0]]
assert np.array_equal(table.a, paths.a[:, 0, 0]) and np.array_equal(table.kind, paths.kind)
links = paths.links.to_pandas()
assert np.array_equal(links.path_gain_db, paths.links["path_gain_db"]) and links.rx[1] == run.receivers[paths.links["rx"][1]]
assert "<table" in paths.links._repr_html_()
whole = run.links_to_pandas()
assert len(whole) == len(run.links["frame"]) and sorted(whole.time_s.unique()) == run.times_s[:1]
cube = paths.to_xarray()
assert dict(cube.sizes) == {"rx": len(run.receivers), "rx_port": 1, "tx": 1, "tx_port": 1, "path": int(links.paths.max())}
row = len(paths) - 1
at = cube.sel(rx=run.receivers[paths.rx[row]], tx="rsu")
delays = at.delay_s.values
assert np.nanmax(delays) == paths.delay_s[row] and np.isnan(delays).sum() == len(delays) - (paths.rx == paths.rx[row]).sum()
assert (at.a.values[0, 0] != 0).sum() == (paths.rx == paths.rx[row]).sum() and cube.attrs["frequency_hz"] == 5.9e9
print("tables ok")
