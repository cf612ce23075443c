// What plots of links show: a few links along all frames, and every path of the first of them.
// A run is read a frame at a time; only what is shown is kept.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>
#include "radio/links.hpp"
#include "results/saved_run.hpp"

namespace wavetracer::plots {

// What the user asks for; an empty name is any.
struct LinkChoice {
  std::string tx, rx;
  std::optional<uint32_t> frame;  // number
};

struct LinkMoment {
  double time_s = 0;
  LinkFigures figures;  // paths = 0 and a gain of -inf where there is none, or the link was not asked for
};

struct PathPoint {
  uint32_t frame = 0;  // number
  double time_s = 0;
  size_t kind = 0;  // of path_kinds
  double delay_s = 0, gain_db = 0, doppler_hz = 0;
  double aod_theta_rad = 0, aod_phi_rad = 0, aoa_theta_rad = 0, aoa_phi_rad = 0;
};

struct LinkSeries {
  std::vector<Link> links;                       // the strongest first, by the power of all frames together
  std::vector<std::vector<LinkMoment>> moments;  // of each link, one per frame of the run
  std::vector<PathPoint> paths;                  // of the first link in all frames, in the order of the file
  uint32_t frame = 0;  // the number of the frame asked for, else that in which the first link is strongest
  double frame_time_s = 0;

  std::vector<PathPoint> paths_of_frame() const;
};

// At most `most` links. Links to receivers of grids count only where rx names one. No link at all where nothing is left
// that has a path and no link is named. Throws ConfigError for names and frames that the run does not have (with the
// nearest names), InputError for a named link without a path.
LinkSeries link_series(const SavedRun& run, const LinkChoice& choice, const std::vector<std::string>& grids,
                       size_t most);

// The index of an end by its name, nothing where the name is empty. option: "--tx". Throws ConfigError.
std::optional<uint32_t> find_end(const std::vector<RadioEnd>& ends, const std::string& name, const std::string& option);

// The row of a frame by its number. Throws ConfigError.
size_t find_frame(const SavedRun& run, uint32_t number);

std::string link_name(const SavedRun& run, const Link& link);  // TX -> RX

}  // namespace wavetracer::plots
