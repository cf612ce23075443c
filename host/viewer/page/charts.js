// SPDX-License-Identifier: Apache-2.0
// Charts of one link: power delay profile, azimuths of departure and arrival, path gain over time.
// Each stores the positions of its values for clicks and tests; colours are those of power.
"use strict";

class Chart {
  constructor(id) {
    this.canvas = control(id);
  }

  // Returns the cleared drawing context, in pixels of the layout; null while the chart is not shown.
  begin() {
    const {clientWidth: width, clientHeight: height} = this.canvas, ratio = devicePixelRatio || 1;
    if (!width || !height) return null;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    const pen = this.canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.font = "11px system-ui, 'DejaVu Sans', sans-serif";
    this.width = width;
    this.height = height;
    return pen;
  }

  // Draws the axes of a diagram; x and y: [lowest, highest]. Sets this.x and this.y, which map values to pixels.
  axes(pen, x, y, x_unit, y_unit) {
    const left = 44, bottom = this.height - 30, right = this.width - 10, top = 16;
    const scale = ([low, high], from, to) => (value) => from + (value - low) / (high - low) * (to - from);
    this.x = scale(x, left, right);
    this.y = scale(y, bottom, top);
    pen.fillStyle = theme().faint;
    pen.strokeStyle = theme().grid;
    pen.lineWidth = 1;
    pen.beginPath();
    for (const value of ticks(...x, 5)) {
      pen.moveTo(this.x(value), top);
      pen.lineTo(this.x(value), bottom);
      pen.textAlign = "center";
      pen.fillText(tick_text(value), this.x(value), bottom + 12);
    }
    for (const value of ticks(...y, 4)) {
      pen.moveTo(left, this.y(value));
      pen.lineTo(right, this.y(value));
      pen.textAlign = "right";
      pen.fillText(tick_text(value), left - 5, this.y(value) + 4);
    }
    pen.stroke();
    pen.textAlign = "right";
    pen.fillText(x_unit, right, bottom + 25);
    pen.textAlign = "left";
    pen.fillText(y_unit, 4, 10);
    return {left, right, top, bottom};
  }
}

const tick_text = (value) => signed(String(+value.toPrecision(6)));

// Returns the zero of the time axis: the first time, if the digits of ticks could not tell times apart otherwise.
function axis_zero() {
  const first = meta.frames[0][1] || 0, last = meta.frames[meta.frames.length - 1][1] || 0;
  return Math.abs(first) > (last > first ? 1e4 * (last - first) : 1e9) ? Math.floor(first) : 0;
}

// Returns about `most` round numbers from low to high.
function ticks(low, high, most) {
  const raw = (high - low) / most, power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((n) => n * power).find((s) => s >= raw) || 1;
  const out = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step && out.length <= 4 * most; ++k) out.push(k * step);
  return out;
}

// Returns the range of the values with a margin, at least `least` wide.
function span_of(values, least) {
  let low = Infinity, high = -Infinity;
  for (const value of values) if (Number.isFinite(value)) [low, high] = [Math.min(low, value), Math.max(high, value)];
  if (low > high) [low, high] = [0, least];
  const missing = Math.max(least - (high - low), 0) / 2 + (high - low) * 0.06;
  return [low - missing, high + missing];
}

// The rings of polar charts, as shares of the rim.
const polar_rings = [1 / 3, 2 / 3, 1];

const power_colour = (gain_db) => css(ramp((gain_db - lowest_db) / (highest_db - lowest_db)));

class Charts {
  // jump(row): shows the frame that was clicked.
  constructor(jump) {
    this.delay = new Chart("delay_chart");
    this.departure = new Chart("departure_chart");
    this.arrival = new Chart("arrival_chart");
    this.gain = new Chart("gain_chart");
    this.series = {key: "", rows: [], gains: []};
    this.gain.canvas.addEventListener("click", (event) => {
      const x = event.offsetX, time = (row) => (meta.frames[row][1] || 0) - axis_zero();
      if (!this.series.gains.some(Number.isFinite)) return;
      const away = (row) => Math.abs(this.gain.x(time(row)) - x);
      jump(this.series.rows.reduce((best, row) => (away(row) < away(best) ? row : best)));
    });
  }

