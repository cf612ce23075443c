// summary.json: what ran, on what, how much work it was and how long each stage took.
// Counts are sums over the frames; seconds of a frame's stages are medians over the frames.
#pragma once
#include <string>
#include "output/output.hpp"

namespace wavetracer {

// write_seconds: the time that encoding and writing the other files took.
std::string encode_summary_json(const RunData& run, double write_seconds);

}  // namespace wavetracer
