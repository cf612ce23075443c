// The city and the vehicles of a run, loaded again from the files that its configuration names.
// They may have changed or gone since: whoever draws them goes on without what cannot be had, and says so.
#pragma once
#include <string>
#include <vector>
#include "results/saved_run.hpp"
#include "scene/streets.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

struct SavedWorld {
  Config config;  // of the run's text; defaults where it cannot be parsed by this version
  Scene scene;    // recentred: file coordinate = scene.origin_m + vertex; empty where it could not be loaded
  std::vector<Scene> models;  // likewise, in the coordinates of the model
  std::vector<uint32_t>
      instance_model;                 // of each SavedRun::instances() the index into models, no_instance where unknown
  std::vector<Street> streets;        // in file coordinates; empty where none are known
  std::vector<std::string> warnings;  // what is missing, and why
};

// with_wedges: also the edges that diffract, whatever the run computed. Never throws for files that are missing or bad.
SavedWorld load_saved_world(const SavedRun& run, bool with_wedges = false);

}  // namespace wavetracer
