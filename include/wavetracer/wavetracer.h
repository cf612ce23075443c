// SPDX-License-Identifier: Apache-2.0
/* libwavetracer for C99, and for every language that calls C: a configuration in, propagation paths out.
   Assumes 8-bit bytes and IEEE double. For C++ there is wavetracer/wavetracer.hpp.

   Objects are opaque and belong to the caller: what _open and _run_frame return is given back to _close and
   _frame_free, an error to _error_free, each once; null is allowed there. All text is UTF-8.

   Errors: a function that takes `error` returns null or 0 on failure and then stores an error there, unless `error` is
   null; on success it stores null. A null object is a failure as well, never a crash.

   Threads: every function may be called by any thread. Simulations run beside each other. wavetracer_run_frame and
   wavetracer_write of one simulation take turns: they wait until the call before them has returned. wavetracer_write of
   all simulations of the process take turns as well. What reads needs no turn, and a frame may be read by any number of
   threads. wavetracer_close waits for the call that is running; no other call may begin from then on. What an observer
   calls of its own simulation: wavetracer_run_frame and wavetracer_write fail with USAGE, wavetracer_close does
   nothing, and all else does what it says.

   Processes: threads of OpenCL's drivers are not in a process that was forked. Once wavetracer_open or
   wavetracer_devices was called, they, wavetracer_run_frame and wavetracer_write fail with RUNTIME in processes that
   are forked afterwards, and wavetracer_close does nothing there. Frames may be read and given back. */
#ifndef WAVETRACER_H
#define WAVETRACER_H
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wavetracer_simulation wavetracer_simulation; /* a scene on a device */
typedef struct wavetracer_frame wavetracer_frame;           /* the results of one frame; may outlive its simulation */
typedef struct wavetracer_error wavetracer_error;

/* Error codes; the program exits with the same ones. */
enum wavetracer_code {
  WAVETRACER_OK = 0,
  WAVETRACER_RUNTIME = 1,  /* out of memory, a full disk, an exceeded limit */
  WAVETRACER_USAGE = 2,    /* a wrong configuration or argument */
  WAVETRACER_INPUT = 3,    /* a wrong scene, antenna or trajectory file */
  WAVETRACER_DEVICE = 4,   /* no OpenCL device, no memory on it, a kernel that does not build */
  WAVETRACER_STOPPED = 130 /* an observer cancelled the frame */
};

/* Return code and text of an error; WAVETRACER_OK and "" for null. The text lives as long as the error; it may have
   several lines. */
int wavetracer_error_code(const wavetracer_error* error);
const char* wavetracer_error_message(const wavetracer_error* error);
void wavetracer_error_free(wavetracer_error* error);

/* Returns the version of the library, such as "0.3.0"; the text lives forever. */
const char* wavetracer_version(void);

/* Returns one line per OpenCL device, in the order of their index: name, tab, platform, tab, "GPU", "CPU" or "other".
   The text lives until the next call of this function in the same thread. It is "" if there is none, and null with an
   error if they cannot be listed. */
const char* wavetracer_devices(wavetracer_error** error);

/* Loads the scene of a configuration and compiles the kernels.
   config: TOML text, as in the files of `wavetracer run`. folder: start of its relative paths; null: the current
   one. sets: set_count texts "key=value" that override it, like --set; may be null if set_count is 0.
   device: an index, or part of a platform's or device's name; null or "": the default choice. */
wavetracer_simulation* wavetracer_open(const char* config, const char* folder, const char* const* sets,
                                       size_t set_count, const char* device, wavetracer_error** error);
void wavetracer_close(wavetracer_simulation* self);

/* Properties of the simulation; 0, NaN or null if self is null or the index is too large. Texts live until
   wavetracer_close. */
uint32_t wavetracer_frame_count(const wavetracer_simulation* self);
double wavetracer_time_s(const wavetracer_simulation* self, uint32_t frame);
size_t wavetracer_transmitter_count(const wavetracer_simulation* self);
size_t wavetracer_receiver_count(const wavetracer_simulation* self);
const char* wavetracer_transmitter_name(const wavetracer_simulation* self, size_t index); /* VEHICLE/NAME for a mount */
const char* wavetracer_receiver_name(const wavetracer_simulation* self, size_t index);
/* The carriers: radio.frequency_hz, then the others of radio.frequencies_hz. */
size_t wavetracer_carrier_count(const wavetracer_simulation* self);
double wavetracer_carrier_hz(const wavetracer_simulation* self, size_t index);
const char* wavetracer_device_name(const wavetracer_simulation* self);
const char* wavetracer_config_text(const wavetracer_simulation* self); /* every key with its value, TOML */
const char* wavetracer_warnings(const wavetracer_simulation* self);    /* one per line; "" if there are none */

