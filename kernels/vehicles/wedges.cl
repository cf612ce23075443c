// SPDX-License-Identifier: Apache-2.0
// wedges: the wedges of all instances in the scene's coordinates, for the poses of a frame. Those of absent instances
// get a length that no place is within.
#include "wavetracer/device/records.h"
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#pragma OPENCL FP_CONTRACT OFF

inline double turned(const global double* row, const global double* v) {
  return row[0] * v[0] + row[1] * v[1] + row[2] * v[2];
}

// One wedge per work-item. models[k] is wedge first + k in the coordinates of its model, complete except for its place.
kernel void wedges(const global wt_exact_instance* instances, const global wt_wedge* models, uint first, uint count,
                   global wt_wedge* out) {
  const uint k = get_global_id(0);
  if (k >= count) return;
  const global wt_wedge* model = models + k;
  const global wt_exact_instance* instance = instances + model->instance;
  wt_wedge placed = *model;
  for (int axis = 0; axis < 3; ++axis) {
    const global double* row = instance->rotation + 3 * axis;
    placed.start[axis] = turned(row, model->start) + instance->position[axis];
    placed.along[axis] = turned(row, model->along);
    placed.face[axis] = turned(row, model->face);
    placed.normal[axis] = turned(row, model->normal);
  }
  if (!instance->present) placed.length = (double)NAN;
  out[first + k] = placed;
}
