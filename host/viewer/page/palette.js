// SPDX-License-Identifier: Apache-2.0
// Colours of the page, dark and light: materials, and scales for power, order and kind.
// Colours are [r, g, b] of 0 to 255. Scales and kinds can be told apart without seeing red or green (palette_page.py).
"use strict";

const dark_scheme = matchMedia("(prefers-color-scheme: dark)");

// From weak to strong, as in plots: viridis (S. van der Walt, N. Smith, 2015, CC0). The strongest paths are farthest from
// the background: dark on light, and the other way round in the dark, where the darkest two would not be seen. Maps are
// dark where they are weak on both.
const viridis = [
  "#fde725", "#b5de2b", "#6ece58", "#35b779", "#1f9e89", "#26828e", "#31688e", "#3e4989", "#482878", "#440154",
];

// Colours of transmitters in maps, which repeat, as in pictures of `wavetracer coverage`.
const server_colours = [
  "#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442", "#808080", "#332288", "#882255", "#999933",
  "#44aa99",
];

const Themes = {
  dark: {
    sky: "#161b24", panel: "#1a202a", text: "#e8ecf2", faint: "#9aa5b5", halo: "#11151c", grid: "#333d4c", accent: "#5ad1ff",
    tx: "#ff5d73", rx: "#5ad1ff", both: "#ffd166", outline: "#0b0e13", wedge: "#3ee08f", vehicle: "#9fb0c6", selected: "#ffffff",
    city_light: 0.42,
    stops: viridis.slice(0, 8).reverse(), map_stops: viridis.slice(0, 8).reverse(), los: ["#5ab4ff", "#e69f00"], sources: ["#5ab4ff", "#e69f00"],
  },
  light: {
    sky: "#eceff2", panel: "#ffffff", text: "#22262c", faint: "#5f666f", halo: "#ffffff", grid: "#d8d6d0", accent: "#0b6fa8",
    tx: "#d4213d", rx: "#0b6fa8", both: "#8a5a00", outline: "#8d877a", wedge: "#00804a", vehicle: "#46505c", selected: "#000000",
    city_light: 1,
    stops: viridis, map_stops: [...viridis].reverse(), los: ["#0072b2", "#e69f00"], sources: ["#0072b2", "#e69f00"],
  },
};

for (const [name, scheme] of Object.entries(Themes)) scheme.kinds = path_kinds.map((kind) => kind[name]);

const theme = () => (dark_scheme.matches ? Themes.dark : Themes.light);

// Materials by the words in their names; the first that fits counts.
const Materials = [
  ["brick", "#b4705c"], ["glass", "#8fb8c9"], ["metal", "#8d97a6"], ["wood", "#a5855e"], ["board", "#b8ab93"],
  ["marble", "#d5d2cb"], ["concrete", "#b3b1aa"], ["asphalt", "#77797d"], ["dry_ground", "#9a9079"],
  ["wet_ground", "#7a7a62"], ["ground", "#8d8571"],
];
const other_materials = ["#a08fb0", "#8fb09a", "#b0a58f", "#8f9db0", "#b08f9a"];

const street_colour = "#93969b";

// Colours of vegetation, in the order of its materials.
const vegetation_colours = ["#4f9a55", "#8aa83c", "#2f8f7a", "#6f8a4a"], vegetation_opacity = 0.3;
const vegetation_colour = (number) => vegetation_colours[number % vegetation_colours.length];

// Flat roofs are paler than the ground of the same material.
const roof_share = 0.45, roof_tint = "#ffffff";

