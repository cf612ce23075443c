// SPDX-License-Identifier: Apache-2.0
// Finds the flat roofs of a scene: level surfaces from whose edge a wall goes down.
// Corners are compared by their positions, to a millimetre, because walls and roofs need not share vertices.
"use strict";

// Tells for each triangle whether it belongs to a flat roof.
function roof_triangles(scene) {
  const count = scene.triangle_surface.length, roofs = new Uint8Array(count), corner = place_numbers(scene.vertices);
  const z = (t, k) => scene.vertices[3 * scene.triangles[3 * t + k] + 2];
  const steep = new Float32Array(count);  // horizontal part of the normal: 0 for a level triangle, 1 for a wall
  for (let t = 0; t < count; ++t) steep[t] = steepness(scene, t);
  const edge = (t, k) => {
    const a = corner[scene.triangles[3 * t + k]], b = corner[scene.triangles[3 * t + (k + 1) % 3]];
    return Math.min(a, b) * corner.length + Math.max(a, b);
  };
  const under = new Set();  // upper edges of walls
  for (let t = 0; t < count; ++t) {
    if (!(steep[t] > 0.95)) continue;
    for (let k = 0; k < 3; ++k) {
      const rim = Math.min(z(t, k), z(t, (k + 1) % 3));
      if (z(t, (k + 2) % 3) < rim - 0.5) under.add(edge(t, k));
    }
  }
  const surfaces = new Set();
  for (let t = 0; t < count; ++t)
    for (let k = 0; k < 3; ++k)
      if (steep[t] < 0.1 && under.has(edge(t, k))) surfaces.add(scene.triangle_surface[t]);
  for (let t = 0; t < count; ++t) roofs[t] = surfaces.has(scene.triangle_surface[t]);
  return roofs;
}

// Vertices at one position get one number.
function place_numbers(vertices) {
  const known = new Map(), numbers = new Uint32Array(vertices.length / 3);
  for (let i = 0; i < numbers.length; ++i) {
    const key = [0, 1, 2].map((axis) => Math.round(1000 * vertices[3 * i + axis])).join(" ");
    if (!known.has(key)) known.set(key, known.size);
    numbers[i] = known.get(key);
  }
  return numbers;
}

function steepness(scene, t) {
  const vertex = (k) => 3 * scene.triangles[3 * t + k];
  const [a, b, c] = [0, 1, 2].map((k) => scene.vertices.subarray(vertex(k), vertex(k) + 3));
  if (a.length + b.length + c.length !== 9) return NaN;  // the index is damaged
  const u = [0, 1, 2].map((k) => b[k] - a[k]), v = [0, 1, 2].map((k) => c[k] - a[k]);
  const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  return Math.hypot(normal[0], normal[1]) / Math.hypot(...normal);
}
