// What is known of a path or an end that was clicked, as text.
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

// Gain and phase of the coefficient between every pair of ports.
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
    ["Kind", `${Kinds[frame.kind[i]][1]}, order ${order}`],
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
    const what = Interactions[frame.vertex_interaction[k]] || `interaction ${frame.vertex_interaction[k]}`;
    list.append(element("li", `${what} at ${position_text(frame.vertex_m, k)} m; ${place_of(frame, k)}`));
  }
  parent.replaceChildren(element("h2", "Path"), rows_table(rows));
  if (order) parent.append(list);
}

const most_rows = 50;

// radio: of radios_of; choose(tx, rx): shows a link.
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
  parent.replaceChildren(element("h2", radio.name || "End without a name"), rows_table(rows));
  if (radio.tx >= 0) group("Sends to", "tx", "rx", meta.receivers, (end) => [radio.tx, end]);
  if (radio.rx >= 0) group("Receives from", "rx", "tx", meta.transmitters, (end) => [end, radio.rx]);
}

function show_hint(parent) {
  const hint = element("p", "Click a path for its data, or an end for its links.");
  hint.className = "faint";
  parent.replaceChildren(hint);
}
