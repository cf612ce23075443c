// What the studies of caches measure: one row a drive, setting and number of rays (or depth), and their table.
// Times are device time of profiling events, averaged over frames; errors are against the same frames without a cache.
#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>
#include "study/columns.hpp"
#include "study/entry_summary.hpp"
#include "study/path_error.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::study {

// Seconds a frame.
struct CacheTimes {
  double loop_s = 0;    // all that discovers: from generate_rays and the order to interact, cache included
  double lookup_s = 0;  // read
  double gather_s = 0;  // missed rays side by side for tracing
  double store_s = 0;   // write
  double group_s = 0;   // missed rays of one key brought together (cache.innerframe)
  double purge_s = 0;
  double trace_s = 0;  // nearest hits
};

CacheTimes cache_times(const StageSeconds& seconds);
// Stage by stage, such as by median().
CacheTimes summarised(const std::vector<CacheTimes>& samples, double (*summary)(std::vector<double>));
CacheTimes operator-(const CacheTimes& a, const CacheTimes& b);

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
  uint64_t rays = 0;  // a transmitter
  uint32_t division = 0;
  double position_step_m = 0;
  uint32_t depth = 0;                      // 0: all segments; else those of this depth
  uint32_t region = 0;                     // 0: rays of all transmitters; else of this one alone, counted from 1
  std::string transmitter{};               // its name
  uint64_t frames = 0;                     // that follow the cold one and are averaged over
  CacheTimes cold{}, warm{};               // of a frame whose table is empty, and of those after it
  double warm_error_s = undefined;         // standard error of the mean of warm.loop_s; NaN for medians
  double frame_s = 0;                      // wall time of a warm frame, with candidates, paths and fields
  CacheCounts cold_counts{}, counts{};     // of the cold frame, and of a warm one on average
  CacheSummary cache{};                    // of the last frame
  double paths = 0, sequences = 0;         // of a warm frame on average
  PathError error{};                       // of warm frames
  double saved_percent = 0;                // of the time of the first setting, warm
  EntrySummary entries{};                  // of the last frame, of settings that keep entries
  std::vector<CentroidError> centroids{};  // frame by frame, of studies that keep them
};

// Not of one depth or one transmitter.
inline bool is_whole(const CacheRow& row) { return row.depth == 0 && row.region == 0; }

// Hits over look-ups; NaN without a look-up.
double hit_rate(const CacheRow& row);
// Nanoseconds per segment: writes of the cold frame, which finds nothing; reads of the warm ones; the rest of the cold.
double write_ns(const CacheRow& row);
double read_ns(const CacheRow& row);
double gather_ns(const CacheRow& row);
double trace_ns(const CacheRow& row);

// Entries of the table that hold a segment, as cache.statistics counts them.
uint64_t entries_used(const CacheRow& row);

// Sets saved_percent of rows of one point, whose first is the reference.
void set_savings(std::vector<CacheRow>& point);

const Columns<CacheRow>& cache_columns();
// The number in a column of the table; NaN where it is not one.
double value_of(const CacheRow& row, const std::string& column);

// Null where it was not measured.
const CacheRow* find_cached(const std::vector<CacheRow>& rows, const std::string& setting, uint64_t rays,
                            const std::string& drive = "still");
// In order of appearance, each once.
std::vector<std::string> settings_of(const std::vector<CacheRow>& rows);
std::vector<std::string> drives_of(const std::vector<CacheRow>& rows);
std::vector<uint64_t> rays_of(const std::vector<CacheRow>& rows);

}  // namespace wavetracer::study
