// SPDX-License-Identifier: Apache-2.0
// The run's data on the page: metadata in `meta`, frames and scenes decoded from their blocks on demand. Coordinates
// are float32, in metres, relative to meta.centre_m in the coordinates of the scene file.
"use strict";

const meta = JSON.parse(document.getElementById("meta").textContent);
const no_instance = 0xFFFFFFFF;
const speed_of_light_m_s = 299792458;
// Kinds of paths, the least special first (wavetracer/interaction_kinds.hpp), and those of them that the run computed,
// or holds.
const path_kinds = meta.path_kinds;
const shown_kinds = [...path_kinds.keys()].filter((kind) => path_kinds[kind].shown);
const code_of = (interaction) => path_kinds.find((kind) => kind.interaction === interaction).code;
const words_of_kind = (kind) => path_kinds[kind].word.replace(/_/g, " ");

// Writes 12345 as 12,345, as the program does.
const grouped = (number) => number.toLocaleString("en-US");

// Empty places of a live world have no names.
const is_taken = ([name]) => name !== "" || !meta.reload_s;

function block(name) {
  const element = document.getElementById("block_" + name);
  const text = atob(element ? element.textContent : "");
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}

// Cells of grids are receivers like others. The page holds their heights alone: names and places follow from the grid.
const grids = meta.grids.map((grid, number) => ({...grid, z_m: new Float32Array(block("grid_" + number))}));
const own_receivers = [];  // indices of receivers that are no cells
const cell_count = grids.reduce((sum, {columns, rows}) => sum + columns * rows, 0);
const cell_m = new Float32Array(3 * (meta.receivers.length + cell_count));
const grid_of = new Int16Array(cell_m.length / 3).fill(-1);  // grid of each receiver, or -1 for none
meta.receivers = (() => {
  const all = [];
  grids.forEach(({name, first, columns, rows, first_m, column_m, row_m, z_m, antenna, polarization}, number) => {
    for (let cell = 0; cell < columns * rows; ++cell) {
      const ix = cell % columns, iy = Math.floor(cell / columns), rx = first + cell;
      all[rx] = [`${name}/${ix},${iy}`, antenna, polarization];
      cell_m.set([...[0, 1].map((axis) => first_m[axis] + ix * column_m[axis] + iy * row_m[axis]), z_m[cell]], 3 * rx);
      grid_of[rx] = number;
    }
  });
  let rx = 0;
  for (const end of meta.receivers) {
    while (grid_of[rx] >= 0) ++rx;
    own_receivers.push(rx);
    all[rx++] = end;
  }
  return all;
})();

// Reads the columns of a buffer, one after the other.
class Columns {
  constructor(buffer) {
    this.buffer = buffer;
    this.at = 0;
  }
  take(Type, count) {
    const column = new Type(this.buffer, this.at, count);
    this.at += column.byteLength;
    return column;
  }
}

// Paths are sorted by gain, the weakest first.
function decode_frame(row) {
  const from = new Columns(block("frame_" + row));
  const [paths, vertices, poses] = from.take(Uint32Array, 3);
  const ports = meta.rx_ports * meta.tx_ports;
  const frame = {row, number: meta.frames[row][0], time_s: meta.frames[row][1] || 0, total: meta.frames[row][2], paths, poses};
  const take = (name, Type, count) => { frame[name] = from.take(Type, count); };
  take("transmitter_m", Float32Array, 3 * meta.transmitters.length);
  take("own_m", Float32Array, 3 * own_receivers.length);
  frame.receiver_m = own_receivers.length === meta.receivers.length ? frame.own_m : cell_m.slice();
  if (frame.receiver_m !== frame.own_m)
    own_receivers.forEach((rx, k) => frame.receiver_m.set(frame.own_m.subarray(3 * k, 3 * k + 3), 3 * rx));
  take("pose_m", Float32Array, 3 * poses);
  take("pose_instance", Uint32Array, poses);
  take("delay_s", Float32Array, paths);
  take("gain_db", Float32Array, paths);
  take("doppler_hz", Float32Array, paths);
  take("a", Float32Array, 2 * ports * paths);
  take("tx", Uint32Array, paths);
  take("rx", Uint32Array, paths);
  take("vertex_end", Uint32Array, paths);
  take("vertex_m", Float32Array, 3 * vertices);
  take("vertex_surface", Uint32Array, vertices);
  take("vertex_instance", Uint32Array, vertices);
  take("pose_rotation", Int16Array, 4 * poses);
  for (const name of ["aod_theta", "aod_phi", "aoa_theta", "aoa_phi"]) take(name, Int16Array, paths);
  take("vertex_interaction", Uint8Array, vertices);
  frame.kind = new Uint8Array(paths);
  for (let i = 0; i < paths; ++i) frame.kind[i] = path_kind(frame, i);
  return frame;
}

