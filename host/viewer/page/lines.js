// SPDX-License-Identifier: Apache-2.0
// The visible paths of a frame as one object of line segments, whose buffers are rewritten when the filter changes.
// Frames hold the weakest path first, so the strongest lie on top.
// A path with a point that is not a number, or an absent end, is counted but not drawn.
"use strict";

// Opacities of the four quarters of the power scale, the weakest first. Thousands of opaque paths would be one blot.
const opacities_of_few = [0.85, 0.85, 0.85, 0.85], opacities_of_many = [0.1, 0.25, 0.6, 0.9];
const many_paths = 400;
// Paths weaker than the strongest visible one by more than this are clutter.
const clutter_db = 60, clutter_opacity = 0.07;

class PathLines {
  constructor() {
    this.materials = [clutter_opacity, ...opacities_of_few].map(
      () => new THREE.LineBasicMaterial({vertexColors: THREE.VertexColors, transparent: true}));
    this.object = new THREE.LineSegments(new THREE.BufferGeometry(), this.materials);
    this.object.frustumCulled = false;
    this.object.renderOrder = 2;
    this.reserve(1024);
    this.visible = new Uint32Array(0);  // rows of the frame that pass the filter
    this.segments = 0;
    this.fade = true;  // clutter is faded
    this.faded = 0;  // number of faded paths
  }

  // wanted: whether paths are visible behind houses.
  through_houses(wanted) {
    for (const material of this.materials) material.depthTest = !wanted;
  }

  reserve(segments) {
    if (this.positions && this.positions.length >= 6 * segments) return;
    this.positions = new Float32Array(6 * segments);
    this.colours = new Uint8Array(8 * segments);  // four bytes per point: aligned
    this.object.geometry.dispose();
    const geometry = new THREE.BufferGeometry();
    this.position_attribute = new THREE.BufferAttribute(this.positions, 3);
    const colours = new THREE.InterleavedBuffer(this.colours, 4);
    this.colour_buffer = colours;
    geometry.setAttribute("position", this.position_attribute);
    geometry.setAttribute("color", new THREE.InterleavedBufferAttribute(colours, 3, 0, true));
    this.object.geometry = geometry;
  }

  // wanted: whether row i is shown; by: the quantity that colours show; scale: colours of powers.
  rebuild(frame, wanted, by, scale) {
    const rows = new Uint32Array(frame.paths);
    let count = 0, most = 0;
    for (let i = 0; i < frame.paths; ++i)
      if (wanted(frame, i)) {
        rows[count++] = i;
        most += order_of(frame, i) + 1;
      }
    this.visible = rows.subarray(0, count);
    this.reserve(most);
    const [table, key] = path_colours(frame, by, scale);
    const opacities = count > many_paths ? opacities_of_many : opacities_of_few;
    this.materials.forEach((material, part) => { material.opacity = part ? opacities[part - 1] : clutter_opacity; });
    const starts = new Array(this.materials.length + 1).fill(0);  // number of segments before each part: clutter, four quarters
    const clutter = this.fade ? strongest_db(frame, this.visible) - clutter_db : -Infinity;
    this.faded = 0;
    let segment = 0, part = 0;  // parts lie one after the other: gains ascend, NaN comes last
    for (const i of this.visible) {
      if (!drawable(frame, i)) continue;
      const colour = table[key(i)], last = order_of(frame, i) + 1;
      const share = (frame.gain_db[i] - lowest_db) / (highest_db - lowest_db);
      const faded = frame.gain_db[i] < clutter;
      part = Math.max(part, faded ? 0 : share > 0 ? 1 + Math.min(Math.floor(4 * share), 3) : 1);
      this.faded += faded;
      for (let later = part + 1; later < starts.length; ++later) starts[later] = segment + last;
      for (let k = 0; k < last; ++k, ++segment) {
        write_point(frame, i, k, this.positions, 6 * segment);
        write_point(frame, i, k + 1, this.positions, 6 * segment + 3);
        for (let point = 0; point < 2; ++point)
          for (let c = 0; c < 3; ++c) this.colours[8 * segment + 4 * point + c] = colour[c];
      }
    }
    this.segments = segment;
    this.position_attribute.needsUpdate = true;
    this.colour_buffer.needsUpdate = true;
    this.object.geometry.clearGroups();
    this.materials.forEach((_, part) =>
      this.object.geometry.addGroup(2 * starts[part], 2 * (starts[part + 1] - starts[part]), part));
  }
}

// Rows ascend in gain, and end with those that are NaN.
function strongest_db(frame, rows) {
  for (let k = rows.length - 1; k >= 0; --k) if (Number.isFinite(frame.gain_db[rows[k]])) return frame.gain_db[rows[k]];
  return -Infinity;
}

// Writes point k of path i: the transmitter, its vertices, the receiver.
function write_point(frame, i, k, out, at) {
  const first = first_vertex(frame, i), order = frame.vertex_end[i] - first;
  let from = frame.vertex_m, row = first + k - 1;
  if (k === 0) [from, row] = [frame.transmitter_m, frame.tx[i]];
  else if (k > order) [from, row] = [frame.receiver_m, frame.rx[i]];
  out[at] = from[3 * row];
  out[at + 1] = from[3 * row + 1];
  out[at + 2] = from[3 * row + 2];
}

function points_of(frame, i) {
  const points = new Float32Array(3 * (order_of(frame, i) + 2));
  for (let k = 0; 3 * k < points.length; ++k) write_point(frame, i, k, points, 3 * k);
  return points;
}

function drawable(frame, i) {
  if (!finite(frame.transmitter_m, frame.tx[i]) || !finite(frame.receiver_m, frame.rx[i])) return false;
  for (let k = first_vertex(frame, i); k < frame.vertex_end[i]; ++k) if (!finite(frame.vertex_m, k)) return false;
  return true;
}
