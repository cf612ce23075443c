// join: paths between ends that send and receive, met in the middle. What one end's rays lived through up to a surface,
// and what the other's did, back to front, is one sequence: half as deep a launch an end serves all its links.
// Rejected in float32 as candidates are; sequences of d interactions are joined of d / 2 + 1 and the rest.
#include "lib/images.clh"
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

// The first place whose key is not below `key`.
inline uint lower_bound(const global uint* keys, uint count, uint key) {
  uint low = 0, high = count;
  while (low < high) {
    const uint middle = (low + high) / 2;
    if (keys[middle] < key)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

// May the line between two images pass through the surface, from side to side? As in candidates.
inline int may_pass(const global wt_surface* s, float3 a, float3 b) {
  const float3 n = (float3)(s->normal[0], s->normal[1], s->normal[2]);
  const float above_a = n.x * a.x + n.y * a.y + n.z * a.z - s->offset;
  const float above_b = n.x * b.x + n.y * b.y + n.z * b.z - s->offset;
  const float size = fabs(a.x) + fabs(a.y) + fabs(a.z) + fabs(b.x) + fabs(b.y) + fabs(b.z) + fabs(s->offset);
  const float error = 1e-6f * size, legs = fabs(above_a) + fabs(above_b), u = fabs(above_a) / legs;
  if (!(legs > 4.0f * error)) return 1;
  if ((above_a > 0.0f ? above_b : -above_b) > error) return 0;
  const float margin = error * (4.0f + 2.0f * size / legs) + 1e-3f;
  const float x = a.x + u * (b.x - a.x), y = a.y + u * (b.y - a.y), z = a.z + u * (b.z - a.z);
  return x >= s->lower[0] - margin && x <= s->upper[0] + margin && y >= s->lower[1] - margin &&
         y <= s->upper[1] + margin && z >= s->lower[2] - margin && z <= s->upper[2] + margin;
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
  for (uint j = lower_bound(keys, node_count, surface); j < node_count && keys[j] == surface; ++j) {
    const float4 before = prefix_of[WT_PREFIX_FLOAT4S * order[j] + 1];
    const uint other_depth = as_uint(before.w);
    if ((other_depth != depth && other_depth + 1 != depth) || depth + other_depth - 1 > max_depth) continue;
    const uint receiver = receiver_of_transmitter[as_uint(prefix_of[WT_PREFIX_FLOAT4S * order[j]].w)];
    if (receiver == WT_NONE || !(links[(size_t)transmitter * groups + receiver / 16] >> receiver % 16 & 1)) continue;
    if (!may_pass(surfaces + surface, image.xyz, before.xyz)) continue;
    const uint slot = atomic_inc(&counters->candidates);
    if (slot >= capacity) continue;
    out[slot].node = nodes[a];
    out[slot].receiver = receiver;
    out[slot].back = nodes[order[j]];
  }
}
