// How far what rays hit in one frame of a drive is what the same rays hit in another.
// A. Zhdanov, TU Munich, 2014, section 6.3.2, equation 6.4 and figure 6.13.
#pragma once
#include <string>
#include <vector>
#include "study/claim.hpp"
#include "study/coherence.hpp"
#include "study/columns.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer::study {

// A frame beside an earlier one, at one depth.
struct FramePair {
  std::string against;  // "first": frame 0, "previous": the frame before
  uint32_t frame = 0;
  uint32_t depth = 0;
  DepthCoherence found;
  double by_place = undefined;  // equation 6.4, normalised, of points paired by their place in lists of hits
};

// A transmitter that drives straight on.
struct Drive {
  glm::dvec3 start_m{0}, velocity_m_s{0};  // file axes
  double step_s = 0.01;                    // 100 frames a second
  uint32_t frames = 201;                   // 2 s

  double time_s(uint32_t frame) const { return step_s * frame; }
  double moved_m(uint32_t frame) const;
  glm::dvec3 place_m(uint32_t frame) const { return start_m + time_s(frame) * velocity_m_s; }
};

// That of the first transmitter: as its velocity says, or at 13.9 m/s along +x.
Drive plan_drive(const Config& config);
// Throws ConfigError where the way leads through the scene. `end`: its name.
void check_way(const Drive& drive, const Scene& scene, const std::string& end);

// A frame beside another, depth by depth.
std::vector<FramePair> compare_pair(const FrameHits& a, const FrameHits& b, const std::string& against, uint32_t frame);

Columns<FramePair> frame_columns(const Drive& drive);

// "at depth 1 if paired by ray and bounce, at no depth if paired by place": where means of subsequent frames are
// greater.
Judge<FramePair> correlate_more_than(double share);

}  // namespace wavetracer::study
