// SPDX-License-Identifier: Apache-2.0
// Sets GDAL up for files that are not trusted: quiet, without network.
// There is one thread, as the program converts one map at a time.
#include "maps/module.hpp"

#include <cpl_conv.h>
#include <cpl_error.h>

#include <filesystem>
#include <stdexcept>

namespace wavetracer::maps {
namespace {

void set_up() {
  static const bool once = [] {
    CPLSetConfigOption(
        "GDAL_SKIP",
        "HTTP,WMS,WMTS,WCS,DAAS,EEDA,EEDAI,NGW,STACIT,STACTA,PLMOSAIC,OGCAPI,PostGISRaster,WFS,OAPIF,CSW,"
        "PLScenes,Elastic,Carto,AmigoCloud,PostgreSQL,MySQL,MongoDBv3,ODBC,MSSQLSpatial");
    CPLSetErrorHandler(CPLQuietErrorHandler);
    GDALAllRegister();
    return true;
  }();
  (void)once;
}

std::string last_error() {
  const std::string text = CPLGetLastErrorMsg();
  return text.empty() ? "GDAL does not say why" : text;
}

// Returns the file that GDAL's reader of GML would write beside its input, with the fields that it found; empty if that
// file exists already.
std::filesystem::path new_schema(const char* file) {
  const std::filesystem::path schema = std::filesystem::path(file).replace_extension(".gfs");
  std::error_code ignored;
  return std::filesystem::exists(std::filesystem::symlink_status(schema, ignored)) ? std::filesystem::path() : schema;
}

struct FreeSystem {
  void operator()(OGRSpatialReferenceH system) const { OSRDestroySpatialReference(system); }
};
using System = std::unique_ptr<void, FreeSystem>;

bool is_on_earth(OGRSpatialReferenceH system) {
  // GeoPackage names an unknown system "Undefined geographic SRS".
  const char* const name = system ? OSRGetName(system) : nullptr;
  if (name && (STARTS_WITH_CI(name, "Undefined") || STARTS_WITH_CI(name, "Unknown"))) return false;
  return system && (OSRIsProjected(system) || OSRIsGeographic(system) || OSRIsCompound(system));
}

// Axes are x, y as on maps: longitude before latitude, whatever the authority's order is.
Transformation between(OGRSpatialReferenceH system, bool to_earth) {
  if (!is_on_earth(system)) return {};
  const System own(OSRClone(system)), degrees(OSRNewSpatialReference(nullptr));
  OSRSetAxisMappingStrategy(own.get(), OAMS_TRADITIONAL_GIS_ORDER);
  if (OSRImportFromEPSG(degrees.get(), 4326) != OGRERR_NONE)
    throw std::runtime_error("PROJ's database (proj.db, Debian's proj-data) was not found: " + last_error());
  OSRSetAxisMappingStrategy(degrees.get(), OAMS_TRADITIONAL_GIS_ORDER);
  CPLErrorReset();
  Transformation out(to_earth ? OCTNewCoordinateTransformation(own.get(), degrees.get())
                              : OCTNewCoordinateTransformation(degrees.get(), own.get()));
  if (!out) throw std::runtime_error("its coordinate system cannot be converted to WGS84: " + last_error());
  return out;
}

}  // namespace

void CloseDataset::operator()(GDALDatasetH dataset) const {
  GDALClose(dataset);
  std::error_code ignored;
  if (!new_schema.empty()) std::filesystem::remove(new_schema, ignored);
}

Dataset open(const char* file, unsigned kind) {
  set_up();
  CPLErrorReset();
  const CloseDataset close{new_schema(file)};
  Dataset out(GDALOpenEx(file, GDAL_OF_READONLY | kind | GDAL_OF_VERBOSE_ERROR, nullptr, nullptr, nullptr), close);
  if (!out) throw std::runtime_error(last_error());
  return out;
}

std::string driver_of(GDALDatasetH dataset) { return GDALGetDriverShortName(GDALGetDatasetDriver(dataset)); }

Transformation to_degrees(OGRSpatialReferenceH system) { return between(system, true); }
Transformation from_degrees(OGRSpatialReferenceH system) { return between(system, false); }

}  // namespace wavetracer::maps

extern "C" {
extern __attribute__((visibility("default"))) const char wt_maps_mark[];
const char wt_maps_mark[] = WT_MAPS_MARK;
}

WT_MAPS_PUBLIC int wt_maps_version(void) { return WT_MAPS_VERSION; }
