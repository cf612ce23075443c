// SPDX-License-Identifier: Apache-2.0
/* The C interface from C99: a frame against closed forms, errors and misuse, files, two simulations in one process.
   Usage: test_c_api FOLDER, which is written to. Says each check that fails; exits 1 if any did. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include "c_checks.h"

static const double pi = 3.14159265358979323846;

/* Two ends in the middle of a street, line of sight alone: one path of a known length. */
static const char* const config =
    "[scene]\ngenerate = \"--blocks 2\"\n"
    "[[transmitter]]\nname = \"t\"\nposition_m = [0, 0, 6]\n"
    "[[receiver]]\nname = \"r\"\nposition_m = [30, 0, 2]\n"
    "[[receiver]]\nname = \"both\"\npolarization = \"VH\"\nposition_m = [40, 0, 2]\n"
    "[trace]\nrays = 1000\nmax_depth = 0\n";

static const double* doubles(const wavetracer_frame* frame, const char* name, size_t rows, size_t width) {
  wavetracer_column column = {NULL, 0, 0, 0};
  CHECK(wavetracer_frame_column(frame, name, &column, NULL) == 1);
  CHECK(column.rows == rows);
  CHECK(column.width == width);
  CHECK(column.type == WAVETRACER_FLOAT64 || column.type == WAVETRACER_COMPLEX128);
  return (const double*)column.data;
}

static void check_frame(const wavetracer_frame* frame) {
  CHECK(wavetracer_frame_number(frame) == 0);
  CHECK(wavetracer_frame_counts(frame).rays == 0); /* line of sight needs none */
  CHECK(wavetracer_frame_counts(frame).paths == 2);
  CHECK(isnan(wavetracer_frame_missed(frame).power_share_high)); /* nothing was left to rays */
  CHECK(wavetracer_frame_rx_ports(frame) == 2);
  CHECK(wavetracer_frame_tx_ports(frame) == 1);
  CHECK(strcmp(wavetracer_frame_warnings(frame), "") == 0);
  const double length_m = sqrt(30 * 30 + 4 * 4), wavelength_m = speed_of_light_m_s / 5.9e9;
  CHECK(fabs(doubles(frame, "delay_s", 2, 1)[0] - length_m / speed_of_light_m_s) < 1e-18);
  const double friis_db = 20 * log10(wavelength_m / (4 * pi * length_m));
  CHECK(fabs(doubles(frame, "gain_db", 2, 1)[0] - friis_db) < 1e-9);
  const double* a = doubles(frame, "a", 2, 2);
  CHECK(fabs(20 * log10(hypot(a[0], a[1])) - friis_db) < 1e-9);
  CHECK(a[2] == 0 && a[3] == 0); /* the port that the receiver r does not have */
  const double* position_m = doubles(frame, "receiver_position_m", 2, 3);
  CHECK(fabs(position_m[3] - 40) < 1e-9 && fabs(position_m[5] - 2) < 1e-9);
  wavetracer_column links, offsets, vertices;
  CHECK(wavetracer_frame_column(frame, "link", &links, NULL) == 1);
  CHECK(links.rows == 2 && links.width == 2 && ((const uint32_t*)links.data)[3] == 1);
  CHECK(wavetracer_frame_column(frame, "vertex_offset", &offsets, NULL) == 1);
  CHECK(offsets.rows == 3 && offsets.type == WAVETRACER_UINT64);
  CHECK(wavetracer_frame_column(frame, "vertex_surface", &vertices, NULL) == 1);
  CHECK(vertices.rows == 0 && vertices.data != NULL);
}

static void check_columns(const wavetracer_frame* frame) {
  wavetracer_error* error = NULL;
  wavetracer_column column;
  for (size_t i = 0; i < wavetracer_column_count(); ++i)
    CHECK(wavetracer_frame_column(frame, wavetracer_column_name(i), &column, &error) == 1 && error == NULL);
  CHECK(wavetracer_column_name(wavetracer_column_count()) == NULL);
  CHECK(wavetracer_frame_column(frame, "delay", &column, &error) == 0);
  check_error(error, WAVETRACER_USAGE, "no column \"delay\"");
  CHECK(wavetracer_frame_column(NULL, "delay_s", &column, &error) == 0);
  check_error(error, WAVETRACER_USAGE, "self is null");
  CHECK(wavetracer_frame_column(frame, NULL, &column, &error) == 0);
  check_error(error, WAVETRACER_USAGE, "name is null");
  CHECK(wavetracer_frame_column(frame, "delay_s", NULL, &error) == 0);
  check_error(error, WAVETRACER_USAGE, "column is null");
}

