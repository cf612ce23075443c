// What the frames of a run add up to: the figures of summary.json and of a shard's line in the manifest.
// Times are kept one by one, because medians do not add.
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
  PathKindCounts kinds{};  // of counts.paths
  MissedCounts missed;
  LateCounts late;
  LeftOutPaths left_out;  // of counts.paths, which are those that were found; all 0 where nothing may be left out
  std::vector<uint64_t> segments_per_depth;
  CacheSummary cache;  // counts are sums; what describes the table is that of the last frame
  // Stage -> one value per frame that measured it: device stages are not in all (Simulation::profile_every).
  std::map<std::string, std::vector<double>> seconds;
  uint64_t timed_segments = 0;        // of counts.segments, those that were traced in frames that measured it
  std::vector<std::string> warnings;  // each text once, in order of first appearance
  MissingLinks missing;               // of the first frame that was asked about
};

Totals totals_of(Frames frames);
// `later` follows `sum`; either may be empty.
void add(Totals& sum, const Totals& later);
// `more` is of other links of the same frame: its seconds are added to those of the frame. `sum` may be empty.
void add_block(Totals& sum, const Totals& more);

// Segments that the device traced: those that no ray cache answered.
uint64_t traced_segments(const Totals& totals);
// Of them per second of tracing; 0 where that was not measured.
double segments_per_second(const Totals& totals);

// Median of a stage over the frames; 0 where no frame has it.
double median_seconds(const Totals& totals, const std::string& stage);
// Sum of a stage over the frames.
double sum_seconds(const Totals& totals, const std::string& stage);

// What to say of links without a path: of one frame by name, of more only where no link has a path in any of them,
// because vehicles that hide from each other are normal.
std::vector<std::string> missing_words(const Totals& totals);

// Appends the texts that are not there yet.
void add_warnings(std::vector<std::string>& all, const std::vector<std::string>& more);

}  // namespace wavetracer
