// SPDX-License-Identifier: Apache-2.0
// Measures point by point: settings in groups that share the device, then the same at depth 1 or by transmitter.
// Each group drives a drive once; its first frame is cold.
#include "study/cache_study.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <memory>
#include "output/median.hpp"
#include "simulation/name_pattern.hpp"
#include "study/interleaved_caches.hpp"
#include "study/ray_counts.hpp"
#include "study/run.hpp"
#include "study/worlds.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/stages.hpp"

namespace wavetracer::study {
namespace {

constexpr uint64_t most_cpu_frames = 20;

double mean(std::vector<double> values) {
  RunningMean mean;
  for (const double value : values) mean.add(value);
  return mean.mean();
}

CacheRow row_of(const CacheStudy& study, const Setting& setting, const CacheSubject& subject, const std::string& drive,
                uint64_t rays) {
  const CacheConfig& cache = subject.simulation.config().cache;
  const bool still = subject.simulation.frame_count() == 1;
  CacheRow row{.study = study.name,
               .drive = drive,
               .setting = setting.name,
               .rays = rays,
               .division = cache.division,
               .position_step_m = cache.position_step_m,
               .frames = subject.warm.size(),
               .cold = summarised(subject.cold, median),
               .warm = summarised(subject.warm, still ? median : mean),
               .cold_error = summarised(subject.cold, error_of_median),
               .warm_error = summarised(subject.warm, still ? error_of_median : error_of_mean),
               .order_s = subject.order_s.mean(),
               .frame_s = median(subject.frame_s),
               .cold_counts = counts_of(subject.first),
               .counts = {subject.segments.mean(), subject.lookups.mean(), subject.hits.mean(), subject.groups.mean(),
                          subject.shared.mean()},
               .cache = subject.last.cache,
               .paths = subject.paths.mean(),
               .sequences = subject.sequences.mean(),
               .error = subject.error.mean(),
               .l2_error_m = subject.centroid_m.standard_error()};
  if (cache.statistics) row.entries = summary_of(subject.last.cache_entries);
  if (study.centroids) row.centroids = subject.centroids;
  return row;
}

// Sets the noise of the times of frames, without what frames of a drive have in common.
void set_loop_noise(const std::vector<CacheSubject>& subjects, std::vector<CacheRow>& rows) {
  std::vector<std::vector<double>> samples(subjects.size());
  for (size_t i = 0; i < subjects.size(); ++i)
    for (const CacheTimes& times : subjects[i].warm) samples[i].push_back(times.loop_s);
  const std::vector<double> noise = relative_errors(samples);
  const double still = subjects.front().simulation.frame_count() == 1 ? median_noise : 1;
  for (size_t i = 0; i < rows.size(); ++i) rows[i].warm_error.loop_s = still * noise[i] * rows[i].warm.loop_s;
}

// A number of rays in a world.
struct Point {
  const CacheStudy& study;
  const Config& config;
  const std::string& drive;
  uint64_t rays, frames;
  const Request& request;
  StudyWatch& watch;

