// The uniform theory of diffraction at a straight wedge, with faces of any material: what host/radio/utd.hpp describes.
// Four terms, each the jump of a geometrical wave at its shadow boundary times a function that is half of that jump on
// either side of the boundary. Local axes: x along face 0, y its normal, z along the edge.
#ifndef WAVETRACER_DEVICE_UTD_H
#define WAVETRACER_DEVICE_UTD_H
#include "wavetracer/device/transfer.h"
#include "wavetracer/device/transition.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

#define WT_UNDECIDED_RAD 1e-6  // geometry in double from the same points is no further off
#define WT_BOUNDARIES 4
#define WT_GRAZING_RAD 1e-9

// In the world's axes.
typedef struct {
  wt_double3 along, face, normal;
  double exterior;  // radians
} wt_wedge_frame;

// permittivity.x is infinite: a perfect conductor.
typedef struct {
  wt_double2 permittivity;
  double thickness_m;
} wt_wedge_face;

// The field at the edge in components along from, times the matrix, leaves it in components along to.
typedef struct {
  wt_basis from, to;
  wt_matrix matrix;
} wt_wave_map;

typedef struct {
  double exterior;
  wt_double3 normals[2];
  wt_wedge_face faces[2];
  double wavelength_m;
} wt_corner;

// A plane wave that comes to the corner, from the side of the edge on which its source lies.
typedef struct {
  wt_double3 k;
  wt_basis coming;
} wt_corner_wave;

// Edge-fixed bases of a wave that leaves the edge and of one that comes to it; (beta, phi, k) is right-handed.
inline wt_basis wt_leaving(wt_double3 along, wt_double3 k) {
  wt_basis out;
  out.second = wt_normalized(wt_cross3(along, k));
  out.first = wt_cross3(out.second, k);
  return out;
}
inline wt_basis wt_coming(wt_double3 along, wt_double3 k) { return wt_leaving(-along, k); }

// Of a direction that points away from the edge, 0 to exterior.
inline double wt_azimuth_of(const wt_wedge_frame* wedge, wt_double3 away) {
  double azimuth = wt_atan2(wt_dot3(away, wedge->normal), wt_dot3(away, wedge->face));
  if (azimuth < 0.0) azimuth += 2.0 * WT_PI;
  if (azimuth <= wedge->exterior) return azimuth;
  return azimuth - wedge->exterior < 2.0 * WT_PI - azimuth ? wedge->exterior : 0.0;
}

// The matrix of the wave the other way, between the edge-fixed bases that belong to that way: beta changes its sign.
inline wt_matrix wt_other_way(wt_matrix m) {
  const wt_double2 other = m.m[1];
  m.m[1] = -m.m[2];
  m.m[2] = -other;
  return m;
}

inline wt_slab wt_face_slab(const wt_wedge_face* face, double cos_theta, double wavelength_m) {
  if (fabs(face->permittivity.x) == WT_INFINITY || fabs(face->permittivity.y) == WT_INFINITY) {
    wt_slab out;
    out.reflection_te = wt_real(-1.0);
    out.reflection_tm = wt_real(1.0);
    out.transmission_te = out.transmission_tm = wt_real(0.0);
    return out;
  }
  return wt_slab_coefficients(face->permittivity, cos_theta, face->thickness_m, wavelength_m);
}

// cosine: of the angle between the wave and the edge; sine: of the same, not negative.
inline wt_corner_wave wt_wave_from(double azimuth, double cosine, double sine) {
  const wt_double2 turn = wt_cos_sin(azimuth);
  wt_corner_wave wave;
  wave.k = WT_DOUBLE3(-sine * turn.x, -sine * turn.y, cosine);
  wave.coming = wt_coming(WT_DOUBLE3(0.0, 0.0, 1.0), wave.k);
  return wave;
}

