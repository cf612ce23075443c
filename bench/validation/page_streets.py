# SPDX-License-Identifier: Apache-2.0
"""The part of docs/validation.md about links in streets."""
import numpy as np

import p1411
import tr37885
import tr38901
from page_parts import ghz, gnuplot, measured, table

LOSS = "validation_loss.svg"
KINDS = {"mast": "mast", "vehicle": "vehicles"}
STATES = {"los": "in sight", "nlosv": "behind vehicles", "nlos": "hidden"}


# --- the figure ---

def curves(kind, state, frequency_ghz):
    """(name, losses at these distances) of the models, for links of this kind."""
    d = np.geomspace(30 if state == "nlos" else 10, 400, 40)
    general = p1411.site_general(frequency_ghz, d, "los" if state == "los" else "nlos_high_rise")
    if kind == "mast":
        return d, {"P.1411": general, "TR 38.901": tr38901.path_loss(frequency_ghz, d, 10, 1.5, state)}
    return d, {"P.1411": general, "TR 37.885": tr37885.path_loss(frequency_ghz, d, state)}


def panel(number, result, kind, hz):
    lines, plots = [], []
    for i, state in enumerate(("los", "nlos")):
        d, models = curves(kind, state, hz / 1e9)
        for j, (name, losses) in enumerate(models.items()):
            lines += [f"$m{number}{i}{j} << END"] + [f"{x:.4g} {y:.5g}" for x, y in zip(d, losses)] + ["END"]
            title = f"title '{name}'" if i == 0 else "notitle"
            plots.append(f"$m{number}{i}{j} with lines lw 2 dt {j + 1} lc rgb '{'#1f77b4' if i == 0 else '#d62728'}' {title}")
        points = [row for row in result["by_distance"] if (row["where"], row["kind"], row["frequency_hz"], row["state"]) ==
                  ("ten cities", kind, hz, state)]
        lines += [f"$p{number}{i} << END"] + [f"{row['d_m']} {row['median_db']} {row['low_db']} {row['high_db'] or 240}" for row in points]
        lines.append("END")
        plots.append(f"$p{number}{i} with yerrorbars pt 7 ps 0.7 lc rgb '{'#1f77b4' if i == 0 else '#d62728'}' "
                     f"title '{'wavetracer, in sight' if i == 0 else 'wavetracer, hidden'}'")
    what = "masts of 10 m" if kind == "mast" else "between vehicles"
    return lines + [f"set title '{what}, {hz / 1e9:g} GHz'", "plot " + ", ".join(plots)]


def draw(result, folder):
    lines = ["set multiplot layout 2,2", "set logscale x", "set xrange [10:400]", "set yrange [60:220]",
             "set xtics (10, 20, 50, 100, 200, 400)", "set key top left font ',10'", "set xlabel 'distance, m'",
             "set ylabel 'path loss, dB'"]
    for number, (kind, hz) in enumerate((k, f) for k in ("mast", "vehicle") for f in (5.9e9, 28e9)):
        lines += panel(number, result, kind, hz)
    gnuplot(folder / LOSS, lines + ["unset multiplot"], "860,780")


# --- tables ---

def chosen(result, variant, states=("los", "nlosv", "nlos")):
    return [row for row in result["classes"] if row["variant"] == variant and row["state"] in states and row["loss"]]


def of(row):
    return f"{row['where']}, {KINDS[row['kind']]}, {ghz(row)} GHz, {STATES[row['state']]}"


def loss_cells(row):
    return [f"{each['median_db']:+.1f} ({each['sigma_db']:.1f}; {each['stated_sigma_db']:g})" for each in row["loss"]]


def loss_table(result):
    rows = []
    for row in chosen(result, "with") + chosen(result, "traffic"):
        also = next((each for each in result["classes"] if each["variant"] == "without" and row["variant"] == "with" and all(
            each[key] == row[key] for key in ("where", "kind", "state", "frequency_hz"))), None)
        rows.append([of(row) + (", with traffic" if row["variant"] == "traffic" else ""), f"{row['links']:,}",
                     f"{row['heard'] / row['links']:.0%}", f"{row['weak'] / row['links']:.0%}", *loss_cells(row),
                     f"{also['heard'] / also['links']:.0%}: {also['loss'][0]['median_db']:+.1f}" if also and also["loss"] else ""])
    return table(["links", "number", "with a path", "above 150 dB or none", "minus P.1411, 4.1.1, dB", "minus 3GPP, dB",
                  "without diffraction: with a path, minus P.1411"], rows)


def spread_cell(values, unit):
    if values is None:
        return "more than 16% have one path"
    mean, sigma = values
    return f"{10 ** mean * (1e9 if unit == 'ns' else 1):.3g} {unit} ({sigma:.2f})"


