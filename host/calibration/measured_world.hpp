// SPDX-License-Identifier: Apache-2.0
// The paths of all measured links, found and solved once; then only their fields are evaluated, for one set of
// materials and turns of antennas after the other. Where ends move, the paths are solved again.
#pragma once
#include <array>
#include <complex>
#include <functional>
#include <map>
#include <string>
#include <vector>
#include "calibration/computed.hpp"
#include "calibration/end_places.hpp"
#include "calibration/measured.hpp"
#include "calibration/measured_places.hpp"
#include "calibration/parameters.hpp"
#include "simulation/frame.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer::calibration {

// Everything that is fitted: materials in the order of the records that fields use, and ends.
struct Inputs {
  std::vector<device::wt_material> materials;
  EndPlaces ends;
};

// Refuses what can be fitted in a world by an exception.
using WorldCheck = std::function<void(const NamedRecords& materials, const EndPlaces& ends)>;

class MeasuredWorld {
 public:
  // Finds the paths from the transmitters of a configuration to measured places (measured_places()). Throws ConfigError
  // or InputError for a world that does not fit the files. moves: inputs with ends in other places will come. watch:
  // watches all frames, which throw FrameStopped if it cancels them. check: may refuse the world before kernels are
  // compiled for it.
  MeasuredWorld(const Config& config, const std::vector<MeasuredFile>& files, const std::string& device,
                bool moves = false, FrameObserver watch = {}, const WorldCheck& check = {});

  // From now on, values have the profiles of delays in so many bins; 0: none.
  void want_profiles(double bin_s, size_t bins) {
    profile_bin_s_ = bin_s;
    profile_bins_ = bins;
  }
  const NamedRecords& materials() const { return materials_; }
  // The ends of the configuration.
  const EndPlaces& ends() const { return ends_; }
  // Positions of the points of all files, in file coordinates of the scene, one file after the other.
  std::vector<glm::dvec3> places() const;
  // Names of the transmitters of the points.
  std::vector<std::string> transmitters() const;
  // Finds the fields of all paths with these inputs, and returns the values of the points. Where the ends are elsewhere
  // than in the last frame, or were moved to get there, paths are found anew. From now on, values() evaluates those
  // paths alone that make all but this share of the power of their link; the others keep their power.
  std::vector<Computed> weigh(const Inputs& inputs, double share_left_out);
  // Values of the points with these inputs, after weigh(). Where ends are elsewhere than in the last frame, the paths
  // of the sequences of surfaces and edges that are known are solved again.
  std::vector<Computed> values(const Inputs& inputs);
  // Frames that were solved again for other places of ends.
  size_t frames_solved() const { return frames_solved_; }
  size_t paths() const { return frame_.paths.size(); }
  size_t paths_that_matter() const { return kept_.size(); }
  const std::vector<std::string>& warnings() const { return frame_.warnings; }
  const DeviceSummary& device() const { return setup_.device; }

 private:
  MeasuredPlaces places_;
  Setup setup_;
  FrameLoop frames_;
  EndPlaces ends_;
  FrameResult frame_;
  NamedRecords materials_;
  Inputs of_frame_;         // those that the paths of frame_ were computed with
  bool found_here_ = true;  // they were found where the ends are, and not brought along from elsewhere
  bool weighed_ = false;    // kept_ to dependents_ are about frame_
  double share_left_out_ = 0;
  size_t frames_solved_ = 0, profile_bins_ = 0;
  double profile_bin_s_ = 0;
  std::vector<uint32_t> kept_;  // rows of frame_.paths that matter
  Paths strong_;                // their columns, with the fields of base_
  RowChoice strong_rows_;
  Inputs base_;
  std::vector<double> rest_;  // for each link of the frame the power of its other paths
  // For a material, the places in strong_ of the paths that depend on it, and their rows.
  struct Dependent {
    std::vector<uint32_t> places;
    RowChoice rows;
  };
  std::map<size_t, Dependent> dependents_;

  WorldState state_at(const EndPlaces& ends) const;
  FrameResult frame_at(const EndPlaces& ends);
  void solve(const Inputs& inputs, bool find_anew);
  void keep_strong();
  std::vector<std::array<std::complex<double>, 4>> fields(const RowChoice& rows, const Inputs& inputs);
  const Dependent& dependent(size_t material);
  // Power of these rows of a link, in the sense of path_gain_db.
  double power_of_rows(const Paths& paths, size_t first, size_t end) const;
  Computed of_link(const Paths& paths, size_t first, size_t end, double rest) const;
  std::vector<Computed> computed(const Paths& paths, const std::vector<double>& rest) const;
};

}  // namespace wavetracer::calibration