static void check_bad_opens(void) {
  wavetracer_error* error = NULL;
  CHECK(wavetracer_open(NULL, NULL, NULL, 0, NULL, &error) == NULL);
  check_error(error, WAVETRACER_USAGE, "config is null");
  CHECK(wavetracer_open("[trace]\nray = 5\n", NULL, NULL, 0, NULL, &error) == NULL);
  check_error(error, WAVETRACER_USAGE, "config:2:1: unknown key \"trace.ray\"");
  CHECK(wavetracer_open(config, NULL, NULL, 1, NULL, &error) == NULL);
  check_error(error, WAVETRACER_USAGE, "sets is null");
  const char* const null_text[] = {NULL};
  CHECK(wavetracer_open(config, NULL, null_text, 1, NULL, &error) == NULL);
  check_error(error, WAVETRACER_USAGE, "one of sets is null");
  const char* const no_scene[] = {"scene.generate=", "scene.file=/nowhere.xml"};
  CHECK(wavetracer_open(config, NULL, no_scene, 2, NULL, &error) == NULL);
  check_error(error, WAVETRACER_INPUT, "/nowhere.xml");
  CHECK(wavetracer_open(config, NULL, NULL, 0, "no such device", &error) == NULL);
  check_error(error, WAVETRACER_DEVICE, "no such device");
  CHECK(wavetracer_open(config, NULL, NULL, 0, "no such device", NULL) == NULL); /* whoever does not ask why */
}

static void check_nulls(void) {
  wavetracer_error* error = NULL;
  wavetracer_close(NULL);
  wavetracer_frame_free(NULL);
  wavetracer_error_free(NULL);
  wavetracer_forget(NULL);
  CHECK(wavetracer_error_code(NULL) == WAVETRACER_OK);
  CHECK(strcmp(wavetracer_error_message(NULL), "") == 0);
  CHECK(wavetracer_frame_count(NULL) == 0);
  CHECK(isnan(wavetracer_time_s(NULL, 0)));
  CHECK(wavetracer_transmitter_name(NULL, 0) == NULL);
  CHECK(wavetracer_receiver_name(NULL, 0) == NULL);
  CHECK(wavetracer_device_name(NULL) == NULL);
  CHECK(wavetracer_config_text(NULL) == NULL);
  CHECK(wavetracer_warnings(NULL) == NULL);
  CHECK(wavetracer_frame_counts(NULL).paths == 0);
  CHECK(isnan(wavetracer_frame_missed(NULL).paths) && isnan(wavetracer_frame_certificate(NULL).floor_db));
  CHECK(wavetracer_run_frame(NULL, 0, &error) == NULL);
  check_error(error, WAVETRACER_USAGE, "self is null");
  CHECK(wavetracer_write(NULL, "out", NULL, 0, &error) == 0);
  check_error(error, WAVETRACER_USAGE, "self is null");
}

static int exists(const char* folder, const char* name) {
  char path[4096];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  FILE* file = fopen(path, "rb");
  if (file) fclose(file);
  return file != NULL;
}

static void check_write(const wavetracer_simulation* simulation, const wavetracer_frame* frame, const char* folder) {
  wavetracer_error* error = NULL;
  const wavetracer_frame* const twice[] = {frame, frame};
  const wavetracer_frame* const none[] = {NULL};
  CHECK(wavetracer_write(simulation, folder, twice, 0, &error) == 0);
  check_error(error, WAVETRACER_USAGE, "no frames");
  CHECK(wavetracer_write(simulation, folder, twice, 2, &error) == 0);
  check_error(error, WAVETRACER_USAGE, "sorted");
  CHECK(wavetracer_write(simulation, folder, none, 1, &error) == 0);
  check_error(error, WAVETRACER_USAGE, "one of frames is null");
  CHECK(wavetracer_write(simulation, "/dev/null/folder", twice, 1, &error) == 0);
  check_error(error, WAVETRACER_RUNTIME, "/dev/null");
  CHECK(wavetracer_write(simulation, folder, twice, 1, &error) == 1 && error == NULL);
  CHECK(exists(folder, "paths.h5") && exists(folder, "links.csv") && exists(folder, "summary.json"));
}

/* Notes what it is told, and gives the frame up at the first step where it is asked to. */
struct watched {
  int calls, go_on, rays, paths;
};

static int watch(void* user, const char* stage, uint64_t done, uint64_t total) {
  struct watched* noted = user;
  ++noted->calls;
  noted->rays |= strcmp(stage, "rays") == 0;
  noted->paths |= strcmp(stage, "paths") == 0;
  CHECK(done <= total);
  return noted->go_on;
}

