// SPDX-License-Identifier: Apache-2.0
// The library of radio materials as text for people.
#pragma once
#include <string>

#include "wavetracer/config.hpp"

namespace wavetracer::app {

// Returns docs/materials.md: both editions of ITU-R P.2040, each law with its range, and the differences.
std::string materials_page();

// Returns a line per law of an edition, with its values at a frequency where the law is valid.
std::string materials_table(ItuEdition edition, double frequency_hz);

}  // namespace wavetracer::app
