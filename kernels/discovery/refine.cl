// SPDX-License-Identifier: Apache-2.0
// refine: finds the samples of a launch that are worth four more each. A sample is a cell of the sphere of directions,
// and its end is the sequence that its ray met. Where few samples of the launch have that end, others like it are
// missed.
#include "wavetracer/device/records.h"

// Adds to hits[n] the number of samples that end in sequence n.
kernel void count_ends(const global uint* ends, uint count, global uint* hits) {
  const uint i = get_global_id(0);
  if (i < count && !(ends[i] & WT_ROOT)) atomic_inc(hits + ends[i]);
}

// Sets marks[i] to i for samples to refine, those whose end at most `rare` samples share, and to WT_NONE for others.
kernel void mark(const global uint* ends, uint count, const global uint* hits, uint rare, global uint* marks) {
  const uint i = get_global_id(0);
  if (i < count) marks[i] = !(ends[i] & WT_ROOT) && hits[ends[i]] <= rare ? i : WT_NONE;
}

// Lists the four cells, one level further down, of each listed cell: samples are (cell, launcher), in planes of
// `capacity`.
kernel void split(const global uint* list, uint count, const global uint* samples, uint capacity,
                  global uint* next_samples, uint next_capacity) {
  const uint k = get_global_id(0);
  if (k >= count) return;
  const uint i = list[k], cell = samples[i], launcher = samples[capacity + i];
  for (uint c = 0; c < 4; ++c) {
    next_samples[4 * k + c] = 4 * cell + c;
    next_samples[next_capacity + 4 * k + c] = launcher;
  }
}

// Counts sequences that were met once, and those that were met at all.
kernel void count_met(const global uint* hits, uint slots, global uint* met) {
  const uint slot = get_global_id(0);
  if (slot >= slots || hits[slot] == 0) return;
  if (hits[slot] == 1) atomic_inc(met);
  atomic_inc(met + 1);
}
