// SPDX-License-Identifier: Apache-2.0
// Checks coordinates of OSM XML in scientific notation: libosmium reads 5e60 as 0 or as any other place, since it
// multiplies beyond 64 bits without a check.
#pragma once
#include <string>
#include <string_view>

namespace wavetracer::imports {

// Throws InputError with the line if a lat or lon of an OSM XML text has an exponent that makes it 10^9 or more.
void check_exponents(std::string_view content, const std::string& name);

}  // namespace wavetracer::imports