static void check_observer(void) {
  wavetracer_error* error = NULL;
  const char* const sets[] = {"trace.max_depth=1"};
  wavetracer_simulation* simulation = wavetracer_open(config, NULL, sets, 1, NULL, NULL);
  struct watched noted = {0, 1, 0, 0};
  wavetracer_observe(NULL, watch, &noted);
  wavetracer_observe(simulation, watch, &noted);
  wavetracer_frame* frame = wavetracer_run_frame(simulation, 0, &error);
  CHECK(frame != NULL && noted.calls > 1 && noted.rays && noted.paths);
  CHECK(wavetracer_frame_time_s(frame) == 0 && isnan(wavetracer_frame_time_s(NULL)));
  wavetracer_frame_free(frame);
  noted.calls = noted.go_on = 0;
  CHECK(wavetracer_run_frame(simulation, 0, &error) == NULL && noted.calls == 1);
  check_error(error, WAVETRACER_STOPPED, "given up");
  wavetracer_observe(simulation, NULL, NULL);
  frame = wavetracer_run_frame(simulation, 0, &error);
  CHECK(frame != NULL && noted.calls == 1);
  wavetracer_frame_free(frame);
  wavetracer_close(simulation);
}

/* Delays and amplitudes between elements, of the paths in another order and with room to spare. */
static void check_element_paths(const wavetracer_simulation* simulation, const wavetracer_frame* frame, double length_m,
                                double centre_m) {
  wavetracer_error* error = NULL;
  const size_t rows[] = {1, 0}, none[] = {7};
  double delay_s[2 * 2 * 3], amplitude[2 * 2 * 3];
  CHECK(wavetracer_element_paths(simulation, frame, rows, 2, 2, 3, delay_s, amplitude, &error) == 1 && error == NULL);
  CHECK(fabs(delay_s[7] - length_m / speed_of_light_m_s) < 1e-18 && fabs(amplitude[7] - centre_m / length_m) < 1e-12);
  CHECK(amplitude[8] == 0 && amplitude[9] == 0); /* the third element of the transmitter, the second of the receiver */
  CHECK(wavetracer_element_paths(simulation, frame, rows, 2, 1, 1, delay_s, amplitude, &error) == 0);
  check_error(error, WAVETRACER_USAGE, "room for 1 values, but 2 are needed");
  CHECK(wavetracer_element_paths(simulation, frame, none, 1, 2, 3, delay_s, amplitude, &error) == 0);
  check_error(error, WAVETRACER_USAGE, "no path 7");
}

