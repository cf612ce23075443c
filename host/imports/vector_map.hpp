// SPDX-License-Identifier: Apache-2.0
// Reads vector maps in the formats of GDAL.
#pragma once
#include <string>

#include "imports/map.hpp"

namespace wavetracer::imports {

// Throws InputError for the map, RuntimeError if GDAL is missing.
Map read_vector_map(const std::string& file, const ImportOptions& options);

}  // namespace wavetracer::imports
