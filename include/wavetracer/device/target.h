// SPDX-License-Identifier: Apache-2.0
// The wave that a point of a target sends on, from its radar cross section: 3GPP TR 38.901 V19, 7.9.2. The cross
// section is a function of the bisector of the directions to both ends, in the axes of the target, and of the bistatic
// angle between them, so it is the same for the way back. docs/targets.md has the laws.
#ifndef WAVETRACER_DEVICE_TARGET_H
#define WAVETRACER_DEVICE_TARGET_H
#include "wavetracer/device/antenna.h"
#include "wavetracer/device/path_world.h"
#include "wavetracer/device/target_facet.h"
#include "wavetracer/device/utd.h"

#if WT_TARGETS
#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// A vector of the scene in the axes of the target, and the reverse.
inline wt_double3 wt_in_target(const WT_GLOBAL double* r, wt_double3 v) {
  return WT_DOUBLE3(r[0] * v.x + r[3] * v.y + r[6] * v.z, r[1] * v.x + r[4] * v.y + r[7] * v.z,
                    r[2] * v.x + r[5] * v.y + r[8] * v.z);
}
inline wt_double3 wt_out_of_target(const WT_GLOBAL double* r, wt_double3 v) {
  return WT_DOUBLE3(wt_dot3(wt_vector(r), v), wt_dot3(wt_vector(r + 3), v), wt_dot3(wt_vector(r + 6), v));
}

// Theta-hat and phi-hat of a direction in the axes of the target, as vectors of the scene.
inline wt_basis wt_target_basis(const WT_GLOBAL double* r, wt_double3 direction) {
  const wt_basis own = wt_spherical_basis(wt_in_target(r, direction));
  wt_basis out;
  out.first = wt_out_of_target(r, own.first);
  out.second = wt_out_of_target(r, own.second);
  return out;
}

// The angle without whole turns, from 0 to 2 pi.
inline double wt_without_turns(double angle) { return angle - 2.0 * WT_PI * floor(angle / (2.0 * WT_PI)); }

inline int wt_lobe_counts(const WT_GLOBAL wt_target_lobe* lobe, wt_angles bisector) {
  return bisector.theta >= lobe->zenith_from && bisector.theta < lobe->zenith_to &&
         wt_without_turns(bisector.phi - lobe->azimuth_from) < lobe->azimuth_span;
}

// The loss of a lobe in dB at an angle from its peak: 12 (angle / width)^2.
inline double wt_lobe_loss(double angle, double width) {
  return width > 0.0 ? 12.0 * (angle / width) * (angle / width) : 0.0;
}

// The cross section of a lobe in dBsm (eq. 7.9.2-3). bistatic_db: the loss by the bistatic angle.
inline double wt_lobe_section(const WT_GLOBAL wt_target_lobe* lobe, wt_angles bisector, double bistatic_db) {
  const double across = wt_without_turns(bisector.phi - lobe->azimuth + WT_PI) - WT_PI;
  const double loss_db = fmin(wt_lobe_loss(bisector.theta - lobe->zenith, lobe->zenith_width), lobe->range_db) +
                         fmin(wt_lobe_loss(across, lobe->azimuth_width), lobe->range_db);
  return lobe->peak_db - fmin(fmin(loss_db, lobe->range_db) + bistatic_db, lobe->range_db);
}

// The cross section in dBsm: that of the strongest of the lobes that count; -infinity where none does. to_source and
// to_goal: directions from the point to both ends, in the axes of the target.
inline double wt_cross_section(const WT_GLOBAL wt_target_law* law, const WT_GLOBAL wt_target_lobe* lobes,
                               wt_double3 to_source, wt_double3 to_goal) {
  const wt_double3 sum = to_source + to_goal;
  const double cosine = 0.5 * wt_length3(sum), sine = 0.5 * wt_length3(to_source - to_goal);
  const wt_angles bisector = wt_angles_of(cosine > 1e-9 ? sum / (2.0 * cosine) : WT_DOUBLE3(0.0, 0.0, 1.0));
  const double half_angle = law->k[0] != 0.0 ? wt_atan2(sine, cosine) : 0.0;
  const double bistatic_db = law->k[0] * wt_cos_sin(law->k[1] * half_angle).y -
                             (law->k[2] != 0.0 ? law->k[2] * wt_log10(fmax(cosine, 1e-150)) : 0.0);
  double section_db = -WT_INFINITY;
  for (wt_uint i = law->first_lobe; i < law->first_lobe + law->lobe_count; ++i)
    if (wt_lobe_counts(lobes + i, bisector))
      section_db = fmax(section_db, wt_lobe_section(lobes + i, bisector, bistatic_db));
  return section_db;
}

// The wave that the point at vertex k of the path sends on: the amplitude is sqrt(section / 4 pi), in metres as in
// wt_scatter. Both bases belong to directions away from the point, so the matrix is the same for the way back (eq.
// 7.9.2-5 without random phases). before_m, after_m: the lengths of the path on both sides of the point. Another kind
// of point, with a matrix of its own, is another branch here.
inline wt_wave_map wt_wave_of_point(const wt_field_world* world, const wt_path* path, wt_uint k, wt_double3 k_in,
                                    wt_double3 k_out, double before_m, double after_m) {
  const wt_uint number = wt_number(path, k);
  const WT_GLOBAL wt_target_point* point = world->targets + number;
  const WT_GLOBAL wt_target_law* law = world->laws + point->law;
  wt_wave_map wave;
  wave.from = wt_target_basis(point->rotation, -k_in);
  wave.to = wt_target_basis(point->rotation, k_out);
#if WT_FACETS
  if (law->lobe_count == WT_FACET_LAW) {
    const wt_beside_facet beside = wt_beside_piece(world, path, k, before_m, after_m);
    wave.matrix =
        wt_facet_wave(world, point, world->facets + law->first_lobe, k_in, k_out, &beside, wave.from, wave.to);
    return wave;
  }
#endif
  const double section_db =
      wt_cross_section(law, world->lobes, wt_in_target(point->rotation, -k_in), wt_in_target(point->rotation, k_out));
  const double same = wt_exp(section_db * 0.11512925464970228) / sqrt(4.0 * WT_PI);  // ln(10) / 20
  wave.matrix.m[0] = wave.matrix.m[3] = wt_real(same);
  wave.matrix.m[1] = wave.matrix.m[2] = wt_real(same * law->cross);
  return wave;
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
#endif
