# SPDX-License-Identifier: Apache-2.0
"""The part of docs/validation.md about measured levels, and its figure."""
import numpy as np

from page_parts import gnuplot, table

STREETS = "measured_streets.svg"
WAYS = {"before": "as configured", "fitted": "fitted", "held_out": "held out"}
PEERS = {"sionna_itu": "Sionna RT, ITU materials", "sionna_learned": "Sionna RT, learned materials",
         "sionna_neural": "Sionna RT, neural materials"}
COLOURS = ("#1f77b4", "#d62728")


# --- figure ---

def draw(points, folder):
    """The levels of the streets, measured less their offset over computed, and the line on which both are the same. points:
    {class: array of (computed, measured) in dB}."""
    lines, plots = [], ["x with lines lc rgb '#888888' notitle"]
    for i, (name, cloud) in enumerate(points.items()):
        heard = cloud[np.isfinite(cloud).all(axis=1)]
        offset = (heard[:, 1] - heard[:, 0]).mean()
        lines += [f"$cloud{i} << END", *(f"{x:.1f} {y - offset:.1f}" for x, y in heard), "END"]
        plots.append(f"$cloud{i} with points pt {7 if i == 0 else 6} ps 0.4 lc rgb '{COLOURS[i]}' "
                     f"title '{name} (offset {offset:+.1f} dB)'")
    gnuplot(folder / STREETS, [
        "set key top left Left reverse", "set size square", "set xtics 10", "set ytics 10", "set xlabel 'computed, dB'",
        "set ylabel 'measured less the offset, dB'", "set title 'Boulder, streets at 28.5 GHz'", *lines,
        "plot " + ", ".join(plots)], "460,460")


# --- tables ---

def cells(found):
    return [f"{found['with_a_path']} of {found['points']}", f"{found['offset_db']:+.1f}", f"{found['sigma_db']:.2f}",
            f"{found['spearman']:.2f}"]


HEAD = ["", "with a path", "offset, dB", "sigma, dB", "rank"]


def street_table(result):
    rows = [[f"{row['class']}, {name}", *cells(row[way])] for row in result["classes"]
            for way, name in {**WAYS, "sionna": result["sionna"]}.items()]
    return table(HEAD, rows)


def spread_table(result):
    rows = [[row["class"], *(cell for name, scale in (("ds", 1e9), ("asa", 1)) for cell in (
        row[name]["points"], f"{row[name]['measured'] * scale:.1f}", f"{row[name]['ours'] * scale:.1f}",
        f"{row[name]['sigma_of_log10']:.2f}", f"{row[name]['spearman']:+.2f}"))] for row in result["classes"]]
    return table(["places", "with a delay spread", "measured, ns", "computed, ns", "sigma of log10", "rank",
                  "with an azimuth spread", "measured, deg", "computed, deg", "sigma of log10", "rank"], rows)


def hallway_table(result):
    rows = []
    for row in result["arrays"]:
        rows += [[f"array {row['array']}, {partitions}, {name}", *cells(found[way])]
                 for partitions, found in row["partitions"].items() for way, name in WAYS.items()]
        rows += [[f"array {row['array']}, {name}", *cells(row[peer])] for peer, name in PEERS.items()]
    return table(HEAD, rows)


def clipped(result):
    return "; ".join(f"array {row['array']}: {row['clipped']['places']} places; without them sigma is "
                     f"{row['clipped']['sionna_itu']['sigma_db']:.2f} dB, and {row['clipped']['before']['sigma_db']:.2f} dB for the "
                     "program" for row in result["arrays"])


def moved(result, name):
    """A parameter of the fits for both arrays: before and fitted."""
    found = [row["partitions"]["slabs"]["parameters"][name] for row in result["arrays"]]
    return f"from {found[0]['before']:.2g} to " + " and ".join(f"{each['fitted']:.2g}" for each in found)


def options(trace):
    return " ".join(f"--set {key}={value}" for key, value in trace.items())


# --- text ---

