// SPDX-License-Identifier: Apache-2.0
// The progress of a study of caches, and whether it should stop.
#pragma once
#include <algorithm>
#include <cstdint>
#include <string>
#include "study/cache_study.hpp"
#include "study/run.hpp"

namespace wavetracer::study {

// The progress of a study in launched rays, since the largest numbers of rays take most of the time.
struct StudyWatch {
  const Host& host;
  const std::string& name;
  uint64_t rays = 0, done = 0, all = 0;  // rays: of a frame
  // Begins another frame; returns false if it was stopped.
  bool next() {
    host.tell(name, done, all, rays_from_few);
    done += rays;
    return !host.interrupted();
  }
};

// Returns the frames of all settings at a point.
inline uint64_t frames_of_point(const CacheStudy& study, size_t transmitters, uint64_t frames, uint32_t repeats) {
  const size_t cut = cut_settings(study).size();
  const uint64_t groups = (study.settings.size() - 1 + study.at_once - 1) / study.at_once,
                 settings = study.settings.size() - 1 + groups + (study.first_depth ? cut : 0) +
                            (study.by_transmitter ? std::min(transmitters, most_regions) * cut : 0);
  return settings * (frames <= 1 ? 1 + 2 * uint64_t{repeats} : frames);
}

}  // namespace wavetracer::study
