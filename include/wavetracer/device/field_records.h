// SPDX-License-Identifier: Apache-2.0
// Records of the fields of paths that host and device share: what fields need of a world and its ends, and what they
// compute of each path. There is no float3, bool, size_t or pointer; padding is explicit.
#ifndef WAVETRACER_DEVICE_FIELD_RECORDS_H
#define WAVETRACER_DEVICE_FIELD_RECORDS_H
#include "wavetracer/device/types.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// wt_material.layers has the number of layers in its low bits, then a bit that says that the first layer is on the side
// that the normal of the surface does not point to, and from WT_LAYER_SHIFT on the place of the first layer.
#define WT_MOST_LAYERS 8u
#define WT_LAYER_COUNT 15u
#define WT_LAYERS_REVERSED 16u
#define WT_LAYER_SHIFT 5u

// A radio material at the carrier's frequency.
typedef struct {
  double permittivity[2];          // relative, real and imaginary part; with layers: that of the first one
  double thickness_m;              // with layers: the sum of theirs
  double scattering, cross_polar;  // S and K
  wt_uint lobe;                    // alpha, 0: Lambert's law
  wt_uint layers;                  // 0: a slab; else its layers are records of the same table, side by side (layers.h)
} wt_material;

// Losses of a wave in the air at the carrier (host/radio/air.hpp).
typedef struct {
  double loss_np_m;  // amplitude loss of any wave by gases and fog
  double log_rain;   // natural logarithm of the rain rate in mm/h
  // The constants of ITU-R P.838-3 for horizontal and vertical waves: k in Np/m for amplitudes, and k alpha.
  double rain_k[2];
  double rain_k_alpha[2];
  wt_uint rains;  // not 0: there is rain
  wt_uint padding;
} wt_air;

// Loss of a wave in vegetation at the carrier: most (1 - exp(-loss d / most)) on d metres; with most < 0: loss d.
typedef struct {
  double loss_np_m, most_np;
  double scattering, cross_polar;  // S and K: the share S^2 of the lost power is scattered
} wt_foliage;

// Tiles that are cells of vegetation have this bit in place of their surface, the kind in three bits from
// WT_CELL_KIND_SHIFT on, and below them the number of the volume, counted on from the surfaces of the static scene.
#define WT_CELL 0x80000000u
#define WT_CELL_KIND_SHIFT 28u
#define WT_CELL_NUMBER 0x0FFFFFFFu

// Shapes of volumes, with the numbers of VolumeShape (wavetracer/scene.hpp).
#define WT_VOLUME_BOX 0u
#define WT_VOLUME_CYLINDER 1u
#define WT_VOLUME_SPHEROID 2u
#define WT_VOLUME_MESH 3u

#define WT_MOST_KINDS 8  // the most kinds of vegetation in a scene

// A volume of vegetation (device/volumes.h), recentred.
typedef struct {
  double centre[3];
  double half_size[3];  // half the size of its box, which is turned about z
  double cosine, sine;  // cosine and sine of that turn
  wt_uint shape;
  wt_uint kind;  // kind of vegetation
  wt_uint first_triangle, triangle_count;
} wt_volume;

// The radar cross section of a point of a target (device/target.h): one lobe about a direction in its axes.
typedef struct {
  double azimuth, azimuth_width;  // the peak, and the width at 3 dB, radians; width 0: all azimuths are alike
  double zenith, zenith_width;    // the same for the angle from the axis upwards
  double peak_db, range_db;       // the peak, dBsm; the lobe falls by range_db at most
  // The lobe counts where the bisector is in this part of the sphere, radians: zeniths from..to, azimuths from..span
  // on.
  double zenith_from, zenith_to, azimuth_from, azimuth_span;
} wt_target_lobe;

typedef struct {
  double k[3];   // the loss k[0] sin(k[1] beta / 2) - k[2] log10(cos(beta / 2)) in dB at the bistatic angle beta
  double cross;  // amplitude in the other polarisation, as a share of that in the same one
  wt_uint first_lobe, lobe_count;
} wt_target_law;

