// SPDX-License-Identifier: Apache-2.0
// Adds up stages, and defines the table as a list of columns.
// A stage that a frame does not need counts as 0.
#include "study/cache_rows.hpp"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <numeric>
#include "output/median.hpp"
#include "study/control_equation.hpp"
#include "wavetracer/stages.hpp"

namespace wavetracer::study {
namespace {

constexpr std::initializer_list<double CacheTimes::*> stages = {
    &CacheTimes::loop_s,  &CacheTimes::lookup_s, &CacheTimes::gather_s, &CacheTimes::store_s,
    &CacheTimes::group_s, &CacheTimes::purge_s,  &CacheTimes::trace_s};

double a_segment_ns(double seconds, double segments) { return segments > 0 ? 1e9 * seconds / segments : undefined; }

// Returns a number that is proportional to one of the times.
Measured with_noise(double value, const CacheTimes& times, const CacheTimes& errors, double CacheTimes::*of) {
  return {value, times.*of > 0 ? value * errors.*of / times.*of : undefined};
}

template <class Value, class Get>
std::vector<Value> distinct(const std::vector<CacheRow>& rows, Get get) {
  std::vector<Value> out;
  for (const CacheRow& row : rows)
    if (std::find(out.begin(), out.end(), get(row)) == out.end()) out.push_back(get(row));
  return out;
}

// Appends the time of the sort of rays, the times with the sort counted once, and look-ups of a cold frame.
Columns<CacheRow> with_parts(Columns<CacheRow> columns) {
  columns.emplace_back("order_s", &CacheRow::order_s);
  columns.emplace_back("warm_once_s", warm_once_s);
  columns.emplace_back("saved_once_percent", &CacheRow::saved_once_percent);
  columns.emplace_back("empty_lookup_ns", empty_lookup_ns);
  return columns;
}

}  // namespace

CacheTimes cache_times(const StageSeconds& seconds) {
  return {.loop_s = part_seconds(seconds, FramePart::discovery) + part_seconds(seconds, FramePart::order) +
                    part_seconds(seconds, FramePart::cache),
          .lookup_s = stage_seconds(seconds, Stage::cache_lookup),
          .gather_s = stage_seconds(seconds, Stage::cache_gather),
          .store_s = stage_seconds(seconds, Stage::cache_store),
          .group_s = stage_seconds(seconds, Stage::cache_groups),
          .purge_s = stage_seconds(seconds, Stage::cache_purge),
          .trace_s = stage_seconds(seconds, Stage::trace) + stage_seconds(seconds, Stage::trace_moving)};
}

CacheTimes summarised(const std::vector<CacheTimes>& samples, double (*summary)(std::vector<double>)) {
  CacheTimes out;
  for (double CacheTimes::*stage : stages) {
    std::vector<double> values;
    for (const CacheTimes& sample : samples) values.push_back(sample.*stage);
    out.*stage = summary(values);
  }
  return out;
}

double hit_rate(const CacheRow& row) {
  return row.counts.lookups > 0 ? row.counts.hits / row.counts.lookups : undefined;
}
double write_ns(const CacheRow& row) { return a_segment_ns(row.cold.store_s, row.cold_counts.traced()); }
double read_ns(const CacheRow& row) { return a_segment_ns(row.warm.lookup_s, row.counts.lookups); }
double gather_ns(const CacheRow& row) { return a_segment_ns(row.cold.gather_s, row.cold_counts.traced()); }
double trace_ns(const CacheRow& row) { return a_segment_ns(row.cold.trace_s, row.cold_counts.traced()); }
double empty_lookup_ns(const CacheRow& row) { return a_segment_ns(row.cold.lookup_s, row.cold_counts.lookups); }

Measured measured_write_ns(const CacheRow& row) {
  return with_noise(write_ns(row), row.cold, row.cold_error, &CacheTimes::store_s);
}
Measured measured_read_ns(const CacheRow& row) {
  return with_noise(read_ns(row), row.warm, row.warm_error, &CacheTimes::lookup_s);
}
Measured measured_gather_ns(const CacheRow& row) {
  return with_noise(gather_ns(row), row.cold, row.cold_error, &CacheTimes::gather_s);
}
Measured measured_trace_ns(const CacheRow& row) {
  return with_noise(trace_ns(row), row.cold, row.cold_error, &CacheTimes::trace_s);
}
Measured measured_empty_lookup_ns(const CacheRow& row) {
  return with_noise(empty_lookup_ns(row), row.cold, row.cold_error, &CacheTimes::lookup_s);
}

uint64_t entries_used(const CacheRow& row) {
  return std::accumulate(row.cache.entries_by_hits.begin(), row.cache.entries_by_hits.end(), uint64_t{0});
}

double warm_once_s(const CacheRow& row) { return row.warm.loop_s - row.order_s; }

void set_savings(std::vector<CacheRow>& point) {
  for (CacheRow& row : point) {
    row.saved_percent = 100 * (1 - row.warm.loop_s / point.front().warm.loop_s);
    row.saved_once_percent = 100 * (1 - warm_once_s(row) / warm_once_s(point.front()));
  }
}

double value_of(const CacheRow& row, const std::string& column) {
  for (const Column<CacheRow>& one : cache_columns()) {
    if (one.name != column) continue;
    const std::string cell = one.cell(row);
    char* end = nullptr;
    const double value = std::strtod(cell.c_str(), &end);
    return !cell.empty() && *end == '\0' ? value : undefined;
  }
  return undefined;
}

const Columns<CacheRow>& cache_columns() {
  using R = CacheRow;
  static const Columns<R> all = with_parts({
      {"study", &R::study},
      {"drive", &R::drive},
      {"setting", &R::setting},
      {"rays", &R::rays},
      {"division", &R::division},
      {"position_step_m", &R::position_step_m},
      {"depth", &R::depth},
      {"frames", &R::frames},
      {"cold_s", [](const R& r) { return r.cold.loop_s; }},
      {"warm_s", [](const R& r) { return r.warm.loop_s; }},
      {"warm_error_s", [](const R& r) { return r.warm_error.loop_s; }},
      {"saved_percent", &R::saved_percent},
      {"frame_s", &R::frame_s},
      {"write_ns", write_ns},
      {"read_ns", read_ns},
      {"gather_ns", gather_ns},
      {"trace_ns", trace_ns},
      {"group_s", [](const R& r) { return r.warm.group_s; }},
      {"purge_s", [](const R& r) { return r.warm.purge_s; }},
      {"segments", [](const R& r) { return r.counts.segments; }},
      {"lookups", [](const R& r) { return r.counts.lookups; }},
      {"hit_rate", hit_rate},
      {"control_error", [](const R& r) { return control_error(static_cast<double>(r.rays), r.division); }},
      {"groups", [](const R& r) { return r.counts.groups; }},
      {"shared", [](const R& r) { return r.counts.shared; }},
      {"traced", [](const R& r) { return r.counts.traced(); }},
      {"traced_share",
       [](const R& r) { return r.counts.segments > 0 ? r.counts.traced() / r.counts.segments : undefined; }},
      {"conflicts", [](const R& r) { return r.cache.conflicts; }},
      {"stale", [](const R& r) { return r.cache.stale; }},
      {"dropped", [](const R& r) { return r.cache.dropped; }},
      {"exhausted", [](const R& r) { return r.cache.exhausted; }},
      {"used", [](const R& r) { return r.cache.used; }},
      {"entries", [](const R& r) { return r.cache.entries; }},
      {"paths", &R::paths},
      {"sequences", &R::sequences},
      {"lost_share", [](const R& r) { return r.error.lost_share; }},
      {"spurious_share", [](const R& r) { return r.error.spurious_share; }},
      {"lost_power", [](const R& r) { return r.error.lost_power; }},
      {"spurious_power", [](const R& r) { return r.error.spurious_power; }},
      {"lost_power_db", [](const R& r) { return share_db(r.error.lost_power); }},
      {"spurious_power_db", [](const R& r) { return share_db(r.error.spurious_power); }},
      {"links_lost", [](const R& r) { return r.error.links_lost; }},
      {"power_median_db", [](const R& r) { return r.error.power_median_db; }},
      {"power_max_db", [](const R& r) { return r.error.power_max_db; }},
      {"delay_spread_ns", [](const R& r) { return r.error.delay_spread_ns; }},
      {"delay_ns", [](const R& r) { return r.error.delay_ns; }},
      {"l1_m", [](const R& r) { return r.error.l1_m; }},
      {"l2_m", [](const R& r) { return r.error.l2_m; }},
      {"l1_relative", [](const R& r) { return r.error.l1_relative; }},
      {"l2_relative", [](const R& r) { return r.error.l2_relative; }},
      {"region", &R::region},
      {"mean_path_length_m", [](const R& r) { return r.error.mean_path_length_m; }},
      {"l2_error_m", &R::l2_error_m},
  });
  return all;
}

const CacheRow* find_cached(const std::vector<CacheRow>& rows, const std::string& setting, uint64_t rays,
                            const std::string& drive) {
  for (const CacheRow& row : rows)
    if (row.setting == setting && row.rays == rays && row.drive == drive && is_whole(row)) return &row;
  return nullptr;
}

std::vector<std::string> settings_of(const std::vector<CacheRow>& rows) {
  return distinct<std::string>(rows, [](const CacheRow& row) { return row.setting; });
}
std::vector<std::string> drives_of(const std::vector<CacheRow>& rows) {
  return distinct<std::string>(rows, [](const CacheRow& row) { return row.drive; });
}
std::vector<uint64_t> rays_of(const std::vector<CacheRow>& rows) {
  return distinct<uint64_t>(rows, [](const CacheRow& row) { return row.rays; });
}

}  // namespace wavetracer::study
