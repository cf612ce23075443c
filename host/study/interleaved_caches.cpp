// SPDX-License-Identifier: Apache-2.0
// A world of one frame is traced cold, then warm, again and again; a drive is driven once, and its first frame is cold.
// Errors are against the first subject, which has no cache.
#include "study/interleaved_caches.hpp"
#include <fmt/format.h>
#include <cmath>
#include "config/contradictions.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/stages.hpp"

namespace wavetracer::study {
namespace {

void note_cold(CacheSubject& subject, FrameResult frame) {
  subject.cold.push_back(cache_times(frame.seconds));
  subject.first = std::move(frame);
}

void note_warm(CacheSubject& subject, FrameResult frame, const PathError& error) {
  const CacheCounts counts = counts_of(frame);
  subject.warm.push_back(cache_times(frame.seconds));
  subject.frame_s.push_back(stage_seconds(frame.seconds, Stage::frame));
  subject.order_s.add(part_seconds(frame.seconds, FramePart::order));
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

// A frame of all subjects: with an empty table, or the one that earlier frames left, or (both) counted as either.
struct Round {
  uint64_t number;
  uint32_t frame;
  bool cold, warm;
};

// Each round starts with another subject. Returns false if it was stopped between two frames.
bool run_whole_round(std::vector<CacheSubject>& subjects, const Round& round, StudyWatch& watch) {
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

// Returns false if it was stopped.
bool run_round(std::vector<CacheSubject>& subjects, const Round& round, StudyWatch& watch) {
  try {
    return run_whole_round(subjects, round, watch);
  } catch (const FrameStopped&) {
    return false;
  }
}

// A setting may contradict the config that all of them share.
void check_setting(const Setting& setting, const Config& applied) {
  for (const config::Contradiction& found : config::contradictions(applied))
    throw ConfigError(fmt::format("{}with the setting \"{}\", {}", applied.file.empty() ? "" : applied.file + ": ",
                                  setting.name, found.what));
}

}  // namespace

CacheCounts counts_of(const FrameResult& frame) {
  return {static_cast<double>(frame.counts.segments), static_cast<double>(frame.cache.lookups),
          static_cast<double>(frame.cache.hits), static_cast<double>(frame.cache.groups),
          static_cast<double>(frame.cache.shared)};
}

std::vector<CacheSubject> make_subjects(const std::vector<Setting>& settings, const Config& config, uint64_t rays,
                                        const std::string& device) {
  std::vector<CacheSubject> subjects;
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

bool run_frames(std::vector<CacheSubject>& subjects, uint64_t frames, bool empty_tables, const Request& request,
                StudyWatch& watch) {
  for (CacheSubject& subject : subjects) subject.simulation.observe(watch.host.watch);
  if (frames <= 1) {
    if (!run_round(subjects, {0, 0, true, false}, watch)) return false;  // warms the device up, and is not counted
    for (CacheSubject& subject : subjects) subject.cold.clear();
    for (uint32_t repeat = 0; repeat < request.repeats; ++repeat)
      for (const bool cold : {true, false})
        if (!run_round(subjects, {repeat, 0, cold || empty_tables, !cold}, watch)) return false;
    return true;
  }
  for (uint32_t frame = 0; frame < frames; ++frame)
    if (!run_round(subjects, {frame, frame, frame == 0 || empty_tables, frame > 0}, watch)) return false;
  return true;
}

}  // namespace wavetracer::study
