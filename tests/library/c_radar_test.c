// SPDX-License-Identifier: Apache-2.0
/* Radars in the C interface: detections and cubes of the direct path against its length, and misuse. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "c_checks.h"

/* Two ends in the middle of a street, line of sight alone. */
static const char* const ends =
    "[scene]\ngenerate = \"--blocks 2\"\n"
    "[[transmitter]]\nname = \"t\"\nposition_m = [0, 0, 6]\n"
    "[[receiver]]\nname = \"r\"\nposition_m = [30, 0, 2]\n"
    "[[receiver]]\nname = \"other\"\nposition_m = [40, 0, 2]\n"
    "[trace]\nrays = 1000\nmax_depth = 0\n";
static const double length_m = 30.265491900843114; /* sqrt(30^2 + 4^2) */

static const double* doubles(const wavetracer_frame* frame, const char* name, size_t rows) {
  wavetracer_column column = {NULL, 0, 0, 0};
  CHECK(wavetracer_frame_column(frame, name, &column, NULL) == 1);
  CHECK(column.rows == rows && column.width == 1 && column.type == WAVETRACER_FLOAT64);
  return (const double*)column.data;
}

static wavetracer_simulation* opened(const char* text, const char* const* sets, size_t set_count) {
  wavetracer_error* error = NULL;
  wavetracer_simulation* simulation = wavetracer_open(text, NULL, sets, set_count, NULL, &error);
  if (simulation) return simulation;
  fprintf(stderr, "%s\n", wavetracer_error_message(error));
  exit(1);
}

/* A radar hears the direct path of a known length; the cube has its peak in the cell of the strongest detection. */
static void check_radars(void) {
  char text[1024];
  snprintf(text, sizeof text, "%s%s", ends,
           "[[radar]]\nname = \"front\"\nreceiver = \"r\"\nbandwidth_hz = 300e6\nchirps = 32\nsamples = 64\n");
  const char* const without[] = {"radar.0.cube=false"};
  for (size_t sets = 0; sets < 2; ++sets) {
    wavetracer_error* error = NULL;
    wavetracer_simulation* simulation = opened(text, without, sets);
    CHECK(wavetracer_radar_count(simulation) == 1 && wavetracer_radar_count(NULL) == 0);
    CHECK(strcmp(wavetracer_radar_name(simulation, 0), "front") == 0);
    CHECK(wavetracer_radar_name(simulation, 1) == NULL && wavetracer_radar_name(NULL, 0) == NULL);
    wavetracer_frame* frame = wavetracer_run_frame(simulation, 0, &error);
    wavetracer_column column, offset;
    CHECK(wavetracer_frame_column(frame, "radar_rx", &column, NULL) == 1 && column.rows == 1);
    CHECK(((const uint32_t*)column.data)[0] == 0 && column.type == WAVETRACER_UINT32);
    CHECK(wavetracer_frame_column(frame, "detection_offset", &offset, NULL) == 1 && offset.rows == 2);
    const size_t found = (size_t)((const uint64_t*)offset.data)[1];
    CHECK(found > 0 && ((const uint64_t*)offset.data)[0] == 0);
    const double range_m = doubles(frame, "detection_range_m", found)[0], cell_m = speed_of_light_m_s / 2 / 300e6;
    CHECK(fabs(range_m - length_m / 2) < cell_m);
    CHECK(fabs(doubles(frame, "detection_delay_s", found)[0] - 2 * range_m / speed_of_light_m_s) < 1e-15);
    CHECK(doubles(frame, "detection_power_dbm", found)[0] > doubles(frame, "detection_threshold_dbm", found)[0]);
    size_t shape[4];
    CHECK(wavetracer_frame_radar_cube(frame, 0, shape, &column, &error) == 1 && error == NULL);
    CHECK(shape[0] == 1 && shape[1] == 1 && shape[2] == 32 && shape[3] == 64);
    CHECK(column.rows == (sets ? 0 : 32) && column.width == 64 && column.type == WAVETRACER_COMPLEX128);
    const double* cube = (const double*)column.data;
    size_t peak = 0;
    for (size_t i = 0; i < column.rows * column.width; ++i)
      if (hypot(cube[2 * i], cube[2 * i + 1]) > hypot(cube[2 * peak], cube[2 * peak + 1])) peak = i;
    CHECK(wavetracer_frame_radar_axis(frame, 0, "range_m", &column, &error) == 1 && column.rows == 64);
    CHECK(sets == 1 || fabs(((const double*)column.data)[peak % 64] - range_m) < cell_m);
    CHECK(wavetracer_frame_radar_axis(frame, 0, "doppler_hz", &column, &error) == 1 && column.rows == 32);
    CHECK(sets == 1 || ((const double*)column.data)[peak / 64] == 0); /* nothing moves */
    CHECK(wavetracer_frame_radar_cube(frame, 1, shape, &column, &error) == 0);
    check_error(error, WAVETRACER_USAGE, "no row 1 of radars, only 1");
    CHECK(wavetracer_frame_radar_axis(frame, 0, "angle", &column, &error) == 0);
    check_error(error, WAVETRACER_USAGE, "no axis \"angle\"");
    CHECK(wavetracer_frame_radar_cube(NULL, 0, shape, &column, &error) == 0);
    check_error(error, WAVETRACER_USAGE, "self is null");
    wavetracer_frame_free(frame);
    wavetracer_close(simulation);
  }
}

/* Without radars there are no rows. */
static void check_none(void) {
  wavetracer_error* error = NULL;
  wavetracer_simulation* simulation = opened(ends, NULL, 0);
  CHECK(wavetracer_radar_count(simulation) == 0 && wavetracer_radar_name(simulation, 0) == NULL);
  wavetracer_frame* frame = wavetracer_run_frame(simulation, 0, &error);
  wavetracer_column column;
  CHECK(wavetracer_frame_column(frame, "radar", &column, NULL) == 1 && column.rows == 0 && column.data != NULL);
  CHECK(wavetracer_frame_column(frame, "detection_offset", &column, NULL) == 1 && column.rows == 1);
  doubles(frame, "detection_range_m", 0);
  size_t shape[4];
  CHECK(wavetracer_frame_radar_cube(frame, 0, shape, &column, &error) == 0);
  check_error(error, WAVETRACER_USAGE, "no row 0 of radars, only 0");
  wavetracer_frame_free(frame);
  wavetracer_close(simulation);
}

int main(void) {
  check_radars();
  check_none();
  return failures != 0;
}
