// SPDX-License-Identifier: Apache-2.0
// place: computes the surfaces of all instances in the scene's coordinates, for the poses of a frame: exact in double,
// and in float32 for discovery. Absent instances get surfaces that no point lies on.
#include "lib/images.clh"
#pragma OPENCL FP_CONTRACT OFF

inline double turned(const global double* row, double3 v) { return row[0] * v.x + row[1] * v.y + row[2] * v.z; }

// One surface per work-item; surface_instances[i] is the instance of surface first_surface + i.
kernel void place(const global wt_exact_instance* instances, const global wt_model_surface* models,
                  const global uint* surface_instances, uint first_surface, uint surface_count,
                  global wt_exact_surface* exact, global wt_surface* surfaces) {
  const uint i = get_global_id(0);
  if (i >= surface_count) return;
  const uint number = surface_instances[i];
  const global wt_exact_instance* instance = instances + number;
  const global wt_model_surface* s =
      models + instance->first_model_surface + (first_surface + i - instance->first_surface);
  const double3 model_n = (double3)(s->normal[0], s->normal[1], s->normal[2]);
  const double3 c = (double3)(0.5 * (s->lower[0] + s->upper[0]), 0.5 * (s->lower[1] + s->upper[1]),
                              0.5 * (s->lower[2] + s->upper[2]));
  const double3 h = (double3)(0.5 * (s->upper[0] - s->lower[0]), 0.5 * (s->upper[1] - s->lower[1]),
                              0.5 * (s->upper[2] - s->lower[2]));
  double offset = s->offset;
  for (int axis = 0; axis < 3; ++axis) {
    const global double* row = instance->rotation + 3 * axis;
    const double n = instance->present ? turned(row, model_n) : (double)NAN;
    offset += n * instance->position[axis];
    const double centre = turned(row, c) + instance->position[axis];
    const double half_size = fabs(row[0]) * h.x + fabs(row[1]) * h.y + fabs(row[2]) * h.z;
    exact[first_surface + i].normal[axis] = n;
    surfaces[first_surface + i].normal[axis] = (float)n;
    surfaces[first_surface + i].lower[axis] = (float)(centre - half_size);
    surfaces[first_surface + i].upper[axis] = (float)(centre + half_size);
  }
  exact[first_surface + i].offset = offset;
  exact[first_surface + i].first_triangle = s->first_triangle;
  exact[first_surface + i].triangle_count = s->triangle_count;
  exact[first_surface + i].instance = number;
  surfaces[first_surface + i].offset = (float)offset;
}
