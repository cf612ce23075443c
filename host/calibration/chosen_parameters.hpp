// SPDX-License-Identifier: Apache-2.0
// The parameters that patterns choose, with what is known of them before anything was measured.
#pragma once
#include <string>
#include <vector>
#include "calibration/end_places.hpp"
#include "calibration/parameters.hpp"

namespace wavetracer::calibration {

struct Priors {
  double factor = 1;                // usual standard deviations are multiplied by it
  std::vector<std::string> errors;  // NAME=VALUE: the standard deviation of the parameters of that pattern, instead of
                                    // these; m or degrees for ends, that of theta for materials
};

// Do the patterns name a height or a coordinate of an end, whose change moves paths?
bool move_paths(const std::vector<std::string>& patterns);

// Returns the parameters that the patterns choose: first those of materials, then angles, then heights and coordinates.
// Each pattern is MATERIAL, MATERIAL.PROPERTY, TRANSMITTER.PROPERTY or receivers.height with * and ? as in shells; a
// material alone stands for its permittivity and conductivity, and no pattern without a property chooses an end. notes:
// gets a sentence for each property that a pattern names and that cannot be fitted. Throws ConfigError for a pattern
// that chooses nothing, or an unknown property, with the names that there are, and for errors that fit no parameter.
std::vector<Parameter> chosen_parameters(const NamedRecords& world, const EndPlaces& ends,
                                         const std::vector<std::string>& patterns, const Priors& priors,
                                         std::vector<std::string>& notes);

}  // namespace wavetracer::calibration