DATA = """**The data** are two folders that `--data` names together. They are not part of this project.

| folder | files | from |
| --- | --- | --- |
| `boulder` | `positions.csv`: a row for each place with `kind` (LOS or NLOS), `id`, `x` and `y` (m east and north of the transmitter), `rxh` (m), `mode` (4: the position is known to centimetres; others are left out) and `pg`, the path gain (dB: the powers of all components, mean of the sectors). `components.csv`: a row for each component with `kind`, `id`, `sector`, `delay_ns`, `aoa_azimuth_deg` and `path_loss_db`. `boulder.toml` with the scene, 28.5 GHz, depth, diffraction, and an isotropic transmitter at (0, 0, 2.5) | NIST, [nextg.nist.gov/submissions/112](https://nextg.nist.gov/submissions/112), under the NIST Data Sharing Agreement, which asks for attribution; its unmodified files, of which these columns are made, are in `data/measurements/Boulder_Downtown` of github.com/functions-lab/geo2sigmap, branch `new_pipe`. The map is that of its notebook `5_scene_nist_28ghz_boulder.ipynb`: OpenStreetMap (ODbL) with storeys of 3.5 m, so heights are guesses |
| `dichasus` | `dc01_hexagons.csv`: `x_m` and `y_m` of each place, and for array 1 and 2 `arrayN_measured`, `arrayN_sionna_itu`, `arrayN_sionna_learned`, `arrayN_sionna_neural` (dB up to a constant). `dc01_array1.toml` and `dc01_array2.toml` with the scene, 3.438 GHz, depth, diffraction, transmission, and the array as one antenna of TR 38.901 | github.com/NVlabs/diff-rt-calibration (NVIDIA License, non-commercial): position and colour of each hexagon in the figures `results/measurements/path_loss_rx1.pdf` and `rx2.pdf`, to 0.08 dB, and the scene `scenes/inue_simple`. The measurement is DICHASUS dc01 of the University of Stuttgart |

```sh
python3 bench/validation/sionna_levels.py DATA/boulder sionna.csv
./dev validation measured --data DATA --sionna sionna.csv
```
"""


