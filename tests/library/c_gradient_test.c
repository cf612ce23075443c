// SPDX-License-Identifier: Apache-2.0
/* Derivatives of paths by the C interface: line of sight against closed forms, a wall that reflects, choices of rows,
   and misuse. Says each check that fails; exits 1 if any did. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include "c_checks.h"
#include "wavetracer/gradient.h"

/* Two ends in the middle of a street: line of sight, and a reflection off the ground and off walls. */
static const char* const config =
    "[scene]\ngenerate = \"--blocks 2\"\n"
    "[[transmitter]]\nname = \"t\"\nposition_m = [0, 0, 6]\n"
    "[[receiver]]\nname = \"r\"\nposition_m = [30, 0, 2]\n"
    "[trace]\nrays = 3000\nmax_depth = 1\n";

static wavetracer_column column(const wavetracer_gradient* gradient, const char* name, size_t rows, int type) {
  wavetracer_column out = {NULL, 0, 0, 0};
  CHECK(wavetracer_gradient_column(gradient, name, &out, NULL) == 1);
  CHECK(out.rows == rows);
  CHECK(out.type == type);
  return out;
}

/* The first path is the direct one. Its length changes as the ends part, and its coefficient falls with the length. */
static void check_line_of_sight(wavetracer_simulation* simulation, const wavetracer_frame* frame) {
  const size_t row = 0;
  wavetracer_gradient* gradient = wavetracer_frame_gradient(simulation, frame, WAVETRACER_WRT_POSITIONS, &row, 1, NULL);
  CHECK(gradient != NULL);
  const size_t paths = (size_t)wavetracer_frame_counts(frame).paths;
  const uint64_t* first = (const uint64_t*)column(gradient, "first", paths + 1, WAVETRACER_UINT64).data;
  CHECK(first[0] == 0 && first[1] == 6 && first[paths] == 6); /* the other paths were not chosen */
  const uint8_t* parameter = (const uint8_t*)column(gradient, "parameter", 6, WAVETRACER_UINT8).data;
  const uint8_t* gap = (const uint8_t*)column(gradient, "gap", 6, WAVETRACER_UINT8).data;
  const uint32_t* material = (const uint32_t*)column(gradient, "material", 6, WAVETRACER_UINT32).data;
  const double* delay_s = (const double*)column(gradient, "delay_s", 6, WAVETRACER_FLOAT64).data;
  const wavetracer_column a = column(gradient, "a", 6, WAVETRACER_COMPLEX128);
  CHECK(a.width == 1);
  wavetracer_column value;
  CHECK(wavetracer_frame_column(frame, "a", &value, NULL) == 1);
  const double apart[3] = {30, 0, -4}, length_m = sqrt(30 * 30 + 4 * 4);
  const double* of = (const double*)value.data;
  for (int i = 0; i < 6; ++i) {
    const double towards = (i < 3 ? -1 : 1) * apart[i % 3] / length_m; /* the growth of the length */
    CHECK(parameter[i] == WAVETRACER_TX_POSITION + i);
    CHECK(gap[i] == WAVETRACER_GAP_NONE && material[i] == 0xFFFFFFFFu);
    CHECK(fabs(delay_s[i] - towards / speed_of_light_m_s) < 1e-20);
    /* isotropic vertical ends turn their polarization with the height alone, which |a| feels by 1 / length */
    const double* slope = (const double*)a.data + 2 * i;
    const double grows = (of[0] * slope[0] + of[1] * slope[1]) / (of[0] * of[0] + of[1] * of[1]);
    CHECK(fabs(grows + towards / length_m) < 1e-12);
  }
  wavetracer_gradient_free(gradient);
}

static void check_materials(wavetracer_simulation* simulation, const wavetracer_frame* frame) {
  wavetracer_gradient* gradient = wavetracer_frame_gradient(
      simulation, frame, WAVETRACER_WRT_MATERIALS | WAVETRACER_WRT_ORIENTATIONS, NULL, 0, NULL);
  const size_t paths = (size_t)wavetracer_frame_counts(frame).paths;
  CHECK(paths > 2);
  const uint64_t* first = (const uint64_t*)column(gradient, "first", paths + 1, WAVETRACER_UINT64).data;
  CHECK(first[1] == 6); /* six turns, and no material */
  for (size_t path = 1; path < paths; ++path) CHECK(first[path + 1] - first[path] == 6 + 3);
  const uint32_t* material =
      (const uint32_t*)column(gradient, "material", (size_t)first[paths], WAVETRACER_UINT32).data;
  CHECK(wavetracer_gradient_material_count(gradient) > 0);
  for (uint64_t i = 0; i < first[paths]; ++i)
    CHECK(material[i] == 0xFFFFFFFFu || strlen(wavetracer_gradient_material_name(gradient, material[i])) > 2);
  CHECK(wavetracer_gradient_material_name(gradient, 100) == NULL);
  wavetracer_column unknown;
  wavetracer_error* error = NULL;
  CHECK(wavetracer_gradient_column(gradient, "gain", &unknown, &error) == 0);
  check_error(error, WAVETRACER_USAGE, "no column \"gain\"");
  wavetracer_gradient_free(gradient);
}

static void check_misuse(wavetracer_simulation* simulation, const wavetracer_frame* frame) {
  wavetracer_error* error = NULL;
  CHECK(wavetracer_frame_gradient(simulation, NULL, WAVETRACER_WRT_POSITIONS, NULL, 0, &error) == NULL);
  check_error(error, WAVETRACER_USAGE, "frame is null");
  CHECK(wavetracer_frame_gradient(simulation, frame, 8, NULL, 0, &error) == NULL);
  check_error(error, WAVETRACER_USAGE, "wrt is 8");
  const size_t none = 1000000;
  CHECK(wavetracer_frame_gradient(simulation, frame, WAVETRACER_WRT_POSITIONS, &none, 1, &error) == NULL);
  check_error(error, WAVETRACER_USAGE, "no path 1000000");
  wavetracer_simulation* other = wavetracer_open(config, NULL, NULL, 0, NULL, NULL);
  CHECK(wavetracer_frame_gradient(other, frame, WAVETRACER_WRT_POSITIONS, NULL, 0, &error) == NULL);
  check_error(error, WAVETRACER_USAGE, "another simulation");
  wavetracer_close(other);
  wavetracer_gradient_free(NULL);
  CHECK(wavetracer_gradient_material_count(NULL) == 0);
}

int main(void) {
  wavetracer_error* error = NULL;
  wavetracer_simulation* simulation = wavetracer_open(config, NULL, NULL, 0, NULL, &error);
  if (!simulation) {
    fprintf(stderr, "%s\n", wavetracer_error_message(error));
    return 1;
  }
  wavetracer_frame* frame = wavetracer_run_frame(simulation, 0, NULL);
  check_line_of_sight(simulation, frame);
  check_materials(simulation, frame);
  check_misuse(simulation, frame);
  wavetracer_frame_free(frame);
  wavetracer_close(simulation);
  return failures ? 1 : 0;
}
