// SPDX-License-Identifier: Apache-2.0
/* Paths of a configuration file through the C interface: cc main.c $(pkg-config --cflags --libs wavetracer) -o example
   Usage: example CONFIG [KEY=VALUE...]. Exits with the code that the program would exit with. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <wavetracer/wavetracer.h>

/* The whole file as text, or null; the caller frees it. */
static char* read_text(const char* path) {
  FILE* file = fopen(path, "rb");
  char* text = NULL;
  size_t size = 0;
  if (!file) return NULL;
  for (;;) {
    char* longer = realloc(text, size + 4097);
    if (!longer) break;
    text = longer;
    const size_t read = fread(text + size, 1, 4096, file);
    size += read;
    text[size] = '\0';
    if (read == 0) break;
  }
  fclose(file);
  return text;
}

/* The folder where relative paths of a configuration start: its own, as for `wavetracer run -c`. The caller frees it.
 */
static char* folder_of(const char* path) {
  const char* slash = strrchr(path, '/');
  const size_t size = slash ? (size_t)(slash - path) + 1 : 1;
  char* folder = malloc(size + 1);
  if (!folder) return NULL;
  memcpy(folder, slash ? path : ".", size);
  folder[size] = '\0';
  return folder;
}

static int failed(wavetracer_error* error) {
  const int code = wavetracer_error_code(error);
  fprintf(stderr, "%s\n", wavetracer_error_message(error));
  wavetracer_error_free(error);
  return code;
}

static int print_frame(const wavetracer_simulation* simulation, const wavetracer_frame* frame) {
  wavetracer_error* error = NULL;
  wavetracer_column tx, rx, delay_s, gain_db;
  if (!wavetracer_frame_column(frame, "tx", &tx, &error) || !wavetracer_frame_column(frame, "rx", &rx, &error) ||
      !wavetracer_frame_column(frame, "delay_s", &delay_s, &error) ||
      !wavetracer_frame_column(frame, "gain_db", &gain_db, &error))
    return failed(error);
  printf("frame %u: %zu paths\n", wavetracer_frame_number(frame), delay_s.rows);
  for (size_t i = 0; i < delay_s.rows; ++i)
    printf("%s -> %s  %9.2f ns %8.2f dB\n", wavetracer_transmitter_name(simulation, ((const uint32_t*)tx.data)[i]),
           wavetracer_receiver_name(simulation, ((const uint32_t*)rx.data)[i]), ((const double*)delay_s.data)[i] * 1e9,
           ((const double*)gain_db.data)[i]);
  return WAVETRACER_OK;
}

int main(int argc, char** argv) {
  if (argc < 2) {
    fprintf(stderr, "usage: %s CONFIG [KEY=VALUE...]\n", argv[0]);
    return WAVETRACER_USAGE;
  }
  char* text = read_text(argv[1]);
  if (!text) {
    perror(argv[1]);
    return WAVETRACER_USAGE;
  }
  char* folder = folder_of(argv[1]);
  wavetracer_error* error = NULL;
  wavetracer_simulation* simulation =
      wavetracer_open(text, folder, (const char* const*)argv + 2, (size_t)(argc - 2), NULL, &error);
  free(text);
  free(folder);
  if (!simulation) return failed(error);
  int code = WAVETRACER_OK;
  for (uint32_t i = 0; i < wavetracer_frame_count(simulation) && code == WAVETRACER_OK; ++i) {
    wavetracer_frame* frame = wavetracer_run_frame(simulation, i, &error);
    code = frame ? print_frame(simulation, frame) : failed(error);
    wavetracer_frame_free(frame);
  }
  wavetracer_close(simulation);
  return code;
}
