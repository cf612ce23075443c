// SPDX-License-Identifier: Apache-2.0
// The uniform theory of diffraction at a straight wedge with faces of any material, as host/radio/utd.hpp describes it.
// It has four terms: each is the jump of a geometrical wave at its shadow boundary times a function that is half of
// that jump on either side of the boundary. Local axes are x along face 0, y along its normal, and z along the edge.
#ifndef WAVETRACER_DEVICE_UTD_H
#define WAVETRACER_DEVICE_UTD_H
#include "wavetracer/device/corner.h"
#include "wavetracer/device/edge_ends.h"
#include "wavetracer/device/transition.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// A device need not compile code for corners, edges with less than a half space around them, where there are none.
#ifndef WT_CORNER_EDGES
#define WT_CORNER_EDGES 1
#endif

#define WT_UNDECIDED_RAD 1e-6  // geometry in double from the same points has smaller errors than this
#define WT_BOUNDARIES 4

// A wedge in the world's axes.
typedef struct {
  wt_double3 along, face, normal;
  double exterior;  // radians
} wt_wedge_frame;

// The field at the edge, in components along from, times the matrix is the field that leaves it, in components along
// to.
typedef struct {
  wt_basis from, to;
  wt_matrix matrix;
} wt_wave_map;

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

// A ray that turns at a corner: the waves from its source and, in the other direction, from its receiver, and the bases
// of what comes and leaves.
typedef struct {
  wt_corner corner;
  wt_turn turn;
  wt_corner_wave there, back;
  wt_basis from, to;
  double n, sine;        // sine: of the angle between the edge and the ray
  double bent;           // see wt_bent
  double legs_m[2];      // from its source, to its receiver: the radii of the waves
  wt_double2 angles[4];  // cosine and sine of the azimuths of both ends from face 0, then from face 1
  wt_matrix behind;      // outside of a convex wedge: what both faces reflect, see wt_convex_jump
  int transmits;
} wt_bend;

// Rays within 1e-9 of the edge, half of the digits of a double, have no azimuths; then this is 0.
inline int wt_turns(const wt_wedge_frame* wedge, wt_double3 k_in, wt_double3 k_out) {
  return fmin(wt_length3(wt_cross3(k_in, wedge->along)), wt_length3(wt_cross3(k_out, wedge->along))) >= 1e-9;
}

// Says how much of a wedge it is: 0 where its faces are one plane, 1 from a right angle on.
inline double wt_bent(double exterior) { return exterior < 1.5 * WT_PI ? 1.0 - wt_cos_sin(exterior - WT_PI).x : 1.0; }

// The reflection at face 0 or 1 of a convex wedge. The face reflects what comes from the end that is nearer to it by
// azimuth: R. Luebbers' choice (IEEE Trans. AP 32(1), 1984) with face 0 on the source's side, which is the same the
// other way. As the faces become one plane, both reflect like the mean of both ends', or it would diffract. spread: of
// the waves that count on this side of the boundary, their mean distance from the edge, in metres.
inline wt_matrix wt_convex_reflection(const wt_bend* bend, int face, wt_double2 spread) {
  const double in = bend->turn.in, away = bend->turn.away, nearer = 0.5 + 0.5 * bend->bent;
  const double share = (face == 0 ? in <= away : in >= away) ? nearer : 1.0 - nearer;
  const double first = bend->legs_m[0] < WT_INFINITY ? bend->legs_m[0] / (bend->legs_m[0] + bend->legs_m[1]) : 0.5;
  const wt_double2 there = face == 0 ? bend->angles[0] : bend->angles[2];
  const wt_double2 back = face == 0 ? bend->angles[1] : bend->angles[3];
  const double lit = bend->sine * (fabs(there.y) * first + fabs(back.y) * (1.0 - first));
  wt_matrix sum = wt_diagonal(wt_real(0.0), wt_real(0.0));
  // The end that counts more comes first, so that on GPUs neighbours, most of which have no other, compute together.
  for (int i = 0; i < 2; ++i) {
    const int is_source = (share >= 0.5) == (i == 0);
    const double part = is_source ? share : 1.0 - share;
    if (part == 0.0) continue;
    const wt_double2 shift =
        spread * ((is_source ? there.x : back.x) / (is_source ? bend->legs_m[0] : bend->legs_m[1]));
    const wt_corner_wave from = is_source ? bend->there : bend->back;
    const wt_matrix wave = wt_reflected_wave(&bend->corner, &from, face, lit, shift);
    sum = wt_matrix_sum(sum, part, is_source ? wave : wt_other_way(wave));
  }
  return sum;
}

