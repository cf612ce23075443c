// SPDX-License-Identifier: Apache-2.0
// Takes things out of the page: the view as an address that shows it again, the picture as a PNG file, a link as CSV.
"use strict";

// --- the address ---

// Controls that are part of a view, beside the camera, the frame and the ends of the link.
const shared_controls = ["colour", "quantity", "rays_by", "least_order", "most_order", "power"];
const shared_boxes = () => [...control("toggles").querySelectorAll("input"), ...control("kinds").querySelectorAll("input")];

// Returns the view as the part of an address after #. Ends have their names; only boxes that were changed are named.
function view_address() {
  const {target, distance, azimuth, elevation} = orbit, out = new URLSearchParams();
  out.set("frame", String(meta.frames[player.row][0]));
  for (const [role, ends] of [["tx", meta.transmitters], ["rx", meta.receivers]])
    if (filters[role] >= 0) out.set(role, name_of(ends, filters[role]));
  if (state.selected >= 0) out.set("path", String(state.selected));
  for (const id of shared_controls) if (control(id).value !== first_view.controls[id]) out.set(id, control(id).value);
  for (const {id, checked} of shared_boxes()) if (checked !== first_view.boxes[id]) out.set(id, checked ? "on" : "off");
  out.set("camera", [...target.toArray(), distance, azimuth, elevation].map((value) => String(+value.toFixed(4))).join(","));
  return out.toString();
}

// Shows the view of an address. Returns false if it has none; parts that this run lacks are left out.
function show_address(text) {
  const view = new URLSearchParams(text.replace(/^#/, ""));
  const camera = (view.get("camera") || "").split(",").map(Number);
  if (camera.length !== 6 || !camera.every(Number.isFinite)) return false;
  const end = (role, ends) => ends.findIndex((_, i) => name_of(ends, i) === view.get(role));
  const row = meta.frames.findIndex(([number]) => String(number) === view.get("frame"));
  for (const id of shared_controls) control(id).value = view.has(id) ? view.get(id) : first_view.controls[id];
  for (const box of shared_boxes()) box.checked = view.has(box.id) ? view.get(box.id) === "on" : first_view.boxes[box.id];
  player.go(Math.max(row, 0));
  filters.set_link(end("tx", meta.transmitters), end("rx", meta.receivers), false);
  select(state.frame.paths > Number(view.get("path") ?? -1) ? Number(view.get("path") ?? -1) : -1);
  paint();
  apply_toggles();
  orbit.target.fromArray(camera);
  [orbit.distance, orbit.azimuth, orbit.elevation] = camera.slice(3);
  orbit.apply();
  return true;
}

// The controls as the page has set them.
const first_view = {controls: {}, boxes: {}};

function remember_first_view() {
  for (const id of shared_controls) first_view.controls[id] = control(id).value;
  for (const {id, checked} of shared_boxes()) first_view.boxes[id] = checked;
}

// Keeps the address up to date: at most twice a second, since browsers refuse many changes. A page inside of another
// one, as in a notebook, has no address of its own.
const address = {shown: "", timer: 0};

function write_address() {
  if (address.timer || meta.reload_s || !/^(file|https?):$/.test(location.protocol)) return;
  address.timer = setTimeout(() => {
    address.timer = 0;
    const now = view_address();
    if (now === address.shown || player.playing) return;
    address.shown = now;
    history.replaceState(null, "", `#${now}`);
  }, 500);
}

// --- files ---

function save_file(name, blob) {
  const link = element("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

const csv_number = (value) => (Number.isNaN(value) ? "nan" : Number.isFinite(value) ? String(value) : value > 0 ? "inf" : "-inf");
const csv_name = (name) => (/[",\n\r]/.test(name) ? `"${name.replace(/"/g, '""')}"` : name);

// Returns a link in every frame that computed it, with columns of links.csv.
function link_csv(tx, rx) {
  const lines = ["time_s,tx,rx,paths,path_gain_db,narrowband_gain_db,rms_delay_spread_s,los,missed_power_share,k_factor_db"];
  const ends = [csv_name(meta.transmitters[tx][0]), csv_name(meta.receivers[rx][0])];
  for (let row = 0; row < meta.frames.length; ++row) {
    const k = link_row(row, tx, rx);
    if (k < 0) continue;
    const values = [links.gain_db[k], links.narrowband_gain_db[k],
                    links.rms_delay_spread_s[k], links.los[k], links.missed_power_share[k], 10 * Math.log10(links.k_factor[k])];
    lines.push([csv_number(meta.frames[row][1]), ...ends, links.paths[k], ...values.map(csv_number)].join(","));
  }
  return `${lines.join("\n")}\n`;
}

// Draws the texts and colours of the legend where the page has them.
function draw_page_legend(pen, legend, origin) {
  const place = (box) => [box.left - origin.left, box.top - origin.top, box.width, box.height];
  if (legend.hidden) return;
  pen.fillStyle = getComputedStyle(document.body).getPropertyValue("--panel");
  pen.fillRect(...place(legend.getBoundingClientRect()));
  for (const part of legend.querySelectorAll("canvas, i")) {
    const box = place(part.getBoundingClientRect());
    pen.fillStyle = getComputedStyle(part).backgroundColor;
    if (part.tagName === "CANVAS") pen.drawImage(part, ...box); else pen.fillRect(...box);
  }
  pen.font = getComputedStyle(legend).font;
  pen.fillStyle = theme().text;
  pen.textBaseline = "middle";
  const texts = document.createTreeWalker(legend, NodeFilter.SHOW_TEXT), range = document.createRange();
  for (let node = texts.nextNode(); node; node = texts.nextNode()) {
    range.selectNodeContents(node);
    const [x, y, , height] = place(range.getBoundingClientRect());
    pen.fillText(node.textContent, x, y + height / 2);
  }
}

// Returns a canvas with the picture, its marks and its legend, which narrow windows have below the view.
function picture() {
  draw();
  const out = document.createElement("canvas"), over = control("overlay"), ratio = over.width / canvas.clientWidth;
  const view = canvas.getBoundingClientRect(), below = Math.max(0, control("legend").getBoundingClientRect().bottom - view.bottom);
  [out.width, out.height] = [over.width, over.height + Math.round(below * ratio)];
  const pen = out.getContext("2d");
  pen.fillStyle = theme().sky;
  pen.fillRect(0, 0, out.width, out.height);
  if (renderer) pen.drawImage(canvas, 0, 0, over.width, over.height);
  pen.drawImage(over, 0, 0);
  pen.scale(ratio, ratio);
  draw_page_legend(pen, control("legend"), view);
  return out;
}

function prepare_sharing() {
  control("picture").addEventListener("click", () => picture().toBlob((blob) => save_file(`${meta.title}.png`, blob)));
  control("link_csv").addEventListener("click", () => {
    const [tx, rx] = state.link, name = `${name_of(meta.transmitters, tx)}-${name_of(meta.receivers, rx)}`;
    save_file(`${name.replace(/[^\w.-]+/g, "_")}.csv`, new Blob([link_csv(tx, rx)], {type: "text/csv"}));
  });
  addEventListener("hashchange", () => show_address(location.hash));
}
