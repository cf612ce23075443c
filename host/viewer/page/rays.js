// SPDX-License-Identifier: Apache-2.0
// Sampled rays of a frame (waypoints.h5): their segments, the places of their hits, and the centroid of these at each
// depth. Rays search for paths; most of them find none.
"use strict";

const launch_kind = 0, miss_kind = 4, traced_source = 1, cache_source = 2;
const ray_opacity = 0.45, centroid_px = 11;

// Reads the columns of a frame's block: positions, then a byte each of depth, source and kind.
function decode_rays(row) {
  const count = meta.rays.points[row], from = new Columns(block("rays_" + row));
  return {
    count, m: from.take(Float32Array, 3 * count), depth: from.take(Uint8Array, count),
    source: from.take(Uint8Array, count), kind: from.take(Uint8Array, count),
  };
}

// Returns for each depth from 1 on: the number of hits, how many of them the cache answered, and their centroid.
function centroids_of(rays) {
  const depths = [];
  for (let i = 0; i < rays.count; ++i) {
    if (rays.kind[i] === launch_kind || rays.kind[i] === miss_kind || !finite(rays.m, i)) continue;
    const at = depths[rays.depth[i] - 1] ||= {points: 0, answered: 0, m: [0, 0, 0]};
    ++at.points;
    at.answered += rays.source[i] === cache_source;
    for (let axis = 0; axis < 3; ++axis) at.m[axis] += rays.m[3 * i + axis];
  }
  for (const at of depths) if (at) at.m = at.m.map((sum) => sum / at.points);
  return depths;
}

class RayLines {
  constructor() {
    this.material = new THREE.LineBasicMaterial({
      vertexColors: THREE.VertexColors, transparent: true, opacity: ray_opacity, depthTest: false,
    });
    this.mark_material = new THREE.PointsMaterial({
      vertexColors: THREE.VertexColors, size: centroid_px, sizeAttenuation: false, depthTest: false,
    });
    this.lines = new THREE.LineSegments(new THREE.BufferGeometry(), this.material);
    this.marks = new THREE.Points(new THREE.BufferGeometry(), this.mark_material);
    for (const part of [this.lines, this.marks]) part.frustumCulled = false;
    this.object = new THREE.Group();
    this.object.renderOrder = 3;
    this.object.add(this.lines, this.marks);
    this.object.visible = false;
    this.segments = 0;
    this.depths = [];  // centroids of the frame, see centroids_of
  }

  colour(rays, i, by) {
    if (by === "source") return rgb(theme().sources[rays.source[i] === cache_source ? 1 : 0]);
    return this.depth_colour(rays.depth[i]);
  }

  depth_colour(depth) {
    return ramp(1 - (depth - 1) / Math.max(meta.rays.highest_depth - 1, 1));
  }

  // by: "depth" or "source".
  rebuild(row, by) {
    const rays = decode_rays(row), positions = [], colours = [];
    for (let i = 1; i < rays.count; ++i) {
      if (rays.depth[i] === 0 || !finite(rays.m, i - 1) || !finite(rays.m, i)) continue;
      positions.push(...rays.m.subarray(3 * i - 3, 3 * i + 3));
      const colour = this.colour(rays, i, by).map((value) => value / 255);
      colours.push(...colour, ...colour);
    }
    this.segments = positions.length / 6;
    this.set(this.lines, positions, colours);
    this.depths = centroids_of(rays);
    const found = this.depths.map((at, k) => [at, k + 1]).filter(([at]) => at);
    this.set(this.marks, found.flatMap(([{m}]) => m),
             found.flatMap(([, depth]) => this.depth_colour(depth).map((value) => value / 255)));
  }

  set(object, positions, colours) {
    object.geometry.dispose();
    object.geometry = new THREE.BufferGeometry();
    object.geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(positions), 3));
    object.geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(colours), 3));
  }

  draw_legend(parent, by) {
    const heading = document.createElement("div");
    heading.textContent = by === "source" ? "Sampled rays: who found the end" : "Sampled rays: segment";
    parent.append(heading);
    if (by === "source")
      ["traced", "answered by the cache"].forEach((word, k) => parent.append(legend_entry(theme().sources[k], word)));
    else
      for (let depth = 1; depth <= meta.rays.highest_depth; ++depth)
        parent.append(legend_entry(css(this.depth_colour(depth)), String(depth)));
  }
}

// Shows a row for each depth: hits, the share that the cache answered, their centroid, and its distance from that of
// the previous frame on the page.
function show_centroids(table, depths, before) {
  const row = (cells, tag) => {
    const line = document.createElement("tr");
    for (const cell of cells) line.append(element(tag, cell));
    return line;
  };
  const number = (value, digits) => value.toFixed(digits).replace("-", "\u2212");
  const heads = ["Segment", "Hits", ...(meta.rays.sources ? ["Answered"] : []), "Centroid (m)", "Moved (m)"];
  table.replaceChildren(row(heads, "th"));
  depths.forEach((at, k) => {
    if (!at) return;
    const last = before && before[k];
    const moved = last ? number(Math.hypot(...at.m.map((value, axis) => value - last.m[axis])), 2) : "";
    const file_m = at.m.map((value, axis) => number(value + meta.centre_m[axis], 1)).join(", ");
    table.append(row([String(k + 1), String(at.points),
                      ...(meta.rays.sources ? [`${Math.round(100 * at.answered / at.points)}%`] : []), file_m, moved], "td"));
  });
}

// Shows sampled rays of the frame, if they are wanted.
function refresh_rays() {
  const by = meta.rays ? control("rays_by").value : "none";
  rays.object.visible = by !== "none";
  control("ray_count").textContent = "";
  control("centroids").replaceChildren();
  if (by !== "none") {
    const {row} = state.frame;
    rays.rebuild(row, by);
    show_centroids(control("centroids"), rays.depths, row > 0 ? centroids_of(decode_rays(row - 1)) : null);
    control("ray_count").textContent = `${rays.segments} segments`;
  }
  draw_legends();
  dirty = true;
}

// The control is hidden if the run holds no rays; the choice of sources is hidden if the run does not know them.
function prepare_rays_control() {
  control("rays_by").addEventListener("change", refresh_rays);
  control("rays").hidden = !meta.rays;
  if (meta.rays && !meta.rays.sources) control("rays_by").querySelector("[value=source]").remove();
}