def spread_table(result):
    rows = []
    for row in chosen(result, "with") + chosen(result, "traffic", ("los", "nlosv", "nlos")):
        cells = []
        for name, unit in (("ds", "ns"), ("asa", "deg"), ("asd", "deg")):
            each = row["spreads"][name]
            cells += [spread_cell(each["ours"], unit), spread_cell(each["model"], unit)]
        rows.append([of(row) + (", with traffic" if row["variant"] == "traffic" else ""), *cells])
    return table(["links", "delay spread", "3GPP", "azimuth, arrival", "3GPP", "azimuth, departure", "3GPP"], rows)


def corner_table(result):
    rows = []
    for row in result["corners"]:
        if row["variant"] != "with":
            continue
        bare = next(each for each in result["corners"] if each["variant"] == "without" and
                    (each["frequency_hz"], each["from_m"]) == (row["frequency_hz"], row["from_m"]))

        def cell(each):
            return f"{each['off'][0]:+.1f} ({each['off'][1]:.1f})" if each["off"] else ""

        rows.append([f"{ghz(row)} GHz, {row['from_m']} to {row['to_m']} m beyond the crossing", row["links"], cell(row),
                     f"{bare['heard'] / max(1, bare['links']):.0%}: {cell(bare)}"])
    return table(["links", "number", "minus P.1411, 4.1.3.2, dB", "without diffraction: with a path, minus P.1411"], rows)


def cause_table(result):
    rows = []
    for what in dict.fromkeys(row["what"] for row in result["causes"]):
        both = [row for row in result["causes"] if row["what"] == what]
        rows.append([what, both[0]["links"], *(f"{row['median_db']:+.1f}; {row['mean_db']:+.1f}" for row in both)])
    return table(["change", "hidden links", "5.9 GHz, median; mean, dB", "28 GHz"], rows)


def bounds_table(result):
    rows = []
    for row in result["bounds"]:
        if row["sum"] != "powers":
            continue
        fields = next(each for each in result["bounds"] if each["sum"] == "fields" and all(
            each[key] == row[key] for key in ("where", "kind", "side")))
        rows.append([f"{row['where']}, {KINDS[row['kind']]}, {row['side']} {row['breakpoint_m']:.0f} m", row["links"]]
                    + [cell for each in (row, fields) for cell in
                       (f"{each['below']:.0%}", f"{each['above']:.0%}", f"{each['from_median_db']:+.1f}")])
    return table(["links", "number", "powers: below", "above", "minus the median, dB", "fields: below", "above",
                  "minus the median, dB"], rows)


def span(values, form="+.1f", unit=" dB"):
    return f"{min(values):{form}} to {max(values):{form}}{unit}"


def medians(result, state, index):
    """The medians of a class with diffraction, less the first model (P.1411) or the second (3GPP)."""
    return [row["loss"][index]["median_db"] for row in chosen(result, "with", (state,))]


def within(result, name):
    """In how many of the classes our median spread is within one sigma of the model, as words."""
    pairs = [(row["spreads"][name]["ours"], row["spreads"][name]["model"]) for row in chosen(result, "with") if
             row["spreads"][name]["ours"]]
    near = sum(abs(ours[0] - model[0]) <= model[1] for ours, model in pairs)
    return f"{near} of {len(pairs)}"


def traffic_effect(result):
    """The change of the medians of blocked links between vehicles that other vehicles cause, at each carrier."""
    hidden = [row for row in result["classes"] if row["kind"] == "vehicle" and row["state"] == "nlos"]
    return [busy["loss"][0]["median_db"] - bare["loss"][0]["median_db"] for busy in hidden if busy["variant"] == "traffic"
            for bare in hidden if bare["variant"] == "with" and
            (bare["where"], bare["frequency_hz"]) == (busy["where"], busy["frequency_hz"])]


def shares(result, where, state, names):
    """Our median spreads over those of the models."""
    return [10 ** (row["spreads"][name]["ours"][0] - row["spreads"][name]["model"][0])
            for row in chosen(result, "with", (state,)) if row["where"] == where for name in names if row["spreads"][name]["ours"]]