/* Solves a frame, 0 to frame_count - 1. With trace.reuse, the result of a frame depends on the frames since the last
   wavetracer_forget, which drops earlier results. After an error of code RUNTIME or DEVICE close the simulation. */
wavetracer_frame* wavetracer_run_frame(wavetracer_simulation* self, uint32_t frame, wavetracer_error** error);
void wavetracer_frame_free(wavetracer_frame* self);
void wavetracer_forget(wavetracer_simulation* self);

/* Sets the observer of all following frames; null removes it. It is called in the thread of wavetracer_run_frame,
   between batches of rays (stage "rays": launched, of how many) and between the steps of the exact solution ("paths").
   If it returns 0, the frame is cancelled with an error of code STOPPED; the simulation can continue with any frame,
   without earlier results. user is passed to it unchanged. A new observer is called from the next step on. */
typedef int (*wavetracer_observer)(void* user, const char* stage, uint64_t done, uint64_t total);
void wavetracer_observe(wavetracer_simulation* self, wavetracer_observer observer, void* user);

/* Counts of a frame. */
typedef struct wavetracer_counts {
  uint64_t rays;       /* launched rays */
  uint64_t segments;   /* rays traced or answered by the cache, all depths */
  uint64_t hits;       /* rays that met a surface */
  uint64_t sequences;  /* distinct sequences of surfaces */
  uint64_t candidates; /* sequence and receiver pairs that may be paths */
  uint64_t solved;     /* candidates with all points in their surfaces */
  uint64_t paths;      /* visible and distinct paths: the rows of the columns */
} wavetracer_counts;

/* Estimate of what the rays of a frame have missed: docs/method.md, "What was missed". low to high: the 95% confidence
   interval. All values are NaN if it is unknown, as with a ray cache or reception by spheres. */
typedef struct wavetracer_missed {
  double paths, paths_low, paths_high;                   /* their number */
  double power_share, power_share_low, power_share_high; /* relative to the power that was found */
} wavetracer_missed;

/* The certificate of a frame with trace.discovery = "beams": it has every path of at most `depth` interactions, of
   which at most `edges` are at edges, whose gain between isotropic antennas is floor_db or more, unless a point of the
   path lies in one of the beams that were too thin to follow. Without beams the integers are 0, and the other values
   are NaN. */
typedef struct wavetracer_certificate {
  uint32_t depth;
  uint32_t any_depth;    /* not 0: no such path has more interactions */
  double left_out_sr;    /* a bound of the solid angle of the thin beams, over all ends */
  double left_out_share; /* the same, of all directions of all ends */
  double left_out_power; /* a bound of the power in these beams, where an isotropic antenna sends 1 W: a link misses no
                            more by reflections in them, but for the gain of its transmitter's antenna */
  double floor_db;       /* trace.floor_db; -infinity if it is not given */
  double weak_share;     /* a bound of the share of the power in beams that were not followed because they are weaker */
  uint32_t edges;        /* 0: the certificate is about reflections alone */
} wavetracer_certificate;

/* 0 for null */
uint32_t wavetracer_frame_number(const wavetracer_frame* self);
double wavetracer_frame_time_s(const wavetracer_frame* self);     /* NaN for null */
uint32_t wavetracer_frame_rx_ports(const wavetracer_frame* self); /* 1, or 2 if any receiver has two */
uint32_t wavetracer_frame_tx_ports(const wavetracer_frame* self);
wavetracer_counts wavetracer_frame_counts(const wavetracer_frame* self);           /* all 0 for null */
wavetracer_missed wavetracer_frame_missed(const wavetracer_frame* self);           /* all NaN for null */
wavetracer_certificate wavetracer_frame_certificate(const wavetracer_frame* self); /* as without beams for null */
const char* wavetracer_frame_warnings(const wavetracer_frame* self); /* as wavetracer_warnings; lives as the frame */

/* Results are columns with the names of the datasets in paths.h5. */
enum wavetracer_type {
  WAVETRACER_UINT8 = 1,
  WAVETRACER_UINT32 = 2,
  WAVETRACER_UINT64 = 3,
  WAVETRACER_FLOAT64 = 4,
  WAVETRACER_COMPLEX128 = 5, /* two doubles, real and imaginary part */
  WAVETRACER_COMPLEX64 = 6   /* two floats, real and imaginary part */
};

