// SPDX-License-Identifier: Apache-2.0
// The results of studies of caches: one row per drive, setting and number of rays (or depth), and their table. Times
// are device times of profiling events, averaged over frames; errors are against the same frames without a cache.
#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>
#include "base/csv_columns.hpp"
#include "study/entry_summary.hpp"
#include "study/measured.hpp"
#include "study/path_error.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::study {

// Seconds per frame.
struct CacheTimes {
  double loop_s = 0;    // discovery: from generate_rays and the order to interact, including the cache
  double lookup_s = 0;  // reading the table
  double gather_s = 0;  // moving missed rays together for tracing
  double store_s = 0;   // writing the table
  double group_s = 0;   // grouping missed rays of equal keys (cache.innerframe)
  double purge_s = 0;
  double trace_s = 0;  // finding nearest hits
};

CacheTimes cache_times(const StageSeconds& seconds);
// Summarises stage by stage, for example by median().
CacheTimes summarised(const std::vector<CacheTimes>& samples, double (*summary)(std::vector<double>));

// Times that were not measured.
constexpr CacheTimes unknown_times = {undefined, undefined, undefined, undefined, undefined, undefined, undefined};

// Segments of a frame.
struct CacheCounts {
  double segments = 0, lookups = 0, hits = 0;
  double groups = 0, shared = 0;  // with cache.innerframe, see CacheSummary
  double traced() const { return lookups > 0 ? lookups - hits - shared : segments; }
};

struct CentroidError {
  uint32_t frame = 0;
  double l2_m = 0, mean_l2_m = 0;  // equation 6.3, and its running mean so far (equation 6.2)
};

struct CacheRow {
  std::string study{};
  std::string drive{};  // see CacheStudy::drives
  std::string setting{};
  uint64_t rays = 0;  // per transmitter
  uint32_t division = 0;
  double position_step_m = 0;
  uint32_t depth = 0;         // 0: all segments; 1: frames that end at this depth
  uint32_t region = 0;        // 0: rays of all transmitters; else of this one alone, counted from 1
  std::string transmitter{};  // name of that transmitter
  uint64_t frames = 0;        // number of frames after the cold one, which are averaged
  CacheTimes cold{}, warm{};  // times of a frame whose table is empty, and of those after it
  CacheTimes cold_error{unknown_times}, warm_error{unknown_times};  // standard errors of these times
  double order_s = 0;                      // keys, sort and gathering of a warm frame, a part of warm.loop_s
  double frame_s = 0;                      // wall time of a warm frame, with candidates, paths and fields
  CacheCounts cold_counts{}, counts{};     // counts of the cold frame, and of an average warm one
  CacheSummary cache{};                    // statistics of the last frame
  double paths = 0, sequences = 0;         // averages over warm frames
  PathError error{};                       // errors of warm frames
  double l2_error_m = undefined;           // standard error of the mean of error.l2_m
  double saved_once_percent = 0;           // the same, with the sort counted once
  double saved_percent = 0;                // relative to the time of the first setting, warm
  EntrySummary entries{};                  // entries of the last frame, for settings that keep entries
  std::vector<CentroidError> centroids{};  // one per frame, in studies that keep them
};

// Tells that the row is not about one depth or one transmitter.
inline bool is_whole(const CacheRow& row) { return row.depth == 0 && row.region == 0; }

// Returns hits over look-ups; NaN without look-ups.
double hit_rate(const CacheRow& row);
// Return nanoseconds per segment: writes of the cold frame, which finds nothing; reads of the warm ones; the rest of
// the cold one.
double write_ns(const CacheRow& row);
double read_ns(const CacheRow& row);
double gather_ns(const CacheRow& row);
double trace_ns(const CacheRow& row);
// Returns nanoseconds of a look-up of the cold frame. In a row of depth 1 the table is empty, so that none is answered.
double empty_lookup_ns(const CacheRow& row);
// Return the same with their noise.
Measured measured_write_ns(const CacheRow& row);
Measured measured_read_ns(const CacheRow& row);
Measured measured_gather_ns(const CacheRow& row);
Measured measured_trace_ns(const CacheRow& row);
Measured measured_empty_lookup_ns(const CacheRow& row);

// Returns the entries of the table that hold a segment, as cache.statistics counts them.
uint64_t entries_used(const CacheRow& row);

// Returns the time of a warm frame without its sort: the thesis sorts its buffer of rays once, when it is made.
double warm_once_s(const CacheRow& row);

// Sets saved_percent and saved_once_percent of rows of one point, whose first is the reference.
void set_savings(std::vector<CacheRow>& point);

const Columns<CacheRow>& cache_columns();
// Returns the number in a column of the table; NaN if it is no number.
double value_of(const CacheRow& row, const std::string& column);

// Returns null if it was not measured.
const CacheRow* find_cached(const std::vector<CacheRow>& rows, const std::string& setting, uint64_t rays,
                            const std::string& drive = "still");
// Returns the settings in order of appearance, each once.
std::vector<std::string> settings_of(const std::vector<CacheRow>& rows);
std::vector<std::string> drives_of(const std::vector<CacheRow>& rows);
std::vector<uint64_t> rays_of(const std::vector<CacheRow>& rows);

}  // namespace wavetracer::study
