// summary.json: what ran, on what, how much work it was and how long each stage took.
// Counts are sums over the frames, those of the ray cache too; seconds of a frame's stages are medians over the frames.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include "output/totals.hpp"
#include "wavetracer/missed.hpp"

namespace wavetracer {

// write_seconds: the time that encoding and writing the other files took. shards: their number, 0 without.
std::string encode_summary_json(const Run& run, const Totals& totals, double write_seconds, size_t shards);

// What readers of a run need of its summary.json.
struct SummaryFacts {
  std::string device;            // empty where it is not known
  std::optional<Missed> missed;  // nothing where it is not known
};

// Nothing is known where the file is missing or is none.
SummaryFacts read_summary_json(const std::filesystem::path& file);

}  // namespace wavetracer
