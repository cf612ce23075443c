// SPDX-License-Identifier: Apache-2.0
// Projects metres to pixels, and finds the nearest path or end of a pixel. Work is linear in the visible paths. Houses
// that hide a path are ignored: the nearest line on the screen is chosen.
"use strict";

class Projector {
  // width, height: pixels of the layout.
  constructor(camera, width, height) {
    this.m = new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).elements;
    this.width = width;
    this.height = height;
    this.near = camera.near;
  }

  // Writes x, y and depth along the view to out; a depth below `near` is not on the screen.
  clip(x, y, z, out) {
    const m = this.m;
    out[0] = m[0] * x + m[4] * y + m[8] * z + m[12];
    out[1] = m[1] * x + m[5] * y + m[9] * z + m[13];
    out[2] = m[3] * x + m[7] * y + m[11] * z + m[15];
  }

  screen(clipped, out) {
    out[0] = (clipped[0] / clipped[2] + 1) * this.width / 2;
    out[1] = (1 - clipped[1] / clipped[2]) * this.height / 2;
  }

  // Returns the pixel of point i of a column, or null if it is not in front of the camera.
  point(column, i) {
    const clipped = [0, 0, 0], out = [0, 0];
    this.clip(column[3 * i], column[3 * i + 1], column[3 * i + 2], clipped);
    if (!(clipped[2] > this.near)) return null;
    this.screen(clipped, out);
    return out;
  }

  // Returns the pixels of both ends of a segment, cut at the camera; null behind it.
  segment(points, k) {
    const a = [0, 0, 0], b = [0, 0, 0];
    this.clip(points[3 * k], points[3 * k + 1], points[3 * k + 2], a);
    this.clip(points[3 * k + 3], points[3 * k + 4], points[3 * k + 5], b);
    if (!(a[2] > this.near || b[2] > this.near)) return null;
    const cut = (behind, before) => {
      const t = (this.near - behind[2]) / (before[2] - behind[2]);
      for (let c = 0; c < 3; ++c) behind[c] += t * (before[c] - behind[c]);
    };
    if (a[2] < this.near) cut(a, b);
    if (b[2] < this.near) cut(b, a);
    this.screen(a, a);
    this.screen(b, b);
    return [a[0], a[1], b[0], b[1]];
  }
}

function distance_to_segment(x, y, [ax, ay, bx, by]) {
  const dx = bx - ax, dy = by - ay, square = dx * dx + dy * dy;
  const t = square > 0 ? Math.min(Math.max(((x - ax) * dx + (y - ay) * dy) / square, 0), 1) : 0;
  return Math.hypot(x - ax - t * dx, y - ay - t * dy);
}

// Tells whether points (three numbers each) all lie well inside of the picture, and not in one small spot of it.
function well_seen(points, projector) {
  const margin = 30, spot = 0.15 * Math.min(projector.width, projector.height);
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (let i = 0; 3 * i < points.length; ++i) {
    const at = projector.point(points, i);
    if (!at) return false;
    for (const axis of [0, 1]) {
      box[axis] = Math.min(box[axis], at[axis]);
      box[axis + 2] = Math.max(box[axis + 2], at[axis]);
    }
  }
  return box[0] >= margin && box[1] >= margin && box[2] <= projector.width - margin &&
    box[3] <= projector.height - margin && Math.max(box[2] - box[0], box[3] - box[1]) >= spot;
}

const pick_radius_px = 7;

// Returns rows of visible paths near the pixel, the nearest first; of equally near ones the strongest comes first.
function paths_near(frame, visible, projector, x, y) {
  const near = [];
  const points = new Float32Array(3 * (meta.highest_order + 2));
  for (const i of visible) {
    if (!drawable(frame, i)) continue;
    const last = order_of(frame, i) + 1;
    for (let k = 0; k <= last; ++k) write_point(frame, i, k, points, 3 * k);
    let least = Infinity;
    for (let k = 0; k < last; ++k) {
      const segment = projector.segment(points, k);
      if (segment) least = Math.min(least, distance_to_segment(x, y, segment));
    }
    if (least <= pick_radius_px) near.push([Math.round(least), i]);
  }
  near.sort((a, b) => a[0] - b[0] || frame.gain_db[b[1]] - frame.gain_db[a[1]]);
  return near.map(([, i]) => i);
}

// Ends at one place with one name are one radio: {name, tx, rx, m}, with -1 if it does not send or receive. Cells of
// grids are left out: they are drawn as maps.
function radios_of(frame) {
  const radios = new Map();
  const add = (role, ends, indices, column) => {
    for (const i of indices) {
      if (!finite(column, i)) continue;
      const [name] = ends[i], m = column.subarray(3 * i, 3 * i + 3), key = `${m.join(" ")} ${name}`;
      if (!radios.has(key)) radios.set(key, {name, tx: -1, rx: -1, m});
      radios.get(key)[role] = i;
    }
  };
  add("tx", meta.transmitters, meta.transmitters.keys(), frame.transmitter_m);
  add("rx", meta.receivers, own_receivers, frame.receiver_m);
  return [...radios.values()];
}

function radio_near(radios, projector, x, y) {
  let best = null, least = 10;
  for (const radio of radios) {
    const at = projector.point(radio.m, 0);
    const distance = at ? Math.hypot(at[0] - x, at[1] - y) : Infinity;
    if (distance < least) [best, least] = [radio, distance];
  }
  return best;
}
