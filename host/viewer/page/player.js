// SPDX-License-Identifier: Apache-2.0
// Time: the slider, play and pause, and the keys that move through frames.
// Frames are shown as they were computed, each until the time of the next; nothing is interpolated.
"use strict";

class Player {
  // show(row): draws a frame.
  constructor(show) {
    this.show = show;
    this.row = 0;
    this.playing = false;
    this.last = meta.frames.length - 1;
    control("time").max = String(this.last);
    control("player").hidden = this.last === 0;
    control("time").addEventListener("input", () => this.go(Number(control("time").value)));
    control("play").addEventListener("click", () => this.toggle());
    // The last frame is shown for the mean duration of a frame before the first comes again.
    this.end_s = this.time(this.last) + (this.time(this.last) - this.time(0)) / Math.max(this.last, 1);
  }

  time(row) {
    return meta.frames[row][1] || 0;
  }

  go(row) {
    this.row = Math.min(Math.max(row, 0), this.last);
    this.time_s = this.time(this.row);
    this.update();
    this.show(this.row);
  }

  update() {
    control("time").value = String(this.row);
    control("play").textContent = this.playing ? "Pause" : "Play";
    const number = `frame ${meta.frames[this.row][0]}`;
    control("clock").textContent = `${fixed(this.time(this.row), 2)} s, ${number}`;
    control("time").setAttribute("aria-valuetext", control("clock").textContent);
  }

  toggle() {
    if (this.last === 0) return;
    this.playing = !this.playing;
    if (this.playing && this.row === this.last) this.go(0);
    this.time_s = this.time(this.row);
    this.update();
    if (!this.playing) return;
    let before = performance.now();
    const step = (now) => {
      if (!this.playing) return;
      this.time_s += Math.max(now - before, 0) / 1000 * Number(control("speed").value);
      before = now;
      let row = this.row;
      while (row < this.last && this.time(row + 1) <= this.time_s) ++row;
      const again = control("loop").checked;
      if (row === this.last && !again) this.playing = false;
      if (row === this.last && again && this.time_s >= this.end_s) [row, this.time_s] = [0, this.time(0)];
      const time_s = this.time_s;
      if (row !== this.row || !this.playing) this.go(row);
      this.time_s = time_s;
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  // Returns whether the key belongs to the time controls.
  key(name) {
    if (name === " ") this.toggle();
    else if (name === "ArrowLeft") this.go(this.row - 1);
    else if (name === "ArrowRight") this.go(this.row + 1);
    else if (name === "Home") this.go(0);
    else if (name === "End") this.go(this.last);
    else return false;
    return true;
  }
}
