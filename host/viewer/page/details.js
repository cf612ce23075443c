// SPDX-License-Identifier: Apache-2.0
// Shows as text what is known of a clicked path or end.
// Names come from files: they are only ever set as text, never as markup.
"use strict";

function element(tag, text, ...children) {
  const made = document.createElement(tag);
  if (text) made.textContent = text;
  made.append(...children);
  return made;
}

const signed = (text) => text.replace(/-/g, "\u2212");
const fixed = (value, digits) => (Number.isFinite(value) ? signed(value.toFixed(digits)) : "none");
const position_text = (column, i) =>
  [0, 1, 2].map((axis) => fixed(meta.centre_m[axis] + column[3 * i + axis], 2)).join(", ");

function rows_table(rows) {
  const table = element("table");
  for (const [name, value] of rows) table.append(element("tr", "", element("th", name), element("td", value)));
  return table;
}

// Turns 0.021 into "2.1 %", 3e-7 into "3\u00b710\u207b\u2077".
function share_text(share) {
  if (!Number.isFinite(share)) return "unknown";
  return share === 0 || share >= 0.001 ? `${+(100 * share).toPrecision(2)} %` : small_text(share);
}

// Writes a number below 1 as a digit and a power of ten.
function small_text(share) {
  const power = Math.floor(Math.log10(share)), digits = "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079";
  return `${+(share / 10 ** power).toPrecision(1)}\u00b710\u207b${[...String(-power)].map((c) => digits[Number(c)]).join("")}`;
}

// Describes what rays may have missed in the run; empty without rays.
function missed_text() {
  const unknown = meta.missed_unknown ? `It is not known what rays have missed${meta.missed ? " in some frames" : ""}: ${meta.missed_unknown}.` : "";
  if (!meta.missed) return unknown;
  const {paths: [paths, low, high], power_share: [share, least, most]} = meta.missed;
  const about = paths < 0.5 ? "probably missed none" : `missed about ${grouped(Math.round(paths))}`;
  return `Rays have ${about} of ${grouped(meta.paths[1])} paths (${grouped(Math.round(low))} to ${grouped(Math.ceil(high))}), `
    + `${share_text(share)} of the power (${share_text(least)} to ${share_text(most)}). ${unknown}`.trim();
}

// Says to which depth beams have found all paths, and but for what; empty without beams.
function certificate_text() {
  if (!meta.certificate) return "";
  const {depth, any_depth, edges, left_out_sr: solid_angle, left_out_share: share, left_out_power: power, floor_db, weak_share} =
    meta.certificate;
  const steps = edges > 0 ? "interactions" : depth === 1 && !any_depth ? "reflection" : "reflections";
  const bends = edges > 0 ? `, up to ${edges} of them at edges` : "";
  const number = `${any_depth ? "any number of" : `up to ${depth}`} ${steps}${bends}`;
  const above = floor_db === null ? "" : ` with a gain of ${signed(String(floor_db))} dB or more between isotropic antennas`;
  const most = power > 0 ? `; a link misses at most ${fixed(10 * Math.log10(power), 0)} dB through them${edges > 0 ? " by paths without an edge" : ""}` : "";
  const but = solid_angle > 0
    ? `, but for beams of ${small_text(solid_angle)} sr in all, ${share_text(share)} of the directions${most}` : "";
  const weak = floor_db === null ? "" : ` Weaker beams, with ${share_text(weak_share)} of the power, were not followed.`;
  return `Beams have found every path of ${number}${above}${but}.${weak}`;
}

// Returns rows of the run's link budget for a gain; none without one.
function budget_rows(gain_db) {
  const {transmit_power_dbm: sent, noise_dbm: noise} = meta.link_budget;
  if (sent === null) return [];
  const received = sent + gain_db;
  return [["Received", `${fixed(received, 2)} dBm${noise === null ? "" : `, SNR ${fixed(received - noise, 2)} dB`}`]];
}

// Returns row k of `links` as rows of a table.
function link_figures(k) {
  if (k < 0) return [["Path gain", "this link was not computed, or is not on the page"]];
  if (!links.paths[k]) return [["Path gain", "no path"]];
  return [
    ["Path gain", `${fixed(links.gain_db[k], 2)} dB, ${links.paths[k]} ${links.paths[k] === 1 ? "path" : "paths"}`],
    ["Narrowband gain", `${fixed(links.narrowband_gain_db[k], 2)} dB, coherent at the carrier`],
    ...budget_rows(links.gain_db[k]),
    ["Delay spread", `${fixed(links.rms_delay_spread_s[k] * 1e9, 2)} ns`],
    ["Line of sight", links.los[k] ? "yes" : "no"],
    ...(links.k_factor[k] > 0 && Number.isFinite(links.k_factor[k])
      ? [["K factor", `${fixed(10 * Math.log10(links.k_factor[k]), 2)} dB`]] : []),
    ...(some_areas && !Number.isNaN(links.cell_mean_db[k])
      ? [["Over the cell", `mean ${fixed(links.cell_mean_db[k], 2)} dB, fading ${value_text("fading", links.fading_db[k])}`]] : []),
    ...(some_beams && Number.isFinite(links.beam_gain_db[k])
      ? [["Best beams", `${fixed(links.beam_gain_db[k], 2)} dB, beam ${links.tx_beam[k]} to ${links.rx_beam[k]}`]] : []),
    ...(Number.isFinite(links.missed_power_share[k])
      ? [["Missed", links.missed_power_share[k] === 0 ? "probably nothing"
          : `about ${share_text(links.missed_power_share[k])} of the power`]] : []),
  ];
}

