// SPDX-License-Identifier: Apache-2.0
// Arguments of the kernels in kernels/fields, in the form of arguments.h, which includes this.
#ifndef WAVETRACER_DEVICE_FIELD_ARGUMENTS_H
#define WAVETRACER_DEVICE_FIELD_ARGUMENTS_H
#include "wavetracer/device/field_records.h"

#ifndef __OPENCL_VERSION__
using wavetracer::device::wt_air;
#endif

typedef struct {
  double origin[3];  // the origin of recentred coordinates in those of the file
  double wavelength_m;
  wt_ulong seed;
  wt_uint row_count;
  wt_uint row_capacity;
  wt_uint vertex_capacity;
  wt_uint max_depth;
  wt_uint transmissions;
  wt_uint scatters;
  wt_air air;
  wt_uint foliage_count;  // kinds of vegetation
  wt_uint reflections;    // the most reflections of a path
  wt_uint rows_of_item;   // CPUs: the rows that a work-item takes
  wt_uint for_sums;       // not 0: link_sums alone reads the rows, so there are no vertices
} wt_fields_arguments;

// Numbers for link_floors. scale: the floor of a link over the power of its strongest path without edges.
typedef struct {
  double wavelength_m;
  double scale;
  wt_air air;
  wt_uint visible_count;
  wt_uint visible_counter;  // the word in wt_counters that counts visible paths, or WT_NONE
  wt_uint max_depth;
  wt_uint receiver_count;
  wt_uint transmissions;
  wt_uint scatters;
  wt_uint reflections;
  wt_uint foliage_count;
} wt_link_floors_arguments;

typedef struct {
  double wavelength_m;
  wt_uint row_count;
  wt_uint row_capacity;
  wt_uint max_depth;
  wt_uint padding;
} wt_path_groups_arguments;

typedef struct {
  double frequency_hz;
  wt_uint link_count;
  wt_uint row_capacity;
  wt_uint values;   // fields of a row: 1, or 4 with antennas of two ports
  wt_uint grouped;  // not 0: rows have waves (path_groups)
} wt_link_sums_arguments;

typedef struct {
  wt_uint visible_count;
  wt_uint visible_counter;  // its word in wt_counters, or WT_NONE
  wt_uint max_depth;
  wt_uint kinds;  // kinds of vegetation
} wt_vegetation_arguments;

#endif