// The wave as a matrix from (beta', phi') to (beta, phi): reflected `count` times, or straight through as many faces;
// at face `first`, then at the other one, and so on.
inline wt_matrix wt_met(const wt_corner* corner, const wt_corner_wave* wave, int first, int count, int straight) {
  // Leaving, both vectors of the basis are turned round.
  if (count == 0) return wt_diagonal(wt_real(-1.0), wt_real(-1.0));
  wt_double3 k = wave->k;
  wt_transfer transfer = wt_transfer_from(wave->coming);
  for (int i = 0; i < count; ++i) {
    const int face = first != (i % 2 == 1);
    const wt_double3 normal = corner->normals[face];
    const wt_double3 out = straight ? k : wt_mirrored(k, normal);
    const wt_slab slab = wt_face_slab(&corner->faces[face], fmin(fabs(wt_dot3(k, normal)), 1.0), corner->wavelength_m);
    if (straight)
      wt_meet(&transfer, k, out, normal, slab.transmission_te, slab.transmission_tm);
    else
      wt_meet(&transfer, k, out, normal, slab.reflection_te, slab.reflection_tm);
    k = out;
  }
  return wt_seen_in(&transfer, wt_leaving(WT_DOUBLE3(0.0, 0.0, 1.0), k));
}

// Reflected |image| times: at face 0, 1, 0, ... if image < 0, at 1, 0, 1, ... if > 0.
inline wt_matrix wt_image_wave(const wt_corner* corner, const wt_corner_wave* wave, int image) {
  return wt_met(corner, wave, image > 0, image < 0 ? -image : image, 0);
}

// A shadow boundary. Reflection unfolds: a geometrical wave is a straight line past the edge, from an azimuth to one
// that differs by less than pi, and each face in between reflects it. At the boundary they differ by just pi; epsilon
// is by how much less, so the wave is there if it is positive.
typedef struct {
  double epsilon;
  int turn;   // +1, -1: unfolded, the receiver's azimuth is larger, smaller than the source's
  int image;  // as wt_image_wave has it
} wt_boundary;

// The boundary nearest to these azimuths of the images of an even number of reflections or of an odd one: pi +- beta =
// 2 pi n N + epsilon, with Kouyoumjian and Pathak's N.
inline wt_boundary wt_nearest_boundary(double in, double out, double exterior, int odd, int turn) {
  const double beta = odd ? out + in : in - out, period = 2.0 * exterior;
  const double angle = WT_PI + turn * beta, number = wt_nearest_whole(angle / period);
  wt_boundary boundary;
  boundary.epsilon = angle - number * period;
  boundary.turn = turn;
  boundary.image = turn * 2 * (int)number - odd;
  return boundary;
}

// cot(epsilon / 2n) F(k L a) / sqrt(2 k L), a = 2 sin^2(epsilon / 2): F(x) = sqrt(x) g(sqrt x) takes the pole away.
inline wt_double2 wt_boundary_term(double epsilon, double n, double root_2kl) {
  const double size = fabs(epsilon), sine = fabs(wt_cos_sin(size / 2.0).y);
  const wt_double2 part = wt_cos_sin(size / (2.0 * n));
  const double ratio = size == 0.0 ? n : sine * part.x / part.y;
  return wt_transition_over_root(root_2kl * sine) * copysign(ratio, epsilon);
}

// The turn of a ray at the edge: the azimuths of its source and its receiver, and the boundaries that are nearest.
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

// Can the wave of this boundary be there at all? Outside of a convex wedge nothing is reflected twice.
inline int wt_has_wave(const wt_wedge_frame* wedge, wt_boundary boundary) {
  return wedge->exterior < WT_PI || (boundary.image >= -1 && boundary.image <= 1);
}

