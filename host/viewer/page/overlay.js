// SPDX-License-Identifier: Apache-2.0
// The overlay of the picture: marks and names of ends, the selected path, a scale. It is drawn in two dimensions. Names
// do not overlap: one without a free place is left out, and those of the chosen link come first.
"use strict";

const most_names = 80;

// Boxes [left, top, right, bottom] in pixels that nothing else may cover, stored by squares, so that a test looks at
// few boxes.
class TakenBoxes {
  constructor() {
    this.squares = new Map();
  }

  keys([left, top, right, bottom]) {
    const side = 48, keys = [];
    for (let y = Math.floor(top / side); y <= Math.floor(bottom / side); ++y)
      for (let x = Math.floor(left / side); x <= Math.floor(right / side); ++x) keys.push(x * 65536 + y);
    return keys;
  }

  add(box) {
    for (const key of this.keys(box)) {
      if (!this.squares.has(key)) this.squares.set(key, []);
      this.squares.get(key).push(box);
    }
  }

  free(box) {
    const apart = (t) => t[2] < box[0] || t[0] > box[2] || t[3] < box[1] || t[1] > box[3];
    return this.keys(box).every((key) => (this.squares.get(key) || []).every(apart));
  }
}

// Draws an end: a triangle sends, a circle receives, a diamond does both.
function draw_mark(pen, radio, x, y, size) {
  const colours = theme();
  pen.beginPath();
  if (radio.tx >= 0 && radio.rx >= 0) {
    pen.moveTo(x, y - size); pen.lineTo(x + size, y); pen.lineTo(x, y + size); pen.lineTo(x - size, y);
    pen.fillStyle = colours.both;
  } else if (radio.tx >= 0) {
    pen.moveTo(x, y - size); pen.lineTo(x + size * 0.9, y + size * 0.7); pen.lineTo(x - size * 0.9, y + size * 0.7);
    pen.fillStyle = colours.tx;
  } else {
    pen.arc(x, y, size * 0.8, 0, 2 * Math.PI);
    pen.fillStyle = colours.rx;
  }
  pen.closePath();
  pen.fill();
  pen.lineWidth = 1.5;
  pen.strokeStyle = colours.halo;
  pen.stroke();
}

// Adds the marks of the ends that there are, and the colour of vehicles, to the legend.
function draw_mark_legend(parent, radios, vehicles) {
  const both = {tx: 0, rx: 0}, tx = {tx: 0, rx: -1}, rx = {tx: -1, rx: 0}, size = 14, line = document.createElement("div");
  const like = (kind) => radios.some((one) => (one.tx >= 0) === (kind.tx >= 0) && (one.rx >= 0) === (kind.rx >= 0));
  for (const [kind, text] of [[tx, "transmitter"], [rx, "receiver"], [both, "sends and receives"]].filter(([one]) => like(one))) {
    const entry = document.createElement("span"), mark = document.createElement("canvas"), pen = mark.getContext("2d");
    entry.className = "entry";
    mark.className = "mark";
    mark.width = mark.height = 2 * size;
    pen.scale(2, 2);
    draw_mark(pen, kind, size / 2, size / 2, 5.5);
    entry.append(mark, text);
    line.append(entry);
  }
  if (vehicles) line.append(legend_entry(theme().vehicle, "vehicle"));
  line.className = "marks";
  if (line.firstChild) parent.append(line);
}

function halo_text(pen, text, x, y) {
  pen.lineWidth = 3.5;
  pen.lineJoin = "round";
  pen.strokeStyle = theme().halo;
  pen.strokeText(text, x, y);
  pen.fillStyle = theme().text;
  pen.fillText(text, x, y);
}

const shortened = (name, most) => (name.length > most ? name.slice(0, most - 1) + "\u2026" : name);

class Overlay {
  constructor(canvas) {
    this.canvas = canvas;
    this.names = [];  // names that were drawn
  }

  resize(width, height, ratio) {
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.ratio = ratio;
    this.width = width;
    this.height = height;
  }

  // state: {frame, radios, selected, link, labels}; selected is a row of the frame or -1.
  draw(state, projector) {
    const pen = this.canvas.getContext("2d");
    pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    pen.clearRect(0, 0, this.width, this.height);
    if (state.selected >= 0) this.draw_path(pen, state.frame, state.selected, projector);
    if (grid_of[state.link[1]] >= 0) this.draw_cell(pen, state.frame, state.link[1], projector);
    const shown = [];
    for (const radio of state.radios) {
      const at = projector.point(radio.m, 0);
      if (!at || at[0] < 0 || at[1] < 0 || at[0] > this.width || at[1] > this.height) continue;
      const chosen = (radio.tx >= 0 && radio.tx === state.link[0]) || (radio.rx >= 0 && radio.rx === state.link[1]);
      shown.push({radio, at, chosen});
    }
    shown.sort((a, b) => a.chosen - b.chosen);
    for (const {radio, at, chosen} of shown) draw_mark(pen, radio, at[0], at[1], chosen ? 9 : 6);
    this.names = [];
    if (state.labels) this.draw_names(pen, shown.reverse());
    this.draw_scale(pen, projector, state.target);
  }

