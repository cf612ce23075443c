// solve: the image method in double for every candidate; keeps those whose points lie inside their surfaces, on the lit
// sides. Legs are not tested here (occlusion does that).
#include "lib/images.clh"
#pragma OPENCL FP_CONTRACT OFF

// Twice the signed area of (a, b, p), compared with -tolerance times the length of ab: is p left of ab, or at most 1e-9
// of the coordinates' size right of it? Inclusive, so that a point on the border of two surfaces is never lost; equal
// paths merge later.
inline int left_of(double ax, double ay, double bx, double by, double px, double py, double tolerance) {
  const double ex = bx - ax, ey = by - ay;
  return ex * (py - ay) - ey * (px - ax) >= -tolerance * (fabs(ex) + fabs(ey));
}

// Is p, a point of the plane, inside one of the surface's triangles? p and the normal n are in the coordinates of the
// triangles; decided in the projection along the normal's largest axis.
inline int inside(const global wt_exact_surface* s, const global double* triangles, double3 n, double3 p) {
  const double ax = fabs(n.x), ay = fabs(n.y), az = fabs(n.z);
  const int drop = ax > ay ? (ax > az ? 0 : 2) : (ay > az ? 1 : 2);
  const int x = drop == 0 ? 1 : 0, y = drop == 2 ? 1 : 2;
  const double px = drop == 0 ? p.y : p.x, py = drop == 2 ? p.y : p.z;
  const double tolerance = 1e-9 * (1.0 + fabs(p.x) + fabs(p.y) + fabs(p.z));
  for (uint k = 0; k < s->triangle_count; ++k) {
    const global double* t = triangles + 9 * (size_t)(s->first_triangle + k);
    const double x0 = t[x], y0 = t[y], x1 = t[3 + x], y1 = t[3 + y], x2 = t[6 + x], y2 = t[6 + y];
    const double area = (x1 - x0) * (y2 - y0) - (y1 - y0) * (x2 - x0);
    const int positive = area > 0.0;
    const double bx = positive ? x1 : x2, by = positive ? y1 : y2, cx = positive ? x2 : x1, cy = positive ? y2 : y1;
    if (left_of(x0, y0, bx, by, px, py, tolerance) && left_of(bx, by, cx, cy, px, py, tolerance) &&
        left_of(cx, cy, x0, y0, px, py, tolerance))
      return 1;
  }
  return 0;
}

// A vector in the axes of an instance's model: the inverse of a rotation is its transpose.
inline double3 unturned(const global wt_exact_instance* instance, double3 v) {
  const global double* r = instance->rotation;
  return (double3)(r[0] * v.x + r[3] * v.y + r[6] * v.z, r[1] * v.x + r[4] * v.y + r[7] * v.z,
                   r[2] * v.x + r[5] * v.y + r[8] * v.z);
}

inline double rounding(double3 p) { return 1e-9 * (1.0 + fabs(p.x) + fabs(p.y) + fabs(p.z)); }

inline int inside_surface(const global wt_exact_surface* s, const global double* triangles,
                          const global wt_exact_instance* instances, double3 p) {
  if (s->instance == WT_NONE) return inside(s, triangles, wt_normal(s), p);
  const global wt_exact_instance* i = instances + s->instance;
  const double3 q = (double3)(p.x - i->position[0], p.y - i->position[1], p.z - i->position[2]);
  return inside(s, triangles, unturned(i, wt_normal(s)), unturned(i, q));
}

inline int same_point(double3 p, double3 q) {
  return fabs(p.x - q.x) + fabs(p.y - q.y) + fabs(p.z - q.z) <= rounding(p);
}

