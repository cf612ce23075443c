// SPDX-License-Identifier: Apache-2.0
// Functions that the files of the module share: GDAL is opened once, its errors become texts, coordinate systems.
// Only GDAL's C interface is used.
#pragma once
#include <gdal.h>
#include <ogr_srs_api.h>

#include <filesystem>
#include <memory>
#include <string>

#include "imports/maps_interface.h"

#define WT_MAPS_PUBLIC extern "C" __attribute__((visibility("default")))

namespace wavetracer::maps {

// Closes a dataset, and removes the file that GDAL wrote beside the input, since the folder is the user's.
struct CloseDataset {
  std::filesystem::path new_schema;  // the file to remove, which did not exist before
  void operator()(GDALDatasetH dataset) const;
};
using Dataset = std::unique_ptr<void, CloseDataset>;

struct FreeTransformation {
  void operator()(OGRCoordinateTransformationH t) const { OCTDestroyCoordinateTransformation(t); }
};
using Transformation = std::unique_ptr<void, FreeTransformation>;

// Opens a file for reading, by a driver that does not use the network. Throws std::runtime_error with GDAL's reason.
Dataset open(const char* file, unsigned kind);
std::string driver_of(GDALDatasetH dataset);

// Converts between a coordinate system and longitude and latitude in degrees (WGS84), in this order. Empty if `system`
// is null or not on the Earth; throws if PROJ knows no transformation.
Transformation to_degrees(OGRSpatialReferenceH system);
Transformation from_degrees(OGRSpatialReferenceH system);

// Calls a function of the interface and turns exceptions into a text; returns 0 or 1.
template <class Function>
int guarded(char* error, const Function& function) {
  try {
    function();
    return 0;
  } catch (const std::exception& e) {
    std::string(e.what()).copy(error, WT_MAPS_ERROR_SIZE - 1);
    error[std::min<size_t>(std::string(e.what()).size(), WT_MAPS_ERROR_SIZE - 1)] = '\0';
    return 1;
  }
}

// Copies a text and cuts it if it is too long.
template <size_t N>
void put(char (&to)[N], const std::string& text) {
  to[text.copy(to, N - 1)] = '\0';
}

}  // namespace wavetracer::maps