function rgb(hex) {
  return [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
}
const css = ([r, g, b]) => `rgb(${r}, ${g}, ${b})`;

function material_colour(name) {
  const known = Materials.find(([word]) => name.toLowerCase().includes(word));
  if (known) return known[1];
  let sum = 0;
  for (const letter of name) sum += letter.codePointAt(0);
  return other_materials[sum % other_materials.length];
}

// share: 0 to 1 along the stops.
function ramp(share, stops = theme().stops) {
  const at = Math.min(Math.max(share, 0), 1) * (stops.length - 1), i = Math.min(Math.floor(at), stops.length - 2);
  const a = rgb(stops[i]), b = rgb(stops[i + 1]);
  return a.map((value, k) => Math.round(value + (b[k] - value) * (at - i)));
}

// The range of the gain scale: whole multiples of 5 dB, at most 60 dB.
const [lowest_db, highest_db] = (() => {
  const high = 5 * Math.ceil(meta.gain_range_db[1] / 5);
  return [Math.min(Math.max(high - 60, 5 * Math.floor(meta.gain_range_db[0] / 5)), high - 5), high];
})();

const ramp_steps = 256;
const ramp_table = (stops) => Array.from({length: ramp_steps}, (_, step) => ramp(step / (ramp_steps - 1), stops));

// The scale of paths by power: the weakest and strongest colour's gain, and the colours.
const own_scale = () => ({low: lowest_db, high: highest_db, stops: theme().stops});

// Orders from 0, the strongest colour, in equal steps; orders from most_orders - 1 on share the last colour.
const most_orders = 6;
function order_colours() {
  const count = Math.min(meta.highest_order + 1, most_orders);
  return Array.from({length: count}, (_, order) => ramp(1 - order / Math.max(count - 1, 1)));
}

// Returns the colours of a frame's paths by a key that is cheap to compute: a table, and the key of path i.
function path_colours(frame, by, {low, high, stops}) {
  if (by === "kind") return [theme().kinds.map(rgb), (i) => frame.kind[i]];
  if (by === "order") {
    const table = order_colours();
    return [table, (i) => Math.min(order_of(frame, i), table.length - 1)];
  }
  const table = ramp_table(stops), scale = (ramp_steps - 1) / (high - low);
  return [table, (i) => {
    const step = Math.round((frame.gain_db[i] - low) * scale);
    return step > 0 ? Math.min(step, ramp_steps - 1) : 0;  // also for NaN
  }];
}

function legend_entry(colour, text) {
  const entry = document.createElement("span"), box = document.createElement("i");
  entry.className = "entry";
  box.style.background = colour;
  entry.append(box, text);
  return entry;
}

// Draws a bar of the scale with its numbers.
function legend_bar(low, high, stops) {
  const bar = document.createElement("canvas"), scale = document.createElement("div");
  bar.width = 220;
  bar.height = 1;
  const pen = bar.getContext("2d");
  for (let x = 0; x < bar.width; ++x) {
    pen.fillStyle = css(ramp(x / (bar.width - 1), stops));
    pen.fillRect(x, 0, 1, 1);
  }
  scale.className = "scale";
  for (let k = 0; k <= 4; ++k) {
    const mark = document.createElement("span"), value = low + (high - low) * k / 4;
    mark.textContent = String(high - low < 20 ? +value.toFixed(1) : Math.round(value)).replace("-", "\u2212");
    scale.append(mark);
  }
  return [bar, scale];
}

// Draws the legend of paths. with_map: colours of power are those of a map, too.
function draw_legend(parent, by, {low, high, stops}, with_map) {
  if (meta.paths[0] === 0) return;
  const heading = document.createElement("div");
  heading.textContent = by === "power" ? `Path gain${with_map ? " of paths and of the map" : ""}, dB` : by === "order" ? "Order: interactions of a path" : "Kind of path";
  parent.append(heading);
  if (by === "power") {
    parent.append(...legend_bar(low, high, stops));
  } else if (by === "order") {
    const colours = order_colours(), more = meta.highest_order >= colours.length;
    colours.forEach((colour, order) =>
      parent.append(legend_entry(css(colour), more && order === colours.length - 1 ? `${order} and more` : String(order))));
  } else {
    for (const kind of shown_kinds) parent.append(legend_entry(theme().kinds[kind], words_of_kind(kind)));
  }
}