kernel void solve(const global ulong* table, const global double4* transmitters, const global double4* receivers,
                  const global wt_exact_surface* surfaces, const global double* triangles,
                  const global wt_exact_instance* instances,
                  const global wt_candidate* candidates, uint candidate_count, uint max_depth, global wt_solved* solved,
                  global double* vertices, global uint* sequences, uint capacity, global wt_counters* counters) {
  const uint i = get_global_id(0);
  if (i >= candidate_count) return;
  uint chain[WT_MAX_DEPTH], transmitter;
  const uint back = candidates[i].back;
  uint depth = wt_chain(table, candidates[i].node, chain, &transmitter);
  if (back != WT_NONE)  // from the last surface but one on, as the receiver's rays met them last to first
    for (uint n = wt_trie_parent(table[back]); !(n & WT_ROOT) && depth < WT_MAX_DEPTH; n = wt_trie_parent(table[n]))
      chain[depth++] = wt_trie_surface(table[n]);
  // The vehicle that carries an antenna is no mirror to it, as it hides nothing from it.
  if (depth > 0) {
    const uint first = surfaces[chain[0]].instance, last = surfaces[chain[depth - 1]].instance;
    if ((first != WT_NONE && first == wt_end_instance(transmitters[transmitter])) ||
        (last != WT_NONE && last == wt_end_instance(receivers[candidates[i].receiver])))
      return;
  }
  double3 images[WT_MAX_DEPTH + 1], points[WT_MAX_DEPTH + 1];
  images[0] = transmitters[transmitter].xyz;
  for (uint k = 0; k < depth; ++k) images[k + 1] = wt_reflected(surfaces + chain[k], images[k]);

  // Backwards from the receiver: the leg to a point is aimed at the image behind the point's surface.
  double3 target = receivers[candidates[i].receiver].xyz;
  for (uint k = depth; k-- > 0;) {
    const global wt_exact_surface* s = surfaces + chain[k];
    const double a = wt_above(s, images[k + 1]), b = wt_above(s, target);
    double3 p = target;
    if (k + 1 < depth && fabs(b) <= rounding(target)) {
      // The point of the next surface is on this one as well. On an edge both reflect it there, with no leg between:
      // whichever comes first, rounding must not decide that neither does; the equal paths of both orders merge later.
      // Two surfaces in one plane, though, would undo each other's reflection, and let the leg through.
      const double cosine = wt_dot(wt_normal(s), wt_normal(surfaces + chain[k + 1]));
      if (cosine * cosine > 1.0 - 1e-6) return;
    } else {
      if (!((a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0))) return;
      const double u = a / (a - b);
      const double3 from = images[k + 1];
      p = (double3)(from.x + u * (target.x - from.x), from.y + u * (target.y - from.y),
                    from.z + u * (target.z - from.z));
    }
    if (!inside_surface(s, triangles, instances, p)) return;
    points[k] = p;
    target = p;
  }
  // The leg that arrives at a surface must come from the side that it leaves to. Legs of no length are passed over.
  for (uint k = 0; k < depth; ++k) {
    uint before = k, after = k + 1;
    while (before > 0 && same_point(points[before - 1], points[k])) --before;
    while (after < depth && same_point(points[after], points[k])) ++after;
    const double a = wt_above(surfaces + chain[k], before > 0 ? points[before - 1] : images[0]);
    const double b =
        wt_above(surfaces + chain[k], after < depth ? points[after] : receivers[candidates[i].receiver].xyz);
    if (!((a < 0.0 && b < 0.0) || (a > 0.0 && b > 0.0))) return;
  }
  // A receiver at a transmitter has no line of sight.
  if (depth == 0 && target.x == images[0].x && target.y == images[0].y && target.z == images[0].z) return;
  const uint slot = atomic_inc(&counters->solved);
  if (slot >= capacity) return;
  solved[slot].transmitter = transmitter;
  solved[slot].receiver = candidates[i].receiver;
  solved[slot].depth = depth;
  solved[slot].blocked = 0;
  solved[slot].node = back == WT_NONE ? candidates[i].node : WT_NONE;
  for (uint k = 0; k < depth; ++k) {
    const size_t at = (size_t)slot * max_depth + k;
    vertices[3 * at] = points[k].x;
    vertices[3 * at + 1] = points[k].y;
    vertices[3 * at + 2] = points[k].z;
    sequences[at] = chain[k];
  }
}
