// Coordinates of OSM XML in scientific notation: libosmium takes 5e60 for 0 or for any other place, as it multiplies
// beyond 64 bits without a look.
#pragma once
#include <string>
#include <string_view>

namespace wavetracer::imports {

// Throws InputError, with the line, where a lat or lon of an OSM XML text has an exponent that makes it 10^9 or more.
void check_exponents(std::string_view content, const std::string& name);

}  // namespace wavetracer::imports
