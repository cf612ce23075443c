// SPDX-License-Identifier: Apache-2.0
// Loads the city and the vehicles of a run again from the files that its configuration names.
// The files may have changed or gone: pictures are then drawn without the missing objects, and a warning says so.
#pragma once
#include <string>
#include <vector>
#include "results/saved_run.hpp"
#include "scene/streets.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

struct SavedWorld {
  Config config;              // configuration of the run; defaults if this version cannot parse it
  Scene scene;                // recentred: file coordinate = scene.origin_m + vertex; empty if it could not be loaded
  std::vector<Scene> models;  // the same, in the coordinates of the model
  std::vector<uint32_t>
      instance_model;           // for each of SavedRun::instances(), the index in models, or no_instance if unknown
  std::vector<Street> streets;  // in file coordinates; empty if none are known
  std::vector<std::string> warnings;  // missing objects, with reasons
};

// with_wedges: also finds the edges that diffract, whether or not the run computed them. Never throws for files that
// are missing or bad.
SavedWorld load_saved_world(const SavedRun& run, bool with_wedges = false);

}  // namespace wavetracer
