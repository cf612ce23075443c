// SPDX-License-Identifier: Apache-2.0
// Measures orders of rays: every series at one number of rays, timed alternately so that a slow phase of the machine
// affects all. The first frame of each series is dropped.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>
#include "base/csv_columns.hpp"
#include "study/series.hpp"
#include "study/statistics.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::study {

// Seconds per frame.
struct OrderTimes {
  double trace_s = 0;   // the stage trace alone
  double order_s = 0;   // keys, sort, gathering
  double unpaid_s = 0;  // discovery on the device, without the time of the order
  double frame_s = 0;   // wall time of the whole frame, with candidates, paths and fields

  double paid_s() const { return unpaid_s + order_s; }
};

struct OrderRow {
  uint64_t rays = 0;    // per transmitter
  uint64_t frames = 1;  // the times are averages of this many frames
  double launched = 0;  // average rays of all transmitters per frame
  Series series;
  OrderTimes times;
  uint64_t paths = 0, sequences = 0;      // sums over all frames
  double gain_unpaid = 1, gain_paid = 1;  // unpaid_s and paid_s of the unordered launch over those of this series
  // Relative standard errors of unpaid_s and paid_s, see relative_errors() of measured.hpp; NaN for a single frame.
  double noise_unpaid = undefined, noise_paid = undefined;
};

// Columns from `rays` to `bins` (0 for orders without a histogram); averages over frames also have `frames` and the
// reductions of time, in percent, that the gains mean. Last are the standard errors of unpaid_s and paid_s.
const Columns<OrderRow>& order_columns(bool averages);

// Returns how much less time a gain means, in percent; negative for more time.
double reduction_percent(double gain);

// Throws ConfigError if frames of this config traced nothing, so that there is no time to compare.
void require_segments(double segments, const Config& config);

// Summarises the seconds of several frames, stage by stage by the median or another summary; and their sums as above.
OrderTimes summarise(const std::vector<StageSeconds>& samples, double (*summary)(std::vector<double>));

// Sets the gains of rows of one number of rays against the first. Throws RuntimeError if two series of the same
// directions differ in paths or sequences, which no order may change.
void compare(std::span<OrderRow> rows);

// The frames that are timed: the frame `still` `repeats` times, as medians; or, if `frames` is not 0, the frames 1 to
// `frames`, once each, as means.
struct OrderFrames {
  uint64_t frames = 0;
  uint32_t still = 0;
  uint32_t repeats = 1;
  FrameObserver watch = {};
};

// Measures `config` with each series applied to it, on the device. Throws FrameStopped if the observer has cancelled a
// frame.
std::vector<OrderRow> measure_orders(const Config& config, const std::vector<Series>& series, uint64_t rays,
                                     const OrderFrames& of, const std::string& device);

// With more rays than this, so many series besides the first share a device, because their queues must fit into its
// memory together; the first is measured again with each group.
constexpr uint64_t rays_of_all_series = 1000000;
constexpr size_t series_at_once = 11;
// Measures any number of series, in groups where there are many rays. The gains of a row are against the first series
// as its own group measured it.
std::vector<OrderRow> measure_groups(const Config& config, const std::vector<Series>& series, uint64_t rays,
                                     const OrderFrames& of, const std::string& device);

// Returns null if the series was not measured at that number of rays.
const OrderRow* find_row(const std::vector<OrderRow>& rows, const Series& series, uint64_t rays);

}  // namespace wavetracer::study