typedef struct wavetracer_column {
  const void* data; /* rows * width values without gaps; never null. Lives as long as the frame. */
  size_t rows;
  size_t width; /* values per row */
  int type;     /* enum wavetracer_type */
} wavetracer_column;

/* One row per path, sorted by frame, tx, rx, delay:
     frame, tx, rx, depth                                    uint32     frame number, indices of the ends, interactions
     delay_s, gain_db                                        float64
     a                                                       complex128 x rx ports x tx ports, row major: coefficient
                                                             between the ports, without the carrier phase of the delay:
                                                             h(f) = sum a exp(-j 2 pi f delay_s). Ports that an antenna
                                                             does not have are 0.
     aod_theta_rad, aod_phi_rad, aoa_theta_rad, aoa_phi_rad  float64    from +z; from +x towards +y
     doppler_hz                                              float64
     quarters                                                uint8      a bit for each quarter of the launch that found
                                                             the path; no rows where that is not known
     target                                                  uint32     the target that the path goes by, a row of
                                                             /targets in paths.h5; 0xFFFFFFFF: none. No rows where there
                                                             are no targets
     group                                                   uint32 x 4: numbers in the link of the groups of the path,
                                                             0xFFFFFFFF: none. The power of a link is the sum over
                                                             groups and pairs of ports of |sum of group_weight a
                                                             exp(-j 2 pi f delay_s)|^2. No rows without diffraction:
                                                             then every path is a group of its own
     group_weight                                            float64 x 4
     lifetime_m                                              float64    with output.lifetimes, else no rows: how far the
                                                             ends and all vehicles may move before the path can end
   Rows vertex_offset[i] to vertex_offset[i + 1] of these are the interactions of path i, from the transmitter on:
     vertex_offset                                           uint64     one row more than there are paths
     vertex_position_m                                       float64 x 3, file coordinates
     vertex_interaction                                      uint8      its kind: 1, 2, 4, ... as in docs/formats.md
     vertex_surface                                          uint32     in its scene or model; of a diffraction the edge
     vertex_instance                                         uint32     the vehicle; 0xFFFFFFFF: the static scene
   One row per pair of ends between which paths were wanted:
     link                                                    uint32 x 2: tx, rx
     link_paths                                              uint32     how many
     link_los                                                uint8      1 where one of them has no interaction
     link_path_gain_db, link_sum_of_powers_db,               float64    as links.csv has them (docs/formats.md): powers
     link_narrowband_gain_db,                                           of groups added, powers of paths added, the
     link_mean_delay_s, link_rms_delay_spread_s,                        coherent sum at the carrier, ...
     link_doppler_spread_hz
     link_missed_power_share                                 float64    of links.csv: power that was missed, estimated,
                                                             against that which arrives; NaN where that is not known
   With several of radio.frequencies_hz one row per path, else none:
     carrier_a                                               complex128 x carriers x rx ports x tx ports, row major: a
                                                             at each carrier
     carrier_gain_db, carrier_doppler_hz                     float64 x carriers
   With response.bandwidth_hz, else no rows; of link i the rows response_offset[i] to response_offset[i + 1] - 1, which
   are [time][rx antenna][tx antenna] (antenna: element * ports + port):
     response                                                complex64 x frequencies
     response_offset                                         uint64     one row more than there are links
   With array.codebook one row per link and pair of beams, of links of which an end has a codebook, else none:
     beam_tx, beam_rx, beam_tx_beam, beam_rx_beam            uint32     ends, and their beams
     beam_gain_db                                            float64    of the power through both beams, in groups
   One row per link of each [[radar]] that is in the frame, sorted by radar, tx, rx; none without [[radar]]:
     radar, radar_tx, radar_rx                               uint32     the radar, and the ends
     radar_left_out                                          uint32     paths that are too long for its waveform
     detection_offset                                        uint64     one row more than there are rows of radars
   Rows detection_offset[i] to detection_offset[i + 1] - 1 of these are what row i of the radars detects, by falling
   power; docs/radar.md says how they are found:
     detection_range_m, detection_delay_s,                   float64    half the length of the path, and its delay
     detection_speed_m_s, detection_doppler_hz,                         the speed at which a target comes nearer
     detection_power_dbm, detection_threshold_dbm,
     detection_azimuth_rad, detection_elevation_rad                     in the axes of the receiver; NaN: not known
   One row an end; NaN while it is absent:
     transmitter_position_m, receiver_position_m             float64 x 3, file coordinates
   Returns 1; 0 with an error of code USAGE where there is no such column. */
int wavetracer_frame_column(const wavetracer_frame* self, const char* name, wavetracer_column* column,
                            wavetracer_error** error);

