// SPDX-License-Identifier: Apache-2.0
// Decides which paths are shown: by transmitter, receiver, order, kind and power. It reads and writes the controls of
// the page. A filter is plain data, so that testing a path costs a few comparisons.
"use strict";

const control = (id) => document.getElementById(id);

// Sorts rx2 before rx10.
const by_name = new Intl.Collator("en", {numeric: true});
const name_of = (ends, i) => ends[i][0] || `number ${i}`;

// A longer list would not help: other ends are found by their names.
const most_options = 400;

function fill_select(select, ends, indices) {
  const sorted = [...indices].sort((a, b) => by_name.compare(name_of(ends, a), name_of(ends, b)) || a - b);
  select.append(new Option("all", "-1"));
  for (const i of sorted.slice(0, most_options)) select.append(new Option(shortened(name_of(ends, i), 60), String(i)));
  if (sorted.length <= most_options) return;
  select.append(new Option(`${sorted.length - most_options} more: find them by name`, ""));
  select.lastChild.disabled = true;
}

// Chooses an end that may not be in the list, such as a cell of a map.
function set_select(select, ends, i) {
  if (i >= 0 && ![...select.options].some(({value}) => value === String(i)))
    select.append(new Option(shortened(name_of(ends, i), 60), String(i)));
  select.value = String(i);
}

class Filters {
  // changed(link_chosen): link_chosen says whether the user has just chosen another transmitter or receiver.
  constructor(changed) {
    fill_select(control("transmitter"), meta.transmitters,
                [...meta.transmitters.keys()].filter((tx) => is_taken(meta.transmitters[tx])));
    fill_select(control("receiver"), meta.receivers, own_receivers.filter((rx) => is_taken(meta.receivers[rx])));
    for (const kind of shown_kinds) {
      const label = document.createElement("label"), box = document.createElement("input");
      box.type = "checkbox";
      box.id = "kind_" + path_kinds[kind].word;
      box.value = String(kind);
      label.append(box, " " + words_of_kind(kind));
      control("kinds").append(label);
    }
    for (const id of ["least_order", "most_order"]) control(id).max = String(meta.highest_order);
    control("power").min = String(Math.floor(Math.min(meta.gain_range_db[0], lowest_db)) - 1);
    control("power").max = String(highest_db);
    this.changed = (link_chosen = false) => {
      this.read();
      changed(link_chosen);
    };
    for (const id of ["transmitter", "receiver"]) control(id).addEventListener("change", () => this.changed(true));
    for (const id of ["least_order", "most_order", "power", "kinds"])
      control(id).addEventListener("input", () => this.changed());
    control("reset").addEventListener("click", () => this.reset());
    this.write_all();
    this.read();
  }

  write_all() {
    control("transmitter").value = control("receiver").value = "-1";
    control("least_order").value = "0";
    control("most_order").value = String(meta.highest_order);
    control("power").value = control("power").min;
    for (const box of control("kinds").querySelectorAll("input")) box.checked = true;
  }

  reset() {
    this.write_all();
    this.changed();
  }

  // tx, rx: indices of ends, -1 for all.
  set_link(tx, rx, link_chosen = true) {
    set_select(control("transmitter"), meta.transmitters, tx);
    set_select(control("receiver"), meta.receivers, rx);
    this.changed(link_chosen);
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
    this.kinds = new Array(path_kinds.length).fill(true);
    for (const box of control("kinds").querySelectorAll("input")) this.kinds[Number(box.value)] = box.checked;
  }

  // Paths to the cells of a map would hide it: only those of the chosen cell are shown.
  wanted(frame, i) {
    if (this.tx >= 0 && frame.tx[i] !== this.tx) return false;
    if (this.rx >= 0 ? frame.rx[i] !== this.rx : grid_of[frame.rx[i]] >= 0) return false;
    const order = order_of(frame, i);
    return order >= this.least_order && order <= this.most_order && this.kinds[frame.kind[i]] &&
      !(frame.gain_db[i] < this.power_db) && (this.power_db === -Infinity || frame.gain_db[i] >= this.power_db);
  }
}
