# SPDX-License-Identifier: Apache-2.0
"""The page docs/validation.md of the results: every number in it is one of bench/validation/results/*.json, or made of them."""
import numpy as np

import page_crossings
import page_measured
import page_streets
from page_parts import gnuplot, measured, table

EDGES = "validation_edges.svg"
FIGURES = (EDGES, page_streets.LOSS, page_measured.STREETS)


def ours(row):
    """The mean of vertical and horizontal waves in dB; P.526 does not tell them apart."""
    return (row["v_db"] + row["h_db"]) / 2


# --- edges ---

def draw_edges(result, folder):
    """Over one edge our losses and the exact ones; over two, how far ours are off."""
    near = [row for row in result["single"] if row["frequency_hz"] == 5.9e9 and row["d1_m"] == 100]
    pairs = [row for row in result["double"] if row["frequency_hz"] == 5.9e9 and row["nu_1"] == row["nu_2"]]
    lines = ["set multiplot layout 1,2", "set key top left Left reverse font ',11'", "set xlabel 'nu'", "set title 'one edge, 100 m and 100 m, 5.9 GHz'",
             "set ylabel 'loss, dB'", "$one << END"]
    lines += [f"{row['nu']} {row['exact_db']} {row['v_db']} {row['h_db']}" for row in near] + ["END"]
    lines += ["plot $one using 1:2 with lines lw 2 title 'Fresnel integral', $one using 1:3 with points pt 7 title 'wavetracer, V', "
              "$one using 1:4 with points pt 6 title 'wavetracer, H'", "set title 'two edges, the same nu at each, 5.9 GHz'",
              "set ylabel 'wavetracer (mean of V, H) - integral, dB'"]
    places = sorted({(row["a_m"], row["b_m"], row["c_m"]) for row in pairs})
    for i, place in enumerate(places):
        lines += [f"$two{i} << END"] + [f"{row['nu_1']} {ours(row) - row['exact_db']}" for row in pairs
                                        if (row["a_m"], row["b_m"], row["c_m"]) == place] + ["END"]
    lines.append("plot " + ", ".join(f"$two{i} with linespoints lw 2 pt {i + 4} title '{a} + {b} + {c} m'"
                                     for i, (a, b, c) in enumerate(places)))
    gnuplot(folder / EDGES, lines + ["unset multiplot"])


def difference_row(rows, reference):
    """Largest differences of the mean of both waves, and of each of them, from a reference."""
    mean = max(abs(ours(row) - row[reference]) for row in rows)
    each = max(abs(row[wave] - row[reference]) for row in rows for wave in ("v_db", "h_db"))
    return f"{mean:.2f}", f"{each:.2f}"


