// SPDX-License-Identifier: Apache-2.0
// Finds ends by their names: a field for text, and the few best matches as buttons.
// Cells of maps are found too, though no list contains them.
"use strict";

const most_found = 8, most_sorted = 300;  // for each kind of match

// choose(role, i): role is "tx" or "rx". It is shown if there are more ends than one sees at a glance.
class NameSearch {
  constructor(choose) {
    this.choose = choose;
    control("search").hidden = meta.transmitters.length + meta.receivers.length <= 12;
    control("find").addEventListener("input", () => this.show(control("find").value));
    control("find").addEventListener("keydown", (event) => {
      if (event.key === "Enter" && control("found").firstChild) control("found").firstChild.click();
      if (event.key === "Escape") this.show(control("find").value = "");
    });
  }

  // Returns [role, index] of ends, the first one of each name; whole names come first, then those that begin with the
  // text.
  matches(text) {
    const wanted = text.trim().toLowerCase(), found = new Map(), counts = [0, 0, 0];
    if (!wanted) return [];
    for (const [role, ends] of [["tx", meta.transmitters], ["rx", meta.receivers]])
      for (let i = 0; i < ends.length; ++i) {
        const name = ends[i][0].toLowerCase(), at = name.indexOf(wanted);
        const rank = name === wanted ? 0 : at === 0 ? 1 : 2;
        if (at < 0 || found.has(ends[i][0]) || counts[rank] === most_sorted) continue;
        ++counts[rank];
        found.set(ends[i][0], [rank, role, i]);
      }
    const sorted = [...found].sort(([a, [one]], [b, [other]]) => one - other || by_name.compare(a, b));
    return sorted.slice(0, most_found).map(([, [, role, i]]) => [role, i]);
  }

  show(text) {
    control("found").replaceChildren(...this.matches(text).map(([role, i]) => {
      const button = element("button", name_of(role === "tx" ? meta.transmitters : meta.receivers, i));
      button.type = "button";
      button.addEventListener("click", () => {
        this.show(control("find").value = "");
        this.choose(role, i);
      });
      return button;
    }));
    if (text.trim() && !control("found").firstChild) control("found").append(element("p", "No antenna has that name."));
  }
}
