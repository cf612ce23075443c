// SPDX-License-Identifier: Apache-2.0
// Settings of a study while they are measured: one Simulation each, all existing at once, with their frames interleaved
// so that a slow phase of the machine affects all.
#pragma once
#include <cstdint>
#include <string>
#include <vector>
#include "study/cache_rows.hpp"
#include "study/compared_caches.hpp"
#include "study/study_watch.hpp"

namespace wavetracer::study {

// Sums over a setting's frames.
struct CacheSubject {
  explicit CacheSubject(Simulation s) : simulation(std::move(s)) {}

  Simulation simulation;
  std::vector<CacheTimes> cold, warm;
  std::vector<double> frame_s;
  RunningMean order_s;  // the sort of a warm frame
  RunningMean segments, lookups, hits, groups, shared, paths, sequences;
  PathErrorMean error;
  RunningMean centroid_m;
  std::vector<CentroidError> centroids;
  FrameResult first, last;
};

// Counts segments of a frame.
CacheCounts counts_of(const FrameResult& frame);

// Makes subjects of a config with this number of rays. Throws ConfigError if a setting contradicts it.
std::vector<CacheSubject> make_subjects(const std::vector<Setting>& settings, const Config& config, uint64_t rays,
                                        const std::string& device);

// Runs a world without motion `repeats` times, cold and warm; else `frames` frames after the cold one. With empty
// tables all frames are cold, and count as warm ones. Returns false if it was stopped.
bool run_frames(std::vector<CacheSubject>& subjects, uint64_t frames, bool empty_tables, const Request& request,
                StudyWatch& watch);

}  // namespace wavetracer::study