def section(result):
    boulder, dichasus = result["boulder"], result["dichasus"]
    sight, hidden, covered = boulder["classes"]
    first, second = dichasus["arrays"]
    def sigmas(partitions, way):
        return " and ".join(f"{row['partitions'][partitions][way]['sigma_db']:.2f}" for row in (first, second))

    learned = " and ".join(f"{row['sionna_learned']['sigma_db']:.2f}" for row in (first, second))
    fits = [boulder["fits"]["LOS"], boulder["fits"]["NLOS"], *(row["partitions"][name] for row in (first, second) for name in row["partitions"])]
    seconds = ", ".join(f"{each['seconds']:.0f} s" for each in fits)
    return f"""## Measured levels
Two public sets of measured levels were at hand, one of streets and one of a hallway. The files of the [campaigns below](#measurement-campaigns) were not. The program is compared with the levels as configured, and after `wavetracer calibrate --folds {result['folds']}` has [fitted materials](calibration.md) to them; "held out" are halves of the places that are predicted by a fit to the other half. Sionna RT stands beside it on the same scenes.

Offset and sigma are the mean and the standard deviation of measured minus computed level, and rank is Spearman's correlation. Fitted and held-out levels contain the offset of the fit. All rows come from one comparer, `wavetracer.measurements.agreement` (`./dev validation measured`, {result["device"]}, {result["date"]}).

**Streets.** NIST measured in downtown Boulder at 28.5 GHz, from an antenna at 2.5 m to a robot with 16 horns at 1.6 m. Levels are path gains without antennas, so the offset should be 0 dB. "In sight" and "hidden" are the measurers' words: {hidden["before"]["points"] - covered["before"]["points"]} of the {hidden["before"]["points"]} hidden places are in sight in the map, because it has neither trees nor parked cars. The options were `{options(boulder["trace"])}`. {boulder["sionna"]} had the same antennas, depth 4, edges of wedges and 10^6 rays (`bench/validation/sionna_levels.py`).

![Measured and computed levels in streets](figures/{STREETS})

{street_table(boulder)}

This table has the spreads of the components up to {boulder["window_db"]:g} dB below the strongest, as medians. Measured spreads are means over up to eight sectors of a place. Computed ones are those of paths between isotropic antennas. Places with one path have no spread and are left out; sigma and rank are those of the logarithms.

{spread_table(boulder)}

**A hallway.** DICHASUS dc01 has levels at {first["partitions"]["slabs"]["before"]["points"]} places of a hallway at 3.438 GHz, from two arrays, up to an unknown constant. The options were `{options(dichasus["trace"])}`, with transmission and one diffraction; the receiver is a dipole. The scene file has its partitions as slabs of plasterboard of 0.1 m, which is a guess: with "slabs" the thickness of all materials is fitted, too (`--fit "*,*.thickness"`). With "two boards" partitions have `layers`: two boards of 12.5 mm with 75 mm of air between them, the best of the three gaps that were [tried on these data](calibration.md#what-walls-are-worth). The levels of Sionna RT are those that the authors of github.com/NVlabs/diff-rt-calibration publish beside the measured ones. They trained the materials called learned and neural on these measurements, so compare them with "fitted" and not with "held out". Sionna's levels with ITU materials end at {first["clipped"]["level_db"]:g} dB ({clipped(dichasus)}).

{hallway_table(dichasus)}

Beside other work, the fits took {seconds} (streets in sight, hidden, array 1 with slabs and with boards, array 2).

### What was learnt
**In sight** levels of streets agree to {sight["before"]["sigma_db"]:.1f} dB, and the offset of {sight["before"]["offset_db"]:+.1f} dB is small. A fit to {sight["before"]["points"]} places in one street has nothing to find there: the places that are held out agree less well ({sight["held_out"]["sigma_db"]:.1f} dB).

**Hidden** places of Boulder receive {-hidden["before"]["offset_db"]:.0f} dB less than computed, and materials change little of it. {boulder["sionna"]} computes nearly the same (offset {hidden["sionna"]["offset_db"]:+.1f} dB, sigma {hidden["sionna"]["sigma_db"]:.1f} dB). So the map is the likely cause, and not the program: something stands between the transmitter and these places that the map does not have, as trees and cars. The models of [streets](#streets) differ from the program in the other direction, probably because their streets have objects that turn waves around corners. What a map lacks can weaken hidden links or strengthen them; do not take their power as a bound.

**Ranks.** Among the hidden places that the map hides, too, the rank is only {covered["before"]["spearman"]:.2f} ({covered["sionna"]["spearman"]:.2f} for {boulder["sionna"]}). The map tells which places are hidden, and hardly which of them hear more.

**Spreads** have the right size in hidden streets: medians of {hidden["ds"]["ours"] * 1e9:.0f} ns computed and {hidden["ds"]["measured"] * 1e9:.0f} ns measured, {hidden["asa"]["ours"]:.0f} and {hidden["asa"]["measured"]:.0f} degrees. In sight the computed ones are {sight["ds"]["ours"] / sight["ds"]["measured"]:.2f} (delay) and {sight["asa"]["ours"] / sight["asa"]["measured"]:.2f} (azimuth) times the measured ones, as in the comparison with models above: smooth walls give fewer echoes than real ones. Ranks are low, so spreads of single places are not predicted.

**Indoors** sigma falls from {sigmas("slabs", "before")} dB as configured to {sigmas("slabs", "held_out")} dB at places that were held out, where plasterboard is thinner than the scene file says (thickness {moved(dichasus, "plasterboard.thickness")} m). Walls of the right kind do as much without any fit: with two boards sigma is {sigmas("two boards", "before")} dB as configured, and {sigmas("two boards", "held_out")} dB held out. Sionna's learned materials reach {learned} dB on the places they were trained on. Sionna's neural materials, which differ from point to point of a wall, fit {first["sionna_neural"]["sigma_db"]:.1f} and {second["sionna_neural"]["sigma_db"]:.1f} dB.

{DATA}"""
