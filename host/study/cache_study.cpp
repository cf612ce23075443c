// A Simulation a setting, all alive at once, their frames interleaved so that a slow spell of the machine hits all.
// A world of one frame is traced cold, then warm, again and again; a drive is driven once, its first frame being cold.
#include "study/cache_study.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include "config/contradictions.hpp"
#include "output/median.hpp"
#include "study/ray_counts.hpp"
#include "study/run.hpp"
#include "study/study_watch.hpp"
#include "study/worlds.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/stages.hpp"

namespace wavetracer::study {
namespace {

constexpr uint64_t cpu_frames = 20;

// What a setting's frames add up to.
struct Subject {
  explicit Subject(Simulation s) : simulation(std::move(s)) {}

  Simulation simulation;
  std::vector<CacheTimes> cold, warm;
  std::vector<double> frame_s;
  RunningMean loop_s, segments, lookups, hits, groups, shared, paths, sequences;
  PathErrorMean error;
  RunningMean centroid_m;
  std::vector<CentroidError> centroids;
  FrameResult first, last;
};

CacheCounts counts_of(const FrameResult& frame) {
  return {static_cast<double>(frame.counts.segments), static_cast<double>(frame.cache.lookups),
          static_cast<double>(frame.cache.hits), static_cast<double>(frame.cache.groups),
          static_cast<double>(frame.cache.shared)};
}

CacheCounts counts_of(const FrameResult& frame, uint32_t depth) {
  const auto at = [depth](const std::vector<uint64_t>& counts) {
    return depth <= counts.size() ? static_cast<double>(counts[depth - 1]) : 0.0;
  };
  CacheCounts counts{at(frame.segments_per_depth), at(frame.cache.lookups_per_depth), at(frame.cache.hits_per_depth)};
  counts.shared = at(frame.cache.shared_per_depth);
  return counts;
}

void note_cold(Subject& subject, FrameResult frame) {
  subject.cold.push_back(cache_times(frame.seconds));
  subject.first = std::move(frame);
}

void note_warm(Subject& subject, FrameResult frame, const PathError& error) {
  const CacheCounts counts = counts_of(frame);
  subject.warm.push_back(cache_times(frame.seconds));
  subject.frame_s.push_back(stage_seconds(frame.seconds, "frame"));
  subject.loop_s.add(subject.warm.back().loop_s);
  subject.segments.add(counts.segments);
  subject.lookups.add(counts.lookups);
  subject.hits.add(counts.hits);
  subject.groups.add(counts.groups);
  subject.shared.add(counts.shared);
  subject.paths.add(static_cast<double>(frame.counts.paths));
  subject.sequences.add(static_cast<double>(frame.counts.sequences));
  subject.error.add(error);
  if (!std::isnan(error.l2_m)) {
    subject.centroid_m.add(error.l2_m);
    subject.centroids.push_back({frame.frame, error.l2_m, subject.centroid_m.mean()});
  }
  subject.last = std::move(frame);
}

double mean(std::vector<double> values) {
  RunningMean mean;
  for (const double value : values) mean.add(value);
  return mean.mean();
}

// A frame of all subjects: with an empty table, or the one that earlier frames left, or (both) counted as either.
struct Round {
  uint64_t number;
  uint32_t frame;
  bool cold, warm;
};

// Another subject runs first each time. False: stopped.
bool run_round(std::vector<Subject>& subjects, const Round& round, StudyWatch& watch) {
  std::vector<FrameResult> results(subjects.size());
  for (size_t i = 0; i < subjects.size(); ++i) {
    if (!watch.next()) return false;
    const size_t at = (i + round.number) % subjects.size();
    if (round.cold) subjects[at].simulation.forget();
    results[at] = subjects[at].simulation.run_frame(round.frame);
  }
  const Paths reference = results.front().paths;
  for (size_t i = 0; i < subjects.size(); ++i) {
    if (round.cold) note_cold(subjects[i], results[i]);
    if (round.warm) {
      const PathError error = path_error(reference, results[i].paths);
      note_warm(subjects[i], std::move(results[i]), error);
    }
  }
  return true;
}

// A standing world `repeats` times, cold and warm; else `frames` frames after the cold one. With empty tables all are
// cold, and count as warm ones do. False: stopped.
bool run_frames(std::vector<Subject>& subjects, uint64_t frames, bool empty_tables, const Request& request,
                StudyWatch& watch) {
  if (frames <= 1) {
    if (!run_round(subjects, {0, 0, true, false}, watch)) return false;  // warms the device up, and is not counted
    for (Subject& subject : subjects) subject.cold.clear();
    for (uint32_t repeat = 0; repeat < request.repeats; ++repeat)
      for (const bool cold : {true, false})
        if (!run_round(subjects, {repeat, 0, cold || empty_tables, !cold}, watch)) return false;
    return true;
  }
  for (uint32_t frame = 0; frame < frames; ++frame)
    if (!run_round(subjects, {frame, frame, frame == 0 || empty_tables, frame > 0}, watch)) return false;
  return true;
}

// A setting may contradict what the config says for all of them.
void check_setting(const Setting& setting, const Config& applied) {
  for (const config::Contradiction& found : config::contradictions(applied))
    throw ConfigError(fmt::format("{}with the setting \"{}\", {}", applied.file.empty() ? "" : applied.file + ": ",
                                  setting.name, found.what));
}

std::vector<Subject> make_subjects(const std::vector<Setting>& settings, const Config& config, uint64_t rays,
                                   const std::string& device) {
  std::vector<Subject> subjects;
  for (const Setting& setting : settings) {
    Config applied = config;
    applied.trace.rays = rays;
    uncached(applied);
    setting.apply(applied);
    check_setting(setting, applied);
    subjects.emplace_back(Simulation(applied, device));
  }
  return subjects;
}

CacheRow row_of(const CacheStudy& study, const Setting& setting, const Subject& subject, const std::string& drive,
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
               .frame_s = median(subject.frame_s),
               .cold_counts = counts_of(subject.first),
               .counts = {subject.segments.mean(), subject.lookups.mean(), subject.hits.mean(), subject.groups.mean(),
                          subject.shared.mean()},
               .cache = subject.last.cache,
               .paths = subject.paths.mean(),
               .sequences = subject.sequences.mean(),
               .error = subject.error.mean()};
  if (!still) row.warm_error_s = subject.loop_s.standard_error();
  if (study.centroids) row.centroids = subject.centroids;
  return row;
}

// The rows of one point; none where it was stopped.
std::vector<CacheRow> measure_point(const CacheStudy& study, const Config& config, const std::string& drive,
                                    uint64_t rays, uint64_t frames, const Request& request, StudyWatch& watch) {
  std::vector<CacheRow> rows;
  for (size_t begin = 1; begin < study.settings.size(); begin += study.at_once) {
    const size_t end = std::min(begin + study.at_once, study.settings.size());
    std::vector<Setting> group = {study.settings.front()};
    group.insert(group.end(), study.settings.begin() + begin, study.settings.begin() + end);
    std::vector<Subject> subjects = make_subjects(group, config, rays, request.device);
    if (!run_frames(subjects, frames, study.empty_tables, request, watch)) return {};
    require_segments(subjects.front().segments.mean(), config);
    std::vector<CacheRow> found;
    for (size_t i = 0; i < group.size(); ++i) found.push_back(row_of(study, group[i], subjects[i], drive, rays));
    set_savings(found);
    rows.insert(rows.end(), found.begin() + (begin == 1 ? 0 : 1), found.end());
  }
  return rows;
}

// A row per depth: what a frame that ends there takes more than one that ends before. No clock runs inside a kernel, so
// this is as far as a frame can be told apart.
std::vector<CacheRow> measure_depths(const CacheStudy& study, const Config& config, const std::string& drive,
                                     uint64_t rays, uint64_t frames, const Request& request, StudyWatch& watch) {
  std::vector<CacheRow> rows;
  std::vector<CacheTimes> cold_before(study.settings.size()), warm_before(study.settings.size());
  for (uint32_t depth = 1; depth <= config.trace.max_depth; ++depth) {
    Config cut = config;
    cut.trace.max_depth = depth;
    std::vector<Subject> subjects = make_subjects(study.settings, cut, rays, request.device);
    if (!run_frames(subjects, frames, study.empty_tables, request, watch)) return {};
    for (size_t i = 0; i < subjects.size(); ++i) {
      CacheRow row = row_of(study, study.settings[i], subjects[i], drive, rays);
      row.depth = depth;
      const CacheTimes cold = row.cold, warm = row.warm;
      row.cold = cold - cold_before[i];
      row.warm = warm - warm_before[i];
      row.cold_counts = counts_of(subjects[i].first, depth);
      row.counts = counts_of(subjects[i].last, depth);
      cold_before[i] = cold;
      warm_before[i] = warm;
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::string point_line(const CacheStudy& study, const std::vector<CacheRow>& point) {
  std::string text = fmt::format("{}: {} rays, {}:", study.name, grouped(point.front().rays), point.front().drive);
  for (const CacheRow& row : point)
    if (row.depth == 0)
      text += fmt::format("{} {} {} ms", &row == &point.front() ? "" : ";", row.setting, plain(1e3 * row.warm.loop_s));
  return text;
}

}  // namespace

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
  const uint64_t frames = gpu ? study.most_frames : cpu_frames;
  return request.quick ? frames / 5 : frames;
}

CacheMeasurement measure_study(const CacheStudy& study, const Request& request, const Host& host) {
  CacheMeasurement out;
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
  StudyWatch watch{host, study.name};
  for (const uint64_t rays : counts)
    watch.all += rays * drives.size() * frames_of_point(study, request.config, out.frames + 1, request.repeats);
  for (const std::string& drive : drives) {
    const Config config = own || !moves ? request.config : with_traffic(request.config, drive, out.frames);
    for (const uint64_t rays : counts) {
      watch.rays = rays;
      std::vector<CacheRow> point = measure_point(study, config, drive, rays, out.frames + 1, request, watch);
      if (!point.empty() && study.by_depth) {
        const std::vector<CacheRow> depths = measure_depths(study, config, drive, rays, out.frames + 1, request, watch);
        if (depths.empty()) point.clear();
        point.insert(point.end(), depths.begin(), depths.end());
      }
      if (point.empty()) return out;  // stopped
      host.say(point_line(study, point));
      out.rows.insert(out.rows.end(), point.begin(), point.end());
      ++out.points;
    }
  }
  return out;
}

}  // namespace wavetracer::study
