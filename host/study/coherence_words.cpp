// SPDX-License-Identifier: Apache-2.0
// Texts about coherence: numbers, a column per depth, and their meaning for the claims.
// Correlations and shares have two decimals; comparisons with the table must round in the same way.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include "study/ray_counts.hpp"
#include "study/run.hpp"

namespace wavetracer::study {
namespace {

std::string number(double value) {
  if (std::isnan(value)) return "undefined";
  return fmt::format("{:.2f}", std::round(100 * value) / 100 + 0.0);  // + 0.0 avoids a minus before a zero
}

// Makes a table with a column per depth.
NumberTable depth_table(const std::string& caption, size_t depths) {
  NumberTable table{.caption = caption, .heads = {""}, .rows = {}};
  for (size_t depth = 1; depth <= depths; ++depth) table.heads.push_back(fmt::format("depth {}", depth));
  return table;
}

void add(NumberTable& table, const std::string& what, const std::vector<double>& values) {
  table.rows.push_back({what});
  for (const double value : values) table.rows.back().push_back(number(value));
  table.rows.back().resize(table.heads.size(), "undefined");
}

using FrameValue = std::function<double(const FramePair&)>;

double by_ray(const FramePair& row) { return row.found.points.total; }
double by_place(const FramePair& row) { return row.by_place; }
double unordered_by_place(const FramePair& row) { return row.by_place_unordered; }

// Returns a list per depth: the defined values of all frames against their previous ones.
std::vector<std::vector<double>> previous_values(const std::vector<FramePair>& rows, const FrameValue& value) {
  std::vector<std::vector<double>> out;
  for (const FramePair& row : rows) {
    if (row.against != "previous" || row.depth == 0) continue;
    out.resize(std::max<size_t>(out.size(), row.depth));
    if (!std::isnan(value(row))) out[row.depth - 1].push_back(value(row));
  }
  return out;
}

Measured mean_value(const std::vector<double>& values) {
  RunningMean mean;
  for (const double value : values) mean.add(value);
  return {mean.mean(), mean.standard_error()};
}
// Extremes are those of the frames that were measured, without an error of their own.
Measured least_value(const std::vector<double>& values) {
  return values.empty() ? Measured{} : Measured{std::ranges::min(values), 0};
}
Measured greatest_value(const std::vector<double>& values) {
  return values.empty() ? Measured{} : Measured{std::ranges::max(values), 0};
}

using FrameSummary = Measured (*)(const std::vector<double>&);

// Returns a value per depth, for subsequent frames.
std::vector<Measured> summaries(const std::vector<FramePair>& rows, const FrameValue& value, FrameSummary summary) {
  std::vector<Measured> out;
  for (const std::vector<double>& values : previous_values(rows, value)) out.push_back(summary(values));
  return out;
}

std::vector<double> previous_means(const std::vector<FramePair>& rows, const FrameValue& value) {
  std::vector<double> out;
  for (const Measured& mean : summaries(rows, value, mean_value)) out.push_back(mean.value);
  return out;
}

// Returns the defined values of whole outputs of subsequent frames.
std::vector<double> whole_values(const std::vector<FramePair>& rows, const FrameValue& value) {
  std::vector<double> out;
  for (const FramePair& row : rows)
    if (row.against == "previous" && row.depth == 0 && !std::isnan(value(row))) out.push_back(value(row));
  return out;
}

// Answers for each pairing and depth whether a summary of the correlations of subsequent frames satisfies a condition.
Judge<FramePair> where_correlations(FrameSummary summary, const std::function<Answer(const Measured&)>& are_so) {
  return [=](const std::vector<FramePair>& rows) {
    Cases out{.form = correlation_form(), .at = "depth"};
    const auto add_pairing = [&](const char* words, const FrameValue& value) {
      for (uint64_t depth = 1; const Measured& found : summaries(rows, value, summary))
        out.all.push_back({words, depth++, are_so(found), found.value});
    };
    add_pairing("paired by ray and bounce", by_ray);
    add_pairing("paired by place", by_place);
    const auto add_whole_output = [&](const char* words, const FrameValue& value) {
      const std::vector<double> values = whole_values(rows, value);
      if (values.empty()) return;
      const Measured found = summary(values);
      out.all.push_back({words, 0, are_so(found), found.value});
    };
    add_whole_output("whole outputs", by_place);
    add_whole_output("whole outputs of rays in no order", unordered_by_place);
    return out;
  };
}

// Returns a value per depth, of the last frame against the first.
std::vector<double> last_values(const std::vector<FramePair>& rows, const FrameValue& value) {
  std::vector<double> out;
  for (const FramePair& row : rows)
    if (row.against == "first" && row.frame == rows.back().frame && row.depth > 0) out.push_back(value(row));
  return out;
}

// Shows equation 6.4 of whole outputs: the mean over subsequent frames, and its range.
void add_whole(NumberTable& table, const std::string& what, const std::vector<double>& values) {
  if (values.empty()) return;
  RunningMean mean;
  for (const double value : values) mean.add(value);
  table.rows.push_back({what, fmt::format("{} ({} to {})", number(mean.mean()), number(std::ranges::min(values)),
                                          number(std::ranges::max(values)))});
  table.rows.back().resize(table.heads.size());
}

const LagRow* find_lag(const std::vector<LagRow>& rows, const std::string& directions, uint32_t depth, uint32_t lag) {
  for (const LagRow& row : rows)
    if (row.directions == directions && row.depth == depth && row.found.lag == lag) return &row;
  return nullptr;
}

// Returns a value per depth, of neighbours.
std::vector<double> neighbours(const std::vector<LagRow>& rows, const std::string& directions,
                               double LagCoherence::*value) {
  std::vector<double> out;
  for (uint32_t depth = 1; const LagRow* row = find_lag(rows, directions, depth, 1); ++depth)
    out.push_back(row->found.*value);
  return out;
}

// Returns the first lag at which points correlate by less than half.
std::string half_lag(const std::vector<LagRow>& rows, const std::string& directions, uint32_t depth) {
  for (const LagRow& row : rows)
    if (row.directions == directions && row.depth == depth && row.found.points < 0.5) return grouped(row.found.lag);
  return "none measured";
}

// Returns "0.98 at lag 987": where points of first hits correlate most.
std::string greatest_words(const std::vector<LagRow>& rows, const std::string& directions) {
  const LagRow* best = nullptr;
  for (const LagRow& row : rows)
    if (row.directions == directions && row.depth == 1 && (!best || row.found.points > best->found.points)) best = &row;
  return best ? fmt::format("{} at lag {}", number(best->found.points), grouped(best->found.lag)) : "undefined";
}

}  // namespace

Judge<FramePair> correlate_on_average(double low, double high) {
  return where_correlations(mean_value, [=](const Measured& mean) { return between(mean, low, high); });
}
Judge<FramePair> correlation_falls_below(double low) {
  return where_correlations(least_value, [=](const Measured& least) { return below(least, low); });
}
Judge<FramePair> correlation_rises_to(double high) {
  return where_correlations(greatest_value, [=](const Measured& most) { return between(most, 0.8 * high, high); });
}

Words frame_words(const Experiment& experiment, const std::vector<FramePair>& rows, const Drive& drive,
                  const std::string& world, const std::string& device) {
  const uint32_t last = rows.back().frame;
  const Fields fields = {{"device", device},
                         {"rays", grouped(experiment_rays)},
                         {"frames", std::to_string(last + 1)},
                         {"world", world},
                         {"moved", fmt::format("{:.1f}", drive.moved_m(last))},
                         {"apart", fmt::format("{:.3f}", drive.moved_m(last) / last)},
                         {"age", fmt::format("{:g}", drive.time_s(last))}};
  const std::vector<double> paired = previous_means(rows, by_ray);
  NumberTable table = depth_table("Correlations of points, and shares of rays:", paired.size());
  add(table, "subsequent frames, points paired by ray and bounce", paired);
  add(table, "subsequent frames, points paired by place", previous_means(rows, by_place));
  add(table, "last frame with the first, points paired by ray and bounce", last_values(rows, by_ray));
  using Values = std::vector<double> (*)(const std::vector<FramePair>&, const FrameValue&);
  for (const auto& [frames, values] :
       {std::pair<const char*, Values>{"subsequent frames", previous_means}, {"last frame and first", last_values}}) {
    const auto line = [&](const char* what, double DepthCoherence::*share) {
      add(table, fmt::format("{}: {}", frames, what),
          values(rows, [share](const FramePair& row) { return row.found.*share; }));
    };
    line("rays that hit in both of those that hit in one", &DepthCoherence::both);
    line("of these, on the same surface", &DepthCoherence::same_surface);
    line("of these, after the same surfaces", &DepthCoherence::same_sequence);
  }
  add_whole(table, "subsequent frames, whole outputs, points paired by place", whole_values(rows, by_place));
  add_whole(table, "the same, rays launched in no order", whole_values(rows, unordered_by_place));
  add_whole(table, "subsequent frames, whole outputs, points paired by ray and bounce", whole_values(rows, by_ray));
  return {filled(experiment.paragraph, fields), judged(experiment.as<FrameFigure>()->claims, rows, {}, fields), table};
}

// Lags must ascend from 1 for each map and depth.
Words lag_words(const Experiment& experiment, const std::vector<LagRow>& rows, const std::string& device) {
  const std::vector<double> same = neighbours(rows, "hilbert", &LagCoherence::same_surface);
  NumberTable table = depth_table("Rays launched one after the other:", same.size());
  for (const char* directions : {"hilbert", "fibonacci", "random"})
    add(table, fmt::format("hit points correlate, {}", directions),
        neighbours(rows, directions, &LagCoherence::points));
  table.rows.push_back({"lag at which that falls below a half, hilbert"});
  for (uint32_t depth = 1; depth <= same.size(); ++depth) table.rows.back().push_back(half_lag(rows, "hilbert", depth));
  for (const char* directions : {"hilbert", "fibonacci", "random"})
    add(table, fmt::format("both hit the same surface, {}", directions),
        neighbours(rows, directions, &LagCoherence::same_surface));
  std::vector<double> wrong;
  for (const double share : same) wrong.push_back(1 - share);
  add(table, "the wrong surface, hilbert", wrong);
  const Fields fields = {
      {"device", device}, {"rays", grouped(experiment_rays)}, {"fibonacci", greatest_words(rows, "fibonacci")}};
  return {filled(experiment.paragraph, fields), {}, table};
}

}  // namespace wavetracer::study
