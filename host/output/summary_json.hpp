// SPDX-License-Identifier: Apache-2.0
// summary.json: the run, its device, the amount of work, and the time of each stage.
// Counts are sums over the frames, those of the ray cache too; seconds of a frame's stages are medians over the frames.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include "output/totals.hpp"
#include "wavetracer/missed.hpp"

namespace wavetracer {

// write_seconds: the time for encoding and writing the other files. shards: their number, 0 without shards.
std::string encode_summary_json(const Run& run, const Totals& totals, double write_seconds, size_t shards);

// The values of summary.json that readers of a run need.
struct SummaryFacts {
  std::string device;            // empty if unknown
  std::optional<Missed> missed;  // nothing if unknown
};

// Returns unknown values if the file is missing or invalid.
SummaryFacts read_summary_json(const std::filesystem::path& file);

}  // namespace wavetracer
