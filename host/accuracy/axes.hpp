// What `wavetracer accuracy` varies, one axis at a time from the user's own settings.
// A setting is what --set takes, so every row can be repeated with `wavetracer run`.
#pragma once
#include <cstdint>
#include <string>
#include <vector>
#include "study/ray_counts.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer::accuracy {

struct Setting {
  std::string axis;               // rays, auto, reuse, depth, diffraction_rays, or the name of a Feature
  std::string name;               // on its axis
  std::vector<std::string> keys;  // KEY=VALUE over the user's own
  std::string needs = {};         // the Feature without which it says nothing; empty: none
  bool leads = false;             // frames before those that count come first, so that these have something to reuse
};

// Settings, and what all of them are compared with.
struct Axis {
  Setting reference;
  std::vector<Setting> settings;
};

constexpr study::RayRange default_rays{10000, 1000000};

// drive: there are frames that may reuse what earlier ones have found. The reference has ten times the most rays.
std::vector<Axis> axes(const Config& own, bool drive, study::RayRange rays);

// The Features that are on or off by keys, and what they are called at the start of a sentence.
struct Mechanism {
  std::string feature, words;
  std::vector<std::string> on, off;
};
const std::vector<Mechanism>& mechanisms();

}  // namespace wavetracer::accuracy