inline wt_bend wt_bend_at(const wt_wedge_frame* wedge, const wt_wedge_face* faces, wt_double3 k_in, wt_double3 k_out,
                          const double* legs_m, const wt_turn* turn, double wavelength_m, int transmits) {
  wt_bend bend;
  const double cosine = fmin(fmax((wt_dot3(k_in, wedge->along) + wt_dot3(k_out, wedge->along)) / 2.0, -1.0), 1.0);
  const double sine = sqrt((1.0 - cosine) * (1.0 + cosine));
  const wt_double2 exterior_turn = wt_cos_sin(wedge->exterior);
  bend.corner.exterior = wedge->exterior;
  bend.corner.normals[0] = WT_DOUBLE3(0.0, 1.0, 0.0);
  bend.corner.normals[1] = WT_DOUBLE3(exterior_turn.y, -exterior_turn.x, 0.0);
  bend.corner.faces[0] = faces[0];
  bend.corner.faces[1] = faces[1];
  bend.corner.wavelength_m = wavelength_m;
  bend.turn = *turn;
  bend.angles[0] = wt_cos_sin(turn->in);
  bend.angles[1] = wt_cos_sin(turn->away);
  bend.angles[2] = wt_cos_sin(wedge->exterior - turn->in);
  bend.angles[3] = wt_cos_sin(wedge->exterior - turn->away);
  bend.there = wt_wave_from(bend.angles[0], cosine, sine);
  bend.back = wt_wave_from(bend.angles[1], -cosine, sine);
  bend.from = wt_coming(wedge->along, k_in);
  bend.to = wt_leaving(wedge->along, k_out);
  bend.n = wedge->exterior / WT_PI;
  bend.sine = sine;
  bend.legs_m[0] = legs_m[0];
  bend.legs_m[1] = legs_m[1];
  bend.transmits = transmits;
  bend.bent = wt_bent(wedge->exterior);
  bend.behind = wt_diagonal(wt_real(0.0), wt_real(0.0));
  if (wedge->exterior < WT_PI) return bend;
  const int forward = turn->in <= turn->away;
  const wt_matrix first = wt_convex_reflection(&bend, !forward, wt_real(0.0));
  bend.behind = wt_matrix_product(wt_convex_reflection(&bend, forward, wt_real(0.0)), first);
  return bend;
}

// The mean distance from the edge, in metres, of the waves on the side of a boundary at which g has the argument s and
// the value g; unit_m: that of the argument, negative on the lit side.
inline wt_double2 wt_spread_of(double s, wt_double2 g, double unit_m) {
  return wt_over(wt_real(1.0) - g * s, g) * unit_m;
}

// Outside of a convex wedge nothing is reflected twice: the only reflection is at the face on this side. One of the two
// terms of the incident wave has its boundary behind the other face; it belongs to the wave that both faces reflect (P.
// Holm, IEEE Trans. AP 48(8), 2000), so that nothing is left where an end lies on a face that reflects -1. along: a
// face is grazed, and its reflections are counted elsewhere.
inline wt_matrix wt_convex_jump(const wt_bend* bend, wt_boundary boundary, int odd, int along, wt_double2 spread) {
  const wt_corner* corner = &bend->corner;
  const int turn = boundary.turn, forward = bend->turn.in <= bend->turn.away;
  if (odd) return wt_convex_reflection(bend, turn > 0, spread);
  wt_matrix jump = wt_diagonal(wt_real(-1.0), wt_real(-1.0));
  if (bend->transmits) {
    const int count = corner->exterior > 2.0 * WT_PI - WT_GRAZING_RAD ? 1 : 2;
    jump = wt_matrix_sum(jump, -0.5, wt_met(corner, &bend->there, turn < 0, count, 1));
    jump = wt_matrix_sum(jump, -0.5, wt_other_way(wt_met(corner, &bend->back, turn > 0, count, 1)));
  }
  if (along || (turn > 0) == forward) return jump;
  return wt_matrix_sum(wt_scaled(jump, wt_real(1.0 - bend->bent)), -bend->bent, bend->behind);
}

