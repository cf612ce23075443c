// SPDX-License-Identifier: Apache-2.0
// Each series has a Simulation; all exist at once, with their frames interleaved.
// Device memory must hold the queues of all of them.
#include "study/order_rows.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <map>
#include <numeric>
#include "output/median.hpp"
#include "study/measured.hpp"
#include "study/ray_counts.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/stages.hpp"

namespace wavetracer::study {
namespace {

struct OrderSubject {
  Simulation simulation;
  uint64_t rays = 0, segments = 0, paths = 0, sequences = 0;  // sums over all counted frames
  std::vector<StageSeconds> samples{};

  void count(const FrameResult& frame) {
    rays += frame.counts.rays;
    segments += frame.counts.segments;
    paths += frame.counts.paths;
    sequences += frame.counts.sequences;
  }
};

double average(std::vector<double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

void check_same(const OrderRow& a, const OrderRow& b) {
  if (a.paths == b.paths && a.sequences == b.sequences) return;
  throw RuntimeError(
      fmt::format("{} rays: {} finds {} paths in {} sequences, {} finds {} in {} from the same rays, "
                  "though no order may change what is found: the device or its driver gives wrong results; "
                  "try another one with --device",
                  grouped(a.rays), label(a.series), a.paths, a.sequences, label(b.series), b.paths, b.sequences));
}

// Sets the noise of rows, one per subject, whose times are medians or means.
void set_noise(const std::vector<OrderSubject>& subjects, bool medians, std::vector<OrderRow>& rows) {
  std::vector<std::vector<double>> unpaid(subjects.size()), paid(subjects.size());
  for (size_t i = 0; i < subjects.size(); ++i)
    for (const StageSeconds& sample : subjects[i].samples) {
      unpaid[i].push_back(part_seconds(sample, FramePart::discovery));
      paid[i].push_back(unpaid[i].back() + part_seconds(sample, FramePart::order));
    }
  const std::vector<double> of_unpaid = relative_errors(unpaid), of_paid = relative_errors(paid);
  for (size_t i = 0; i < rows.size(); ++i) {
    rows[i].noise_unpaid = (medians ? median_noise : 1) * of_unpaid[i];
    rows[i].noise_paid = (medians ? median_noise : 1) * of_paid[i];
  }
}

}  // namespace

const Columns<OrderRow>& order_columns(bool averages) {
  using R = OrderRow;
  static const Columns<R> errors = {
      {"unpaid_error_s", [](const R& r) { return r.noise_unpaid * r.times.unpaid_s; }},
      {"paid_error_s", [](const R& r) { return r.noise_paid * r.times.paid_s(); }},
  };
  static const Columns<R> common = {
      {"rays", &R::rays},
      {"method", [](const R& r) { return r.series.method; }},
      {"mnemonic", [](const R& r) { return r.series.mnemonic; }},
      {"shape", [](const R& r) { return r.series.shape; }},
      {"each_depth", [](const R& r) { return r.series.each_depth; }},
      {"trace_s", [](const R& r) { return r.times.trace_s; }},
      {"order_s", [](const R& r) { return r.times.order_s; }},
      {"unpaid_s", [](const R& r) { return r.times.unpaid_s; }},
      {"paid_s", [](const R& r) { return r.times.paid_s(); }},
      {"frame_s", [](const R& r) { return r.times.frame_s; }},
      {"paths", &R::paths},
      {"sequences", &R::sequences},
      {"gain_unpaid", &R::gain_unpaid},
      {"gain_paid", &R::gain_paid},
      {"launched", &R::launched},
      {"bins", [](const R& r) { return has_bins(r.series) ? r.series.bins : 0; }},
  };
  static const Columns<R> one_frame = [] {
    Columns<R> all = common;
    all.insert(all.end(), errors.begin(), errors.end());
    return all;
  }();
  static const Columns<R> many = [] {
    Columns<R> all = common;
    all.emplace_back("frames", &R::frames);
    all.emplace_back("reduction_unpaid_percent", [](const R& r) { return reduction_percent(r.gain_unpaid); });
    all.emplace_back("reduction_paid_percent", [](const R& r) { return reduction_percent(r.gain_paid); });
    all.insert(all.end(), errors.begin(), errors.end());
    return all;
  }();
  return averages ? many : one_frame;
}

double reduction_percent(double gain) { return 100 * (1 - 1 / gain); }

void require_segments(double segments, const Config& config) {
  if (segments > 0) return;
  throw ConfigError(
      fmt::format("{}no transmitter launches rays in the frames that are measured, because no link is wanted there: "
                  "see [links], and whether vehicles with antennas are there at [time] start_s",
                  config.file.empty() ? "" : config.file + ": "));
}

OrderTimes summarise(const std::vector<StageSeconds>& samples, double (*summary)(std::vector<double>)) {
  std::map<std::string, std::vector<double>> values;
  for (const StageSeconds& sample : samples)
    for (const auto& [stage, seconds] : sample) values[stage].push_back(seconds);
  StageSeconds summaries;
  for (const auto& [stage, seconds] : values) summaries[stage] = summary(seconds);
  return {.trace_s = stage_seconds(summaries, Stage::trace),
          .order_s = part_seconds(summaries, FramePart::order),
          .unpaid_s = part_seconds(summaries, FramePart::discovery),
          .frame_s = part_seconds(summaries, FramePart::whole)};
}

void compare(std::span<OrderRow> rows) {
  for (OrderRow& row : rows) {
    row.gain_unpaid = rows.front().times.unpaid_s / row.times.unpaid_s;
    row.gain_paid = rows.front().times.paid_s() / row.times.paid_s();
    check_same(
        *std::find_if(rows.begin(), rows.end(),
                      [&row](const OrderRow& first) { return first.series.directions == row.series.directions; }),
        row);
  }
}

std::vector<OrderRow> measure_groups(const Config& config, const std::vector<Series>& series, uint64_t rays,
                                     const OrderFrames& of, const std::string& device) {
  if (rays <= rays_of_all_series) return measure_orders(config, series, rays, of, device);
  std::vector<OrderRow> rows;
  for (size_t begin = 1; rows.empty() || begin < series.size(); begin += series_at_once) {
    std::vector<Series> group = {series.front()};
    const size_t end = std::min(begin + series_at_once, series.size());
    group.insert(group.end(), series.begin() + std::min(begin, end), series.begin() + end);
    const std::vector<OrderRow> found = measure_orders(config, group, rays, of, device);
    rows.insert(rows.end(), found.begin() + (rows.empty() ? 0 : 1), found.end());
  }
  return rows;
}

std::vector<OrderRow> measure_orders(const Config& config, const std::vector<Series>& series, uint64_t rays,
                                     const OrderFrames& of, const std::string& device) {
  std::vector<OrderSubject> subjects;
  for (const Series& one : series) {
    Config applied = config;
    apply(applied, one, rays);
    subjects.push_back({.simulation = Simulation(applied, device)});
    subjects.back().simulation.observe(of.watch);
    const FrameResult first = subjects.back().simulation.run_frame(of.frames == 0 ? of.still : 0);
    if (of.frames == 0) subjects.back().count(first);
  }
  const uint64_t rounds = of.frames > 0 ? of.frames : of.repeats;
  for (uint64_t round = 0; round < rounds; ++round)
    for (size_t i = 0; i < subjects.size(); ++i) {
      OrderSubject& subject = subjects[(i + round) % subjects.size()];  // so that no series always follows the same one
      const FrameResult frame =
          subject.simulation.run_frame(of.frames > 0 ? static_cast<uint32_t>(round + 1) : of.still);
      if (of.frames > 0) subject.count(frame);
      subject.samples.push_back(frame.seconds);
    }
  std::vector<OrderRow> rows;
  for (size_t i = 0; i < subjects.size(); ++i) {
    require_segments(static_cast<double>(subjects[i].segments), config);
    const uint64_t frames = std::max<uint64_t>(of.frames, 1);
    rows.push_back({.rays = rays,
                    .frames = frames,
                    .launched = static_cast<double>(subjects[i].rays) / static_cast<double>(frames),
                    .series = series[i],
                    .times = summarise(subjects[i].samples, of.frames > 0 ? average : median),
                    .paths = subjects[i].paths,
                    .sequences = subjects[i].sequences});
  }
  set_noise(subjects, of.frames == 0, rows);
  compare(rows);
  return rows;
}

const OrderRow* find_row(const std::vector<OrderRow>& rows, const Series& series, uint64_t rays) {
  for (const OrderRow& row : rows)
    if (row.rays == rays && row.series == series) return &row;
  return nullptr;
}

}  // namespace wavetracer::study
