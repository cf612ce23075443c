// SPDX-License-Identifier: Apache-2.0
// Figures of orders: the time of every series at every number of rays.
// A frame without a cache, reuse or diffraction launches the rays of its transmitters and no others.
#include <fmt/format.h>
#include <algorithm>
#include <memory>
#include "base/stopwatch.hpp"
#include "study/order_claims.hpp"
#include "study/run.hpp"
#include "study/scripts.hpp"
#include "study/worlds.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::study {
namespace {

constexpr uint64_t thesis_frames = 500, cpu_frames = 20;
// With many rays, means are over fewer frames: about this many rays of a transmitter in all, and at least this many
// frames.
constexpr uint64_t rays_of_means = 100000000, least_frames = 5;
// A figure starts no number of rays that would end later than this, unless --rays asks for it or --minutes gives
// another limit.
constexpr double gpu_minutes = 3, cpu_minutes = 10;
// Quick figures of orders go beyond the thesis' first number of rays in figure 6.1, which is 50,000.
constexpr RayRange quick_range = {claimed_few, 200000};

std::string point_line(const Experiment& experiment, const std::vector<OrderRow>& rows) {
  std::string text =
      fmt::format("{}: {} rays, tracing with the sort paid:", experiment.name, grouped(rows.front().rays));
  for (const OrderRow& row : rows)
    text += fmt::format("{} {} {} ms", &row == &rows.front() ? "" : ",", label(row.series),
                        plain(1e3 * row.times.paid_s()));
  return text;
}

RayRange series_range(const Request& request) {
  if (request.rays) return *request.rays;
  return request.quick ? quick_range : RayRange{};
}

uint64_t wanted_frames(const Request& request, bool gpu) {
  if (request.frames > 0) return request.frames;
  return (gpu ? thesis_frames : cpu_frames) / (request.quick ? 5 : 1);
}

// Returns the number of averaged frames at this number of rays, out of the wanted `frames` of the world.
uint64_t frames_at(uint64_t rays, uint64_t frames, const Request& request) {
  if (request.frames > 0) return frames;
  return std::min(frames, std::max(rays_of_means / rays, least_frames));
}

std::vector<std::string> notes_of(const OrderFigure& figure, const std::vector<OrderRow>& rows,
                                  const Request& request) {
  const std::string times =
      figure.moves ? fmt::format(
                         "times: means (equation 6.2) over {} frames that follow the first, {} at {} rays, "
                         "the series in turns",
                         rows.front().frames, rows.back().frames, grouped(rows.back().rays))
                   : fmt::format("times: medians of {} warm frames, the series in turns", request.repeats);
  return {
      times +
          "; tracing is generate_rays, trace, trace_moving, compact, scan and interact, the sort is order "
          "and sort, all from profiling events",
      "every frame launches all rays of its transmitters: trace.reuse, trace.diffraction and cache.kind are off" +
          std::string(figure.moves ? "" : "; where vehicles drive, it is the first frame in which something sends")};
}

// Returns the first frame in which rays are launched; 0 if there is none.
uint32_t first_sending(Simulation& probe, const Host& host) {
  for (uint32_t frame = 0; frame < probe.frame_count() && !host.interrupted(); ++frame)
    if (probe.run_frame(frame).counts.rays > 0) return frame;
  return 0;
}

// The state of a figure of orders while it is measured.
struct OrderRun {
  const OrderFigure& figure;
  const Experiment& experiment;
  const Request& request;
  const Host& host;
  Config config = {};
  uint64_t frames = 0;  // 0: the figure does not move
  uint32_t still = 0;   // the frame that is measured in that case
  double most_s = 0;
  std::vector<uint64_t> counts = {};