  draw_names(pen, shown) {
    pen.font = "12px system-ui, 'DejaVu Sans', sans-serif";
    pen.textBaseline = "middle";
    // There are marks for all, but no overlapping names.
    const taken = new TakenBoxes();
    for (const {at} of shown) taken.add([at[0] - 5, at[1] - 5, at[0] + 5, at[1] + 5]);
    for (const {radio, at, chosen} of shown) {
      if (this.names.length === most_names) break;
      if (!radio.name) continue;
      const text = shortened(radio.name, 28), w = pen.measureText(text).width;
      for (const [x, y] of [[10, 0], [-10 - w, 0], [-w / 2, -15], [-w / 2, 15]]) {
        const box = [at[0] + x - 2, at[1] + y - 8, at[0] + x + w + 2, at[1] + y + 8];
        const free = box[0] >= 0 && box[2] <= this.width && box[1] >= 0 && box[3] <= this.height && taken.free(box);
        if (!free) continue;
        taken.add(box);
        pen.font = `${chosen ? "bold " : ""}12px system-ui, 'DejaVu Sans', sans-serif`;
        halo_text(pen, text, at[0] + x, at[1] + y);
        pen.font = "12px system-ui, 'DejaVu Sans', sans-serif";
        this.names.push(radio.name);
        break;
      }
    }
  }

  // Draws the frame of a cell of a map.
  draw_cell(pen, frame, rx, projector) {
    const {column_m, row_m, rise_m} = grids[grid_of[rx]], [x, y, z] = frame.receiver_m.subarray(3 * rx, 3 * rx + 3);
    const signs = [[-1, -1], [1, -1], [1, 1], [-1, 1]];
    const corners = new Float32Array(signs.flatMap(([u, v]) => [
      x + (u * column_m[0] + v * row_m[0]) / 2, y + (u * column_m[1] + v * row_m[1]) / 2, z + v * rise_m / 2]));
    const at = [0, 1, 2, 3].map((k) => projector.point(corners, k));
    if (!at.every(Boolean)) return;
    // A cell that is small on the screen gets a wider frame.
    const middle = [0, 1].map((axis) => at.reduce((sum, point) => sum + point[axis], 0) / 4);
    const scale = Math.max(1, 7 / Math.max(...at.map((point) => Math.hypot(point[0] - middle[0], point[1] - middle[1]))));
    for (const [width, colour] of [[4.5, theme().halo], [2, theme().selected]]) {
      pen.beginPath();
      for (const point of at) pen.lineTo(...[0, 1].map((axis) => middle[axis] + scale * (point[axis] - middle[axis])));
      pen.closePath();
      pen.lineWidth = width;
      pen.strokeStyle = colour;
      pen.stroke();
    }
  }

  draw_path(pen, frame, i, projector) {
    if (!drawable(frame, i)) return;
    const points = points_of(frame, i), order = order_of(frame, i);
    for (const [width, colour] of [[6, theme().halo], [2.5, theme().selected]]) {
      pen.beginPath();
      for (let k = 0; k <= order; ++k) {
        const segment = projector.segment(points, k);
        if (!segment) continue;
        pen.moveTo(segment[0], segment[1]);
        pen.lineTo(segment[2], segment[3]);
      }
      pen.lineCap = "round";
      pen.lineWidth = width;
      pen.strokeStyle = colour;
      pen.stroke();
    }
    pen.font = "bold 11px system-ui, 'DejaVu Sans', sans-serif";
    pen.textBaseline = "middle";
    pen.textAlign = "center";
    for (let k = 1; k <= order; ++k) {
      const at = projector.point(points, k);
      if (!at) continue;
      pen.beginPath();
      pen.arc(at[0], at[1], 8, 0, 2 * Math.PI);
      pen.fillStyle = theme().selected;
      pen.fill();
      pen.fillStyle = theme().halo;
      pen.fillText(String(k), at[0], at[1] + 0.5);
    }
    pen.textAlign = "left";
  }

  // Draws the scale at the camera's target.
  draw_scale(pen, projector, target) {
    const {x, y, z} = target, points = new Float32Array([x, y, z, x, y, z + 1]);
    const camera = projector.m, right = [camera[0], camera[4], camera[8]];  // the screen's x axis, scaled
    const length = Math.hypot(...right);
    for (let axis = 0; axis < 3; ++axis) points[3 + axis] = points[axis] + right[axis] / length;
    const segment = projector.segment(points, 0);
    const pixels = segment ? Math.hypot(segment[2] - segment[0], segment[3] - segment[1]) : 0;
    if (!(pixels > 0)) return;
    const power = 10 ** Math.floor(Math.log10(120 / pixels));
    const metres = [1, 2, 5].map((n) => n * power).filter((n) => n * pixels <= 120).pop();
    const x0 = 16, y0 = this.height - 16, x1 = x0 + metres * pixels;
    for (const [width, colour] of [[4, theme().halo], [1.5, theme().text]]) {
      pen.beginPath();
      pen.moveTo(x0, y0 - 5); pen.lineTo(x0, y0); pen.lineTo(x1, y0); pen.lineTo(x1, y0 - 5);
      pen.lineWidth = width;
      pen.strokeStyle = colour;
      pen.stroke();
    }
    pen.font = "12px system-ui, 'DejaVu Sans', sans-serif";
    pen.textBaseline = "middle";
    halo_text(pen, `${+metres.toPrecision(1)} m`, x0 + 4, y0 - 12);
  }
}