// In a corner an image of several reflections has two boundaries, one for each order of the faces. Away from them their
// terms nearly cancel (exactly at a right angle, and where nothing is bent); there the image with two reflections fewer
// takes its place. near: 1 on the boundary, 0 far away. Between boundaries the mean of the waves from both ends makes
// the coefficient reciprocal.
inline wt_matrix wt_corner_jump(const wt_bend* bend, wt_boundary boundary, int odd, double near) {
  const wt_corner* corner = &bend->corner;
  const int image = boundary.image, images = image < 0 ? -image : image;
  const double share = images > 1 ? 0.5 * near : 0.5;
  wt_matrix sum = wt_diagonal(wt_real(0.0), wt_real(0.0));
  sum = wt_matrix_sum(sum, share, wt_image_wave(corner, &bend->there, image));
  sum = wt_matrix_sum(sum, share, wt_other_way(wt_image_wave(corner, &bend->back, odd ? image : -image)));
  if (images > 1) {
    const int other = image < 0 ? images - 2 : 2 - images;
    sum = wt_matrix_sum(sum, 0.5 - share, wt_image_wave(corner, &bend->there, other));
    sum = wt_matrix_sum(sum, 0.5 - share, wt_other_way(wt_image_wave(corner, &bend->back, odd ? other : -other)));
  }
  return sum;
}

// The jump of the geometrical field at boundary `term`, from shadow to light, between the bases of the bend.
// root_2kl: see wt_term_factors; along, spread: see wt_convex_jump.
inline wt_matrix wt_jump(const wt_bend* bend, int term, double root_2kl, int along, wt_double2 spread) {
  const wt_boundary boundary = bend->turn.boundaries[term];
  const int odd = term / 2;
#if WT_CORNER_EDGES
  if (bend->corner.exterior < WT_PI) {
    const double away_from = root_2kl * wt_cos_sin(0.5 * boundary.epsilon).y;
    return wt_corner_jump(bend, boundary, odd, 1.0 / (1.0 + away_from * away_from));
  }
#endif
  return wt_convex_jump(bend, boundary, odd, along, spread);
}

// Does a wave run along a face, so that it and its reflection are one wave?
inline int wt_grazes(double azimuth, double exterior) {
  return azimuth < WT_GRAZING_RAD || exterior - azimuth < WT_GRAZING_RAD;
}

// The factor of the sum of an edge's terms: sqrt(L / pi) / 2n exp(3 j pi / 4).
inline wt_double2 wt_edge_amplitude(double distance_m, double n) {
  const double size = sqrt(distance_m / WT_PI) / (2.0 * n);
  return WT_DOUBLE2(-size, size) * 0.70710678118654752440;
}

// The matrix is in sqrt(m), see Diffraction in host/radio/utd.hpp. turn: that of these directions. distance_m: s s'
// sin^2 beta0 / (s + s'). ends: those of the edge.
inline wt_wave_map wt_diffract(wt_wedge_frame wedge, const wt_wedge_face* faces, wt_double3 k_in, wt_double3 k_out,
                               const wt_turn* turn, const double* legs_m, double distance_m, double wavelength_m,
                               int transmits, const wt_known_waves* known, const wt_edge_ends* ends) {
  wt_wave_map out;
  out.matrix = wt_diagonal(wt_real(0.0), wt_real(0.0));
  if (!wt_turns(&wedge, k_in, k_out)) {
    out.from.first = out.to.first = wedge.face;
    out.from.second = out.to.second = wedge.normal;
    return out;
  }
  const wt_bend bend = wt_bend_at(&wedge, faces, k_in, k_out, legs_m, turn, wavelength_m, transmits);
  const double root_2kl = sqrt(4.0 * WT_PI * distance_m / wavelength_m);
  for (int term = 0; term < WT_BOUNDARIES; ++term) {
    const wt_boundary boundary = turn->boundaries[term];
    const int images = boundary.image < 0 ? -boundary.image : boundary.image;
    if (wedge.exterior < WT_PI && images > 1 && images > known->most_images) continue;  // no such wave ends here
    const wt_term_factors factors = wt_factors_of(wt_decided(boundary, known, term), bend.n);
    const double s = root_2kl * factors.sine;
    const wt_double2 g = wt_transition_over_root(s);
    const wt_double2 factor = (ends->counts ? wt_transition_between(s, g, ends) : g) * factors.ratio;
    wt_double2 spread = wt_real(0.0);
    if (term >= 2 && wedge.exterior >= WT_PI)
      spread = wt_spread_of(s, g, copysign(root_2kl * wavelength_m / (2.0 * WT_PI), -factors.ratio));
    const wt_matrix jump = wt_jump(&bend, term, root_2kl, 0, spread);
    for (int i = 0; i < 4; ++i) out.matrix.m[i] = out.matrix.m[i] + wt_times(factor, jump.m[i]);
  }
  const int grazes = wt_grazes(turn->in, wedge.exterior) || wt_grazes(turn->away, wedge.exterior);
  out.matrix = wt_scaled(out.matrix, wt_edge_amplitude(distance_m, bend.n) * (grazes ? 0.5 : 1.0));
  out.from = bend.from;
  out.to = bend.to;
  return out;
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
