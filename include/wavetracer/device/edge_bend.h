// SPDX-License-Identifier: Apache-2.0
// The jumps of the geometrical field at the shadow boundaries of an edge that a ray bends around (utd.h).
#ifndef WAVETRACER_DEVICE_EDGE_BEND_H
#define WAVETRACER_DEVICE_EDGE_BEND_H
#include "wavetracer/device/corner.h"
#include "wavetracer/device/edge_turn.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// A device need not compile code for corners, edges with less than a half space around them, where there are none.
#ifndef WT_CORNER_EDGES
#define WT_CORNER_EDGES 1
#endif

// A ray that turns at a corner, and the bases of what comes and leaves.
typedef struct {
  wt_corner corner;
  wt_turn turn;
  wt_basis from, to;
  double n, cosine, sine;  // cosine, sine: of the angle between the edge and the ray
  double bent;             // see wt_bent
  double legs_m[2];        // from its source, to its receiver: the radii of the waves
  wt_double2 angles[4];    // cosine and sine of the azimuths of both ends from face 0, then from face 1
  int transmits;
} wt_bend;

// The waves from the source of the ray and, in the other direction, from its receiver.
inline wt_corner_wave wt_wave_there(const wt_bend* bend) {
  return wt_wave_from(bend->angles[0], bend->cosine, bend->sine);
}
inline wt_corner_wave wt_wave_back(const wt_bend* bend) {
  return wt_wave_from(bend->angles[1], -bend->cosine, bend->sine);
}

// Rays within 1e-9 of the edge, half of the digits of a double, have no azimuths; then this is 0.
inline int wt_turns(const wt_wedge_frame* wedge, wt_double3 k_in, wt_double3 k_out) {
  return fmin(wt_length3(wt_cross3(k_in, wedge->along)), wt_length3(wt_cross3(k_out, wedge->along))) >= 1e-9;
}

// Says how much of a wedge it is: 0 where its faces are one plane, 1 from a right angle on.
inline double wt_bent(double exterior) { return exterior < 1.5 * WT_PI ? 1.0 - wt_cos_sin(exterior - WT_PI).x : 1.0; }

// The reflection at face 0 or 1 of a convex wedge. The face reflects what comes from the end that is nearer to it by
// azimuth: R. Luebbers' choice (IEEE Trans. AP 32(1), 1984) with face 0 on the source's side, which is the same the
// other way. As the faces become one plane, both reflect like the mean of both ends', or it would diffract. spread: of
// the waves that count on this side of the boundary, their mean distance from the edge, in metres; near: `mirrored` of
// wt_face_slab_beside.
inline wt_matrix wt_convex_reflection(const wt_bend* bend, int face, wt_double2 spread, double near) {
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
    const wt_matrix wave = wt_reflected_wave(wt_corner_face(&bend->corner, face), face, is_source ? there : back,
                                             is_source ? bend->cosine : -bend->cosine, bend->sine, lit, shift, near,
                                             bend->corner.wavelength_m);
    sum = wt_matrix_sum(sum, part, is_source ? wave : wt_other_way(wave));
  }
  return sum;
}

inline wt_bend wt_bend_at(const wt_wedge_frame* wedge, const wt_wedge_face* faces, wt_double3 k_in, wt_double3 k_out,
                          const double* legs_m, const wt_turn* turn, double wavelength_m, int transmits) {
  wt_bend bend;
  const double cosine = fmin(fmax((wt_dot3(k_in, wedge->along) + wt_dot3(k_out, wedge->along)) / 2.0, -1.0), 1.0);
  const double sine = sqrt((1.0 - cosine) * (1.0 + cosine));
  bend.corner.exterior = wedge->exterior;
  bend.corner.turn = wt_cos_sin(wedge->exterior);
  bend.corner.faces[0] = faces[0];
  bend.corner.faces[1] = faces[1];
  bend.corner.wavelength_m = wavelength_m;
  bend.turn = *turn;
  bend.angles[0] = wt_cos_sin(turn->in);
  bend.angles[1] = wt_cos_sin(turn->away);
  bend.angles[2] = wt_cos_sin(wedge->exterior - turn->in);
  bend.angles[3] = wt_cos_sin(wedge->exterior - turn->away);
  bend.from = wt_coming(wedge->along, k_in);
  bend.to = wt_leaving(wedge->along, k_out);
  bend.n = wedge->exterior / WT_PI;
  bend.cosine = cosine;
  bend.sine = sine;
  bend.legs_m[0] = legs_m[0];
  bend.legs_m[1] = legs_m[1];
  bend.transmits = transmits;
  bend.bent = wt_bent(wedge->exterior);
  return bend;
}

