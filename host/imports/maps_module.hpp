// SPDX-License-Identifier: Apache-2.0
// The module that reads maps by GDAL. It is opened when it is first needed: the program does not link GDAL.
// The libraries stay loaded until the program ends.
#pragma once
#include <string>

#include "imports/maps_interface.h"

namespace wavetracer::imports {

struct MapsModule {
  decltype(&wt_maps_shapes) shapes;
  decltype(&wt_maps_open_raster) open_raster;
  decltype(&wt_maps_places_of_posts) places_of_posts;
  decltype(&wt_maps_close_raster) close_raster;
};

// needed_for: a file, for messages. Throws RuntimeError that says what to install if the module or GDAL is missing. The
// environment variable WAVETRACER_MAPS_MODULE names another file of the module.
const MapsModule& maps_module(const std::string& needed_for);

}  // namespace wavetracer::imports
