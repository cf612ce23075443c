// A Simulation a series, all alive at once, their frames interleaved.
// Assumes device memory for the queues of all of them.
#include "study/measure.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <map>
#include "output/median.hpp"
#include "study/ray_counts.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::study {
namespace {

struct Subject {
  Simulation simulation;
  FrameCounts counts;
  std::vector<StageSeconds> samples;
};

void check_same(const Row& a, const Row& b) {
  if (a.paths == b.paths && a.sequences == b.sequences) return;
  throw RuntimeError(fmt::format(
      "{} rays: {} finds {} paths in {} sequences, {} finds {} in {} from the same rays, though no order may "
      "change what is found: the device or its driver is not to be trusted; try another with --device",
      grouped(a.rays), label(a.series), a.paths, a.sequences, label(b.series), b.paths, b.sequences));
}

}  // namespace

double sum_stages(const StageSeconds& seconds, std::initializer_list<const char*> stages) {
  double total = 0;
  for (const char* stage : stages)
    if (const auto found = seconds.find(stage); found != seconds.end()) total += found->second;
  return total;
}

void require_segments(double segments, const Config& config) {
  if (segments > 0) return;
  throw ConfigError(
      fmt::format("{}no transmitter launches rays in the frames that are measured, because no link is wanted there: "
                  "see [links], and "
                  "whether vehicles with antennas are there at [time] start_s",
                  config.file.empty() ? "" : config.file + ": "));
}

Times summarise(const std::vector<StageSeconds>& samples, uint32_t frames) {
  std::map<std::string, std::vector<double>> values;
  for (const StageSeconds& sample : samples)
    for (const auto& [stage, seconds] : sample) values[stage].push_back(seconds);
  StageSeconds medians;
  for (const auto& [stage, seconds] : values) medians[stage] = median(seconds) / frames;
  return {.trace_s = sum_stages(medians, {"trace"}),
          .order_s = sum_stages(medians, {"order", "sort"}),
          .unpaid_s = sum_stages(medians, {"generate_rays", "trace", "compact", "scan", "interact"}),
          .frame_s = sum_stages(medians, {"frame"})};
}

void compare(std::span<Row> rows) {
  for (Row& row : rows) {
    row.gain_unpaid = rows.front().times.unpaid_s / row.times.unpaid_s;
    row.gain_paid = rows.front().times.paid_s() / row.times.paid_s();
    check_same(*std::find_if(rows.begin(), rows.end(),
                             [&row](const Row& first) { return first.series.directions == row.series.directions; }),
               row);
  }
}

std::vector<Row> measure(const Config& config, const std::vector<Series>& series, uint64_t rays, uint32_t frames,
                         const std::string& device, uint32_t repeats) {
  std::vector<Subject> subjects;
  for (const Series& one : series) {
    Config applied = config;
    apply(applied, one, rays);
    subjects.push_back({Simulation(applied, device), {}, {}});
    subjects.back().counts = subjects.back().simulation.run_frame(0).counts;
    require_segments(static_cast<double>(subjects.back().counts.segments), config);
  }
  for (uint32_t repeat = 0; repeat < repeats; ++repeat)
    for (size_t i = 0; i < subjects.size(); ++i) {
      Subject& subject = subjects[(i + repeat) % subjects.size()];  // so that no series always follows the same one
      subject.samples.push_back(subject.simulation.run_frame(0).seconds);
    }
  std::vector<Row> rows;
  for (size_t i = 0; i < subjects.size(); ++i)
    rows.push_back({.rays = rays,
                    .frames = frames,
                    .series = series[i],
                    .times = summarise(subjects[i].samples, frames),
                    .paths = subjects[i].counts.paths,
                    .sequences = subjects[i].counts.sequences});
  compare(rows);
  return rows;
}

}  // namespace wavetracer::study
