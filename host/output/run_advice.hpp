// What the results of a run suggest to set otherwise, for its summary.
// Of the record of a run alone, so that merged runs get the same words.
#pragma once
#include <string>
#include <vector>
#include "output/totals.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

// A sentence an item, with the key to set. Nothing where no path was found at all, or a warning names the key already.
std::vector<std::string> advice(const Run& run, const Totals& totals);

}  // namespace wavetracer
