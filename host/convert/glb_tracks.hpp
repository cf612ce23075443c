// SPDX-License-Identifier: Apache-2.0
// The places of vehicles and ends in the chosen frames, as keys of an animation.
// A frame whose time does not increase, or is not a number, has no key.
#pragma once
#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <vector>
#include "convert/convert.hpp"

namespace wavetracer {

// The place of a node in each frame; nothing while it is absent.
struct NodeTrack {
  struct Key {
    glm::dvec3 position_m{0};
    glm::dquat rotation{1, 0, 0, 0};
  };
  std::vector<std::optional<Key>> keys;

  bool ever_present() const {
    return std::ranges::any_of(keys, [](const auto& key) { return key.has_value(); });
  }
  bool always_present() const {
    return std::ranges::all_of(keys, [](const auto& key) { return key.has_value(); });
  }
};

struct NodeTracks {
  std::vector<float> times_s;  // times since the first frame
  std::vector<NodeTrack> vehicles, transmitters, receivers;

  // Reads the rows after the first one, a frame at a time. first: the frame of options.first_row.
  NodeTracks(const SavedRun& run, const ExportOptions& options, const SavedFrame& first);

 private:
  void add(const SavedFrame& frame, float time_s);
};

}  // namespace wavetracer
