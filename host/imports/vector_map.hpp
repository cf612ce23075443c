// Vector maps of the formats that GDAL opens.
#pragma once
#include <string>

#include "imports/map.hpp"

namespace wavetracer::imports {

// Throws InputError for the map, RuntimeError where there is no GDAL.
Map read_vector_map(const std::string& file, const ImportOptions& options);

}  // namespace wavetracer::imports
