// SPDX-License-Identifier: Apache-2.0
// summary.json: the run, its device, the amount of work, and the time of each stage.
// Counts are sums over the frames, those of the ray cache too; seconds of a frame's stages are medians over the frames.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include "output/totals.hpp"
#include "wavetracer/missed.hpp"

namespace wavetracer {

// write_seconds: the time for encoding and writing the other files. shards: their number, 0 without shards.
std::string encode_summary_json(const Run& run, const Totals& totals, double write_seconds, size_t shards);

// A certificate as the file has it, see wavetracer/certificate.hpp.
struct CertificateFacts {
  uint32_t depth = 0, edges = 0;
  bool any_depth = false;
  double left_out_sr = 0, left_out_share = 0, left_out_power = 0, weak_share = 0;
  std::optional<double> floor_db;
};

// The values of summary.json that readers of a run need.
struct SummaryFacts {
  std::string device;            // empty if unknown
  std::optional<Missed> missed;  // nothing if unknown
  std::string missed_unknown;    // the reason why frames do not know what rays have missed; empty if all know it
  std::optional<CertificateFacts> certificate;  // nothing without beams
};

// Returns unknown values if the file is missing or invalid.
SummaryFacts read_summary_json(const std::filesystem::path& file);

}  // namespace wavetracer
