// Which paths are shown: by transmitter, receiver, order, kind and power. Reads and writes the controls of the page.
// A filter is plain data, so that its test costs a few comparisons a path.
"use strict";

const control = (id) => document.getElementById(id);

class Filters {
  constructor(changed) {
    const fill = (select, ends) => {
      select.append(new Option("all", "-1"));
      ends.forEach(([name], i) => select.append(new Option(shortened(name, 60) || `number ${i}`, String(i))));
    };
    fill(control("transmitter"), meta.transmitters);
    fill(control("receiver"), meta.receivers);
    Kinds.forEach(([key, words], kind) => {
      const label = document.createElement("label"), box = document.createElement("input");
      box.type = "checkbox";
      box.id = "kind_" + key;
      box.value = String(kind);
      label.append(box, " " + words);
      control("kinds").append(label);
    });
    for (const id of ["least_order", "most_order"]) control(id).max = String(meta.highest_order);
    control("power").min = String(Math.floor(Math.min(meta.gain_range_db[0], lowest_db)) - 1);
    control("power").max = String(highest_db);
    this.changed = () => {
      this.read();
      changed();
    };
    for (const id of ["transmitter", "receiver"]) control(id).addEventListener("change", this.changed);
    for (const id of ["least_order", "most_order", "power", "kinds"]) control(id).addEventListener("input", this.changed);
    control("reset").addEventListener("click", () => this.reset());
    this.write_all();
    this.read();
  }

  write_all() {
    control("transmitter").value = control("receiver").value = "-1";
    control("least_order").value = "0";
    control("most_order").value = String(meta.highest_order);
    control("power").value = control("power").min;
    for (const [key] of Kinds) control("kind_" + key).checked = true;
  }

  reset() {
    this.write_all();
    this.changed();
  }

  // Indices of ends, -1 for all.
  set_link(tx, rx) {
    control("transmitter").value = String(tx);
    control("receiver").value = String(rx);
    this.changed();
  }

  read() {
    const number = (id, otherwise) => (control(id).value === "" ? otherwise : Number(control(id).value));
    this.tx = number("transmitter", -1);
    this.rx = number("receiver", -1);
    this.least_order = number("least_order", 0);
    this.most_order = number("most_order", Infinity);
    const power = control("power"), all = power.value === power.min;
    this.power_db = all ? -Infinity : Number(power.value);
    control("power_text").textContent = all ? "any" : `${power.value} dB`.replace("-", "\u2212");
    this.kinds = Kinds.map(([key]) => control("kind_" + key).checked);
  }

  wanted(frame, i) {
    if (this.tx >= 0 && frame.tx[i] !== this.tx) return false;
    if (this.rx >= 0 && frame.rx[i] !== this.rx) return false;
    const order = order_of(frame, i);
    return order >= this.least_order && order <= this.most_order && this.kinds[frame.kind[i]] &&
      !(frame.gain_db[i] < this.power_db) && (this.power_db === -Infinity || frame.gain_db[i] >= this.power_db);
  }
}
