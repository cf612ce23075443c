// Orders of rays, measured: every series at one number of rays, timed in turns so that a slow spell of the machine hits
// all. The first frame of each series is dropped.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>
#include "study/columns.hpp"
#include "study/series.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::study {

// Seconds a frame.
struct OrderTimes {
  double trace_s = 0;   // the stage trace alone
  double order_s = 0;   // keys, sort, gathering
  double unpaid_s = 0;  // what discovers on the device, with the order as a gift
  double frame_s = 0;   // wall time of the whole frame, with candidates, paths and fields

  double paid_s() const { return unpaid_s + order_s; }
};

struct OrderRow {
  uint64_t rays = 0;    // of each transmitter
  uint64_t frames = 1;  // that the times are an average of
  double launched = 0;  // rays of all transmitters, of a frame on average
  Series series;
  OrderTimes times;
  uint64_t paths = 0, sequences = 0;      // of all frames together
  double gain_unpaid = 1, gain_paid = 1;  // unpaid_s and paid_s of the unordered launch over those of this series
};

// From `rays` to `launched`; of averages over frames also `frames` and the reductions of time, in percent, that the
// gains amount to.
const Columns<OrderRow>& order_columns(bool averages);

// How much less time a gain means, in percent; negative: more time.
double reduction_percent(double gain);

// Throws ConfigError where frames of this config traced nothing, so that there is no time to compare.
void require_segments(double segments, const Config& config);

// Of the seconds of several frames, stage by stage the median or another summary; and their sums as above.
OrderTimes summarise(const std::vector<StageSeconds>& samples, double (*summary)(std::vector<double>));

// Sets the gains of rows of one number of rays against the first. Throws RuntimeError where two series of the same
// directions differ in paths or sequences, which no order may change.
void compare(std::span<OrderRow> rows);

// What the times are of: `repeats` times the frame `still`, as medians; or, where `frames` is not 0, the frames 1 to
// `frames`, once each, as means.
struct OrderFrames {
  uint64_t frames = 0;
  uint32_t still = 0;
  uint32_t repeats = 1;
};

// `config` with each series applied to it, on the device.
std::vector<OrderRow> measure_orders(const Config& config, const std::vector<Series>& series, uint64_t rays,
                                     const OrderFrames& of, const std::string& device);

// Null where the series was not measured at that number of rays.
const OrderRow* find_row(const std::vector<OrderRow>& rows, const Series& series, uint64_t rays);

}  // namespace wavetracer::study
