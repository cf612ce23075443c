// SPDX-License-Identifier: Apache-2.0
// Adds up over frames and over shards of frames, which must be added in the order of frames.
#include "output/totals.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <numeric>
#include "base/digits.hpp"
#include "output/cache_counts.hpp"
#include "output/median.hpp"

namespace wavetracer {
namespace {

void add(PathKindCounts& sum, const PathKindCounts& more) {
  for (size_t i = 0; i < sum.size(); ++i) sum[i] += more[i];
}

void add(std::vector<uint64_t>& sum, const std::vector<uint64_t>& more) {
  sum.resize(std::max(sum.size(), more.size()), 0);
  for (size_t i = 0; i < more.size(); ++i) sum[i] += more[i];
}

void add(CacheSummary& sum, const CacheSummary& later) {
  CacheSummary total = later;
  for (const auto& [name, count] : cache_counts) total.*count += sum.*count;
  add(total.lookups_per_depth, sum.lookups_per_depth);
  add(total.hits_per_depth, sum.hits_per_depth);
  add(total.shared_per_depth, sum.shared_per_depth);
  sum = std::move(total);
}

void add(LeftOutPaths& sum, const LeftOutPaths& more) {
  sum.paths += more.paths;
  sum.power += more.power;
  sum.all += more.all;
}

// Adds later links of the same frame.
void add(MissingLinks& sum, const MissingLinks& more) {
  sum.links += more.links;
  sum.in_grids += more.in_grids;
  for (const auto member : {&MissingLinks::why, &MissingLinks::why_in_grids}) {
    std::vector<std::string>& all = sum.*member;
    all.insert(all.end(), (more.*member).begin(), (more.*member).end());
    all.resize(std::min(all.size(), MissingLinks::shown));
  }
}

Totals totals_of(const FrameResult& frame) {
  Totals totals;
  totals.frames = 1;
  totals.first = totals.last = frame.frame;
  totals.start_s = totals.end_s = frame.world.time_s;
  totals.vertices = frame.paths.vertex_position_m.size();
  totals.links = frame.world.links.size();
  totals.counts = frame.counts;
  totals.kinds = frame.summed ? frame.summed->kinds : count_path_kinds(frame.paths);
  totals.missed = frame.missed;
  totals.certificate = frame.certificate;
  totals.late = frame.late;
  totals.left_out_at_edges = frame.left_out_at_edges;
  totals.segments_per_depth = frame.segments_per_depth;
  totals.cache = frame.cache;
  for (const auto& [stage, seconds] : frame.seconds) totals.seconds[stage] = {seconds};
  if (frame.seconds.contains("trace"))
    totals.timed_segments = frame.counts.segments - frame.cache.hits - frame.cache.shared;
  add_warnings(totals.warnings, frame.warnings);
  totals.missing = frame.missing;
  return totals;
}

}  // namespace

void add_warnings(std::vector<std::string>& all, const std::vector<std::string>& more) {
  for (const std::string& text : more)
    if (std::find(all.begin(), all.end(), text) == all.end()) all.push_back(text);
}

void add(Totals& sum, const Totals& later) {
  if (later.frames == 0) return;
  if (sum.frames == 0) {
    sum = later;
    return;
  }
  sum.frames += later.frames;
  sum.last = later.last;
  sum.end_s = later.end_s;
  sum.vertices += later.vertices;
  sum.timed_segments += later.timed_segments;
  sum.links += later.links;
  add(sum.counts, later.counts);
  add(sum.kinds, later.kinds);
  add(sum.missed, later.missed);
  add(sum.certificate, later.certificate);
  sum.late.add(later.late);
  add(sum.left_out, later.left_out);
  sum.left_out_at_edges = std::max(sum.left_out_at_edges, later.left_out_at_edges);
  add(sum.segments_per_depth, later.segments_per_depth);
  add(sum.cache, later.cache);
  for (const auto& [stage, values] : later.seconds)
    sum.seconds[stage].insert(sum.seconds[stage].end(), values.begin(), values.end());
  add_warnings(sum.warnings, later.warnings);
  if (sum.missing.empty()) sum.missing = later.missing;
}

void add_block(Totals& sum, const Totals& more) {
  const bool empty = sum.frames == 0;
  MissedCounts missed = sum.missed;
  add_part(missed, more.missed);
  Certificate certificate = sum.certificate;
  add_part(certificate, more.certificate);
  std::map<std::string, std::vector<double>> seconds = sum.seconds;
  for (const auto& [stage, values] : more.seconds) {
    std::vector<double>& all = seconds[stage];
    all.resize(std::max(all.size(), values.size()), 0);
    for (size_t i = 0; i < values.size(); ++i) all[i] += values[i];
  }
  MissingLinks missing = sum.missing;
  add(missing, more.missing);
  add(sum, more);
  if (!empty) sum.frames -= more.frames;
  sum.missed = missed;
  sum.certificate = certificate;
  sum.seconds = std::move(seconds);
  sum.missing = std::move(missing);
}

std::vector<std::string> missing_words(const Totals& totals) {
  const bool none = totals.counts.paths == 0;
  if (totals.frames == 0 || (totals.frames > 1 && !none)) return {};
  const MissingLinks& missing = totals.missing;
  std::vector<std::string> out;
  if (none && totals.links == 0)
    out.push_back("no path was found, because no frame has a link: look at [links], and at when vehicles are there");
  else if (none)
    out.push_back(fmt::format("no path was found, of {} links in {} frame{}", grouped(totals.links),
                              grouped(totals.frames), totals.frames == 1 ? "" : "s"));
  const auto say = [&](const std::vector<std::string>& why, uint64_t links) {
    out.insert(out.end(), why.begin(), why.end());
    if (links > why.size()) out.push_back(fmt::format("{} more links have no path", grouped(links - why.size())));
  };
  say(missing.why, missing.links);
  if (none) say(missing.why_in_grids, missing.in_grids);
  return out;
}

Totals totals_of(Frames frames) {
  Totals sum;
  for (const FrameResult& frame : frames) add(sum, totals_of(frame));
  return sum;
}

uint64_t traced_segments(const Totals& totals) {
  return totals.counts.segments - totals.cache.hits - totals.cache.shared;
}

double median_seconds(const Totals& totals, const std::string& stage) {
  const auto found = totals.seconds.find(stage);
  return found == totals.seconds.end() ? 0.0 : median(found->second);
}

double sum_seconds(const Totals& totals, const std::string& stage) {
  const auto found = totals.seconds.find(stage);
  return found == totals.seconds.end() ? 0.0 : std::accumulate(found->second.begin(), found->second.end(), 0.0);
}

double segments_per_second(const Totals& totals) {
  const double seconds = sum_seconds(totals, "trace");
  return seconds > 0 ? static_cast<double>(totals.timed_segments) / seconds : 0;
}

}  // namespace wavetracer