// Returns gain and phase of the coefficient between every pair of ports.
function port_rows(frame, i) {
  const rows = [], ports = meta.rx_ports * meta.tx_ports;
  for (let port = 0; port < ports; ++port) {
    const re = frame.a[2 * (i * ports + port)], im = frame.a[2 * (i * ports + port) + 1];
    const power = re * re + im * im;
    const rx = Math.floor(port / meta.tx_ports), tx = port % meta.tx_ports;
    const text = power > 0 ? `${fixed(10 * Math.log10(power), 2)} dB, ${fixed(Math.atan2(im, re) * 180 / Math.PI, 1)}\u00b0` : "none";
    rows.push([ports === 1 ? "Phase" : `Ports ${tx} to ${rx}`,
               ports === 1 && power > 0 ? text.split(", ")[1] : text]);
  }
  return rows;
}

function show_path(parent, frame, i) {
  const order = order_of(frame, i), first = first_vertex(frame, i);
  const theta_phi = (theta, phi) => `zenith ${fixed(degrees(theta, i), 2)}\u00b0, azimuth ${fixed(degrees(phi, i), 2)}\u00b0`;
  const rows = [
    ["From", meta.transmitters[frame.tx[i]][0]], ["To", meta.receivers[frame.rx[i]][0]],
    ["Kind", `${words_of_kind(frame.kind[i])}, order ${order}`],
    ["Length", `${fixed(frame.delay_s[i] * speed_of_light_m_s, 3)} m`],
    ["Delay", `${fixed(frame.delay_s[i] * 1e9, 3)} ns`],
    ["Gain", `${fixed(frame.gain_db[i], 2)} dB`],
    ...port_rows(frame, i),
    ["Departure", theta_phi(frame.aod_theta, frame.aod_phi)],
    ["Arrival", theta_phi(frame.aoa_theta, frame.aoa_phi)],
    ["Doppler", `${fixed(frame.doppler_hz[i], 2)} Hz`],
  ];
  const list = element("ol");
  for (let k = first; k < frame.vertex_end[i]; ++k) {
    const code = frame.vertex_interaction[k], known = path_kinds.find((kind) => kind.code === code);
    const what = known ? known.interaction : `interaction ${code}`;
    list.append(element("li", `${what} at ${position_text(frame.vertex_m, k)} m; ${place_of(frame, k)}`));
  }
  parent.replaceChildren(element("h2", "Path"), rows_table(rows));
  if (order) parent.append(list);
}

const most_rows = 50;

// Returns rows of what the other transmitters do to a cell.
function rivals_rows(cells, rx) {
  return ["sinr", "interference", "margin"].filter((quantity) => Quantities[quantity].known)
    .map((quantity) => [Quantities[quantity].name, Quantities[quantity].value(cells, rx)])
    .filter(([, value]) => Number.isFinite(value))
    .map(([name, value]) => [name[0].toUpperCase() + name.slice(1), `${fixed(value, 2)} ${name === "interference" ? "dBm" : "dB"}`]);
}

// Shows a cell of a map; cells: the reception of the frame.
function show_cell(parent, frame, rx, cells) {
  const rows = [["Position", `${position_text(frame.receiver_m, rx)} m`]], k = cells.server[rx];
  if (k >= 0)
    rows.push([several && k === cells.best[rx] ? "Strongest" : "Transmitter", name_of(meta.transmitters, links.tx[k])]);
  parent.replaceChildren(element("h2", name_of(meta.receivers, rx)),
                         rows_table([...rows, ...link_figures(k), ...(k >= 0 ? rivals_rows(cells, rx) : [])]));
}

// radio: one of radios_of(); choose(tx, rx): shows a link.
function show_radio(parent, frame, radio, choose) {
  const rows = [["Position", `${position_text(radio.m, 0)} m`]];
  const [, antenna, polarization] = radio.tx >= 0 ? meta.transmitters[radio.tx] : meta.receivers[radio.rx];
  rows.push(["Antenna", `${antenna}, ${polarization}`]);
  const [first, last] = links_of_frame(frame.row);
  const group = (heading, own, other, ends, link_of) => {
    const found = [];
    for (let k = first; k < last; ++k) if (links[own][k] === radio[own]) found.push(k);
    found.sort((a, b) => links.gain_db[b] - links.gain_db[a]);
    const list = element("div");
    list.className = "links";
    for (const k of found.slice(0, most_rows)) {
      const end = links[other][k], gain = links.gain_db[k];
      const button = element("button", "", element("span", ends[end][0] || `number ${end}`),
                             element("span", Number.isFinite(gain) ? `${fixed(gain, 2)} dB` : "no path"));
      button.type = "button";
      button.addEventListener("click", () => choose(...link_of(end)));
      list.append(button);
    }
    const more = found.length > most_rows ? `, the ${most_rows} strongest` : "";
    parent.append(element("h2", `${heading} ${found.length}${more}`), list);
  };
  parent.replaceChildren(element("h2", radio.name || "Antenna without a name"), rows_table(rows));
  if (radio.tx >= 0) group("Sends to", "tx", "rx", meta.receivers, (end) => [radio.tx, end]);
  if (radio.rx >= 0) group("Receives from", "rx", "tx", meta.transmitters, (end) => [end, radio.rx]);
}

const usual_hint =
  `Click a path for its data, ${meta.grids.length ? "a cell of the map for its link, " : ""}or an antenna for its links.`;

function show_hint(parent, text = usual_hint) {
  const hint = element("p", text);
  hint.className = "faint";
  parent.replaceChildren(hint);
}
