// SPDX-License-Identifier: Apache-2.0
// Maps colour the cells of receiver grids by their reception, and find the cell under the pointer.
// A cell without a path has no colour. With several transmitters a cell shows the strongest.
"use strict";

const no_row = -1;

// The height of a corner is the mean of the cells that meet there; a flat grid only needs its four corners.
function map_geometry(grid) {
  const {columns, rows, z_m, first_m: [x0, y0], step_m: [dx, dy]} = grid;
  const flat = z_m.every((z) => z === z_m[0]);
  const geometry = new THREE.PlaneBufferGeometry(columns * dx, rows * dy, flat ? 1 : columns, flat ? 1 : rows);
  geometry.translate(x0 + (columns - 1) * dx / 2, y0 + (rows - 1) * dy / 2, flat ? z_m[0] : 0);
  if (flat) return geometry;
  const positions = geometry.attributes.position;
  for (let y = 0; y <= rows; ++y)
    for (let x = 0; x <= columns; ++x) {
      let sum = 0, count = 0;
      for (const iy of [y - 1, y])
        for (const ix of [x - 1, x])
          if (ix >= 0 && iy >= 0 && ix < columns && iy < rows) [sum, count] = [sum + z_m[iy * columns + ix], count + 1];
      positions.setZ((rows - y) * (columns + 1) + x, sum / count);  // the plane's rows go down
    }
  return geometry;
}

// Returns the values at two shares of all, in order: a few extreme cells would take the colours of the others.
function quantiles(values, low, high) {
  const sorted = values.filter(Number.isFinite).sort();
  const at = (share) => sorted[Math.round(share * (sorted.length - 1))];
  return sorted.length ? [at(low), at(high)] : [0, 1];
}

// The quantities of maps: words, unit, the value of a row of `links`, and the lowest and highest colour.
const Quantities = {
  gain: {words: "Path gain of the map, dB", value: (k) => links.gain_db[k]},
  spread: {words: "Delay spread of the map, ns", value: (k) => links.rms_delay_spread_s[k] * 1e9},
  los: {words: "Map"},
};

function colour_ranges() {
  const cells = [];
  for (let k = 0; k < links.rx.length; ++k) if (grid_of[links.rx[k]] >= 0 && links.paths[k]) cells.push(k);
  const values = (quantity) => Float32Array.from(cells, Quantities[quantity].value);
  const [weak, strong] = quantiles(values("gain"), 0.01, 0.99), high = 5 * Math.ceil(strong / 5);
  Quantities.gain.range = [Math.min(Math.max(5 * Math.floor(weak / 5), high - 100), high - 5), high];
  const [, spread] = quantiles(values("spread"), 0, 0.98), power = 10 ** Math.floor(Math.log10(Math.max(spread, 1)));
  Quantities.spread.range = [0, [1, 2, 5, 10].map((n) => n * power).find((n) => n >= spread) || 1];
}

class Coverage {
  // largest: side in pixels that the browser can draw; 0 without WebGL.
  constructor(largest) {
    this.object = new THREE.Group();
    this.maps = [];
    this.problems = [];
    this.quantity = "gain";
    this.rows = new Int32Array(meta.receivers.length).fill(no_row);  // row of `links` with the best reception of each cell
    if (!grids.length) return;
    colour_ranges();
    for (const grid of grids) {
      const {columns, rows, first_m, step_m} = grid;
      if (![...first_m, ...step_m].every(Number.isFinite) || !step_m[0] || !step_m[1]) continue;
      if (Math.max(columns, rows) > largest) {
        if (largest) this.problems.push(`The map of ${grid.name} has more cells in a row than this browser can draw.`);
        continue;
      }
      const pixels = new Uint8Array(4 * columns * rows);
      const texture = new THREE.DataTexture(pixels, columns, rows, THREE.RGBAFormat);
      const material = new THREE.MeshBasicMaterial({map: texture, alphaTest: 0.5, side: THREE.DoubleSide});
      const mesh = new THREE.Mesh(map_geometry(grid), material);
      this.maps.push({grid, pixels, texture, mesh});
      this.object.add(mesh);
    }
  }

  // Colours all maps; tx: only this transmitter, -1: the strongest.
  paint(frame_row, tx, quantity) {
    if (!this.maps.length) return;
    this.quantity = quantity;
    this.object.visible = quantity !== "none";
    this.rows.fill(no_row);
    const [first, last] = links_of_frame(frame_row);
    for (let k = first; k < last; ++k) {
      const rx = links.rx[k], best = this.rows[rx];
      if (grid_of[rx] < 0 || !links.paths[k] || (tx >= 0 && links.tx[k] !== tx)) continue;
      if (best === no_row || links.gain_db[k] > links.gain_db[best]) this.rows[rx] = k;
    }
    if (!this.object.visible) return;
    const colour = this.colours();
    for (const {grid, pixels, texture} of this.maps) {
      for (let cell = 0; cell < grid.columns * grid.rows; ++cell) {
        const k = this.rows[grid.first + cell];
        pixels[4 * cell + 3] = k === no_row ? 0 : 255;
        if (k !== no_row) pixels.set(colour(k), 4 * cell);
      }
      texture.needsUpdate = true;
    }
  }

  // Sets the colour of each row of `links`.
  colours() {
    if (this.quantity === "los") {
      const [direct, around] = theme().los.map(rgb);
      return (k) => (links.los[k] ? direct : around);
    }
    const {range: [low, high], value} = Quantities[this.quantity], table = ramp_table();
    return (k) => {
      const step = Math.round((value(k) - low) / (high - low) * (ramp_steps - 1));
      return table[Math.min(Math.max(step, 0), ramp_steps - 1) || 0];
    };
  }

  // Returns the receiver whose cell the ray meets first, or -1 if it meets none with a colour.
  probe(raycaster) {
    if (!this.maps.length || !this.object.visible) return -1;
    for (const {object, uv} of raycaster.intersectObjects(this.maps.map(({mesh}) => mesh))) {
      const {grid} = this.maps.find(({mesh}) => mesh === object);
      const ix = Math.min(Math.floor(uv.x * grid.columns), grid.columns - 1);
      const iy = Math.min(Math.floor(uv.y * grid.rows), grid.rows - 1);
      const rx = grid.first + iy * grid.columns + ix;
      if (this.rows[rx] !== no_row) return rx;
    }
    return -1;
  }

  draw_legend(parent) {
    if (!this.maps.length || this.quantity === "none") return;
    parent.append(element("div", Quantities[this.quantity].words));
    if (this.quantity !== "los") return parent.append(...legend_bar(...Quantities[this.quantity].range));
    for (const [colour, words] of [[theme().los[0], "line of sight"], [theme().los[1], "other paths only"]])
      parent.append(legend_entry(colour, words));
  }
}
