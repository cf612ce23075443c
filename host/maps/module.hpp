// What the files of the module share: GDAL opened once, its errors as texts, coordinate systems.
// GDAL's C interface alone.
#pragma once
#include <gdal.h>
#include <ogr_srs_api.h>

#include <filesystem>
#include <memory>
#include <string>

#include "imports/maps_interface.h"

#define WT_MAPS_PUBLIC extern "C" __attribute__((visibility("default")))

namespace wavetracer::maps {

// Closes a dataset, and removes what GDAL has written beside its file: the folder is the user's.
struct CloseDataset {
  std::filesystem::path new_schema;  // what there was not before
  void operator()(GDALDatasetH dataset) const;
};
using Dataset = std::unique_ptr<void, CloseDataset>;

struct FreeTransformation {
  void operator()(OGRCoordinateTransformationH t) const { OCTDestroyCoordinateTransformation(t); }
};
using Transformation = std::unique_ptr<void, FreeTransformation>;

// Opens a file for reading, by no driver that would ask the network. Throws std::runtime_error with GDAL's reason.
Dataset open(const char* file, unsigned kind);
std::string driver_of(GDALDatasetH dataset);

// Between a coordinate system and longitude and latitude in degrees (WGS84), in this order. Empty where `system` is
// null or says nothing of the earth; throws where PROJ knows no way.
Transformation to_degrees(OGRSpatialReferenceH system);
Transformation from_degrees(OGRSpatialReferenceH system);

// What a function of the interface does, with what it throws as a text: 0 or 1.
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

// Copies a text that is cut where it is too long.
template <size_t N>
void put(char (&to)[N], const std::string& text) {
  to[text.copy(to, N - 1)] = '\0';
}

}  // namespace wavetracer::maps
