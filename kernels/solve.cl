// solve: the image method in double for every candidate; keeps those whose points lie inside their surfaces, on the lit
// sides. Legs are not tested here (occlusion does that).
#include "lib/reflections.clh"
#include "wavetracer/device/arguments.h"
#pragma OPENCL FP_CONTRACT OFF

kernel void solve(const global ulong* table, const global uint* quarters, const global double4* transmitters,
                  const global double4* receivers, const global wt_exact_surface* surfaces,
                  const global double* triangles, const global wt_exact_instance* instances,
                  const global wt_candidate* candidates, global wt_solved* solved, global double* vertices,
                  global uint* sequences, global wt_counters* counters, wt_solve_arguments args) {
  const uint i = get_global_id(0);
  if (i >= args.candidate_count) return;
  uint chain[WT_MAX_DEPTH], transmitter;
  const uint depth = wt_chain(table, candidates[i].node, chain, &transmitter);
  // The vehicle that carries an antenna is no mirror to it, as it hides nothing from it.
  if (depth > 0) {
    const uint first = surfaces[chain[0]].instance, last = surfaces[chain[depth - 1]].instance;
    if ((first != WT_NONE && first == wt_end_instance(transmitters[transmitter])) ||
        (last != WT_NONE && last == wt_end_instance(receivers[candidates[i].receiver])))
      return;
  }
  double3 images[WT_MAX_DEPTH + 1], points[WT_MAX_DEPTH];
  images[0] = transmitters[transmitter].xyz;
  for (uint k = 0; k < depth; ++k) images[k + 1] = wt_reflected(surfaces + chain[k], images[k]);
  const double3 to = receivers[candidates[i].receiver].xyz;
  if (!wt_reflection_points(surfaces, triangles, instances, chain, depth, images, to, points)) return;
  const uint slot = atomic_inc(&counters->solved);
  if (slot >= args.capacity) return;
  solved[slot].transmitter = transmitter;
  solved[slot].receiver = candidates[i].receiver;
  solved[slot].depth = depth;
  solved[slot].blocked = 0;
  solved[slot].node = candidates[i].node;
  solved[slot].quarters = wt_found_by(quarters, candidates[i].node);
  for (uint k = 0; k < depth; ++k) {
    const size_t at = (size_t)slot * args.max_depth + k;
    vstore3(points[k], at, vertices);
    sequences[at] = chain[k];
  }
}
