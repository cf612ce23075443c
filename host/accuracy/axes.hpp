// SPDX-License-Identifier: Apache-2.0
// The axes of `wavetracer accuracy`, which are varied one at a time from the user's own settings.
// A setting is a list of --set options, so every row can be repeated with `wavetracer run`.
#pragma once
#include <cstdint>
#include <string>
#include <vector>
#include "study/ray_counts.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer::accuracy {

struct Setting {
  std::string axis;               // rays, auto, reuse, depth, diffraction_rays, edge_rays, or the name of a Feature
  std::string name;               // name on its axis
  std::vector<std::string> keys;  // KEY=VALUE settings that override the user's own
  std::string needs = {};         // the Feature without which the row has no meaning; empty: none
  bool leads = false;             // frames before the measured ones are run first, so that there is something to reuse
};

// An axis: settings, and the reference that they are compared with.
struct Axis {
  Setting reference;
  std::vector<Setting> settings;
};

constexpr study::RayRange default_rays{10000, 1000000};

// drive: there are frames that may reuse results of earlier ones. The reference of rays has ten times the most rays, or
// with `certify`, or where the user's own settings ask for beams, it is found by beams, which miss nothing.
std::vector<Axis> axes(const Config& own, bool drive, study::RayRange rays, bool certify = false);

// Do beams take less time than ten times the rays? They do where there are reflections alone, and not many in a path.
// Then the list of beams is the reference that nothing is missing from.
bool beams_are_cheap(const Config& config);

// Features that keys switch on or off, and their names at the start of a sentence.
struct Mechanism {
  std::string feature, words;
  std::vector<std::string> on, off;
};
const std::vector<Mechanism>& mechanisms();

}  // namespace wavetracer::accuracy
