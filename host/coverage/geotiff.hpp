// SPDX-License-Identifier: Apache-2.0
// Writes a layer as GeoTIFF (OGC 19-008r4) of TIFF 6.0: float32, not compressed, the first row in the north.
#pragma once
#include <span>
#include <string>
#include "coverage/map_place.hpp"

namespace wavetracer::coverage {

// values: row by row from the south, as in Map; NaN is the value of empty cells. Without a georeference the file has
// the place in the scene's coordinates and no coordinate system. Throws InputError for a projection that GeoTIFF cannot
// name.
std::string geotiff(const Map& map, const LayerKind& layer, std::span<const double> values, const MapPlace& place);

}  // namespace wavetracer::coverage
