// Sums of stages, and the table as a list of columns.
// A stage that a frame has no use for counts nothing.
#include "study/cache_rows.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <initializer_list>
#include "output/median.hpp"
#include "study/measure.hpp"

namespace wavetracer::study {
namespace {

constexpr std::initializer_list<double CacheTimes::*> stages = {&CacheTimes::loop_s,   &CacheTimes::lookup_s,
                                                                &CacheTimes::gather_s, &CacheTimes::store_s,
                                                                &CacheTimes::purge_s,  &CacheTimes::trace_s};

double a_segment_ns(double seconds, double segments) {
  return segments > 0 ? 1e9 * seconds / segments : study::undefined;
}

struct Column {
  std::string name;
  std::function<std::string(const CacheRow&)> cell;
};

Column number(const std::string& name, const std::function<double(const CacheRow&)>& value) {
  return {name, [value](const CacheRow& row) { return fmt::format("{:.6g}", value(row)); }};
}

const std::vector<Column>& columns() {
  using R = CacheRow;
  static const std::vector<Column> all = {
      {"study", [](const R& r) { return r.study; }},
      {"drive", [](const R& r) { return r.drive; }},
      {"setting", [](const R& r) { return r.setting; }},
      {"rays", [](const R& r) { return std::to_string(r.rays); }},
      {"division", [](const R& r) { return std::to_string(r.division); }},
      number("position_step_m", [](const R& r) { return r.position_step_m; }),
      {"depth", [](const R& r) { return std::to_string(r.depth); }},
      {"frames", [](const R& r) { return std::to_string(r.frames); }},
      number("cold_s", [](const R& r) { return r.cold.loop_s; }),
      number("warm_s", [](const R& r) { return r.warm.loop_s; }),
      number("warm_error_s", [](const R& r) { return r.warm_error_s; }),
      number("saved_percent", [](const R& r) { return r.saved_percent; }),
      number("frame_s", [](const R& r) { return r.frame_s; }),
      number("write_ns", write_ns),
      number("read_ns", read_ns),
      number("gather_ns", gather_ns),
      number("trace_ns", trace_ns),
      number("purge_s", [](const R& r) { return r.warm.purge_s; }),
      number("segments", [](const R& r) { return r.counts.segments; }),
      number("lookups", [](const R& r) { return r.counts.lookups; }),
      number("hit_rate", hit_rate),
      {"conflicts", [](const R& r) { return std::to_string(r.cache.conflicts); }},
      {"stale", [](const R& r) { return std::to_string(r.cache.stale); }},
      {"dropped", [](const R& r) { return std::to_string(r.cache.dropped); }},
      {"exhausted", [](const R& r) { return std::to_string(r.cache.exhausted); }},
      {"used", [](const R& r) { return std::to_string(r.cache.used); }},
      {"entries", [](const R& r) { return std::to_string(r.cache.entries); }},
      number("paths", [](const R& r) { return r.paths; }),
      number("sequences", [](const R& r) { return r.sequences; }),
      number("lost_share", [](const R& r) { return r.error.lost_share; }),
      number("spurious_share", [](const R& r) { return r.error.spurious_share; }),
      number("lost_power", [](const R& r) { return r.error.lost_power; }),
      number("spurious_power", [](const R& r) { return r.error.spurious_power; }),
      number("lost_power_db", [](const R& r) { return study::share_db(r.error.lost_power); }),
      number("spurious_power_db", [](const R& r) { return study::share_db(r.error.spurious_power); }),
      {"links_lost", [](const R& r) { return std::to_string(r.error.links_lost); }},
      number("power_median_db", [](const R& r) { return r.error.power_median_db; }),
      number("power_max_db", [](const R& r) { return r.error.power_max_db; }),
      number("delay_spread_ns", [](const R& r) { return r.error.delay_spread_ns; }),
      number("delay_ns", [](const R& r) { return r.error.delay_ns; }),
      number("l1_m", [](const R& r) { return r.error.l1_m; }),
      number("l2_m", [](const R& r) { return r.error.l2_m; }),
      number("l1_relative", [](const R& r) { return r.error.l1_relative; }),
      number("l2_relative", [](const R& r) { return r.error.l2_relative; }),
      number("mean_path_length_m", [](const R& r) { return r.error.mean_path_length_m; }),
  };
  return all;
}

template <class Value, class Get>
std::vector<Value> distinct(const std::vector<CacheRow>& rows, Get get) {
  std::vector<Value> out;
  for (const CacheRow& row : rows)
    if (std::find(out.begin(), out.end(), get(row)) == out.end()) out.push_back(get(row));
  return out;
}

}  // namespace

CacheTimes cache_times(const StageSeconds& seconds) {
  return {.loop_s = sum_stages(seconds,
                               {"generate_rays", "order", "sort", "label_rays", "cache_lookup", "cache_gather", "trace",
                                "trace_moving", "compact", "scan", "cache_store", "cache_purge", "interact"}),
          .lookup_s = sum_stages(seconds, {"cache_lookup"}),
          .gather_s = sum_stages(seconds, {"cache_gather"}),
          .store_s = sum_stages(seconds, {"cache_store"}),
          .purge_s = sum_stages(seconds, {"cache_purge"}),
          .trace_s = sum_stages(seconds, {"trace", "trace_moving"})};
}

CacheTimes median_times(const std::vector<CacheTimes>& samples) {
  CacheTimes out;
  for (double CacheTimes::*stage : stages) {
    std::vector<double> values;
    for (const CacheTimes& sample : samples) values.push_back(sample.*stage);
    out.*stage = median(values);
  }
  return out;
}

CacheTimes operator-(const CacheTimes& a, const CacheTimes& b) {
  CacheTimes out;
  for (double CacheTimes::*stage : stages) out.*stage = a.*stage - b.*stage;
  return out;
}

double hit_rate(const CacheRow& row) {
  return row.counts.lookups > 0 ? row.counts.hits / row.counts.lookups : study::undefined;
}
double write_ns(const CacheRow& row) { return a_segment_ns(row.cold.store_s, row.cold_counts.missed()); }
double read_ns(const CacheRow& row) { return a_segment_ns(row.warm.lookup_s, row.counts.lookups); }
double gather_ns(const CacheRow& row) { return a_segment_ns(row.cold.gather_s, row.cold_counts.missed()); }
double trace_ns(const CacheRow& row) {
  const bool cached = row.cold_counts.lookups > 0;
  return a_segment_ns(row.cold.trace_s, cached ? row.cold_counts.missed() : row.cold_counts.segments);
}

void set_savings(std::vector<CacheRow>& point) {
  for (CacheRow& row : point) row.saved_percent = 100 * (1 - row.warm.loop_s / point.front().warm.loop_s);
}

std::string encode_cache_table(const std::vector<CacheRow>& rows) {
  std::string text = fmt::format("{}\n", fmt::join(cache_columns(), ","));
  for (const CacheRow& row : rows) {
    for (const Column& column : columns()) text += (&column == &columns().front() ? "" : ",") + column.cell(row);
    text += "\n";
  }
  return text;
}

double value_of(const CacheRow& row, const std::string& column) {
  for (const Column& one : columns()) {
    if (one.name != column) continue;
    const std::string cell = one.cell(row);
    char* end = nullptr;
    const double value = std::strtod(cell.c_str(), &end);
    return !cell.empty() && *end == '\0' ? value : study::undefined;
  }
  return study::undefined;
}

const std::vector<std::string>& cache_columns() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const Column& column : columns()) out.push_back(column.name);
    return out;
  }();
  return names;
}

const CacheRow* find_cached(const std::vector<CacheRow>& rows, const std::string& setting, uint64_t rays,
                            const std::string& drive) {
  for (const CacheRow& row : rows)
    if (row.setting == setting && row.rays == rays && row.drive == drive && row.depth == 0) return &row;
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