/* Two elements 10 cm apart across the line of sight, and the receiver's one: lengths by Pythagoras. */
static void check_arrays(void) {
  const char* const sets[] = {"transmitter.0.array=two", "radio.frequencies_hz=[5.9e9, 28e9]",
                              "response.bandwidth_hz=1e6", "response.subcarriers=4"};
  char text[1024];
  snprintf(text, sizeof text, "%s%s", config,
           "[[array]]\nname = \"two\"\npositions_m = [[0, -0.05, 0], [0, 0.05, 0.02]]\n");
  wavetracer_error* error = NULL;
  wavetracer_simulation* simulation = wavetracer_open(text, NULL, sets, 4, NULL, &error);
  if (!simulation) {
    ++failures;
    fprintf(stderr, "%s\n", wavetracer_error_message(error));
    return;
  }
  CHECK(wavetracer_carrier_count(simulation) == 2 && wavetracer_carrier_hz(simulation, 1) == 28e9);
  CHECK(wavetracer_carrier_count(NULL) == 0 && isnan(wavetracer_carrier_hz(NULL, 0)));
  CHECK(wavetracer_transmitter_elements(simulation, 0) == 2 && wavetracer_transmitter_elements(simulation, 1) == 0);
  CHECK(wavetracer_receiver_elements(simulation, 1) == 1 && wavetracer_receiver_elements(NULL, 0) == 0);
  double places[6], a[4], h[16];
  CHECK(wavetracer_transmitter_element_positions(simulation, 0, places, 6, &error) == 1 && error == NULL);
  CHECK(places[1] == -0.05 && places[4] == 0.05 && places[5] == 0.02);
  CHECK(wavetracer_transmitter_element_positions(simulation, 0, places, 5, &error) == 0);
  check_error(error, WAVETRACER_USAGE, "room for 5 values, but 6 are needed");
  CHECK(wavetracer_receiver_element_positions(simulation, 2, places, 6, &error) == 0);
  check_error(error, WAVETRACER_USAGE, "no end 2, only 2");
  wavetracer_frame* frame = wavetracer_run_frame(simulation, 0, &error);
  CHECK(frame != NULL);
  const double centre_m = sqrt(30 * 30 + 4 * 4), length_m = sqrt(30 * 30 + 0.05 * 0.05 + 4.02 * 4.02);
  for (uint32_t carrier = 0; carrier < 2; ++carrier) {
    const double f = carrier ? 28e9 : 5.9e9;
    CHECK(wavetracer_element_coefficients(simulation, frame, 0, carrier, a, 2, &error) == 1 && error == NULL);
    const double turned = atan2(a[3], a[2]), wanted = -2 * pi * f * (length_m - centre_m) / speed_of_light_m_s;
    const double friis = speed_of_light_m_s / f / (4 * pi * length_m);
    CHECK(fabs(remainder(turned - wanted, 2 * pi)) < 1e-6);
    CHECK(fabs(hypot(a[2], a[3]) / friis - 1) < 1e-9);
    const double frequencies_hz[] = {f - 1e6, f}, times_s[] = {0};
    CHECK(wavetracer_response(simulation, frame, 0, 0, carrier, frequencies_hz, 2, times_s, 1, h, 4, &error) == 1);
    CHECK(fabs(remainder(atan2(h[7], h[6]) + 2 * pi * f * length_m / speed_of_light_m_s, 2 * pi)) < 1e-5);
  }
  check_element_paths(simulation, frame, length_m, centre_m);
  CHECK(wavetracer_element_coefficients(simulation, frame, 0, 2, a, 2, &error) == 0);
  check_error(error, WAVETRACER_USAGE, "no carrier 2, only 2");
  CHECK(wavetracer_element_coefficients(simulation, frame, 9, 0, a, 2, &error) == 0);
  check_error(error, WAVETRACER_USAGE, "no path 9");
  const double not_a_number = nan(""), late_s = 1e300, some_hz = 1e9;
  CHECK(wavetracer_response(simulation, frame, 0, 0, 0, &not_a_number, 1, places, 1, h, 4, &error) == 0);
  check_error(error, WAVETRACER_USAGE, "frequencies_hz[0] is ");
  CHECK(wavetracer_response(simulation, frame, 0, 0, 0, &some_hz, 1, &late_s, 1, h, 4, &error) == 0);
  check_error(error, WAVETRACER_USAGE, "times_s[0] is ");
  CHECK(wavetracer_response(simulation, frame, 0, 7, 0, places, 1, places, 1, h, 16, &error) == 0);
  check_error(error, WAVETRACER_USAGE, "no link from transmitter 0 to receiver 7");
  wavetracer_column responses, carriers;
  CHECK(wavetracer_frame_column(frame, "response", &responses, NULL) == 1);
  CHECK(responses.rows == 2 + 4 && responses.width == 8 && responses.type == WAVETRACER_COMPLEX64);
  CHECK(wavetracer_frame_column(frame, "carrier_a", &carriers, NULL) == 1);
  CHECK(carriers.rows == 2 && carriers.width == 4 && carriers.type == WAVETRACER_COMPLEX128);
  wavetracer_frame_free(frame);
  wavetracer_close(simulation);
}

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  wavetracer_error* error = NULL;
  check_nulls();
  check_bad_opens();
  wavetracer_simulation* simulation = wavetracer_open(config, "/tmp", NULL, 0, "", &error);
  if (!simulation) {
    fprintf(stderr, "%s\n", wavetracer_error_message(error));
    return 1;
  }
  CHECK(strcmp(wavetracer_version(), "") != 0);
  CHECK(wavetracer_frame_count(simulation) == 1);
  CHECK(wavetracer_time_s(simulation, 0) == 0);
  CHECK(isnan(wavetracer_time_s(simulation, 1)));
  CHECK(wavetracer_transmitter_count(simulation) == 1 && wavetracer_receiver_count(simulation) == 2);
  CHECK(strcmp(wavetracer_receiver_name(simulation, 1), "both") == 0);
  CHECK(wavetracer_receiver_name(simulation, 2) == NULL);
  CHECK(strstr(wavetracer_config_text(simulation), "rays = 1000") != NULL);
  CHECK(wavetracer_run_frame(simulation, 1, &error) == NULL);
  check_error(error, WAVETRACER_USAGE, "no frame 1");
  wavetracer_frame* frame = wavetracer_run_frame(simulation, 0, &error);
  CHECK(frame != NULL && error == NULL);
  check_frame(frame);
  check_columns(frame);
  check_write(simulation, frame, argv[1]);
  check_observer();
  CHECK(wavetracer_carrier_hz(simulation, 0) == 5.9e9 && isnan(wavetracer_carrier_hz(simulation, 1)));
  CHECK(strstr(wavetracer_devices(NULL), wavetracer_device_name(simulation)) != NULL);
  const char* const sets[] = {"trace.rays=2000"};
  wavetracer_simulation* other = wavetracer_open(config, NULL, sets, 1, NULL, NULL);
  CHECK(other != NULL);
  const wavetracer_frame* const foreign[] = {frame};
  CHECK(wavetracer_write(other, argv[1], foreign, 1, &error) == 0);
  check_error(error, WAVETRACER_USAGE, "of another simulation");
  wavetracer_close(simulation);
  check_frame(frame); /* frames outlive their simulation */
  wavetracer_frame_free(frame);
  wavetracer_close(other);
  check_arrays();
  printf("%d failures\n", failures);
  return failures == 0 ? 0 : 1;
}
