// SPDX-License-Identifier: Apache-2.0
// The quantities of maps: what a cell receives from its server, which is the chosen transmitter or else the strongest,
// and from all others. Their formulas are those of `wavetracer coverage` (host/coverage).
"use strict";

const no_row = -1;
const {transmit_power_dbm: sent_dbm, noise_dbm: noise_floor_dbm} = meta.link_budget;
const power_of_db = (db) => 10 ** (db / 10), db_of_power = (power) => 10 * Math.log10(power);

// The links of the cells of a frame, by receivers.
class Reception {
  constructor() {
    const count = meta.receivers.length;
    this.server = new Int32Array(count);    // row of `links`, or no_row
    this.best = new Int32Array(count);      // that of the strongest transmitter, whichever is chosen
    this.second = new Int32Array(count);    // that of the next one
    this.others = new Float64Array(count);  // sum of the path gains of all but the server, as powers
  }

  // tx: the chosen transmitter, or -1 for the strongest.
  read(frame_row, tx) {
    for (const column of [this.server, this.best, this.second]) column.fill(no_row);
    this.others.fill(0);
    const {server, best, second} = this, [first, last] = links_of_frame(frame_row);
    const above = (k, other) => other === no_row || links.gain_db[k] > links.gain_db[other];
    for (let k = first; k < last; ++k) {
      const rx = links.rx[k];
      if (grid_of[rx] < 0 || !links.paths[k]) continue;
      if (above(k, best[rx])) [second[rx], best[rx]] = [best[rx], k];
      else if (above(k, second[rx])) second[rx] = k;
      if (links.tx[k] === tx) server[rx] = k;
    }
    if (tx < 0) server.set(best);
    if (meta.transmitters.length < 2) return;
    for (let k = first; k < last; ++k) {
      const rx = links.rx[k];
      if (grid_of[rx] >= 0 && links.paths[k] && k !== server[rx]) this.others[rx] += power_of_db(links.gain_db[k]);
    }
  }

  // Returns the gain of the server over that of the strongest other transmitter; NaN without one of them.
  margin(rx) {
    const server = this.server[rx], other = server === this.best[rx] ? this.second[rx] : this.best[rx];
    return other === no_row ? NaN : links.gain_db[server] - links.gain_db[other];
  }

  interference(rx) {
    return this.others[rx] > 0 ? sent_dbm + db_of_power(this.others[rx]) : NaN;
  }

  sinr(rx) {
    const disturbing = power_of_db(noise_floor_dbm) + power_of_db(sent_dbm) * this.others[rx];
    return sent_dbm + links.gain_db[this.server[rx]] - db_of_power(disturbing);
  }
}