/* Number and names of the radars ([[radar]]); 0 and null as above. */
size_t wavetracer_radar_count(const wavetracer_simulation* self);
const char* wavetracer_radar_name(const wavetracer_simulation* self, size_t index);
/* The cube of row `row` of the radars of a frame, complex128 in roots of watts: one row per receiving antenna,
   transmitting antenna and Doppler shift, one value per delay. shape: set to the numbers of receiving and transmitting
   antennas, Doppler shifts and delays; antenna number = port * elements + element. A radar with cube = false has no
   rows, and its shape is set all the same. Returns 1, or 0 with an error of code USAGE. */
int wavetracer_frame_radar_cube(const wavetracer_frame* self, size_t row, size_t shape[4], wavetracer_column* cube,
                                wavetracer_error** error);
/* An axis of the same cube, float64: "delay_s", "range_m", "doppler_hz" or "speed_m_s". Returns as above. */
int wavetracer_frame_radar_axis(const wavetracer_frame* self, size_t row, const char* name, wavetracer_column* axis,
                                wavetracer_error** error);

/* Number of elements of an end's array ([[array]]); 1 for an end without one, 0 if self is null or the index is too
   large. */
size_t wavetracer_transmitter_elements(const wavetracer_simulation* self, size_t index);
size_t wavetracer_receiver_elements(const wavetracer_simulation* self, size_t index);
/* Write the positions of elements: 3 doubles each, metres from the position of the end, in the axes of its antenna.
   count: number of doubles that fit. Return 1, or 0 with an error of code USAGE. */
int wavetracer_transmitter_element_positions(const wavetracer_simulation* self, size_t index, double* positions_m,
                                             size_t count, wavetracer_error** error);
int wavetracer_receiver_element_positions(const wavetracer_simulation* self, size_t index, double* positions_m,
                                          size_t count, wavetracer_error** error);

/* Writes row `row` of the paths between all pairs of antennas, [rx antenna][tx antenna]; antenna number = element *
   ports + port. Coefficients are like the column a, without the carrier phase of the path's own delay_s. carrier: 0, or
   the index of another one in radio.frequencies_hz. coefficients: pairs of doubles, real and imaginary part; count:
   number of pairs that fit, which must be rx elements x rx ports x tx elements x tx ports. Returns 1, or 0 with an
   error of code USAGE. */
int wavetracer_element_coefficients(const wavetracer_simulation* self, const wavetracer_frame* frame, size_t row,
                                    uint32_t carrier, double* coefficients, size_t count, wavetracer_error** error);

/* Writes the rows rows[0] to rows[row_count - 1] of the paths between all pairs of elements, [row][rx element]
   [tx element]: delays in seconds, and amplitudes relative to those between the centres. The coefficient between two
   elements is a amplitude exp(-j 2 pi f (delay - delay_s)) at its carrier f, for every pair of ports. rx_elements,
   tx_elements: numbers of elements that fit; if an end has fewer, the other amplitudes are 0. Returns 1, or 0 with an
   error of code USAGE. */
int wavetracer_element_paths(const wavetracer_simulation* self, const wavetracer_frame* frame, const size_t* rows,
                             size_t row_count, size_t rx_elements, size_t tx_elements, double* delay_s,
                             double* amplitude, wavetracer_error** error);

/* Writes the channel of a link, [time][rx antenna][tx antenna][frequency], pairs of doubles:
   h(f, t) = sum over its paths of a exp(-j 2 pi f delay) exp(j 2 pi doppler t), with the delays between elements.
   frequencies_hz: absolute; times_s: relative to that of the frame; carrier: the one of the coefficients; count:
   number of pairs that fit. Returns 1, or 0 with an error of code USAGE. */
int wavetracer_response(const wavetracer_simulation* self, const wavetracer_frame* frame, uint32_t tx, uint32_t rx,
                        uint32_t carrier, const double* frequencies_hz, size_t frequency_count, const double* times_s,
                        size_t time_count, double* h, size_t count, wavetracer_error** error);

/* Names of all columns, 0 to wavetracer_column_count() - 1; null beyond. */
size_t wavetracer_column_count(void);
const char* wavetracer_column_name(size_t index);

/* Writes paths.h5, links.csv and summary.json into a folder, as the program does; results of an earlier run there are
   removed. frames: at least one, of this simulation, sorted by their number, each once. Returns 1, or 0 with an error.
 */
int wavetracer_write(const wavetracer_simulation* self, const char* folder, const wavetracer_frame* const* frames,
                     size_t count, wavetracer_error** error);

#ifdef __cplusplus
}
#endif
#endif
