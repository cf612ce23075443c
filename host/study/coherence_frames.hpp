// SPDX-License-Identifier: Apache-2.0
// Compares the hits of rays in one frame of a drive with those of the same rays in another.
// A. Zhdanov, TU Munich, 2014, section 6.3.2, equation 6.4 and figure 6.13.
#pragma once
#include <functional>
#include <string>
#include <vector>
#include "base/csv_columns.hpp"
#include "study/claim.hpp"
#include "study/coherence.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer::study {

// A frame compared with an earlier one, at one depth, or whole (depth 0): all waypoints of its rays, one ray after the
// other, as the waypoint buffer of the thesis holds them.
struct FramePair {
  std::string against;  // "first": frame 0, "previous": the frame before
  uint32_t frame = 0;
  uint32_t depth = 0;
  DepthCoherence found;
  double by_place = undefined;  // equation 6.4, normalised, for points paired by their index in lists of hits
  // For whole frames, the same where the rays were launched in no order, as without reordering.
  double by_place_unordered = undefined;
};

// The frames in which a transmitter launches its rays: consecutive numbers, times, and its positions (file axes).
// Functions count frames from the first of them.
struct Drive {
  uint32_t transmitter = 0;  // in the world
  std::string name = "";     // name of the transmitter
  uint32_t first = 0;        // frame of the world
  std::vector<double> at_s = {};
  std::vector<glm::dvec3> place_m = {};

  uint32_t frames() const { return static_cast<uint32_t>(at_s.size()); }
  double time_s(uint32_t frame) const { return at_s[frame] - at_s[0]; }
  double moved_m(uint32_t frame) const;  // the length of its way
};

// Plans the first `frames` frames, or as many as there are, in which one transmitter is always present. A transmitter
// on a vehicle is preferred, since it moves; among those, the first that is present long enough. Throws ConfigError if
// none is present in `least` consecutive frames. state: of each of `count` frames; where: begins the message.
Drive plan_drive(const std::vector<RadioEnd>& transmitters, const std::function<WorldState(uint32_t)>& state,
                 uint64_t count, const glm::dvec3& origin_m, uint32_t frames, uint32_t least, const std::string& where);
// Throws ConfigError if the way passes through objects of the scene.
void check_way(const Drive& drive, const Scene& scene);

// Returns the points where rays were reflected, ray by ray, each in the order of its depths: the whole output. order:
// the launch indices of the rays, one after the other; empty: ascending.
std::vector<glm::dvec3> whole_output(const FrameHits& hits, const std::vector<uint32_t>& order = {});
// Returns the same order of rays at each call: launch indices at random, each once.
std::vector<uint32_t> random_order(size_t rays);

// Compares a frame with another, depth by depth, and then whole.
std::vector<FramePair> compare_pair(const FrameHits& a, const FrameHits& b, const std::string& against, uint32_t frame);

Columns<FramePair> frame_columns(const Drive& drive);

// Answers for each pairing and depth, and for whole outputs by place, whether subsequent frames correlate by a mean
// from `low` to `high`.
Judge<FramePair> correlate_on_average(double low, double high);
// In the same way: whether their correlation falls below `low`, and whether it rises to `high`, or to four fifths of
// it, but no further.
Judge<FramePair> correlation_falls_below(double low);
Judge<FramePair> correlation_rises_to(double high);

}  // namespace wavetracer::study