def edges_section(result):
    single, double = result["single"], result["double"]
    ones = []
    for f, d1, d2 in sorted({(row["frequency_hz"], row["d1_m"], row["d2_m"]) for row in single}):
        rows = [row for row in single if (row["frequency_hz"], row["d1_m"], row["d2_m"]) == (f, d1, d2)]
        shadow = [row for row in rows if row["nu"] > -0.78]
        ones.append([f"{f / 1e9:g} GHz, {d1} + {d2} m", *difference_row([row for row in rows if row["nu"] <= 3], "exact_db"),
                     *difference_row([row for row in rows if row["nu"] > 3], "exact_db"), difference_row(shadow, "p526_db")[0]])
    twos = []
    for low, high in ((0, 0), (0, 0.5), (0, 5), (0.5, 0.5), (1, 1), (2, 2), (5, 5)):
        rows = [row for row in double if sorted((row["nu_1"], row["nu_2"])) == [low, high]]
        off = [ours(row) - row["exact_db"] for row in rows]
        theirs = [row["p526_db"] - row["exact_db"] for row in rows]
        between = max(abs(row["v_db"] - row["h_db"]) for row in rows)
        twos.append([f"{low:g} and {high:g}", len(rows), f"{np.median(off):+.2f}", f"{min(off):+.2f} to {max(off):+.2f}",
                     f"{between:.1f}", f"{min(theirs):+.2f} to {max(theirs):+.2f}"])
    return f"""## Edges
Metal screens hang in free space. The field that arrives over their upper edges is compared with Recommendation ITU-R P.526-15: section 4.1 for one edge (the Fresnel integral, and its approximation), section 4.3 for two. `nu` is the parameter of section 4.1: 0 is grazing, positive is shadow. With two edges it is taken at each edge, from its end to the other edge. Section 4.3 approximates the Fresnel integral over both half planes (L. E. Vogler, Radio Science 17, 1982). Here that integral is evaluated by quadrature, and the results of the program and of P.526 are both compared with it. The recommendation does not distinguish polarisations; "mean" is the mean of the program's losses with vertical and horizontal waves {measured(result)}.

![Losses over one edge and over two](figures/{EDGES})

This table has the largest differences in dB for one edge, with `nu` from -2 to 10:

{table(["", "mean, exact, nu to 3", "each wave", "mean, exact, nu 5 and 10", "each wave", "mean, P.526's approximation"], ones)}

The mean follows the Fresnel integral. Vertical and horizontal waves differ from each other where the angle of diffraction is large. This is the physics of a conducting screen, and a scalar integral cannot show it.

The next table has two edges of one height, {len(double)} cases at 5.9 and 28 GHz, {min(row['b_m'] for row in double)} to {max(row['b_m'] for row in double)} m from each other. It shows the loss of the program minus the double integral, in dB:

{table(["nu at the edges", "cases", "median of the mean", "range", "V and H apart, up to", "P.526 4.3 less the integral"], twos)}

With two edges, grazing ones included, the program differs from the integral by at most {max(abs(ours(row) - row["exact_db"]) for row in double):.2f} dB. It combines each term of one edge with each term of the other in that integral.

**Solid bodies.** `./dev edges` compares blocks of metal and of lossy materials, corners, a car's roof and rows of screens with integral equations, a paraxial equation and Vogler's integral. Its tables are in [errors.md](../bench/validation/edges/errors.md).

**Where the program is wrong.** At corners of lossy walls it errs by some dB if the source grazes the wall. At a wall of 1 cm it errs if the top of the wall is seen from above at the angle of its mirror. errors.md has the worst case of each set.

The wave of an edge ends where the edge ends, unless `trace.edge_ends` is on. This was tested on lines that go from deep shadow past the shadow of a corner of a metal plate (3 x 2 and 10 x 7 m, 1 to 6 GHz, ends 20 + 20 and 10 + 50 m from it). Single edges are compared with Kirchhoff's integral (`bench/validation/edges/plate.py`, the table in errors.md). Without the key the median error is 0.2 to 1 dB where the field is above -40 dB. But where the point of diffraction leaves the edge, the field steps by up to 0.57 of the field in free space: right at the shadow of the corner the exact value is 3/4, and one edge alone gives 1/2. With the key the median error is at most 0.06 dB, the largest error is 0.017 of the field in free space, and the largest step is 0.010, which is the change of the error from one receiver to the next. The wave of the corner reaches as far as a Fresnel zone of the corner. Paths over the roof of a house and around its upright corners leave their edges there.
"""


# --- laws ---

def laws_section(result):
    rows = []
    for name, orders in result["energy"].items():
        last = orders[-1]
        worst = max(abs(row["program_returns_w"] / row["returns_w"] - 1) for row in orders[:-1])
        rows.append([name, f"{orders[0]['arrives_w']:.4f}", f"{orders[1]['arrives_w']:.4f}", f"{last['returns_w']:.1e}",
                     f"{last['taken_w']:.4f}", f"{last['taken_w'] + last['returns_w']:.4f}", f"{worst:.2%}"])
    back = result["reciprocity"]
    most = max(abs(orders[-1]["taken_w"] + orders[-1]["returns_w"] - 1) for orders in result["energy"].values())
    return f"""## Energy and reciprocity
**A closed room.** A transmitter sends 1 W in an empty room of {' x '.join(f'{side:g}' for side in result['room_m'])} m. For every number of reflections, Gauss' rule integrates the flux that arrives at the walls over {result['receivers']} receivers 1 mm in front of them. The walls absorb that flux times 1 - abs(R)^2. The script computes the reflectances R itself (ITU-R P.2040-3, section 2.2.2), and does not ask the program for them. The sum of all absorbed power equals the sent power to {most:.2%} {measured(result)}.

{table(["walls", "arrives directly, W", "after one reflection", "still under way after the last", "absorbed by the walls", "absorbed and under way", "reflected power of the program against the script, worst order"], rows)}

**Ends swapped.** The program computed {back["links"]} links of a generated city with reflection, diffraction, transmission and scattering, up to three interactions, and antenna patterns of TR 38.901 with two polarisations in any orientation. Then every receiver became a transmitter, and every transmitter a receiver. {back["common"]:,} paths of {back["paths"]:,} and {back["paths_back"]:,} are found both ways. Their coefficients between all ports differ by at most {back["worst_of_amplitude"]:.0e} of the largest, and their delays by {back["worst_delay_s"] * 1e9:.0e} ns. Rays have missed the paths that only one way has found; these have {back["lost_share"]:.0e} of the power. Where a radio sends and receives, links get the paths of both ways ([architecture.md](architecture.md#moving-worlds)).
"""


