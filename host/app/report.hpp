// The closing words of a run, for people: what ran where, how fast, what was found and where it is.
// Everything in it stands in summary.json and links.csv, too.
#pragma once
#include <filesystem>
#include <string>
#include <vector>
#include "output/output.hpp"

namespace wavetracer::app {

std::string report(const RunData& run, const std::vector<std::filesystem::path>& files);

}  // namespace wavetracer::app
