// SPDX-License-Identifier: Apache-2.0
// The data of link plots: a few links over all frames, and every path of the first of them.
// A run is read one frame at a time; only shown data are kept.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>
#include "radio/links.hpp"
#include "results/saved_run.hpp"

namespace wavetracer::plots {

// The user's choice; an empty name means any.
struct LinkChoice {
  std::string tx, rx;
  std::optional<uint32_t> frame;  // number of the frame
};

struct LinkMoment {
  double time_s = 0;
  LinkFigures figures;  // paths = 0 and a gain of -inf if there is no path, or the link was not computed
};

struct PathPoint {
  uint32_t frame = 0;  // number of the frame
  double time_s = 0;
  size_t kind = 0;  // index in path_kinds
  double delay_s = 0, gain_db = 0, doppler_hz = 0;
  double aod_theta_rad = 0, aod_phi_rad = 0, aoa_theta_rad = 0, aoa_phi_rad = 0;
};

struct LinkSeries {
  std::vector<Link> links;                       // the strongest first, by the power of all frames together
  std::vector<std::vector<LinkMoment>> moments;  // for each link, one entry per frame of the run
  std::vector<PathPoint> paths;                  // paths of the first link in all frames, in the order of the file
  uint32_t frame = 0;  // the number of the chosen frame, or else of the frame in which the first link is strongest
  double frame_time_s = 0;

  std::vector<PathPoint> paths_of_frame() const;
};

// Returns at most `most` links. Links to receivers of grids count only if rx names one. It returns no link if no link
// is named and none has a path. Throws ConfigError for names and frames that the run does not have (with the nearest
// names), InputError for a named link without a path.
LinkSeries link_series(const SavedRun& run, const LinkChoice& choice, const std::vector<std::string>& grids,
                       size_t most);

std::string link_name(const SavedRun& run, const Link& link);  // "TX -> RX"

}  // namespace wavetracer::plots
