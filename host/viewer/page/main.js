// SPDX-License-Identifier: Apache-2.0
// The page as a whole: what is shown, what is selected, and when the picture is drawn again. Scripts can inspect and
// control it through `window.wavetracer`.
"use strict";

const state = {
  frame: null, radios: [], selected: -1, link: [-1, -1], labels: true, target: null, follow: -1, last_m: null,
};
const timing = {rebuild_ms: 0, draw_ms: 0};
let dirty = true;

const canvas = control("world");
const orbit = new OrbitCamera(canvas, () => { dirty = true; });
const overlay = new Overlay(control("overlay"));
const lines = new PathLines();
const filters = new Filters((link_chosen) => { refilter(); if (link_chosen) bring_link_into_view(); });
const chosen = new ChosenPath();
const charts = new Charts((row) => player.go(row));
const player = new Player((row) => show_frame(row));
const world = new WorldView();
world.scene.add(lines.object);
const rays = new RayLines();
world.scene.add(rays.object);

const warnings = [...meta.warnings];
const renderer = (() => {
  try {
    return new THREE.WebGLRenderer({canvas, antialias: true});
  } catch (error) {
    warnings.push("This browser cannot draw the three-dimensional view (WebGL is missing or switched off); "
                  + "paths, filters and charts work nevertheless.");
    return null;
  }
})();

const coverage = new Coverage(renderer ? renderer.capabilities.maxTextureSize : 0);
warnings.push(...coverage.problems);
world.scene.add(coverage.object);

function draw() {
  const start = performance.now();
  dirty = false;
  if (renderer) renderer.render(world.scene, orbit.camera);
  state.target = orbit.target;
  overlay.draw(state, projector());
  write_address();
  timing.draw_ms = performance.now() - start;
}

const projector = () => new Projector(orbit.camera, canvas.clientWidth, canvas.clientHeight);

function refilter() {
  const start = performance.now();
  coverage.paint(state.frame.row, filters.tx, control("quantity").value);
  lines.rebuild(state.frame, (frame, i) => filters.wanted(frame, i), control("colour").value, path_scale());
  timing.rebuild_ms = performance.now() - start;
  const {paths, total} = state.frame;
  const of = total === paths ? `of ${grouped(paths)}` : `of ${grouped(paths)}, the strongest of ${grouped(total)}`;
  const faded = lines.faded ? `; ${grouped(lines.faded)} of them faded` : "";
  const maps = grids.length && grid_of[filters.rx] === undefined ? "; click the map for those of a cell" : "";
  control("count").textContent = `${grouped(lines.visible.length)} ${of} in this frame${faded}${maps}`;
  if (state.selected >= 0 && !filters.wanted(state.frame, state.selected)) select(-1);
  draw_legends();
  refresh_link();
  pointer_value.again();
}

// Returns the scale of paths by power: that of the map, if it shows gains as well; beside other maps only its colours.
function path_scale() {
  if (!coverage.maps.length || !coverage.object.visible) return own_scale();
  const [low, high] = coverage.shows_gain() ? range_of("gain") : [lowest_db, highest_db];
  return {low, high, stops: theme().map_stops};
}

function draw_legends() {
  const parent = control("legend"), by = control("colour").value, of_paths = lines.visible.length > 0 || !grids.length;
  parent.replaceChildren();
  if (of_paths) draw_legend(parent, by, path_scale(), coverage.shows_gain());
  coverage.draw_legend(parent, of_paths && by === "power");
  if (rays.object.visible) rays.draw_legend(parent, control("rays_by").value);
  draw_mark_legend(parent, state.radios, meta.instances.length > 0 && control("show_vehicles").checked);
  parent.hidden = !parent.firstChild;
}

// Sets the link of the charts: that of the filters, else that of the chosen path, else that of the map's cell.
function refresh_link() {
  const {tx, rx} = filters, cell = rx >= 0 && grid_of[rx] >= 0 ? coverage.rows[rx] : no_row;
  state.link = [tx, rx];
  if (chosen.link && (tx < 0 || rx < 0)) state.link = chosen.link;
  else if (tx < 0 && cell !== no_row) state.link = [links.tx[cell], rx];
  charts.draw(state.frame, state.link[0] >= 0 && state.link[1] >= 0 ? state.link : null, state.selected);
  control("link_figures").hidden = state.selected < 0 && cell !== no_row;  // show_cell() has the same figures
  dirty = true;
}

function show_frame(row) {
  state.frame = frame_data(row);
  state.radios = radios_of(state.frame);
  world.place(state.frame);
  follow();
  state.selected = chosen.find(state.frame);
  refilter();
  refresh_rays();
  if (state.selected >= 0) show_path(control("details"), state.frame, state.selected);
  else if (chosen.link) show_hint(control("details"), "The selected path does not exist in this frame.");
  else if (grid_of[filters.rx] >= 0) show_cell(control("details"), state.frame, filters.rx, coverage.cells);
}

