// The library of radio materials as people read it.
#pragma once
#include <string>

#include "wavetracer/config.hpp"

namespace wavetracer::app {

// docs/materials.md: both editions of ITU-R P.2040, each law with its range, and what they differ in.
std::string materials_page();

// A line per law of an edition, with what it is at a frequency, where it is known there.
std::string materials_table(ItuEdition edition, double frequency_hz);

}  // namespace wavetracer::app