HEAD = """# Validation
This page compares the program with published recommendations, with models that were fitted to measurements, and with laws of physics. It also compares it with [measured levels](#measured-levels) of two public sets. `./dev validation` generates the page from `bench/validation` and computes every number in it, so do not edit the page. [method.md](method.md#what-is-exact-and-what-is-sampled) says what is exact by construction and what is sampled.

The documents of the ITU and of 3GPP were not at hand. The formulas come from transcriptions, which the files in `bench/validation` name beside each formula. The test `validation_models` compares the formulas with values that others have computed.
"""


CAMPAIGNS = """## Measurement campaigns
If you have the files of a campaign, one command compares them with computed channels. It prints for each route the number of points, how many have a path, the offset (the mean of measured minus computed gain), the deviation about it, and the rank correlation of Spearman. Powers and antennas of campaigns are not known well, so only the levels relative to the offset are compared. A path loss counts with its sign changed. `--points FILE` writes every point, `--every N` takes one point of N. `--shift X Y` adds metres to the places of files whose coordinates are not those of the map.

```sh
python3 -m wavetracer.measurements cost231 -c configs/measurements/cost231.toml METRO200.csv METRO201.csv METRO202.csv --shift 1200 1699.27
python3 -m wavetracer.measurements berlin -c configs/measurements/berlin.toml sidelink_dataframe.csv --every 10
python3 -m wavetracer.measurements flourish -c configs/measurements/flourish.toml vehNo_01_RxCAM_HP.log
```

| campaign | files | how they are read |
| --- | --- | --- |
| COST 231, Munich, 947 MHz | METRO 200, 201, 202 as CSV | X, Y, Z in metres and the path loss in dB; a file per route. The transmitter is that of the configuration, in the coordinates of the public map; those of propagationtools.com are less by (1200, 1699.27), hence the shift |
| Berlin V2X, sidelink, 5.9 GHz | `sidelink_dataframe.parquet`, written as CSV by pandas (`to_csv`) | columns `Latitude_source`, `Longitude_source`, `Latitude_destination`, `Longitude_destination`, `Source`, `Destination`, `Scenario` and a level, `--level RSRP`, `RSSI` or `SNR`; a route per scenario and pair of cars |
| FLOURISH, Bristol, 5.9 GHz | `NAME_RxCAM_HP.log` with `NAME_tcpDump_HP.log` beside it, as the authors' scripts grep them (github.com/v2x-dev/ITS-G5_trials) | places of receivers and levels, joined by the sender's address and the number of the message; a route per sender |

The files of a campaign contain no map. The head of each configuration in `configs/measurements` says how to make the map, and has the heights of the antennas. If both ends have positions in degrees, every row becomes a frame, with a vehicle of the type `sender` and one of the type `receiver`. The configuration defines the bodies of these vehicles. They look east, because headings are not read.

**None of these files was at hand, so this section claims no number.** The readers follow the published descriptions: propagationtools.com for COST 231, `metadata/sidelink_info.csv` of github.com/fraunhoferhhi/BerlinV2X, and the scripts of FLOURISH, which identify the fields by their places. These scripts do not say which of the two positions in a line of RxCAM is the receiver's; the reader takes `GpsLon` and `GpsLat`. The test `python_measurements` reads small files of these forms, in free space, where the answer is known. A row that cannot be read is an error with its file and line. Rows that state that they have no position or level are left out and counted.
"""


def text(results):
    return "\n".join([HEAD, edges_section(results["edges"]), laws_section(results["laws"]),
                      page_streets.section(results["streets"]), page_crossings.section(results["crossings"]),
                      page_measured.section(results["measured"]), CAMPAIGNS])


def draw(results, folder):
    """The figures of the results; page_measured.draw needs the measured data."""
    draw_edges(results["edges"], folder)
    page_streets.draw(results["streets"], folder)
