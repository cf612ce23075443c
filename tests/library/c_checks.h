// SPDX-License-Identifier: Apache-2.0
/* Checks of the C programs of this folder: each says the line that fails, and counts it. */
#ifndef WAVETRACER_TESTS_C_CHECKS_H
#define WAVETRACER_TESTS_C_CHECKS_H
#include <stdio.h>
#include <string.h>
#include "wavetracer/wavetracer.h"

static int failures = 0;
#define CHECK(condition) \
  ((condition) ? (void)0 : (void)(++failures, fprintf(stderr, "line %d: %s\n", __LINE__, #condition)))

static const double speed_of_light_m_s = 299792458.0;

/* Checks an error's code and a part of its message, and frees it. */
static void check_error(wavetracer_error* error, int code, const char* part) {
  CHECK(error != NULL);
  CHECK(wavetracer_error_code(error) == code);
  if (!strstr(wavetracer_error_message(error), part)) {
    ++failures;
    fprintf(stderr, "no \"%s\" in \"%s\"\n", part, wavetracer_error_message(error));
  }
  wavetracer_error_free(error);
}

#endif
