// SPDX-License-Identifier: Apache-2.0
// Reflection and transmission of a plane wave at a wall of several layers in free space. Fields along the wall are
// carried from its far side to its near side, layer by layer (characteristic matrices: M. Born, E. Wolf, Principles of
// Optics, section 1.6). A wall of one layer is a slab (slab.h).
#ifndef WAVETRACER_DEVICE_LAYERS_H
#define WAVETRACER_DEVICE_LAYERS_H
#include "wavetracer/device/field_records.h"
#include "wavetracer/device/slab.h"

// A device need not compile code for walls of several layers where there are none.
#ifndef WT_LAYERS
#define WT_LAYERS 1
#endif

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// The layers of a wall, as a wave meets them.
typedef struct {
  const WT_GLOBAL wt_material* first;  // the layer on the side of the normal, or on the other side if `reversed`
  wt_uint count;                       // 0: the wall is a slab
  int from_last;                       // the wave meets the last layer first
} wt_layers;

inline wt_layers wt_no_layers(void) {
  wt_layers out;
  out.first = 0;
  out.count = 0;
  out.from_last = 0;
  return out;
}

// materials: the table; packed: wt_material.layers; along_normal: the wave travels along the normal of the surface, and
// so meets its other side.
inline wt_layers wt_layers_of(const WT_GLOBAL wt_material* materials, wt_uint packed, int along_normal) {
  wt_layers out;
  out.first = materials + (packed >> WT_LAYER_SHIFT);
  out.count = packed & WT_LAYER_COUNT;
  out.from_last = along_normal != ((packed & WT_LAYERS_REVERSED) != 0);
  return out;
}

inline wt_double2 wt_permittivity_of(const WT_GLOBAL wt_material* material) {
  return WT_DOUBLE2(material->permittivity[0], material->permittivity[1]);
}

// The permittivity that the wave meets first. slab: that of a wall without layers.
inline wt_double2 wt_met_permittivity(wt_layers layers, wt_double2 slab) {
  if (layers.count == 0) return slab;
  return wt_permittivity_of(layers.first + (layers.from_last ? layers.count - 1 : 0));
}

// Fields along a plane of the wall, apart from a common factor: for TE `field` is the electric and `other` the magnetic
// one, for TM the other way round. echo: c field - other, which vanishes for a single wave in free space that goes on
// at the angle of cos theta = c; thin layers make it from nothing, so it is no difference of large numbers.
typedef struct {
  wt_double2 field, other, echo;
} wt_plane_fields;

inline double wt_extent(wt_double2 a) { return fabs(a.x) + fabs(a.y); }

// Carries the fields through a layer, up to a factor 2 exp(-j q), which wt_layer_coefficients keeps. weight: 1 (TE) or
// the permittivity (TM); difference: (weight c)^2 - s^2 in a form without cancellation. The matrix of the layer,
//   cos q, j sin q / w; j w sin q, cos q,  w = s / weight,
// is made of E = exp(-2 j q), which is at most 1 in size, and of (1 - E) / s, so nothing overflows.
inline wt_plane_fields wt_through_layer(const wt_inside* in, wt_double2 weight, wt_double2 difference, double c,
                                        wt_plane_fields behind) {
  wt_plane_fields out;
  if (in->half_space) {  // one wave goes away in it, whatever lies behind
    out.field = wt_real(1.0);
    out.other = wt_over(in->s, weight);
    out.echo = wt_over(difference, wt_times(weight, weight * c + in->s));
    return out;
  }
  const wt_double2 both = wt_real(1.0) + in->round_trip, turn = wt_times(weight, in->missing);
  const wt_double2 back = wt_over(wt_times(wt_times(in->s, in->s), in->missing), weight);
  const wt_double2 shift = wt_over(wt_times(difference, in->missing), weight);
  out.field = wt_times(both, behind.field) + wt_times(turn, behind.other);
  out.other = wt_times(back, behind.field) + wt_times(both, behind.other);
  // The echo is carried on by itself, or is the difference; of the two, that with the smaller terms loses less.
  const wt_double2 kept = wt_times(both - turn * c, behind.echo), made = wt_times(shift, behind.field);
  out.echo = kept + made;
  if (wt_extent(kept) + wt_extent(made) > c * wt_extent(out.field) + wt_extent(out.other))
    out.echo = out.field * c - out.other;
  return out;
}

// passed: the factor of the fields on the far side over those on this side.
inline void wt_wall_of(const wt_plane_fields* at, wt_double2 passed, double c, wt_double2* reflection,
                       wt_double2* transmission) {
  const wt_double2 share = wt_over(wt_real(1.0), at->field * c + at->other);
  *reflection = wt_times(at->echo, share);
  *transmission = wt_times(passed * (2.0 * c), share);
}

// At grazing incidence every wall reflects all, unless it is empty.
inline wt_slab wt_grazed_wall(wt_layers layers) {
  int empty = 1;
  for (wt_uint i = 0; i < layers.count; ++i) {
    const wt_double2 permittivity = wt_permittivity_of(layers.first + i);
    empty = empty && ((permittivity.x == 1.0 && permittivity.y == 0.0) || layers.first[i].thickness_m == 0.0);
  }
  wt_slab out;
  out.reflection_te = out.reflection_tm = wt_real(empty ? 0.0 : -1.0);
  out.transmission_te = out.transmission_tm = wt_real(empty ? 1.0 : 0.0);
  return out;
}

// Takes cos_theta and wavelength_m as wt_slab_coefficients does. There is one layer or more.
WT_CALLED wt_slab wt_layer_coefficients(wt_layers layers, double cos_theta, double wavelength_m) {
  if (layers.count == 1)
    return wt_slab_coefficients(wt_permittivity_of(layers.first), cos_theta, layers.first->thickness_m, wavelength_m);
  const double c = cos_theta;
  if (c == 0.0) return wt_grazed_wall(layers);
  wt_plane_fields te, tm;
  te.field = wt_real(1.0);  // behind the wall, one wave goes away in free space
  te.other = wt_real(c);
  te.echo = wt_real(0.0);
  tm = te;
  wt_double2 passed = wt_real(1.0);
  for (wt_uint i = 0; i < layers.count; ++i) {
    const WT_GLOBAL wt_material* layer = layers.first + (layers.from_last ? i : layers.count - 1 - i);
    const wt_double2 permittivity = wt_permittivity_of(layer), contrast = permittivity - wt_real(1.0);
    const wt_inside in = wt_inside_of(permittivity, c, layer->thickness_m, wavelength_m);
    te = wt_through_layer(&in, wt_real(1.0), -contrast, c, te);
    tm = wt_through_layer(&in, permittivity, wt_times(contrast, (permittivity + wt_real(1.0)) * (c * c) - wt_real(1.0)),
                          c, tm);
    passed = wt_times(passed, in.one_pass * 2.0);
  }
  wt_slab out;
  wt_wall_of(&te, passed, c, &out.reflection_te, &out.transmission_te);
  wt_wall_of(&tm, passed, c, &out.reflection_tm, &out.transmission_tm);
  return out;
}

// The coefficients of a wall: of its layers, if it has any, else of the slab.
inline wt_slab wt_wall_coefficients(wt_layers layers, wt_double2 permittivity, double cos_theta, double thickness_m,
                                    double wavelength_m) {
#if WT_LAYERS
  if (layers.count > 0) return wt_layer_coefficients(layers, cos_theta, wavelength_m);
#endif
  return wt_slab_coefficients(permittivity, cos_theta, thickness_m, wavelength_m);
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