// The wave that both faces of a convex wedge reflect, see wt_convex_jump.
inline wt_matrix wt_reflected_behind(const wt_bend* bend) {
  const int forward = bend->turn.in <= bend->turn.away;
  const wt_matrix first = wt_convex_reflection(bend, !forward, wt_real(0.0), 0.0);
  return wt_matrix_product(wt_convex_reflection(bend, forward, wt_real(0.0), 0.0), first);
}

// The mean distance from the edge, in metres, of the waves on the side of a boundary at which g has the argument s and
// the value g; unit_m: that of the argument, negative on the lit side.
inline wt_double2 wt_spread_of(double s, wt_double2 g, double unit_m) {
  return wt_over(wt_real(1.0) - g * s, g) * unit_m;
}

// Outside of a convex wedge nothing is reflected twice: the only reflection is at the face on this side. One of the two
// terms of the incident wave has its boundary behind the other face; it belongs to the wave that both faces reflect (P.
// Holm, IEEE Trans. AP 48(8), 2000), so that nothing is left where an end lies on a face that reflects -1. along: a
// face is grazed, and its reflections are counted elsewhere. near: see wt_convex_reflection.
inline wt_matrix wt_convex_jump(const wt_bend* bend, wt_boundary boundary, int odd, int along, wt_double2 spread,
                                double near) {
  const wt_corner* corner = &bend->corner;
  const int turn = boundary.turn, forward = bend->turn.in <= bend->turn.away;
  if (odd) return wt_convex_reflection(bend, turn > 0, spread, near);
  wt_matrix jump = wt_diagonal(wt_real(-1.0), wt_real(-1.0));
  if (bend->transmits) {
    const int count = corner->exterior > 2.0 * WT_PI - WT_GRAZING_RAD ? 1 : 2;
    const wt_corner_wave there = wt_wave_there(bend), back = wt_wave_back(bend);
    jump = wt_matrix_sum(jump, -0.5, wt_met(corner, &there, turn < 0, count, 1));
    jump = wt_matrix_sum(jump, -0.5, wt_other_way(wt_met(corner, &back, turn > 0, count, 1)));
  }
  if (along || (turn > 0) == forward) return jump;
  return wt_matrix_sum(wt_scaled(jump, wt_real(1.0 - bend->bent)), -bend->bent, wt_reflected_behind(bend));
}

// In a corner an image of several reflections has two boundaries, one for each order of the faces. Away from them their
// terms nearly cancel (exactly at a right angle, and where nothing is bent); there the image with two reflections fewer
// takes its place. near: 1 on the boundary, 0 far away. Between boundaries the mean of the waves from both ends makes
// the coefficient reciprocal.
inline wt_matrix wt_corner_jump(const wt_bend* bend, wt_boundary boundary, int odd, double near) {
  const wt_corner* corner = &bend->corner;
  const wt_corner_wave there = wt_wave_there(bend), back = wt_wave_back(bend);
  const int image = boundary.image, images = image < 0 ? -image : image;
  const double share = images > 1 ? 0.5 * near : 0.5;
  wt_matrix sum = wt_diagonal(wt_real(0.0), wt_real(0.0));
  sum = wt_matrix_sum(sum, share, wt_image_wave(corner, &there, image));
  sum = wt_matrix_sum(sum, share, wt_other_way(wt_image_wave(corner, &back, odd ? image : -image)));
  if (images > 1) {
    const int other = image < 0 ? images - 2 : 2 - images;
    sum = wt_matrix_sum(sum, 0.5 - share, wt_image_wave(corner, &there, other));
    sum = wt_matrix_sum(sum, 0.5 - share, wt_other_way(wt_image_wave(corner, &back, odd ? other : -other)));
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
  const double away = root_2kl * wt_cos_sin(0.5 * boundary.epsilon).y;
  return wt_convex_jump(bend, boundary, odd, along, spread, spread.x < 0.0 ? 1.0 / (1.0 + away * away) : 0.0);
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
