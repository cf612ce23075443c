// summary.json: what ran, on what, how much work it was and how long each stage took.
// Counts are sums over the frames, those of the ray cache too; seconds of a frame's stages are medians over the frames.
#pragma once
#include <filesystem>
#include <string>
#include "output/totals.hpp"

namespace wavetracer {

// write_seconds: the time that encoding and writing the other files took. shards: their number, 0 without.
std::string encode_summary_json(const Run& run, const Totals& totals, double write_seconds, size_t shards);

// The name of the device in a summary.json; empty where the file is missing or is none.
std::string device_in_summary(const std::filesystem::path& file);

}  // namespace wavetracer
