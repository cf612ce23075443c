// SPDX-License-Identifier: Apache-2.0
// Sums over the frames of a run: the figures of summary.json and of a shard's line in the manifest.
// Times are kept one by one, because medians cannot be added.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>
#include "output/path_kinds.hpp"
#include "output/path_limits.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

struct Totals {
  uint64_t frames = 0;
  uint32_t first = 0, last = 0;  // numbers of frames
  double start_s = 0, end_s = 0;
  uint64_t vertices = 0, links = 0;
  FrameCounts counts;
  PathKindCounts kinds{};  // adds up to counts.paths
  MissedCounts missed;
  Certificate certificate;
  LateCounts late;
  double left_out_at_edges = 0;  // the largest of all frames, see FrameResult
  LeftOutPaths left_out;  // part of counts.paths, which counts paths that were found; all 0 if no path may be left out
  std::vector<uint64_t> segments_per_depth;
  CacheSummary cache;  // counts are sums; values that describe the table are those of the last frame
  // Stage -> one value per frame that measured it: device stages are not measured in all frames
  // (Simulation::profile_every).
  std::map<std::string, std::vector<double>> seconds;
  uint64_t timed_segments = 0;        // the part of counts.segments that was traced in frames that measured tracing
  std::vector<std::string> warnings;  // each text once, in order of first appearance
  MissingLinks missing;               // links without a path in the first frame that was checked
};

Totals totals_of(Frames frames);
// `later` follows `sum`; either may be empty.
void add(Totals& sum, const Totals& later);
// `more` has other links of the same frame: its seconds are added to those of the frame. `sum` may be empty.
void add_block(Totals& sum, const Totals& more);

// Returns the segments that the device traced: those that no ray cache answered.
uint64_t traced_segments(const Totals& totals);
// Returns the number of these per second of tracing; 0 if that was not measured.
double segments_per_second(const Totals& totals);

// Returns the median of a stage over the frames; 0 if no frame has it.
double median_seconds(const Totals& totals, const std::string& stage);
// Returns the sum of a stage over the frames.
double sum_seconds(const Totals& totals, const std::string& stage);

// Makes the message about links without a path. A single frame's links are named; with several frames it only mentions
// links without a path in all of them, because vehicles often hide from each other.
std::vector<std::string> missing_words(const Totals& totals);

// Appends the texts that are not in the list yet.
void add_warnings(std::vector<std::string>& all, const std::vector<std::string>& more);

}  // namespace wavetracer
