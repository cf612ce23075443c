// SPDX-License-Identifier: Apache-2.0
// The turn of a ray at a straight edge: its azimuths, the shadow boundaries near it, and what is known of the waves
// there. Local axes are x along face 0, y along its normal, and z along the edge.
#ifndef WAVETRACER_DEVICE_EDGE_TURN_H
#define WAVETRACER_DEVICE_EDGE_TURN_H
#include "wavetracer/device/elementary.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

#define WT_UNDECIDED_RAD 1e-6  // geometry in double from the same points has smaller errors than this
#define WT_BOUNDARIES 4

// A wedge in the world's axes.
typedef struct {
  wt_double3 along, face, normal;
  double exterior;  // radians
} wt_wedge_frame;

// The azimuth of a direction that points away from the edge, 0 to exterior.
inline double wt_azimuth_of(const wt_wedge_frame* wedge, wt_double3 away) {
  double azimuth = wt_atan2(wt_dot3(away, wedge->normal), wt_dot3(away, wedge->face));
  if (azimuth < 0.0) azimuth += 2.0 * WT_PI;
  if (azimuth <= wedge->exterior) return azimuth;
  return azimuth - wedge->exterior < 2.0 * WT_PI - azimuth ? wedge->exterior : 0.0;
}

// A shadow boundary. If reflections are unfolded, a geometrical wave is a straight line past the edge, from one azimuth
// to another that differs by less than pi, and each face in between reflects it. At the boundary they differ by exactly
// pi. They differ by epsilon less than that, so the wave is there if epsilon is positive.
typedef struct {
  double epsilon;
  int turn;   // +1, -1: unfolded, the receiver's azimuth is larger, smaller than the source's
  int image;  // the image, as wt_image_wave takes it
} wt_boundary;

// The boundary nearest to these azimuths among the images of an even or of an odd number of reflections: pi +- beta = 2
// pi n N + epsilon, with Kouyoumjian and Pathak's N.
inline wt_boundary wt_nearest_boundary(double in, double out, double exterior, int odd, int turn) {
  const double beta = odd ? out + in : in - out, period = 2.0 * exterior;
  const double angle = WT_PI + turn * beta, number = wt_nearest_whole(angle / period);
  wt_boundary boundary;
  boundary.epsilon = angle - number * period;
  boundary.turn = turn;
  boundary.image = turn * 2 * (int)number - odd;
  return boundary;
}

// Factors of cot(e / 2n) F(k L a) / sqrt(2 k L), e = epsilon, a = 2 sin^2(e / 2); F(x) = sqrt(x) g(sqrt x): no pole.
typedef struct {
  double sine;   // |sin(epsilon / 2)|: times sqrt(2 k L), it is the argument of g
  double ratio;  // cot(epsilon / 2n) |sin(epsilon / 2)|
} wt_term_factors;

inline wt_term_factors wt_factors_of(double epsilon, double n) {
  const double size = fabs(epsilon);
  const wt_double2 part = wt_cos_sin(size / (2.0 * n));
  wt_term_factors out;
  out.sine = fabs(wt_cos_sin(size / 2.0).y);
  out.ratio = copysign(size == 0.0 ? n : out.sine * part.x / part.y, epsilon);
  return out;
}

// The turn of a ray at the edge: the azimuths of its source and its receiver, and the nearest boundaries.
typedef struct {
  double in, away;
  wt_boundary boundaries[WT_BOUNDARIES];
} wt_turn;

inline wt_turn wt_turn_at(const wt_wedge_frame* wedge, wt_double3 k_in, wt_double3 k_out) {
  wt_turn turn;
  turn.in = wt_azimuth_of(wedge, -k_in);
  turn.away = wt_azimuth_of(wedge, k_out);
  for (int i = 0; i < WT_BOUNDARIES; ++i)
    turn.boundaries[i] = wt_nearest_boundary(turn.in, turn.away, wedge->exterior, i / 2, i % 2 ? 1 : -1);
  return turn;
}

// Can the wave of this boundary exist? Outside of a convex wedge nothing is reflected twice.
inline int wt_has_wave(const wt_wedge_frame* wedge, wt_boundary boundary) {
  return wedge->exterior < WT_PI || (boundary.image >= -1 && boundary.image <= 1);
}

// Describes the waves at the boundaries of a turn, in their order.
typedef struct {
  int lit[WT_BOUNDARIES];  // 1: the wave reaches the receiver; 0: it does not; -1: not known
  double undecided;        // radians; within this distance from a boundary `lit` decides the side, not the angles
  int most_images;         // in a corner, waves with more reflections than this, and more than one, are left out
} wt_known_waves;

inline wt_known_waves wt_nothing_known(void) {
  wt_known_waves known;
  for (int i = 0; i < WT_BOUNDARIES; ++i) known.lit[i] = -1;
  known.undecided = WT_UNDECIDED_RAD;
  known.most_images = 0x7FFFFFFF;
  return known;
}

inline double wt_decided(wt_boundary boundary, const wt_known_waves* known, int i) {
  if (known->lit[i] < 0 || fabs(boundary.epsilon) > known->undecided) return boundary.epsilon;
  return copysign(boundary.epsilon, known->lit[i] ? 1.0 : -1.0);
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