def section(result):
    behind = "; ".join(f"{row['links']} links at {ghz(row)} GHz {row['added'][0]:+.1f} dB ({row['added'][1]:.1f})"
                       for row in result["blocked"] if row["added"])
    stated = "; ".join(f"{tr37885.blockage(row['distance_m'], False)[0]:g} or {tr37885.blockage(row['distance_m'])[0]:g}"
                       for row in result["blocked"][:1])
    counts = {where: sum(row["links"] for row in result["classes"] if row["where"] == where and row["variant"] == "with")
              for where in dict.fromkeys(row["where"] for row in result["classes"])}
    trace = result["trace"]
    return f"""## Streets
The scenes are ten generated cities (`--seed 1` to `10`, blocks of 80 m, streets of 20 m, 3 to 9 storeys) and, if its files are present, the centre of Munich. There are two kinds of links, up to {result["far_m"]:g} m long: from masts of 10 m down to 1.5 m, and between vehicles with antennas at 1.6 m. Both are computed at 5.9 and at 28 GHz ({", ".join(f"{where}: {count:,}" for where, count in counts.items())} links, each carrier counted). The vehicles in the cities are those of `--vehicles 200`: cars, vans and trucks. Paths have up to {trace["max_depth"]} interactions, at most one of them diffraction. There is no scattering, and there are no trees {measured(result)}.

Path loss is computed from the sum of the powers of all paths between vertical isotropic antennas. It is compared with the site-general model of ITU-R P.1411-12 (4.1.1, urban high-rise). Links from masts are also compared with UMi street canyon of 3GPP TR 38.901 (Table 7.4.1-1), and links between vehicles with TR 37.885, urban (Table 6.2.1-1). (P.1411 has coefficients of low-rise cities without sight only from 10 GHz on, so the table uses high-rise throughout.) Each cell has the median of the program's loss minus the model's loss. The brackets have the standard deviation of that difference, and the deviation that the model states. Hidden links count from 30 m on, where P.1411 begins. Links without any path are left out of the medians, and counted.

![Path loss over distance](figures/{LOSS})

{loss_table(result)}

The points of the figure are the program's medians in the ten cities. Bars reach from the 10th to the 90th of 100 links, where links without a path count as infinite loss.

**Two slopes.** This table compares links in sight at 5.9 GHz with the bounds of P.1411, 4.1.2, which meet at the breakpoint 4 h1 h2 / wavelength. Beyond the breakpoint the reflection off the ground weakens the direct wave. The sum of fields shows this (`narrowband_gain_db` of [links.csv](formats.md#linkscsv)); a sum of powers cannot. Between vehicles beyond the breakpoint both sums stay below the lower bound, because smooth walls carry power past the loss at the ground.

{bounds_table(result)}

**Around a corner.** This table compares links from masts in the ten cities, with the ends in two streets that cross, with P.1411, 4.1.3.2 (one corner, urban, wedges):

{corner_table(result)}

**Behind vehicles.** Where only vehicles hide a link, they add this loss (median; standard deviation in brackets): {behind}. TR 37.885, 6.2.1, adds a mean of {stated} dB, by the height of the vehicle in between, with a sigma of 4 to 4.5 dB.

**Spreads.** The table has medians, and in brackets the sigma of log10 (for the program: half of the range between the 16th and the 84th of 100 links). Paths 25 dB below the strongest do not count. The columns "3GPP" are Table 7.5-6 of TR 38.901 for masts, and Table 6.2.3-1 of TR 37.885 for vehicles.

{spread_table(result)}

### Where they disagree, and why
**In sight** the medians of the differences (program minus model) are {span(medians(result, "los", 0))} for P.1411 and {span(medians(result, "los", 1))} for 3GPP, with less deviation than the models state. P.1411 is nearly free space here. The program adds the power of every reflection off flat, bare ground and flat walls, with nothing in front of them. The models are fitted to streets where many objects that no map has graze the direct wave, and, between low antennas, to the breakpoint (above).

**Hidden** links with diffraction have medians of {span(medians(result, "nlos", 0))} for P.1411, with more at 28 GHz than at 5.9, and {span([row["loss"][0]["sigma_db"] / row["loss"][0]["stated_sigma_db"] for row in chosen(result, "with", ("nlos",))], ".1f", "")} times its sigma. More depth or second edges explain little of this. The next table shows how the loss of hidden links from masts in the first city changes when more mechanisms are computed (solved on {result["causes"][0]["date"]}):

{cause_table(result)}

The probable cause is that objects are missing in the map. Vehicles alone change the medians of hidden links between vehicles by {span(traffic_effect(result))} (the rows with traffic). Rough walls with S = 0.3 give hidden links several dB if waves are also reflected before and after they scatter (`trace.scattering_reflections = 1`, of paths above -170 dB each), and more at 28 GHz than at 5.9; an edge beside the tile (`trace.scattering_diffraction`) adds little. The cities have neither balconies, signs, lamp posts nor trees, and their corners are sharp. Around such a corner only edges carry power, and edges lose more with frequency than scatterers would. The models also do not include losses above some 150 dB, which receivers cannot hear; the table of path loss says how many of the program's links are beyond. This explanation is not proved. Where levels were [measured](#measured-levels) in a street, hidden places received less than computed, not more. So take the power of hidden links of a bare map as a rough estimate. Give materials `scattering` where it matters.

**Without diffraction** few hidden links have a path, and these are the strongest ones. Their medians lose less than the models, and cannot be compared with them.

**Spreads.** Among the classes with diffraction and without traffic, the median delay spread is within one sigma of the model in {within(result, "ds")}, the spread of azimuths of arrival in {within(result, "asa")}, and that of departure in {within(result, "asd")}. TR 37.885 states a sigma of 0.1 in sight. Cities that differ as much as these cannot meet it. In sight in the generated cities, delay spreads are {span(shares(result, "ten cities", "los", ["ds"]), ".2f", "")} times the models' values, and azimuths of arrival {span(shares(result, "ten cities", "los", ["asa"]), ".2f", "")} times. The reason is a canyon of smooth walls: the direct wave is much stronger than its echoes, and no echo comes from near the terminal. Vehicles in the street increase both (rows with traffic).
"""
