// SPDX-License-Identifier: Apache-2.0
/* Derivatives of the paths of a frame, for C99 and for every language that calls C; see wavetracer.h. */
#ifndef WAVETRACER_GRADIENT_H
#define WAVETRACER_GRADIENT_H
#include "wavetracer/wavetracer.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Exact derivatives of the columns of a frame's paths at the first carrier; the sequences of their surfaces and edges
   stay as they are. wrt: a sum of enum wavetracer_wrt. rows: row_count paths, in any order; null: all of them. The
   frame is one of this simulation. The result is given back to _free. Returns null with an error. */
enum wavetracer_wrt {
  WAVETRACER_WRT_MATERIALS = 1,
  WAVETRACER_WRT_POSITIONS = 2,   /* those of both ends */
  WAVETRACER_WRT_ORIENTATIONS = 4 /* those of the antennas of both ends */
};
typedef struct wavetracer_gradient wavetracer_gradient;
wavetracer_gradient* wavetracer_frame_gradient(wavetracer_simulation* self, const wavetracer_frame* frame, unsigned wrt,
                                               const size_t* rows, size_t row_count, wavetracer_error** error);
void wavetracer_gradient_free(wavetracer_gradient* self);

/* The parameter by which a row differentiates. */
enum wavetracer_parameter {
  WAVETRACER_PERMITTIVITY = 0,     /* real part of the relative permittivity */
  WAVETRACER_CONDUCTIVITY = 1,     /* S/m */
  WAVETRACER_THICKNESS = 2,        /* m */
  WAVETRACER_SCATTERING = 3,       /* the coefficient S */
  WAVETRACER_ATTENUATION = 4,      /* dB/m, of vegetation */
  WAVETRACER_MOST_ATTENUATION = 5, /* dB, the most that a path loses in vegetation */
  WAVETRACER_TX_POSITION = 6,      /* and 7, 8: x, y, z of the transmitter, m */
  WAVETRACER_RX_POSITION = 9,      /* and 10, 11 */
  WAVETRACER_TX_TURN = 12,         /* and 13, 14: small turns of the transmitter's antenna about the axes x, y, z of the
                                      scene, rad, right-handed */
  WAVETRACER_RX_TURN = 15          /* and 16, 17 */
};

/* Says why the derivatives of a row are NaN. */
enum wavetracer_gap {
  WAVETRACER_GAP_NONE = 0,       /* they are there */
  WAVETRACER_GAP_NOT_SOLVED = 1, /* the points of the path are not those of the exact solution */
  WAVETRACER_GAP_POLE = 2,       /* a leg or an antenna points exactly to a pole of the angles or of the pattern */
  WAVETRACER_GAP_SINGULAR = 3,   /* the derivative is infinite or does not exist */
  WAVETRACER_GAP_JUMP = 4        /* the coefficients jump where coordinates round */
};

/* Columns of a gradient, which live as long as it:
     first                                                   uint64     rows first[i] to first[i + 1] - 1 of the others
                                                             belong to path i of the frame; one row more than there are
                                                             paths. A path has a row for each parameter that may change
                                                             it; by all other materials its derivatives are 0
     parameter                                               uint8      enum wavetracer_parameter
     material                                                uint32     its index; 0xFFFFFFFF for positions and turns
     a                                                       complex128 x rx ports x tx ports: derivative of a
     delay_s, aod_theta_rad, aod_phi_rad, aoa_theta_rad,     float64    derivatives of the columns of these names
     aoa_phi_rad
     gap                                                     uint8      enum wavetracer_gap
   Returns 1; 0 with an error of code USAGE where there is no such column. */
int wavetracer_gradient_column(const wavetracer_gradient* self, const char* name, wavetracer_column* column,
                               wavetracer_error** error);
/* Names of the materials of a gradient. Layer i of a wall W, counted from 0, has its thickness under the name
   "W.layers[i]". 0 or null if self is null or the index is too large. */
size_t wavetracer_gradient_material_count(const wavetracer_gradient* self);
const char* wavetracer_gradient_material_name(const wavetracer_gradient* self, size_t index);

#ifdef __cplusplus
}
#endif
#endif