  // Returns the rays of all frames of a point.
  double work(uint64_t rays) const {
    return static_cast<double>(rays) * static_cast<double>(frames > 0 ? frames_at(rays, frames, request) : 1);
  }
};

// Finds mistakes in the device, the scene and the ends before anything is measured.
DeviceSummary prepare(OrderRun& run) {
  run.counts = ray_counts(series_range(run.request));
  Config first = point_config(run.figure, run.request.config, 1);
  apply(first, run.figure.series.front(), run.counts.front());
  Simulation probe(first, run.request.device);
  const DeviceSummary device = probe.device();
  run.most_s = 60 * run.request.minutes.value_or(device.gpu ? gpu_minutes : cpu_minutes);
  if (!run.figure.moves) run.still = first_sending(probe, run.host);
  if (run.figure.moves) run.frames = wanted_frames(run.request, device.gpu);
  if (run.figure.moves && has_vehicles(run.request.config))
    run.frames = std::min<uint64_t>(run.frames, probe.frame_count() - 1);
  if (run.figure.moves && run.frames == 0)
    throw ConfigError(
        fmt::format("{}: {} averages over the frames of a drive, and there is one frame alone: give trajectories "
                    "that last longer, or another [time]",
                    run.request.config.file, run.experiment.name));
  run.config = point_config(run.figure, run.request.config, run.frames);
  run.host.say(fmt::format("{}: {} series at {} to {} rays on {}", run.experiment.name, run.figure.series.size(),
                           grouped(run.counts.front()), grouped(run.counts.back()), device.name));
  return device;
}

// Tells whether the next point ends in time, if its time per ray is that of the last one.
bool in_time(const OrderRun& run, size_t next, double spent_s, double last_s) {
  if ((run.request.rays && !run.request.minutes) || next == 0) return true;
  const double next_s = last_s * run.work(run.counts[next]) / run.work(run.counts[next - 1]);
  return spent_s + next_s <= run.most_s;
}

// Adds the rows of all points. Returns a note about what was left out, or an empty text.
std::string measure_points(const OrderRun& run, std::vector<OrderRow>& rows, Findings& found) {
  uint64_t done = 0, all = 0;
  for (const uint64_t rays : run.counts) all += rays;
  Stopwatch watch;
  double spent_s = 0, last_s = 0;
  for (size_t i = 0; i < run.counts.size(); ++i) {
    const uint64_t rays = run.counts[i];
    if (run.host.interrupted()) return "";
    if (!in_time(run, i, spent_s, last_s)) {
      found.planned = found.points;
      return fmt::format(
          "left out: {} to {} rays, as the next number of rays would end later than {:g} minutes after "
          "the start on this device; --rays {}:{} or more --minutes measure them",
          grouped(rays), grouped(run.counts.back()), run.most_s / 60, rays, run.counts.back());
    }
    run.host.tell(run.experiment.name, done, all, rays_from_few);
    done += rays;
    const OrderFrames of = {.frames = run.frames > 0 ? frames_at(rays, run.frames, run.request) : 0,
                            .still = run.still,
                            .repeats = run.request.repeats,
                            .watch = run.host.watch};
    std::vector<OrderRow> point;
    const std::shared_ptr<void> guard = rows.empty() ? run.host.guard() : nullptr;  // there is nothing to keep
    try {
      point = measure_groups(run.config, run.figure.series, rays, of, run.request.device);
    } catch (const FrameStopped&) {
      return "";
    } catch (const DeviceError& error) {  // such as too little memory; earlier measurements are kept
      if (rows.empty()) throw;
      return fmt::format("left out: {} to {} rays, as the device failed: {}", grouped(rays), grouped(run.counts.back()),
                         error.what());
    }
    last_s = watch.lap();
    spent_s += last_s;
    run.host.say(point_line(run.experiment, point));
    rows.insert(rows.end(), point.begin(), point.end());
    ++found.points;
  }
  return "";
}

}  // namespace

Words order_words(const Experiment& experiment, const std::vector<OrderRow>& rows, const std::string& device) {
  const Fields fields = order_fields(rows, device);
  const OrderFigure& figure = *experiment.as<OrderFigure>();
  return {filled(experiment.paragraph, fields), judged(figure.claims, rows, figure.range, fields), gain_table(rows)};
}

Findings measure(const OrderFigure& figure, const Experiment& experiment, const Request& request, const Host& host) {
  OrderRun run{.figure = figure, .experiment = experiment, .request = request, .host = host};
  std::shared_ptr<void> guard = host.guard();  // while the kernels of the probe are compiled
  Findings found{.device = prepare(run)};
  guard.reset();
  found.planned = run.counts.size();
  std::vector<OrderRow> rows;
  const std::string left_out = measure_points(run, rows, found);
  if (rows.empty()) return found;
  found.figure = order_figure(experiment.name, experiment.title + ", " + found.device.name, figure.series,
                              csv_of(order_columns(figure.moves), rows));
  found.words = order_words(experiment, rows, found.device.name);
  found.notes = notes_of(figure, rows, request);
  if (!left_out.empty()) {
    found.notes.push_back(left_out);
    host.say(experiment.name + ": " + left_out);
  }
  return found;
}

}  // namespace wavetracer::study