  // link: [tx, rx], or null for none; selected: a row of the frame or -1.
  draw(frame, link, selected) {
    control("charts").hidden = !link;
    if (!link) return;
    const [tx, rx] = link;
    control("link_name").textContent = `${meta.transmitters[tx][0]} \u2192 ${meta.receivers[rx][0]}`;
    control("link_figures").replaceChildren(rows_table(link_figures(link_row(frame.row, tx, rx))));
    const rows = [];
    for (let i = 0; i < frame.paths; ++i)
      if (frame.tx[i] === tx && frame.rx[i] === rx && Number.isFinite(frame.gain_db[i])) rows.push(i);
    rows.sort((a, b) => frame.gain_db[a] - frame.gain_db[b]);
    this.draw_delay(frame, rows, selected);
    this.draw_angles(this.departure, frame, rows, frame.aod_phi, selected);
    this.draw_angles(this.arrival, frame, rows, frame.aoa_phi, selected);
    control("gain_figure").hidden = meta.frames.length < 2;
    if (meta.frames.length > 1) this.draw_gain(frame, tx, rx);
    this.delay.canvas.setAttribute("aria-label", `${rows.length} paths; the strongest ${
      rows.length ? fixed(frame.gain_db[rows[rows.length - 1]], 1) : "none"} dB`);
  }

  draw_delay(frame, rows, selected) {
    const pen = this.delay.begin();
    if (!pen) return;
    if (!rows.length) return this.say(pen, this.delay, "no path in this frame");
    const {bottom} = this.delay.axes(pen, span_of(rows.map((i) => frame.delay_s[i] * 1e9), 10),
                                     span_of(rows.map((i) => frame.gain_db[i]), 10), "delay, ns", "gain, dB");
    for (const i of rows) {
      const x = this.delay.x(frame.delay_s[i] * 1e9), y = this.delay.y(frame.gain_db[i]);
      pen.strokeStyle = pen.fillStyle = power_colour(frame.gain_db[i]);
      pen.lineWidth = i === selected ? 3 : 1.5;
      pen.beginPath();
      pen.moveTo(x, bottom);
      pen.lineTo(x, y);
      pen.stroke();
      this.dot(pen, x, y, i === selected);
    }
  }

  say(pen, chart, text) {
    pen.fillStyle = theme().faint;
    pen.textAlign = "center";
    pen.fillText(text, chart.width / 2, chart.height / 2);
  }

  dot(pen, x, y, selected) {
    pen.beginPath();
    pen.arc(x, y, selected ? 5 : 3, 0, 2 * Math.PI);
    pen.fill();
    if (!selected) return;
    pen.lineWidth = 1.5;
    pen.strokeStyle = theme().selected;
    pen.stroke();
  }

  // 0 degrees is +x, to the right; angles go towards +y, up. The gain grows outwards, by the scale of power.
  draw_angles(chart, frame, rows, phi, selected) {
    const pen = chart.begin();
    if (!pen) return;
    const cx = chart.width / 2, cy = chart.height / 2, rim = Math.min(cx, cy) - 4;
    pen.strokeStyle = theme().grid;
    pen.beginPath();
    for (const share of polar_rings) {
      pen.moveTo(cx + rim * share, cy);
      pen.arc(cx, cy, rim * share, 0, 2 * Math.PI);
    }
    for (let angle = 0; angle < 360; angle += 45) {
      pen.moveTo(cx, cy);
      pen.lineTo(cx + rim * Math.cos(angle * Math.PI / 180), cy - rim * Math.sin(angle * Math.PI / 180));
    }
    pen.stroke();
    chart.place = (i) => {
      const share = (frame.gain_db[i] - lowest_db) / (highest_db - lowest_db);
      const r = rim * Math.min(Math.max(share, 0.04), 1), angle = degrees(phi, i) * Math.PI / 180;
      return [cx + r * Math.cos(angle), cy - r * Math.sin(angle)];
    };
    for (const i of rows) {
      const [x, y] = chart.place(i);
      pen.strokeStyle = pen.fillStyle = power_colour(frame.gain_db[i]);
      pen.lineWidth = 1.2;
      pen.beginPath();
      pen.moveTo(cx, cy);
      pen.lineTo(x, y);
      pen.stroke();
      this.dot(pen, x, y, i === selected);
    }
    this.name_rings(pen, cx, cy, rim, rows.map((i) => degrees(phi, i)));
  }

