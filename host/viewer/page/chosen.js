// SPDX-License-Identifier: Apache-2.0
// Finds the chosen path in other frames: the one of the same link over the same surfaces and edges. The number of a
// path has no meaning in another frame, but its sequence has.
"use strict";

// Tells whether paths i and j, of frames that may differ, have one link and one sequence.
function same_sequence(one, i, other, j) {
  const order = order_of(one, i);
  if (one.tx[i] !== other.tx[j] || one.rx[i] !== other.rx[j] || order !== order_of(other, j)) return false;
  const a = first_vertex(one, i), b = first_vertex(other, j);
  for (let k = 0; k < order; ++k)
    for (const column of ["vertex_interaction", "vertex_surface", "vertex_instance"])
      if (one[column][a + k] !== other[column][b + k]) return false;
  return true;
}

class ChosenPath {
  constructor() {
    this.frame = null;
    this.row = -1;
  }

  // i: a row of the frame, -1 for none.
  choose(frame, i) {
    this.frame = i >= 0 ? frame : null;
    this.row = i;
  }

  get link() {
    return this.frame ? [this.frame.tx[this.row], this.frame.rx[this.row]] : null;
  }

  // Returns its row in another frame, or -1; if there are several, the one with the most similar delay.
  find(frame) {
    let best = -1;
    if (!this.frame) return best;
    const away = (i) => Math.abs(frame.delay_s[i] - this.frame.delay_s[this.row]);
    for (let i = 0; i < frame.paths; ++i)
      if (same_sequence(this.frame, this.row, frame, i) && (best < 0 || away(i) < away(best))) best = i;
    return best;
  }
}