// Keeps the followed vehicle at its place in the picture.
function follow() {
  const {frame} = state;
  for (let k = 0; k < frame.poses; ++k) {
    if (frame.pose_instance[k] !== state.follow || !finite(frame.pose_m, k)) continue;
    const now = new THREE.Vector3().fromArray(frame.pose_m, 3 * k);
    orbit.shift(state.last_m ? now.clone().sub(state.last_m) : now.clone().sub(orbit.target));
    state.last_m = now;
  }
}

function set_follow(instance) {
  Object.assign(state, {follow: instance, last_m: null});
  control("follow").value = String(instance);
  follow();
}

function select(i) {
  state.selected = i;
  chosen.choose(state.frame, i);
  if (i >= 0) show_path(control("details"), state.frame, i);
  else show_hint(control("details"));
  refresh_link();
}

function select_radio(radio) {
  select(-1);
  filters.set_link(radio.tx, radio.tx >= 0 ? -1 : radio.rx, false);
  show_radio(control("details"), state.frame, radio, (tx, rx) => filters.set_link(tx, rx));
}

function select_cell(rx) {
  select(-1);
  filters.set_link(filters.tx, rx, false);
  show_cell(control("details"), state.frame, rx, coverage.cells);
}

// Shows an end that was found by its name.
function go_to(role, i) {
  if (role === "rx" && grid_of[i] >= 0) {
    select_cell(i);
    orbit.focus(new THREE.Vector3().fromArray(state.frame.receiver_m, 3 * i));
    return;
  }
  const radio = state.radios.find((one) => one[role] === i);
  if (!radio) return show_hint(control("details"), "This antenna is not present in this frame.");
  select_radio(radio);
  orbit.focus(new THREE.Vector3().fromArray(radio.m));
}

// Shows both ends of the chosen link and their surroundings, unless they are clearly visible already.
function bring_link_into_view() {
  const [tx, rx] = state.link, {frame} = state;
  if (tx < 0 || rx < 0 || !finite(frame.transmitter_m, tx) || !finite(frame.receiver_m, rx)) return;
  const from = frame.transmitter_m.subarray(3 * tx, 3 * tx + 3), to = frame.receiver_m.subarray(3 * rx, 3 * rx + 3);
  if (well_seen([...from, ...to], projector())) return;
  const ends = (least) => [0, 1, 2].map((axis) => least(from[axis], to[axis]));
  orbit.fit(ends(Math.min), ends(Math.max));
}

// A second click in one place selects the next path there.
function click(x, y) {
  const radio = radio_near(state.radios, projector(), x, y);
  if (radio) return select_radio(radio);
  const caster = orbit.raycaster(x, y);
  const near = control("show_paths").checked ? paths_near(state.frame, lines.visible, projector(), x, y) : [];
  if (near.length) return select(near[(near.indexOf(state.selected) + 1) % near.length]);
  const cell = coverage.probe(caster);
  if (cell >= 0) return select_cell(cell);
  select(-1);
}

function double_click(x, y) {
  const surface = surface_under(world, orbit.raycaster(x, y));
  const point = surface ? surface.point : orbit.level_point(x, y);
  if (point) orbit.focus(point);
}

function show_everything() {
  set_follow(-1);
  select(-1);
  filters.reset();
}

// Shows the whole run; with_city: and the whole scene.
function show_all(with_city, elevation) {
  const [lower, upper] = box_of_run(with_city);
  orbit.show(lower, upper, elevation);
}

function resize() {
  const {clientWidth: width, clientHeight: height} = canvas, ratio = Math.min(devicePixelRatio || 1, 2);
  if (!width || !height) return;
  if (renderer) {
    renderer.setPixelRatio(ratio);
    renderer.setSize(width, height, false);
  }
  overlay.resize(width, height, ratio);
  orbit.resize(width, height);
  if (state.frame) refresh_link();
}

function paint() {
  world.paint();
  refilter();
  refresh_rays();
}

function apply_toggles() {
  lines.object.visible = control("show_paths").checked;
  lines.through_houses(control("show_hidden").checked);
  world.city.visible = control("show_city").checked;
  world.streets.visible = control("show_streets").checked;
  world.vegetation.visible = control("show_vegetation").checked;
  world.vehicles.visible = control("show_vehicles").checked;
  world.edges.visible = control("show_edges").checked;
  state.labels = control("show_labels").checked;
  if (lines.fade !== control("fade_clutter").checked) {
    lines.fade = control("fade_clutter").checked;
    refilter();
  }
  dirty = true;
}

