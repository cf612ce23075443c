// SPDX-License-Identifier: Apache-2.0
// Measured places in the coordinates of a map, as surveyors give them.
#pragma once
#include <string>
#include "calibration/measured.hpp"

namespace wavetracer::calibration {

// Turns x (east) and y (north) of all points, in this coordinate system, into latitudes and longitudes. crs: a code
// such as "EPSG:25832", or a PROJ string. Adds a note if the file has north first, as the system's area tells. Throws
// InputError if the system is unknown, or a place is outside of its area.
void places_to_degrees(MeasuredFile& file, const std::string& crs);

}  // namespace wavetracer::calibration
