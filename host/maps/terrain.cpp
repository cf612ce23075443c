// SPDX-License-Identifier: Apache-2.0
// Reads heights of a raster around places by GDAL: its first band, in metres.
// Posts are the middles of pixels, as in GDAL's geotransform.
#include <cpl_error.h>
#include <cpl_string.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "maps/module.hpp"

namespace wavetracer::maps {
namespace {

struct Window {
  int first_column, first_row, columns, rows;
};

struct OpenRaster {
  Dataset dataset;
  std::array<double, 6> pixel_to_place{}, place_to_pixel{};
  Transformation to_earth, from_earth;
  Window window{};
  std::vector<float> heights;
};

double unit_m(GDALRasterBandH band) {
  const std::string unit = GDALGetRasterUnitType(band);
  if (EQUAL(unit.c_str(), "ft") || EQUAL(unit.c_str(), "foot") || EQUAL(unit.c_str(), "feet")) return 0.3048;
  if (EQUAL(unit.c_str(), "US survey foot") || EQUAL(unit.c_str(), "ftUS")) return 1200.0 / 3937;
  if (unit.empty() || EQUAL(unit.c_str(), "m") || EQUAL(unit.c_str(), "metre") || EQUAL(unit.c_str(), "meter") ||
      EQUAL(unit.c_str(), "metres") || EQUAL(unit.c_str(), "meters"))
    return 1;
  throw std::runtime_error("its heights are in '" + unit +
                           "'; only metres and feet are known: convert them with gdal_calc.py");
}

void set_transforms(OpenRaster& raster, bool in_degrees) {
  if (GDALGetGeoTransform(raster.dataset.get(), raster.pixel_to_place.data()) != CE_None)
    throw std::runtime_error(
        "it does not say where its pixels are (no geotransform); give it one with gdal_translate -a_ullr");
  if (!GDALInvGeoTransform(raster.pixel_to_place.data(), raster.place_to_pixel.data()))
    throw std::runtime_error("its geotransform cannot be inverted");
  if (!in_degrees) return;
  const OGRSpatialReferenceH system = GDALGetSpatialRef(raster.dataset.get());
  raster.to_earth = to_degrees(system);
  raster.from_earth = from_degrees(system);
  if (!raster.to_earth)
    throw std::runtime_error(
        "it does not name its coordinate system, as the map does; name it with gdal_edit.py -a_srs EPSG:NUMBER");
}

Window window_of(OpenRaster& raster, const double* places, size_t count, size_t margin, bool& clipped) {
  const double columns = GDALGetRasterXSize(raster.dataset.get()), rows = GDALGetRasterYSize(raster.dataset.get());
  double left = HUGE_VAL, right = -HUGE_VAL, top = HUGE_VAL, bottom = -HUGE_VAL;
  for (size_t i = 0; i < count; ++i) {
    double x = places[2 * i], y = places[2 * i + 1], column = 0, row = 0;
    if (raster.from_earth && !OCTTransform(raster.from_earth.get(), 1, &x, &y, nullptr))
      throw std::runtime_error("the map is outside of the area of its coordinate system");
    GDALApplyGeoTransform(raster.place_to_pixel.data(), x, y, &column, &row);
    left = std::min(left, column), right = std::max(right, column);
    top = std::min(top, row), bottom = std::max(bottom, row);
  }
  clipped = left < 0.5 || top < 0.5 || right > columns - 0.5 || bottom > rows - 0.5;
  const auto more = static_cast<double>(margin);
  left = std::max(std::floor(left) - more, 0.0), top = std::max(std::floor(top) - more, 0.0);
  right = std::min(std::ceil(right) + more, columns), bottom = std::min(std::ceil(bottom) + more, rows);
  if (!(right - left >= 2 && bottom - top >= 2))
    throw std::runtime_error("the map is outside of it; gdalinfo shows what it covers");
  return {static_cast<int>(left), static_cast<int>(top), static_cast<int>(right - left),
          static_cast<int>(bottom - top)};
}

void read_heights(OpenRaster& raster) {
  const GDALRasterBandH band = GDALGetRasterBand(raster.dataset.get(), 1);
  const Window& w = raster.window;
  std::vector<double> values(static_cast<size_t>(w.columns) * static_cast<size_t>(w.rows));
  CPLErrorReset();
  if (GDALRasterIO(band, GF_Read, w.first_column, w.first_row, w.columns, w.rows, values.data(), w.columns, w.rows,
                   GDT_Float64, 0, 0) != CE_None)
    throw std::runtime_error(CPLGetLastErrorMsg());
  int has_none = 0, has_scale = 0, has_offset = 0;
  const double none = GDALGetRasterNoDataValue(band, &has_none);
  const double scale = GDALGetRasterScale(band, &has_scale), offset = GDALGetRasterOffset(band, &has_offset);
  const double factor = unit_m(band);
  for (const double value : values) {
    const bool given = std::isfinite(value) && !(has_none && value == none);
    const double height_m = factor * ((has_scale ? scale : 1) * value + (has_offset ? offset : 0));
    raster.heights.push_back(given && std::abs(height_m) < 1e5 ? static_cast<float>(height_m) : NAN);
  }
}

}  // namespace
}  // namespace wavetracer::maps

