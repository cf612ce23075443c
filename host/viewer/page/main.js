// The page as a whole: what is shown, what is selected, and when the picture is drawn again.
// `window.wavetracer` lets scripts look at it and steer it.
"use strict";

const state = {frame: null, radios: [], selected: -1, link: [-1, -1], labels: true, target: null};
const timing = {rebuild_ms: 0, draw_ms: 0};
let dirty = true;

const canvas = control("world");
const orbit = new OrbitCamera(canvas, () => { dirty = true; });
const overlay = new Overlay(control("overlay"));
const lines = new PathLines();
const filters = new Filters(() => refilter());
const charts = new Charts((row) => player.go(row));
const player = new Player((row) => show_frame(row));
const world = new WorldView();
world.scene.add(lines.object);

const warnings = [...meta.warnings];
const renderer = (() => {
  try {
    return new THREE.WebGLRenderer({canvas, antialias: true});
  } catch (error) {
    warnings.push("This browser draws no three-dimensional pictures (WebGL is missing or switched off); "
                  + "paths, filters and charts are here all the same.");
    return null;
  }
})();

function draw() {
  const start = performance.now();
  dirty = false;
  if (renderer) renderer.render(world.scene, orbit.camera);
  state.target = orbit.target;
  overlay.draw(state, projector());
  timing.draw_ms = performance.now() - start;
}

const projector = () => new Projector(orbit.camera, canvas.clientWidth, canvas.clientHeight);

function refilter() {
  const start = performance.now();
  lines.rebuild(state.frame, (frame, i) => filters.wanted(frame, i), control("colour").value);
  timing.rebuild_ms = performance.now() - start;
  const {paths, total} = state.frame;
  const of = total === paths ? `of ${paths}` : `of ${paths}, the strongest of ${total}`;
  control("count").textContent = `${lines.visible.length} ${of} in this frame`;
  if (state.selected >= 0 && !filters.wanted(state.frame, state.selected)) select(-1);
  refresh_link();
}

// The link of the charts: that of the filters, else that of the selected path.
function refresh_link() {
  const {frame, selected} = state;
  state.link = filters.tx < 0 && filters.rx < 0 && selected >= 0 ? [frame.tx[selected], frame.rx[selected]]
                                                                 : [filters.tx, filters.rx];
  if (filters.tx >= 0 !== filters.rx >= 0 && selected >= 0) state.link = [frame.tx[selected], frame.rx[selected]];
  charts.draw(frame, state.link[0] >= 0 && state.link[1] >= 0 ? state.link : null, selected);
  dirty = true;
}

function show_frame(row) {
  state.frame = frame_data(row);
  state.radios = radios_of(state.frame);
  world.place(state.frame);
  if (state.selected >= 0) select(-1);
  refilter();
}

function select(i) {
  state.selected = i;
  if (i >= 0) show_path(control("details"), state.frame, i);
  else show_hint(control("details"));
  refresh_link();
}

function select_radio(radio) {
  state.selected = -1;
  filters.set_link(radio.tx, radio.tx >= 0 ? -1 : radio.rx);
  show_radio(control("details"), state.frame, radio, (tx, rx) => filters.set_link(tx, rx));
}

// A second click in one place goes on to the next path there.
function click(x, y) {
  const radio = radio_near(state.radios, projector(), x, y);
  if (radio) return select_radio(radio);
  const near = control("show_paths").checked ? paths_near(state.frame, lines.visible, projector(), x, y) : [];
  select(near.length ? near[(near.indexOf(state.selected) + 1) % near.length] : -1);
}

function show_all(elevation) {
  const [lower, upper] = box_of(state.frame);
  orbit.show(lower, upper, elevation);
}

function resize() {
  const {clientWidth: width, clientHeight: height} = canvas.parentElement, ratio = Math.min(devicePixelRatio || 1, 2);
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
  draw_legend(control("legend"), control("colour").value);
  refilter();
}

function apply_toggles() {
  lines.object.visible = control("show_paths").checked;
  lines.through_houses(control("show_hidden").checked);
  world.city.visible = control("show_city").checked;
  world.vehicles.visible = control("show_vehicles").checked;
  world.edges.visible = control("show_edges").checked;
  state.labels = control("show_labels").checked;
  dirty = true;
}

function key(event) {
  const typing = event.target.closest("select, input");
  if (event.ctrlKey || event.altKey || event.metaKey || (typing && typing.type !== "checkbox")) return;
  if (event.key === " " && event.target.closest("button, input")) return;  // presses it
  const turn = {ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1]}[event.key];
  if (event.shiftKey && turn) orbit.turn(...turn);
  else if (event.key === "+" || event.key === "=") orbit.zoom(0.8);
  else if (event.key === "-") orbit.zoom(1.25);
  else if (event.key === "Escape") select(-1);
  else if (!player.key(event.key)) return;
  event.preventDefault();
}

function write_facts() {
  document.title = `${meta.title} \u2013 wavetracer`;
  control("title").textContent = meta.title;
  const count = (n, one, many) => `${n} ${n === 1 ? one : many}`;
  const [shown, all] = meta.paths, ends = meta.transmitters.length + meta.receivers.length;
  control("summary").textContent = [
    `${+(meta.frequency_hz / 1e9).toPrecision(6)} GHz`,
    shown === all ? count(all, "path", "paths") : `the ${shown} strongest of ${all} paths`,
    count(meta.frames.length, "frame", "frames"), count(ends, "end", "ends"),
    count(meta.instances.length, "vehicle", "vehicles"), `wavetracer ${meta.version}`].join(", ");
  if (all === 0) warnings.push("This run has no paths.");
  for (const warning of warnings) control("warnings").append(element("li", warning));
  for (const name of [...new Set(world.solids.map(([, name]) => name))])
    control("materials").append(legend_entry(material_colour(name), name));
}

canvas.addEventListener("click", (event) => { if (!orbit.dragged) click(event.offsetX, event.offsetY); });
document.addEventListener("keydown", key);
control("toggles").addEventListener("input", apply_toggles);
control("colour").addEventListener("change", paint);
control("home").addEventListener("click", () => show_all());
control("top").addEventListener("click", () => show_all(Math.PI / 2));
dark_scheme.addEventListener("change", paint);
new ResizeObserver(resize).observe(canvas.parentElement);

write_facts();
player.go(0);
resize();
show_all();
paint();
apply_toggles();
(function loop() {
  if (dirty) draw();
  requestAnimationFrame(loop);
})();

window.wavetracer = {
  meta, state, timing, charts, orbit, world, overlay, lines, filters, player, draw, select, click, refilter, projector,
  setFrame: (row) => player.go(row),
  visibleCount: () => lines.visible.length,
  frameTime: () => timing.rebuild_ms + timing.draw_ms,
};
