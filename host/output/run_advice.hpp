// SPDX-License-Identifier: Apache-2.0
// Suggests settings from the results of a run, for its summary.
// It uses the record of a run alone, so that merged runs get the same text.
#pragma once
#include <string>
#include <vector>
#include "output/totals.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

// Returns a sentence per item, with the key to set. It returns nothing if no path was found at all, or a warning names
// the key already.
std::vector<std::string> advice(const Run& run, const Totals& totals);

}  // namespace wavetracer
