// SPDX-License-Identifier: Apache-2.0
// Maps colour the cells of receiver grids by a quantity (quantities.js), weak dark and strong bright, and find the cell
// under the pointer. A cell without a value has no colour.
"use strict";

// The height of a corner is the mean of the cells that meet there; a flat grid and an upright one only need their four
// corners.
function map_geometry(grid) {
  const {columns, rows, z_m, first_m, column_m, row_m, rise_m} = grid;
  const even = rise_m !== 0 || z_m.every((z) => z === z_m[0]);
  const geometry = new THREE.PlaneBufferGeometry(columns, rows, even ? 1 : columns, even ? 1 : rows);
  const positions = geometry.attributes.position;
  for (let k = 0; k < positions.count; ++k) {  // the plane has cells of 1 x 1 around the origin
    const ix = positions.getX(k) + (columns - 1) / 2, iy = positions.getY(k) + (rows - 1) / 2;
    const [x, y] = [0, 1].map((axis) => first_m[axis] + ix * column_m[axis] + iy * row_m[axis]);
    positions.setXYZ(k, x, y, z_m[0] + iy * rise_m);
  }
  if (even) return geometry;
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

class Coverage {
  // largest: side in pixels that the browser can draw; 0 without WebGL.
  constructor(largest) {
    this.object = new THREE.Group();
    this.maps = [];
    this.problems = [];
    this.quantity = "gain";
    this.cells = new Reception();
    this.rows = this.cells.server;  // row of `links` that each cell shows
    this.rows.fill(no_row);
    for (const grid of grids) {
      const {columns, rows, first_m, column_m, row_m, rise_m} = grid;
      if (![...first_m, ...column_m, ...row_m, rise_m].every(Number.isFinite)) continue;
      if (!Math.hypot(...column_m) || !Math.hypot(...row_m, rise_m)) continue;
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
    this.cells.read(frame_row, tx);
    if (!this.object.visible) return;
    const colour = this.colours();
    this.holes = false;
    for (const {grid, pixels, texture} of this.maps) {
      for (let cell = 0; cell < grid.columns * grid.rows; ++cell) {
        const value = this.value(grid.first + cell), empty = Number.isNaN(value);
        this.holes = this.holes || empty;
        pixels[4 * cell + 3] = empty ? 0 : 255;
        if (!empty) pixels.set(colour(value), 4 * cell);
      }
      texture.needsUpdate = true;
    }
  }

  // Returns the value that the map shows for a receiver; NaN without one.
  value(rx) {
    return this.rows[rx] === no_row ? NaN : Quantities[this.quantity].value(this.cells, rx);
  }

  // Returns the colour of a value.
  colours() {
    if (Quantities[this.quantity].counted) {
      const table = this.counted_colours().map(rgb);
      return (value) => table[value % table.length];
    }
    const [low, high] = range_of(this.quantity), table = ramp_table(theme().map_stops);
    return (value) => {
      const step = Math.round((value - low) / (high - low) * (ramp_steps - 1));
      return table[Math.min(Math.max(step, 0), ramp_steps - 1) || 0];
    };
  }

  // Colours of the values 0, 1 and so on.
  counted_colours() {
    return this.quantity === "los" ? [...theme().los].reverse() : server_colours;
  }

  // Does the map show path gains? Colours of paths by power are then those of the map, so that one legend says both.
  shows_gain() {
    return this.maps.length > 0 && this.quantity === "gain";
  }

  // Returns the receiver whose cell the ray meets first, or -1; with_value: cells without a colour do not count.
  probe(raycaster, with_value = true) {
    if (!this.maps.length || !this.object.visible) return -1;
    for (const {object, uv} of raycaster.intersectObjects(this.maps.map(({mesh}) => mesh))) {
      const {grid} = this.maps.find(({mesh}) => mesh === object);
      const ix = Math.min(Math.floor(uv.x * grid.columns), grid.columns - 1);
      const iy = Math.min(Math.floor(uv.y * grid.rows), grid.rows - 1);
      const rx = grid.first + iy * grid.columns + ix;
      if (!with_value || this.rows[rx] !== no_row) return rx;
    }
    return -1;
  }

  // Returns the words for a cell under the pointer: its value, and its server where that may differ.
  words(rx) {
    if (this.rows[rx] === no_row) return "no path";
    const text = value_text(this.quantity, this.value(rx));
    return several && this.quantity !== "server" ? `${text}, ${name_of(meta.transmitters, links.tx[this.rows[rx]])}` : text;
  }

  // with_paths: whether the legend of paths above says what colours of path gains mean.
  draw_legend(parent, with_paths) {
    if (!this.maps.length || this.quantity === "none") return;
    const {words, unit, counted} = Quantities[this.quantity];
    if (!(with_paths && this.shows_gain())) {
      parent.append(element("div", `${words} of the map${unit ? `, ${unit}` : ""}`));
      if (!counted) parent.append(...legend_bar(...range_of(this.quantity), theme().map_stops));
    }
    if (counted) {
      for (const [value, colour] of this.counted_entries()) parent.append(legend_entry(colour, value_text(this.quantity, value)));
      if (counted_values(this.quantity) > this.counted_colours().length) parent.append(element("div", "and so on: colours repeat"));
    }
    if (this.holes) parent.append(legend_entry("transparent", "no colour: no path, or no value"));
  }

  // Values and colours of a legend; there are not more of them than colours.
  counted_entries() {
    const colours = this.counted_colours();
    return colours.slice(0, counted_values(this.quantity)).map((colour, value) => [value, colour]).reverse();
  }
}

// Fills the list of quantities with those that the run has.
function prepare_quantities() {
  const known = Object.entries(Quantities).filter(([, {known}]) => known).map(([key, {name}]) => [name, key]);
  control("quantity").replaceChildren(...[...known, ["none", "none"]].map((words) => new Option(...words)));
}

// Shows the value of the cell under the pointer beside it.
class PointerValue {
  // box: the element; cell_at(x, y): the receiver of the cell at a pixel, or -1; words(rx): the text.
  constructor(box, view, cell_at, words) {
    Object.assign(this, {box, view, cell_at, words, place: null, waiting: false, took_ms: 0});
    const hide = () => { this.place = null; box.hidden = true; };
    for (const event of ["pointerleave", "pointerdown", "wheel"]) view.addEventListener(event, hide, {passive: true});
    view.addEventListener("pointermove", (event) => {
      this.place = event.buttons ? null : [event.offsetX, event.offsetY];
      if (this.waiting) return;
      this.waiting = true;
      setTimeout(() => this.show(), Math.max(16, 2 * this.took_ms));  // a map on hills has many triangles to meet
    });
  }

  // Shows the present value, after the frame or the layer has changed.
  again() {
    if (!this.box.hidden && this.place) this.show();
  }

  show() {
    this.waiting = false;
    const start = performance.now(), rx = this.place ? this.cell_at(...this.place) : -1;
    this.took_ms = performance.now() - start;
    this.box.hidden = rx < 0;
    if (rx < 0) return;
    this.box.textContent = this.words(rx);
    const [x, y] = this.place, {offsetWidth: width, offsetHeight: height} = this.box;
    const left = x + width + 16 > this.view.clientWidth ? x - width - 12 : x + 12;
    this.box.style.transform = `translate(${left}px, ${Math.max(y - height - 8, 0)}px)`;
  }
}