  // Writes angles inside of the rim, and the gains of the rings along the diagonal that is farthest from all paths.
  // angles: those of the paths, in degrees.
  name_rings(pen, cx, cy, rim, angles) {
    const apart = (diagonal) => Math.min(...angles.map((angle) => Math.abs((((angle - diagonal) % 360) + 540) % 360 - 180)), 180);
    const diagonal = [315, 45, 135, 225].reduce((best, one) => (apart(one) > apart(best) ? one : best)) * Math.PI / 180;
    const write = (text, x, y, align) => {
      pen.textAlign = align;
      pen.strokeStyle = theme().panel;
      pen.lineWidth = 3;
      pen.strokeText(text, x, y);
      pen.fillText(text, x, y);
    };
    pen.font = "10px system-ui, 'DejaVu Sans', sans-serif";
    pen.fillStyle = theme().faint;
    pen.textBaseline = "middle";
    write("0\u00b0", cx + rim - 2, cy - 7, "right");
    write("90\u00b0", cx + 3, cy - rim + 8, "left");
    write("180\u00b0", cx - rim + 3, cy - 7, "left");
    write("270\u00b0", cx + 3, cy + rim - 8, "left");
    for (const share of polar_rings) {
      const gain_db = lowest_db + share * (highest_db - lowest_db), away = rim * share - 6;
      write(`${signed(String(+gain_db.toFixed(1)))}${share === 1 ? " dB" : ""}`, cx + away * Math.cos(diagonal), cy - away * Math.sin(diagonal),
            share < 1 ? "center" : Math.cos(diagonal) > 0 ? "right" : "left");
    }
  }

  // Returns the gain of the link in every frame that computed it; -Infinity if it has no path.
  gains(tx, rx) {
    const key = `${tx} ${rx}`;
    if (this.series.key === key) return this.series;
    const rows = [], gains = [];
    for (let k = 0; k < links.frame.length; ++k)
      if (links.tx[k] === tx && links.rx[k] === rx) {
        rows.push(links.frame[k]);
        gains.push(links.gain_db[k]);
      }
    this.series = {key, rows, gains};
    return this.series;
  }

  draw_gain(frame, tx, rx) {
    const pen = this.gain.begin();
    if (!pen) return;
    const zero = axis_zero(), time = (row) => (meta.frames[row][1] || 0) - zero;
    const {rows, gains} = this.gains(tx, rx);
    if (!gains.some(Number.isFinite)) return this.say(pen, this.gain, "no path in any frame");
    const {top, bottom} = this.gain.axes(pen, [time(0), Math.max(time(meta.frames.length - 1), time(0) + 1e-6)],
                                         span_of(gains, 5), zero ? `time after ${zero} s, s` : "time, s", "path gain, dB");
    pen.strokeStyle = pen.fillStyle = theme().accent;
    pen.lineWidth = 1.5;
    pen.beginPath();
    let before = -2;
    rows.forEach((row, k) => {
      if (!Number.isFinite(gains[k])) return;
      const x = this.gain.x(time(row)), y = this.gain.y(gains[k]);
      if (before === row - 1) pen.lineTo(x, y); else pen.moveTo(x, y);
      if (rows.length < 100) pen.rect(x - 1.5, y - 1.5, 3, 3), pen.moveTo(x, y);
      before = row;
    });
    pen.stroke();
    const now = this.gain.x(time(frame.row)), k = rows.indexOf(frame.row);
    pen.strokeStyle = theme().selected;
    pen.setLineDash([4, 3]);
    pen.beginPath();
    pen.moveTo(now, top);
    pen.lineTo(now, bottom);
    pen.stroke();
    pen.setLineDash([]);
    if (k >= 0 && Number.isFinite(gains[k])) this.dot(pen, now, this.gain.y(gains[k]), true);
  }
}
