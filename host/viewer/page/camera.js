// SPDX-License-Identifier: Apache-2.0
// A camera that circles a point above the ground: drag turns, right drag or Shift moves, the wheel zooms towards the
// pointer. z is up. Everything is in metres and radians, relative to the centre of the page's coordinates.
"use strict";

class OrbitCamera {
  // changed: called when the picture no longer shows the camera's view.
  constructor(element, changed) {
    this.camera = new THREE.PerspectiveCamera(45, 1, 1, 10000);
    this.camera.up.set(0, 0, 1);
    this.target = new THREE.Vector3();
    this.distance = 100;
    this.azimuth = -Math.PI / 2;  // from the target to the camera, which looks from the south
    this.elevation = 1.05;
    this.element = element;
    this.changed = changed;
    this.pointers = new Map();
    this.dragged = false;  // the pointer moved during the last press, so that it was no click
    element.addEventListener("pointerdown", (event) => this.press(event));
    element.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"])
      element.addEventListener(end, (event) => this.pointers.delete(event.pointerId));
    element.addEventListener("contextmenu", (event) => event.preventDefault());
    element.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(Math.min(Math.max(event.deltaY, -400), 400) * 0.0015), event.offsetX, event.offsetY);
    }, {passive: false});
    this.apply();
  }

  press(event) {
    this.element.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    this.travelled = 0;
    this.dragged = false;
  }

  move(event) {
    const last = this.pointers.get(event.pointerId);
    if (!last) return;
    const dx = event.clientX - last[0], dy = event.clientY - last[1];
    this.travelled += Math.abs(dx) + Math.abs(dy);
    if (this.travelled < 4) return;  // ignores small movements during a click
    this.dragged = true;
    const spread = this.spread();
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    if (this.pointers.size > 1) {
      this.pan(dx / this.pointers.size, dy / this.pointers.size);
      if (spread > 0 && this.spread() > 0) this.zoom(spread / this.spread());
    } else if (event.buttons & 6 || event.shiftKey) {
      this.pan(dx, dy);
    } else {
      this.turn(-dx * 0.006, dy * 0.006);
    }
  }

  // Distance of the first two pointers in pixels.
  spread() {
    const [a, b] = this.pointers.values();
    return b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0;
  }

  turn(azimuth, elevation) {
    this.azimuth += azimuth;
    this.elevation = Math.min(Math.max(this.elevation + elevation, -0.2), Math.PI / 2 - 0.001);
    this.apply();
  }

  // Moves by pixels: the point under the pointer stays there, on the level of the target.
  pan(dx, dy) {
    const metres = 2 * this.distance * Math.tan(this.camera.fov * Math.PI / 360) / this.element.clientHeight;
    const forward = dy * metres / Math.max(Math.sin(this.elevation), 0.25), right = -dx * metres;
    const s = Math.sin(this.azimuth), c = Math.cos(this.azimuth);
    this.target.x += -s * right - c * forward;
    this.target.y += c * right - s * forward;
    this.apply();
  }

  // x, y: a pixel whose point on the level of the target stays fixed; without them the target stays fixed.
  zoom(factor, x, y) {
    const distance = Math.min(Math.max(this.distance * factor, 1), 1e6);
    const fixed = x === undefined ? null : this.level_point(x, y);
    if (fixed) this.target.sub(fixed).multiplyScalar(distance / this.distance).add(fixed);
    this.distance = distance;
    this.apply();
  }

  // Returns a ray from the camera through a pixel.
  raycaster(x, y) {
    const caster = new THREE.Raycaster();
    const {clientWidth: width, clientHeight: height} = this.element;
    caster.setFromCamera(new THREE.Vector2(2 * x / width - 1, 1 - 2 * y / height), this.camera);
    return caster;
  }

  // Returns the point of a pixel on the level of the target; null for the sky and far behind the target.
  level_point(x, y) {
    const {origin, direction} = this.raycaster(x, y).ray, away = (this.target.z - origin.z) / direction.z;
    return away > 0 && away < 5 * this.distance ? origin.clone().addScaledVector(direction, away) : null;
  }

  shift(by) {
    this.target.add(by);
    this.apply();
  }

  // Turns around this point and moves nearer.
  focus(point) {
    this.target.copy(point);
    this.distance = Math.max(this.distance * 0.4, 5);
    this.apply();
  }

  // Shows the box and its surroundings from the camera's present direction.
  fit(lower, upper) {
    this.show(lower, upper, this.elevation, this.azimuth, 1.8);
  }

  // Shows the box (arrays of three) from the south, above. margin: relative to its size.
  show(lower, upper, elevation = 1.05, azimuth = -Math.PI / 2, margin = 1) {
    const size = Math.max(Math.hypot(upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]), 20);
    this.target.set((lower[0] + upper[0]) / 2, (lower[1] + upper[1]) / 2, (lower[2] + upper[2]) / 2);
    const narrow = Math.min(this.camera.aspect, 1);
    this.distance = margin * size * 0.57 / Math.tan(this.camera.fov * Math.PI / 360) / narrow;
    this.azimuth = azimuth;
    this.elevation = elevation;
    this.apply();
  }

  resize(width, height) {
    this.camera.aspect = width / height;
    this.apply();
  }

  apply() {
    const flat = this.distance * Math.cos(this.elevation);
    this.camera.position.set(this.target.x + flat * Math.cos(this.azimuth), this.target.y + flat * Math.sin(this.azimuth),
                             this.target.z + this.distance * Math.sin(this.elevation));
    this.camera.near = this.distance / 200;
    this.camera.far = this.distance * 20 + 5000;
    this.camera.lookAt(this.target);
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    this.changed();
  }
}