const first_vertex = (frame, i) => (i === 0 ? 0 : frame.vertex_end[i - 1]);
const order_of = (frame, i) => frame.vertex_end[i] - first_vertex(frame, i);
// Returns an angle of a column in degrees.
const degrees = (column, i) => column[i] * 180 / 32767;

// Returns an index into path_kinds, by the most special interaction.
function path_kind(frame, i) {
  let met = 0;
  for (let k = first_vertex(frame, i); k < frame.vertex_end[i]; ++k) met |= frame.vertex_interaction[k];
  let kind = path_kinds.length - 1;
  while (kind > 0 && !(met & path_kinds[kind].code)) --kind;
  return kind;
}

// The last few frames that were used.
const decoded = new Map();
function frame_data(row) {
  const known = decoded.get(row);
  if (known) return known;
  const frame = decode_frame(row);
  decoded.set(row, frame);
  if (decoded.size > 4) decoded.delete(decoded.keys().next().value);
  return frame;
}

function decode_scene(description) {
  const read = (name, Type) => new Type(block(description.prefix + "_" + name));
  return {
    ...description,
    vertices: read("vertices", Float32Array), triangles: read("triangles", Uint32Array),
    triangle_surface: read("triangle_surface", Uint32Array), surface_material: read("surface_material", Uint32Array),
    surface_object: read("surface_object", Uint32Array), outlines: read("outlines", Uint32Array),
    wedges: read("wedges", Float32Array), wedge_surface: read("wedge_surface", Uint32Array),
    wedge_shown: read("wedge_shown", Uint8Array),
  };
}

const city = decode_scene(meta.scene);
const models = meta.models.map(decode_scene);
// The name of each vegetation material and the corners of its triangles.
const vegetation = (() => {
  const from = new Columns(block("vegetation"));
  return meta.vegetation.map(([name, triangles]) => [name, from.take(Float32Array, 9 * triangles)]);
})();
const streets = {
  vertices: new Float32Array(block("street_vertices")), triangles: new Uint32Array(block("street_triangles")),
};

// Links of all frames, sorted by frame, transmitter, receiver. They include paths that the page leaves out.
const links = (() => {
  const from = new Columns(block("links"));
  return {
    frame: from.take(Uint32Array, meta.links), tx: from.take(Uint32Array, meta.links),
    rx: from.take(Uint32Array, meta.links), paths: from.take(Uint32Array, meta.links),
    gain_db: from.take(Float32Array, meta.links), narrowband_gain_db: from.take(Float32Array, meta.links),
    rms_delay_spread_s: from.take(Float32Array, meta.links),
    missed_power_share: from.take(Float32Array, meta.links), k_factor: from.take(Float32Array, meta.links),
    ...(meta.link_columns.areas
      ? {cell_mean_db: from.take(Float32Array, meta.links), fading_db: from.take(Float32Array, meta.links)} : {}),
    ...(meta.link_columns.beams
      ? {beam_gain_db: from.take(Float32Array, meta.links), tx_beam: from.take(Uint16Array, meta.links),
         rx_beam: from.take(Uint16Array, meta.links)} : {}),
    los: from.take(Uint8Array, meta.links),
  };
})();

// Returns the rows of `links` of a frame: first, and one after the last.
function links_of_frame(row) {
  const first = (wanted) => {
    let low = 0, high = links.frame.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (links.frame[middle] < wanted) low = middle + 1; else high = middle;
    }
    return low;
  };
  return [first(row), first(row + 1)];
}

// Returns the row of a link in a frame, or -1.
function link_row(row, tx, rx) {
  let [low, high] = links_of_frame(row);
  const end = high;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (links.tx[middle] < tx || (links.tx[middle] === tx && links.rx[middle] < rx)) low = middle + 1; else high = middle;
  }
  return low < end && links.tx[low] === tx && links.rx[low] === rx ? low : -1;
}

// Describes the place of a path's vertex in words.
function place_of(frame, k) {
  const instance = frame.vertex_instance[k], number = frame.vertex_surface[k];
  const [id, , model] = instance === no_instance ? ["", "", -1] : meta.instances[instance];
  const scene = instance === no_instance ? city : models[model];
  const on = instance === no_instance ? "" : ", vehicle " + id;
  if (frame.vertex_interaction[k] === code_of("target")) return `point ${number}${on}`;
  const edge = frame.vertex_interaction[k] === code_of("diffraction");
  if (scene === city && !edge && number >= city.surface_material.length && city.surface_material.length)
    return `vegetation ${number - city.surface_material.length}`;
  const surfaces = edge ? (scene ? Array.from(scene.wedge_surface.subarray(2 * number, 2 * number + 2)) : []) : [number];
  const names = [];
  for (const surface of surfaces) {
    if (!scene || surface >= scene.surface_material.length) continue;
    const name = scene.materials[scene.surface_material[surface]] + " of " + scene.objects[scene.surface_object[surface]];
    if (!names.includes(name)) names.push(name);
  }
  return `${edge ? "edge" : "surface"} ${number}${names.length ? ", " + names.join(" and ") : ""}${on}`;
}
