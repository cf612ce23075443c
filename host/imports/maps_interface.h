// SPDX-License-Identifier: Apache-2.0
/* The interface of the module wavetracer_maps.so, the one part of the program that uses GDAL: footprints, points and
   lines of vector maps, and heights of rasters. It is plain C, so that the program can load it at run time if it
   exists. Texts are UTF-8 and belong to the module; they and all arrays are valid until the function or the callback
   that has them returns. */
#ifndef WAVETRACER_IMPORTS_MAPS_INTERFACE_H
#define WAVETRACER_IMPORTS_MAPS_INTERFACE_H
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define WT_MAPS_VERSION 3
enum { WT_MAPS_ERROR_SIZE = 2048 };

/* A text in the module's file: the program searches it before it opens GDAL, since it could not do without it later. */
#define WT_MAPS_TEXT_OF(number) #number
#define WT_MAPS_MARK_OF(number) "wavetracer maps, interface " WT_MAPS_TEXT_OF(number) ";"
#define WT_MAPS_MARK WT_MAPS_MARK_OF(WT_MAPS_VERSION)

/* A polygon, a point or a line of a feature. */
enum { WT_MAPS_POLYGON, WT_MAPS_POINT, WT_MAPS_LINE };
struct wt_maps_shape {
  int kind;
  const char* layer;
  int64_t feature;           /* its id in the layer */
  size_t part;               /* number among the shapes of a feature, from 0 */
  size_t rings;              /* a polygon has the outer one first, then its holes; else 1 */
  const size_t* ring_sizes;  /* points of each ring, the last of which repeats the first; else all points */
  const double* xy;          /* all points: longitude and latitude in degrees (WGS84), or unchanged from the file */
  const char* const* values; /* values of the query's fields, in their order; NULL: not set */
};

struct wt_maps_query {
  const char* layer;         /* NULL: all layers */
  const char* const* fields; /* names; if a layer has no field of exactly that name, case is ignored */
  size_t field_count;
  size_t most_points; /* limit of a shape; larger ones are counted, not passed on */
};

struct wt_maps_layers {
  int in_degrees;     /* 1: xy are degrees; 0: no layer has a coordinate system */
  uint64_t features;  /* number of features that were read */
  uint64_t no_shapes; /* features without a polygon, a point and a line */
  uint64_t too_large; /* shapes of more than most_points */
  char driver[64];    /* the format, as GDAL calls it */
  char fields[1024];  /* all fields of the layers, separated by ", " */
  uint32_t found;     /* bit i: a layer has the field i of the query */
  uint32_t ambiguous; /* bit i: a layer has several fields that may be the field i of the query; the first was read */
};

/* Calls visit for every shape, until it does not return 0. Returns 0 if all was read; else `error` has the reason. */
int wt_maps_shapes(const char* file, const struct wt_maps_query* query,
                   int (*visit)(void* user, const struct wt_maps_shape* shape), void* user,
                   struct wt_maps_layers* layers, char error[WT_MAPS_ERROR_SIZE]);

/* A part of a raster of heights. */
struct wt_maps_raster {
  size_t columns, rows;
  const float* heights_m; /* row by row, from the first row of the file; NaN where the file has no height */
  int clipped;            /* 1: some requested places are outside of the raster */
  double full_columns, full_rows;
  char driver[64];
  void* handle;
};

/* The posts around places, `margin` posts more on all sides; in_degrees says what places are: longitude and latitude,
   or coordinates of the raster. 0: found; else `error` says why not. */
int wt_maps_open_raster(const char* file, int in_degrees, const double* places_xy, size_t places, size_t margin,
                        size_t most_posts, struct wt_maps_raster* raster, char error[WT_MAPS_ERROR_SIZE]);
/* Places (column, row) of posts as the places above, in place; of such that cannot be told NaN. */
void wt_maps_places_of_posts(const struct wt_maps_raster* raster, double* column_row, size_t count);
void wt_maps_close_raster(struct wt_maps_raster* raster);

int wt_maps_version(void);

#ifdef __cplusplus
}
#endif
#endif