// With this in place of lobe_count, the law is that of a piece of a facet, and first_lobe is its number.
#define WT_FACET_LAW 0xFFFFFFFFu

// A flat triangle of a body that scatters by physical optics (facet.h).
typedef struct {
  double corners[9];  // from the point, in the axes of the target; counter-clockwise, seen from outside
  wt_uint material;   // its record
  wt_uint turned;     // not 0: the normal of its surface points inwards
} wt_target_facet;

// Patterns of antennas; the first four have the numbers of NamedAntenna (wavetracer/config.hpp).
#define WT_PATTERN_ISOTROPIC 0u
#define WT_PATTERN_SHORT_DIPOLE 1u
#define WT_PATTERN_HALF_WAVE_DIPOLE 2u
#define WT_PATTERN_TR38901 3u
#define WT_PATTERN_GRID 4u  // a pattern from a file

typedef struct {
  wt_uint pattern;
  wt_uint ports;  // 1 or 2
  // For a grid: where its samples begin. A sample is four doubles (theta, phi; real, imaginary); each theta has a row
  // and each phi a column.
  wt_uint first_sample;
  wt_uint rows, columns;
  wt_uint padding;
  double theta_step, phi_step, first_phi;  // micro-degrees
  double slant[2][2];                      // cosine and sine of each port's
} wt_antenna;

// An end of links in a frame.
typedef struct {
  double position_m[3];  // recentred
  double velocity_m_s[3];
  double rotation[9];  // from the antenna's axes to global ones, row by row
  wt_uint antenna;
  wt_uint padding;
} wt_field_end;

// A path of a frame as the host reads it, with the columns of Paths (wavetracer/paths.hpp). Bits beside those of the
// quarters say that the path is closer to an edge than the theory of diffraction holds (path_edges.h), and which kinds
// of interactions it has: the codes of its vertices together, 0 in sight.
#define WT_ROW_NEAR_EDGE 256u
#define WT_ROW_MET_SHIFT 16u
typedef struct {
  double delay_s, gain_db, doppler_hz;
  double aod_theta, aod_phi, aoa_theta, aoa_phi;  // radians
  double a[8];                                    // receiver's port 2 r + transmitter's port t; real, imaginary
  wt_uint tx, rx, first_vertex, quarters;         // vertices of a row follow those of the row before
} wt_path_row;

// The waves that a path belongs to (path_groups.h): the first `count` of these, by weight.
#define WT_MOST_GROUPS 4u
typedef struct {
  wt_ulong keys[4];  // hashes of the steps of a wave
  double weights[4];
  wt_uint count;
  wt_uint bends;  // not 0: the path is diffracted
} wt_path_waves;

// The waves of a path as the host reads them. Most paths belong to one wave alone.
#define WT_ONE_WAVE 0xFFFFFFFFu
typedef struct {
  wt_ulong key;    // key of that wave, or of the one with the largest weight
  wt_uint shared;  // number of the record of all its waves, where there are several; else WT_ONE_WAVE
  wt_uint bends;   // not 0: the path is diffracted
  wt_uint tx, rx;  // its link
} wt_path_wave;

// Sums over the paths of a link (link_sums.cl). Powers are |a|^2 of all pairs of ports.
typedef struct {
  double power;                                      // the sum over all paths, without phases
  double grouped;                                    // the sum over waves; the fields of a wave are added first
  double narrowband;                                 // the power of the sum of all fields
  double mean_delay_s, rms_delay_s, rms_doppler_hz;  // weighted by power, rms about the mean; 0 without power
  double direct;                                     // the power of the path without interactions
  double found_powers[4], amplitude;                 // see powers and amplitude of MissedCounts (wavetracer/missed.hpp)
  wt_uint kinds[6];                                  // numbers of paths by their kind
  wt_uint found[4];                                  // see paths of MissedCounts
  wt_uint near_edges;                                // the number of paths with WT_ROW_NEAR_EDGE
  wt_uint paths;
} wt_link_sum;

typedef struct {
  double position[3];  // in the coordinates of the file
  wt_uint surface, instance, interaction;
  wt_uint padding;
} wt_vertex_row;

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
