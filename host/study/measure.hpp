// One point of a figure: every series at one ray count, timed in turns so that a slow spell of the machine hits all.
// Times are medians of warm frames; the first frame of each series is dropped.
#pragma once
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>
#include "study/series.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::study {

// Seconds a frame. What tracing takes on the device is the sum of the stages generate_rays, trace, compact, scan and
// interact; what ordering adds is the sum of the stages order and sort.
struct Times {
  double trace_s = 0;   // the stage trace alone
  double order_s = 0;   // keys, sort, gathering
  double unpaid_s = 0;  // tracing with the order as a gift
  double frame_s = 0;   // wall time of the whole frame, with candidates, paths and fields

  double paid_s() const { return unpaid_s + order_s; }
};

struct Row {
  uint64_t rays = 0;    // a transmitter
  uint32_t frames = 1;  // that the times are an average of
  Series series;
  Times times;
  uint64_t paths = 0, sequences = 0;      // of all frames together
  double gain_unpaid = 1, gain_paid = 1;  // unpaid_s and paid_s of the unordered launch over those of this series
};

// Seconds of these stages together. A frame has no entry for a stage that it had no use for.
double sum_stages(const StageSeconds& seconds, std::initializer_list<const char*> stages);

// Throws ConfigError where frames of this config traced nothing, so that there is no time to compare.
void require_segments(double segments, const Config& config);

// Of the seconds of several frames, stage by stage the median; and their sums as above, divided by `frames`.
Times summarise(const std::vector<StageSeconds>& samples, uint32_t frames);

// Sets the gains of rows of one ray count against the first. Throws RuntimeError where two series of the same
// directions differ in paths or sequences, which no order may change.
void compare(std::span<Row> rows);

// `config` with each series applied to it, on the device; `frames` transmitters stand for as many frames.
std::vector<Row> measure(const Config& config, const std::vector<Series>& series, uint64_t rays, uint32_t frames,
                         const std::string& device, uint32_t repeats);

}  // namespace wavetracer::study
