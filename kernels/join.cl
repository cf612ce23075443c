// join: paths between ends that send and receive, met in the middle. What one end's rays lived through up to a surface,
// and what the other's did, back to front, is one sequence: half as deep a launch an end serves all its links.
// Rejected in float32 as candidates are; sequences of d interactions are joined of d / 2 + 1 and the rest.
#include "lib/images.clh"
#include "lib/join.clh"
#pragma OPENCL FP_CONTRACT OFF

// A prefix: the transmitter's image in all its surfaces and in all but the last, and as words its transmitter and
// depth.
#define WT_PREFIX_FLOAT4S 2

// keys[i] is the last surface of node i, none for roots, single surfaces (whose end candidates joins) and prefixes of
// more than most_depth.
kernel void prefixes(const global ulong* table, const global uint* nodes, uint node_count, uint most_depth,
                     uint surface_count, const global double4* transmitters, const global wt_exact_surface* exact,
                     global uint* keys, global float4* prefix_of) {
  const uint i = get_global_id(0);
  if (i >= node_count) return;
  uint chain[WT_MAX_DEPTH], transmitter;
  const uint depth = wt_chain(table, nodes[i], chain, &transmitter);
  keys[i] = surface_count;
  if (depth < 2 || depth > most_depth) return;
  double3 image = transmitters[transmitter].xyz;
  for (uint k = 0; k + 1 < depth; ++k) image = wt_reflected(exact + chain[k], image);
  const double3 last = wt_reflected(exact + chain[depth - 1], image);
  keys[i] = chain[depth - 1];
  prefix_of[WT_PREFIX_FLOAT4S * i] = (float4)((float)last.x, (float)last.y, (float)last.z, as_float(transmitter));
  prefix_of[WT_PREFIX_FLOAT4S * i + 1] = (float4)((float)image.x, (float)image.y, (float)image.z, as_float(depth));
}

// One prefix a work-item, in order of the last surface, against all that end on the same. keys and order: sorted, with
// the place in nodes that each had.
kernel void join(const global uint* keys, const global uint* order, uint node_count, uint surface_count,
                 const global uint* nodes, const global float4* prefix_of, const global uint* receiver_of_transmitter,
                 const global ushort* links, uint groups, uint max_depth, const global wt_surface* surfaces,
                 global wt_candidate* out, uint capacity, global wt_counters* counters) {
  const uint i = get_global_id(0);
  if (i >= node_count || keys[i] == surface_count) return;
  const uint a = order[i], surface = keys[i];
  const float4 image = prefix_of[WT_PREFIX_FLOAT4S * a];
  const uint transmitter = as_uint(image.w), depth = as_uint(prefix_of[WT_PREFIX_FLOAT4S * a + 1].w);
  for (uint j = wt_lower_bound(keys, node_count, surface); j < node_count && keys[j] == surface; ++j) {
    const float4 before = prefix_of[WT_PREFIX_FLOAT4S * order[j] + 1];
    const uint other_depth = as_uint(before.w);
    if ((other_depth != depth && other_depth + 1 != depth) || depth + other_depth - 1 > max_depth) continue;
    const uint receiver = receiver_of_transmitter[as_uint(prefix_of[WT_PREFIX_FLOAT4S * order[j]].w)];
    if (receiver == WT_NONE || !(links[(size_t)transmitter * groups + receiver / 16] >> receiver % 16 & 1)) continue;
    if (!wt_may_pass(surfaces + surface, image.xyz, before.xyz)) continue;
    const uint slot = atomic_inc(&counters->candidates);
    if (slot >= capacity) continue;
    out[slot].node = nodes[a];
    out[slot].receiver = receiver;
    out[slot].back = nodes[order[j]];
  }
}