function key(event) {
  const typing = event.target.closest("select, input");
  if (event.ctrlKey || event.altKey || event.metaKey || (typing && typing.type !== "checkbox")) return;
  if (event.key === " " && event.target.closest("button, input")) return;  // the key presses that button
  const turn = {ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1]}[event.key];
  if (event.shiftKey && turn) orbit.turn(...turn);
  else if (event.key === "+" || event.key === "=") orbit.zoom(0.8);
  else if (event.key === "-") orbit.zoom(1.25);
  else if (event.key === "Escape") show_everything();
  else if (!player.key(event.key)) return;
  event.preventDefault();
}

// Ends that send and receive under one name count as one antenna.
function antenna_count() {
  const names = new Set();
  let unnamed = 0;
  for (const [name] of [...meta.transmitters, ...own_receivers.map((rx) => meta.receivers[rx])].filter(is_taken))
    if (name) names.add(name); else ++unnamed;
  return names.size + unnamed;
}

function fill_follow() {
  control("follow").parentElement.hidden = meta.instances.length === 0;
  control("follow").append(new Option("nothing", "-1"));
  const id = (i) => meta.instances[i][0];
  const sorted = [...meta.instances.keys()].filter((i) => is_taken(meta.instances[i])).sort((a, b) => by_name.compare(id(a), id(b)));
  for (const i of sorted) control("follow").append(new Option(shortened(meta.instances[i][0], 40), String(i)));
}

function write_facts() {
  document.title = `${meta.title} \u2013 wavetracer`;
  control("title").textContent = meta.title;
  const count = (n, one, many) => `${grouped(n)} ${n === 1 ? one : many}`;
  const [shown, all] = meta.paths;
  control("summary").textContent = [
    `${+(meta.frequency_hz / 1e9).toPrecision(6)} GHz`,
    shown === all ? count(all, "path", "paths") : `the ${grouped(shown)} strongest of ${grouped(all)} paths`,
    count(meta.frames.length, "frame", "frames"), count(antenna_count(), "antenna", "antennas"),
    ...grids.map(({name, columns, rows}) => `map ${name} of ${columns} \u00d7 ${rows} receivers`),
    ...(meta.instances.length ? [count(meta.instances.filter(is_taken).length, "vehicle", "vehicles")] : []), `wavetracer ${meta.version}`].join(", ");
  control("missed").textContent = missed_text();
  control("certificate").textContent = certificate_text();
  if (all === 0) warnings.push("This run has no paths.");
  for (const warning of warnings) control("warnings").append(element("li", warning));
  for (const name of [...new Set(world.solids.map(([, name]) => name))])
    control("materials").append(legend_entry(material_colour(name), name));
  control("show_streets").parentElement.hidden = !streets.triangles.length;
  if (streets.triangles.length) control("materials").append(legend_entry(street_colour, "streets"));
  control("show_vegetation").parentElement.hidden = !vegetation.length;
  vegetation.forEach(([name], number) => control("materials").append(legend_entry(vegetation_colour(number), name)));
}

// The second click of a double click chooses nothing.
canvas.addEventListener("click", (event) => {
  if (!orbit.dragged && event.detail < 2) click(event.offsetX, event.offsetY);
});
canvas.addEventListener("dblclick", (event) => double_click(event.offsetX, event.offsetY));
control("follow").addEventListener("change", () => set_follow(Number(control("follow").value)));
control("quantity").addEventListener("change", refilter);
for (const part of document.querySelectorAll(".of_maps")) part.hidden = !grids.length;
document.addEventListener("keydown", key);
control("toggles").addEventListener("input", apply_toggles);
control("colour").addEventListener("change", paint);
prepare_rays_control();
prepare_quantities();
const pointer_value = new PointerValue(control("pointer"), canvas, (x, y) => coverage.probe(orbit.raycaster(x, y), false), (rx) => coverage.words(rx));
control("home").addEventListener("click", () => show_all(true));
control("top").addEventListener("click", () => show_all(false, Math.PI / 2));
dark_scheme.addEventListener("change", paint);
new ResizeObserver(resize).observe(canvas);

write_facts();
fill_follow();
show_hint(control("details"));
const search = new NameSearch(go_to);
player.go(0);
resize();
remember_first_view();
prepare_sharing();
if (!restore_view()) show_all(false);
paint();
apply_toggles();
show_address(location.hash);
reload_later();
(function loop() {
  if (dirty) draw();
  requestAnimationFrame(loop);
})();

window.wavetracer = {
  meta, state, timing, rays, charts, coverage, chosen, search, orbit, world, overlay, lines, filters, player, draw, select,
  click, refilter, projector,
  renderer, ready_ms: performance.now(),
  setFrame: (row) => player.go(row),
  visibleCount: () => lines.visible.length,
  frameTime: () => timing.rebuild_ms + timing.draw_ms,
};