// A quantity has its words, its unit, its value in a cell that has a server, whether the run has it, and the words for
// an infinite value. Values are counts in `counted` ones: rows of transmitters, no and yes, or numbers of beams.
const some_power = sent_dbm !== null, some_noise = some_power && noise_floor_dbm !== null;
const several = meta.transmitters.length > 1;
const of_server = (column, factor = 1) => ({server}, rx) => factor * links[column][server[rx]];
const {areas: some_areas, beams: some_beams} = meta.link_columns;
// Links without a gain through beams have no pair of them.
const beam_of = (k, side) => (Number.isFinite(links.beam_gain_db[k]) ? links[side][k] : NaN);
const beam_of_server = (side) => ({server}, rx) => beam_of(server[rx], side);
// Quantities with `of_link` have colours that hold for each transmitter, and not for the strongest alone.
const Quantities = {
  gain: {name: "path gain", words: "Path gain", unit: "dB", value: of_server("gain_db"), known: true,
         of_link: (k) => links.gain_db[k]},
  narrowband: {name: "narrowband gain", words: "Narrowband gain", unit: "dB", value: of_server("narrowband_gain_db"), known: true,
               of_link: (k) => links.narrowband_gain_db[k]},
  received: {name: "received power", words: "Received power", unit: "dBm", known: some_power,
             value: ({server}, rx) => sent_dbm + links.gain_db[server[rx]], of_link: (k) => sent_dbm + links.gain_db[k]},
  snr: {name: "SNR", words: "Signal to noise", unit: "dB", known: some_noise,
        value: ({server}, rx) => sent_dbm + links.gain_db[server[rx]] - noise_floor_dbm},
  sinr: {name: "SINR", words: "Signal to interference and noise", unit: "dB", known: some_noise && several,
         value: (cells, rx) => cells.sinr(rx)},
  interference: {name: "interference", words: "Power of the other transmitters", unit: "dBm", known: some_power && several,
                 value: (cells, rx) => cells.interference(rx)},
  server: {name: "best transmitter", words: "Strongest transmitter", counted: true, known: several,
           value: ({best}, rx) => links.tx[best[rx]]},
  margin: {name: "margin", words: "Path gain over the strongest other transmitter", unit: "dB", known: several,
           value: (cells, rx) => cells.margin(rx)},
  spread: {name: "delay spread", words: "Delay spread", unit: "ns", known: true, value: of_server("rms_delay_spread_s", 1e9)},
  k_factor: {name: "K factor", words: "Direct path over all others", unit: "dB", known: true,
             value: ({server}, rx) => db_of_power(links.k_factor[server[rx]]), infinite: "the direct path alone"},
  los: {name: "line of sight", words: "Line of sight", counted: true, known: true, value: of_server("los")},
  paths: {name: "number of paths", words: "Number of paths", unit: "", known: true, value: of_server("paths")},
  cell_mean: {name: "cell mean", words: "Mean gain over the cell", unit: "dB", known: some_areas,
              value: of_server("cell_mean_db")},
  fading: {name: "fading", words: "Fading within the cell", unit: "dB", known: some_areas,
           value: of_server("fading_db"), infinite: "the same power everywhere"},
  beam_gain: {name: "beam gain", words: "Gain through the best beams", unit: "dB", known: some_beams,
              value: of_server("beam_gain_db")},
  tx_beam: {name: "beam of the transmitter", words: "Beam of the transmitter", counted: true, known: some_beams,
            value: beam_of_server("tx_beam"), side: "tx_beam"},
  rx_beam: {name: "beam of the receiver", words: "Beam of the receiver", counted: true, known: some_beams,
            value: beam_of_server("rx_beam"), side: "rx_beam"},
};

// Returns the number of values of a counted quantity, which begin at 0.
function counted_values(quantity) {
  const {side} = Quantities[quantity];
  if (quantity === "los") return 2;
  return side ? links[side].reduce((most, value) => Math.max(most, value), 0) + 1 : meta.transmitters.length;
}

// Returns the values at two shares of all, in order: a few extreme cells would take the colours of the others.
function quantiles(values, low, high) {
  const sorted = Float64Array.from(values.filter(Number.isFinite)).sort();
  const at = (share) => sorted[Math.round(share * (sorted.length - 1))];
  return sorted.length ? [at(low), at(high)] : [0, 1];
}

// Returns the values of all cells in all frames.
function values_of_map(quantity) {
  const out = [], {value, of_link} = Quantities[quantity];
  if (of_link) {
    for (let k = 0; k < links.rx.length; ++k) if (grid_of[links.rx[k]] >= 0 && links.paths[k]) out.push(of_link(k));
    return out;
  }
  const cells = new Reception();
  for (let row = 0; row < meta.frames.length; ++row) {
    cells.read(row, -1);
    for (let rx = 0; rx < cells.server.length; ++rx) if (cells.server[rx] !== no_row) out.push(value(cells, rx));
  }
  return out;
}

// Returns the values of the darkest and of the brightest colour: multiples of 5 dB, or from 0 to a round number. They
// are the same in all frames.
function range_of(quantity) {
  const known = Quantities[quantity];
  if (known.range) return known.range;
  const values = values_of_map(quantity);
  if (known.unit.startsWith("dB")) {
    const [weak, strong] = quantiles(values, 0.01, 0.99), high = 5 * Math.ceil(strong / 5);
    known.range = [Math.min(Math.max(5 * Math.floor(weak / 5), high - 100), high - 5), high];
  } else {
    const [, most] = quantiles(values, 0, 0.98), power = 10 ** Math.floor(Math.log10(Math.max(most, 1)));
    known.range = [0, [1, 2, 5, 10].map((n) => n * power).find((n) => n >= most) || 1];
  }
  return known.range;
}

// Returns the value of a quantity in words.
function value_text(quantity, value) {
  const {unit, infinite, side} = Quantities[quantity];
  if (Number.isNaN(value)) return "no value";
  if (quantity === "los") return value ? "line of sight" : "other paths only";
  if (quantity === "server") return name_of(meta.transmitters, value);
  if (side) return `beam ${value}`;
  if (!Number.isFinite(value)) return infinite || "no power";
  return unit === "" ? String(value) : `${fixed(value, 1)} ${unit}`;
}
