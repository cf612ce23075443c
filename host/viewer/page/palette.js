// Colours of the page, dark and light: materials, and scales for power, order and kind.
// Colours are [r, g, b] of 0 to 255.
"use strict";

const dark_scheme = matchMedia("(prefers-color-scheme: dark)");

const Themes = {
  dark: {
    sky: "#161b24", text: "#e8ecf2", faint: "#9aa5b5", halo: "#11151c", grid: "#333d4c", accent: "#5ad1ff",
    tx: "#ff5d73", rx: "#5ad1ff", both: "#ffd166", outline: "#0b0e13", wedge: "#3ee08f", vehicle: "#d9a441", selected: "#ffffff",
    city_light: 0.42,
    stops: ["#7a5cff", "#b44cf0", "#ee5699", "#ff8a5b", "#ffc24b", "#fff59d"],
    orders: ["#f7f7f7", "#4cc9f0", "#ffd166", "#ef6f8f", "#80ed99", "#b892ff", "#ff9f5a", "#7fb2ff"],
    kinds: ["#f7f7f7", "#5ad1ff", "#c7a6ff", "#3ee08f", "#ffb35c"],
  },
  light: {
    sky: "#eceff2", text: "#22262c", faint: "#5f666f", halo: "#ffffff", grid: "#d8d6d0", accent: "#0b6fa8",
    tx: "#d4213d", rx: "#0b6fa8", both: "#8a5a00", outline: "#8d877a", wedge: "#00804a", vehicle: "#c98a1b", selected: "#000000",
    city_light: 1,
    stops: ["#fdb42f", "#ed7953", "#cc4778", "#9c179e", "#6a00a8", "#0d0887"],
    orders: ["#111111", "#0b6fa8", "#b36b00", "#c2255c", "#2b8a3e", "#6741d9", "#d9480f", "#1864ab"],
    kinds: ["#111111", "#0b6fa8", "#7048c8", "#00804a", "#c05a00"],
  },
};

const theme = () => (dark_scheme.matches ? Themes.dark : Themes.light);

// Materials by the words in their names, the first that fits.
const Materials = [
  ["brick", "#b4705c"], ["glass", "#8fb8c9"], ["metal", "#8d97a6"], ["wood", "#a5855e"], ["board", "#b8ab93"],
  ["marble", "#d5d2cb"], ["concrete", "#b3b1aa"], ["asphalt", "#77797d"], ["dry_ground", "#9a9079"],
  ["wet_ground", "#7a7a62"], ["ground", "#8d8571"],
];
const other_materials = ["#a08fb0", "#8fb09a", "#b0a58f", "#8f9db0", "#b08f9a"];

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
function ramp(share) {
  const stops = theme().stops;
  const at = Math.min(Math.max(share, 0), 1) * (stops.length - 1), i = Math.min(Math.floor(at), stops.length - 2);
  const a = rgb(stops[i]), b = rgb(stops[i + 1]);
  return a.map((value, k) => Math.round(value + (b[k] - value) * (at - i)));
}

// The gains that the scale spans: to whole 5 dB, 60 dB at most.
const [lowest_db, highest_db] = (() => {
  const high = 5 * Math.ceil(meta.gain_range_db[1] / 5);
  return [Math.min(Math.max(high - 60, 5 * Math.floor(meta.gain_range_db[0] / 5)), high - 5), high];
})();

const ramp_steps = 256;

// The colours of a frame's paths by a key that is cheap to compute: a table, and the key of path i.
function path_colours(frame, by) {
  if (by === "kind") return [theme().kinds.map(rgb), (i) => frame.kind[i]];
  if (by === "order") {
    const table = theme().orders.map(rgb);
    return [table, (i) => order_of(frame, i) % table.length];
  }
  const table = Array.from({length: ramp_steps}, (_, step) => ramp(step / (ramp_steps - 1)));
  const scale = (ramp_steps - 1) / (highest_db - lowest_db);
  return [table, (i) => {
    const step = Math.round((frame.gain_db[i] - lowest_db) * scale);
    return step > 0 ? Math.min(step, ramp_steps - 1) : 0;  // also what is not a number
  }];
}

function legend_entry(colour, text) {
  const entry = document.createElement("span"), box = document.createElement("i");
  entry.className = "entry";
  box.style.background = colour;
  entry.append(box, text);
  return entry;
}

function draw_legend(parent, by) {
  parent.replaceChildren();
  parent.hidden = meta.paths[0] === 0;
  const heading = document.createElement("div");
  heading.textContent = by === "power" ? "Path gain, dB" : by === "order" ? "Order: interactions of a path" : "Kind of path";
  parent.append(heading);
  if (by === "power") {
    const bar = document.createElement("canvas"), scale = document.createElement("div");
    bar.width = 220;
    bar.height = 1;
    const pen = bar.getContext("2d");
    for (let x = 0; x < bar.width; ++x) {
      pen.fillStyle = css(ramp(x / (bar.width - 1)));
      pen.fillRect(x, 0, 1, 1);
    }
    scale.className = "scale";
    for (let k = 0; k <= 4; ++k) {
      const mark = document.createElement("span");
      mark.textContent = String(Math.round(lowest_db + (highest_db - lowest_db) * k / 4)).replace("-", "\u2212");
      scale.append(mark);
    }
    parent.append(bar, scale);
  } else if (by === "order") {
    const colours = theme().orders, shown = Math.min(meta.highest_order + 1, colours.length);
    const again = meta.highest_order >= colours.length;
    for (let order = 0; order < shown; ++order)
      parent.append(legend_entry(colours[order], again ? `${order}, ${order + colours.length}, \u2026` : String(order)));
  } else {
    Kinds.forEach(([, words], kind) => parent.append(legend_entry(theme().kinds[kind], words)));
  }
}
