// SPDX-License-Identifier: Apache-2.0
// Makes one HTML page of a run that needs no network and opens from the disk: city, vehicles, ends, paths, charts. If
// not all paths fit, the weakest are left out and counted.
#pragma once
#include <cstdint>
#include <limits>
#include <string>
#include <vector>
#include "results/saved_run.hpp"
#include "results/saved_world.hpp"

namespace wavetracer {

// A size that browsers open in a second or two.
constexpr uint64_t page_bytes = 60'000'000;

struct ViewOptions {
  // Numbers of frames, both ends included.
  uint32_t first_frame = 0, last_frame = std::numeric_limits<uint32_t>::max();
  uint64_t max_paths = 0;           // the strongest of all frames; 0: as many as keep the page below max_bytes
  std::string title = {};           // empty: the run's folder
  uint64_t max_bytes = page_bytes;  // limit of the page, if the scene leaves room for 8 MB of frames
  uint64_t area_paths = 3'000'000;  // pages of more paths to cells of grids have no values of areas, which take long
  double reload_s = 0;              // the page reloads itself after this time; 0: never
};

struct ViewPage {
  std::string html;  // ASCII
  size_t frames = 0;
  uint64_t paths = 0;                 // number of paths on the page
  std::vector<std::string> warnings;  // missing or omitted parts; the page shows them too
};

// Throws ConfigError if the run has no frame between those two, InputError if its file is damaged.
ViewPage make_view(const SavedRun& run, const ViewOptions& options);
// Does the same for a run whose world was loaded already, with outlines.
ViewPage make_view(const SavedRun& run, const SavedWorld& world, const ViewOptions& options);

}  // namespace wavetracer