  // Returns subjects after their frames; nothing if it was stopped.
  std::vector<CacheSubject> measured(const std::vector<Setting>& settings, const Config& of) const {
    std::vector<CacheSubject> subjects = make_subjects(settings, of, rays, request.device);
    if (!run_frames(subjects, frames, study.empty_tables, request, watch)) subjects.clear();
    return subjects;
  }
};

// Returns the rows of one point; nothing if it was stopped.
std::vector<CacheRow> measure_point(const Point& at) {
  const CacheStudy& study = at.study;
  std::vector<CacheRow> rows;
  for (size_t begin = 1; begin < study.settings.size(); begin += study.at_once) {
    const size_t end = std::min(begin + study.at_once, study.settings.size());
    std::vector<Setting> group = {study.settings.front()};
    group.insert(group.end(), study.settings.begin() + begin, study.settings.begin() + end);
    const std::vector<CacheSubject> subjects = at.measured(group, at.config);
    if (subjects.empty()) return {};
    require_segments(subjects.front().segments.mean(), at.config);
    std::vector<CacheRow> found;
    for (size_t i = 0; i < group.size(); ++i) found.push_back(row_of(study, group[i], subjects[i], at.drive, at.rays));
    set_loop_noise(subjects, found);
    set_savings(found);
    rows.insert(rows.end(), found.begin() + (begin == 1 ? 0 : 1), found.end());
  }
  return rows;
}

// Adds a row of depth 1 per setting: of frames that end there. Errors are left out: deeper paths are missing. Returns
// false if it was stopped.
bool add_first_depth(const Point& at, std::vector<CacheRow>& rows) {
  const std::vector<Setting> settings = cut_settings(at.study);
  Config cut = at.config;
  cut.trace.max_depth = cut.cache.first_depth = 1;
  const std::vector<CacheSubject> subjects = at.measured(settings, cut);
  for (size_t i = 0; i < subjects.size(); ++i) {
    rows.push_back(row_of(at.study, settings[i], subjects[i], at.drive, at.rays));
    rows.back().depth = 1;
    rows.back().error = {};
  }
  return !subjects.empty();
}

// Adds a row per transmitter: its rays alone, in its region of the same table. Regions alternate, so that a slow phase
// of the machine affects all of them. Errors are left out: frames have no reference among other regions. Returns false
// if it was stopped.
bool add_regions(const Point& at, const std::vector<std::string>& transmitters, std::vector<CacheRow>& rows) {
  const std::vector<Setting> cut = cut_settings(at.study);
  std::vector<Setting> settings;
  const size_t count = std::min(transmitters.size(), most_regions);
  for (size_t region = 0; region < count; ++region)
    for (const Setting& setting : cut)
      settings.push_back({setting.name, [apply = setting.apply, name = transmitters[region]](Config& config) {
                            apply(config);
                            config.links.transmitters = {name};
                          }});
  const std::vector<CacheSubject> subjects = at.measured(settings, at.config);
  if (subjects.empty()) return false;
  for (size_t i = 0; i < subjects.size(); ++i) {
    if (subjects[i].segments.mean() == 0) continue;  // none of its links is computed
    rows.push_back(row_of(at.study, settings[i], subjects[i], at.drive, at.rays));
    rows.back().region = static_cast<uint32_t>(i / cut.size() + 1);
    rows.back().transmitter = transmitters[i / cut.size()];
    rows.back().error = {};
  }
  return true;
}

// Returns the names of the ends that [links] uses as transmitters.
std::vector<std::string> wanted_transmitters(const Config& config) {
  std::vector<std::string> out;
  for (const RadioEnd& end : config.transmitters)
    if (std::ranges::any_of(config.links.transmitters,
                            [&](const std::string& pattern) { return matches(pattern, end.name); }))
      out.push_back(end.name);
  return out;
}

std::string point_line(const CacheStudy& study, const std::vector<CacheRow>& point) {
  std::string text = fmt::format("{}: {} rays, {}:", study.name, grouped(point.front().rays), point.front().drive);
  for (const CacheRow& row : point)
    if (is_whole(row))
      text += fmt::format("{} {} {} ms", &row == &point.front() ? "" : ";", row.setting, plain(1e3 * row.warm.loop_s));
  return text;
}

}  // namespace

std::vector<Setting> cut_settings(const CacheStudy& study) {
  std::vector<Setting> out = study.settings;
  std::erase_if(out, [](const Setting& setting) { return setting.whole_only; });
  return out;
}

std::vector<uint64_t> study_rays(const CacheStudy& study, const Request& request, bool gpu) {
  if (!request.rays) return gpu && !request.quick ? study.rays : study.few_rays;
  std::vector<uint64_t> counts;
  for (const uint64_t rays : study.rays)
    if (request.rays->first <= rays && rays <= request.rays->last) counts.push_back(rays);
  if (!counts.empty()) return counts;
  std::vector<std::string> known;
  for (const uint64_t rays : study.rays) known.push_back(grouped(rays));
  throw ConfigError(fmt::format("--rays {}:{}: {} is measured at {} rays, of which none lies in it",
                                request.rays->first, request.rays->last, study.name, fmt::join(known, "; ")));
}

uint64_t study_frames(const CacheStudy& study, const Request& request, bool gpu) {
  if (request.frames > 0) return request.frames;
  const uint64_t frames = gpu ? study.most_frames : most_cpu_frames;
  return request.quick ? frames / 5 : frames;
}

CacheMeasurement measure_study(const CacheStudy& study, const Request& request, const Host& host) {
  CacheMeasurement out;
  std::shared_ptr<void> guard = host.guard();  // until there is a point to keep
  Config first = request.config;
  first.trace.rays = study.rays.front();
  uncached(first);
  const Simulation probe(first, request.device);  // finds mistakes before anything is measured
  out.device = probe.device();
  const bool gpu = out.device.gpu;
  const std::vector<uint64_t> counts = study_rays(study, request, gpu);
  const bool own = request.config.file != built_in_city_name || probe.frame_count() > 1;
  std::vector<std::string> drives = study.drives;
  if (own) drives = {probe.frame_count() > 1 ? "own" : "still"};
  const bool moves = drives.front() != "still";
  out.frames = moves ? study_frames(study, request, gpu) : 0;
  if (own && moves) out.frames = std::min(out.frames, probe.frame_count() - 1);
  out.planned = counts.size() * drives.size();
  host.say(fmt::format("{}: {} settings at {} to {} rays on {}", study.name, study.settings.size(),
                       grouped(counts.front()), grouped(counts.back()), out.device.name));
  const std::vector<std::string> transmitters = wanted_transmitters(probe.config());
  StudyWatch watch{host, study.name};
  for (const uint64_t rays : counts)
    watch.all += rays * drives.size() * frames_of_point(study, transmitters.size(), out.frames + 1, request.repeats);
  for (const std::string& drive : drives) {
    const Config config = own || !moves ? request.config : with_traffic(request.config, drive, out.frames);
    for (const uint64_t rays : counts) {
      watch.rays = rays;
      const Point at{study, config, drive, rays, out.frames + 1, request, watch};
      std::vector<CacheRow> point = measure_point(at);
      if (!point.empty() && study.first_depth && !add_first_depth(at, point)) point.clear();
      if (!point.empty() && study.by_transmitter && !add_regions(at, transmitters, point)) point.clear();
      if (point.empty()) return out;  // it was stopped
      guard.reset();
      host.say(point_line(study, point));
      out.rows.insert(out.rows.end(), point.begin(), point.end());
      ++out.points;
    }
  }
  return out;
}

}  // namespace wavetracer::study