// Describes the waves at the boundaries of a turn, in their order.
typedef struct {
  int lit[WT_BOUNDARIES];  // does the wave reach the receiver? -1: not known
  double undecided;        // radians; no farther from a boundary angles leave the side to what is known
  int most_images;         // waves that are reflected in a corner more often than this, and than once, are left out
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

// The jump of the geometrical field at a boundary, from shadow to light. Outside of a convex wedge nothing is reflected
// twice: one reflection, at the face on this side, is all. On the boundary both choices of angles agree; between
// boundaries their mean makes the coefficient reciprocal.
// In a corner an image of several reflections has two boundaries, one for either order of the faces, and away from them
// their terms nearly cancel (just so at a right angle, and where nothing is bent): there its weight is that of the
// other. there: the wave; back: that of the link the other way. near: 1 on the boundary, 0 far away.
inline wt_matrix wt_jump(const wt_corner* corner, const wt_corner_wave* there, const wt_corner_wave* back,
                         wt_boundary boundary, int odd, int transmits, double near) {
  const int convex = corner->exterior >= WT_PI, turn = boundary.turn;
  const int image = !convex ? boundary.image : odd ? turn : 0, images = image < 0 ? -image : image;
  const double share = images > 1 ? 0.5 * near : 0.5;
  wt_matrix sum = wt_diagonal(wt_real(0.0), wt_real(0.0));
  sum = wt_matrix_sum(sum, share, wt_image_wave(corner, there, image));
  sum = wt_matrix_sum(sum, share, wt_other_way(wt_image_wave(corner, back, odd ? image : -image)));
  if (images > 1) {
    const int other = image < 0 ? images - 2 : 2 - images;
    sum = wt_matrix_sum(sum, 0.5 - share, wt_image_wave(corner, there, other));
    sum = wt_matrix_sum(sum, 0.5 - share, wt_other_way(wt_image_wave(corner, back, odd ? other : -other)));
  }
  if (!odd && transmits && convex) {
    const int count = corner->exterior > 2.0 * WT_PI - WT_GRAZING_RAD ? 1 : 2;
    sum = wt_matrix_sum(sum, -0.5, wt_met(corner, there, turn < 0, count, 1));
    sum = wt_matrix_sum(sum, -0.5, wt_other_way(wt_met(corner, back, turn > 0, count, 1)));
  }
  return sum;
}

// The matrix is in sqrt(m), see Diffraction in host/radio/utd.hpp. turn: of these directions. distance_m: s s' sin^2
// beta0 / (s + s').
inline wt_wave_map wt_diffract(wt_wedge_frame wedge, const wt_wedge_face* faces, wt_double3 k_in, wt_double3 k_out,
                               const wt_turn* turn, double distance_m, double wavelength_m, int transmits,
                               const wt_known_waves* known) {
  wt_wave_map out;
  out.matrix = wt_diagonal(wt_real(0.0), wt_real(0.0));
  // Within 1e-9 of the edge, half of the digits of a double, azimuths mean nothing.
  if (fmin(wt_length3(wt_cross3(k_in, wedge.along)), wt_length3(wt_cross3(k_out, wedge.along))) < 1e-9) {
    out.from.first = out.to.first = wedge.face;
    out.from.second = out.to.second = wedge.normal;
    return out;
  }
  const double cosine = fmin(fmax((wt_dot3(k_in, wedge.along) + wt_dot3(k_out, wedge.along)) / 2.0, -1.0), 1.0);
  const wt_double2 exterior_turn = wt_cos_sin(wedge.exterior);
  wt_corner corner;
  corner.exterior = wedge.exterior;
  corner.normals[0] = WT_DOUBLE3(0.0, 1.0, 0.0);
  corner.normals[1] = WT_DOUBLE3(exterior_turn.y, -exterior_turn.x, 0.0);
  corner.faces[0] = faces[0];
  corner.faces[1] = faces[1];
  corner.wavelength_m = wavelength_m;
  const double n = wedge.exterior / WT_PI;
  const double in = turn->in, away = turn->away;
  const double sine = sqrt((1.0 - cosine) * (1.0 + cosine));
  const wt_corner_wave there = wt_wave_from(in, cosine, sine), back = wt_wave_from(away, -cosine, sine);

  const double root_2kl = sqrt(4.0 * WT_PI * distance_m / wavelength_m);
  for (int term = 0; term < WT_BOUNDARIES; ++term) {
    const wt_boundary boundary = turn->boundaries[term];
    const int images = boundary.image < 0 ? -boundary.image : boundary.image;
    if (wedge.exterior < WT_PI && images > 1 && images > known->most_images) continue;  // no such wave ends here
    const wt_double2 factor = wt_boundary_term(wt_decided(boundary, known, term), n, root_2kl);
    const double away_from = root_2kl * wt_cos_sin(0.5 * boundary.epsilon).y;
    const wt_matrix jump =
        wt_jump(&corner, &there, &back, boundary, term / 2, transmits, 1.0 / (1.0 + away_from * away_from));
    for (int i = 0; i < 4; ++i) out.matrix.m[i] = out.matrix.m[i] + wt_times(factor, jump.m[i]);
  }
  const int grazing = fmin(in, away) < WT_GRAZING_RAD || wedge.exterior - fmax(in, away) < WT_GRAZING_RAD;
  const double size = sqrt(distance_m / WT_PI) / (2.0 * n) * (grazing ? 0.5 : 1.0);
  out.matrix = wt_scaled(out.matrix, WT_DOUBLE2(-size, size) * 0.70710678118654752440);  // -size exp(-j pi / 4)
  out.from = wt_coming(wedge.along, k_in);
  out.to = wt_leaving(wedge.along, k_out);
  return out;
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