using namespace wavetracer::maps;

WT_MAPS_PUBLIC int wt_maps_open_raster(const char* file, int in_degrees, const double* places_xy, size_t places,
                                       size_t margin, size_t most_posts, wt_maps_raster* out,
                                       char error[WT_MAPS_ERROR_SIZE]) {
  *out = {};
  return guarded(error, [&] {
    auto raster = std::make_unique<OpenRaster>();
    raster->dataset = open(file, GDAL_OF_RASTER);
    if (GDALGetRasterCount(raster->dataset.get()) < 1) throw std::runtime_error("it has no band with heights");
    set_transforms(*raster, in_degrees != 0);
    bool clipped = false;
    raster->window = window_of(*raster, places_xy, places, margin, clipped);
    const double posts = static_cast<double>(raster->window.columns) * raster->window.rows;
    if (posts > static_cast<double>(most_posts))
      throw std::runtime_error("it has " + std::to_string(static_cast<long long>(posts)) +
                               " posts in this area, and at most " + std::to_string(most_posts) +
                               " are read: make it coarser with gdalwarp -tr 2 2 -r average");
    read_heights(*raster);
    out->columns = static_cast<size_t>(raster->window.columns);
    out->rows = static_cast<size_t>(raster->window.rows);
    out->heights_m = raster->heights.data();
    out->clipped = clipped;
    out->full_columns = GDALGetRasterXSize(raster->dataset.get());
    out->full_rows = GDALGetRasterYSize(raster->dataset.get());
    put(out->driver, driver_of(raster->dataset.get()));
    out->handle = raster.release();
  });
}

WT_MAPS_PUBLIC void wt_maps_places_of_posts(const wt_maps_raster* raster, double* column_row, size_t count) {
  const auto& open = *static_cast<const OpenRaster*>(raster->handle);
  for (size_t i = 0; i < count; ++i) {
    double x = 0, y = 0;
    GDALApplyGeoTransform(const_cast<double*>(open.pixel_to_place.data()),
                          column_row[2 * i] + open.window.first_column + 0.5,
                          column_row[2 * i + 1] + open.window.first_row + 0.5, &x, &y);
    if (open.to_earth && !OCTTransform(open.to_earth.get(), 1, &x, &y, nullptr)) x = y = NAN;
    column_row[2 * i] = x;
    column_row[2 * i + 1] = y;
  }
}

WT_MAPS_PUBLIC void wt_maps_close_raster(wt_maps_raster* raster) {
  delete static_cast<OpenRaster*>(raster->handle);
  raster->handle = nullptr;
}
