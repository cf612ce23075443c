// SPDX-License-Identifier: Apache-2.0
// The paths of all measured links, found and solved once; then only their fields are evaluated, for one set of
// materials after the other.
#pragma once
#include <array>
#include <complex>
#include <map>
#include <string>
#include <vector>
#include "calibration/computed.hpp"
#include "calibration/measured.hpp"
#include "calibration/measured_places.hpp"
#include "calibration/parameters.hpp"
#include "simulation/frame.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer::calibration {

class MeasuredWorld {
 public:
  // Finds the paths from the transmitters of a configuration to measured places (measured_places()). Throws ConfigError
  // or InputError for a world that does not fit the files.
  MeasuredWorld(const Config& config, const std::vector<MeasuredFile>& files, const std::string& device);

  const NamedRecords& materials() const { return materials_; }
  // Positions of the points of all files, in file coordinates of the scene, one file after the other.
  std::vector<glm::dvec3> places() const;
  // Names of the transmitters of the points.
  std::vector<std::string> transmitters() const;
  // Finds the fields of all paths with these materials, and returns the values of the points. From now on, values()
  // evaluates those paths alone that make all but this share of the power of their link; the others keep their power.
  std::vector<Computed> weigh(const std::vector<device::wt_material>& materials, double share_left_out);
  // Values of the points with these materials, after weigh().
  std::vector<Computed> values(const std::vector<device::wt_material>& materials);
  size_t paths() const { return frame_.paths.size(); }
  size_t paths_that_matter() const { return kept_.size(); }
  const std::vector<std::string>& warnings() const { return frame_.warnings; }
  const DeviceSummary& device() const { return setup_.device; }

 private:
  MeasuredPlaces places_;
  Setup setup_;
  FrameLoop frames_;
  FrameResult frame_;
  NamedRecords materials_;
  std::vector<device::wt_material> of_frame_;  // those that the fields of frame_ were computed with
  std::vector<uint32_t> kept_;                 // rows of frame_.paths that matter
  Paths strong_;                               // their columns, with the fields of base_
  RowChoice strong_rows_;
  std::vector<device::wt_material> base_;
  std::vector<double> rest_;  // for each link of the frame the power of its other paths
  // For a material, the places in strong_ of the paths that depend on it, and their rows.
  struct Dependent {
    std::vector<uint32_t> places;
    RowChoice rows;
  };
  std::map<size_t, Dependent> dependents_;

  void keep_strong(double share_left_out);
  std::vector<std::array<std::complex<double>, 4>> fields(const RowChoice& rows,
                                                          const std::vector<device::wt_material>& materials);
  const Dependent& dependent(size_t material);
  // Power of these rows of a link, in the sense of path_gain_db.
  double power_of_rows(const Paths& paths, size_t first, size_t end) const;
  Computed of_link(const Paths& paths, size_t first, size_t end, double rest) const;
  std::vector<Computed> computed(const Paths& paths, const std::vector<double>& rest) const;
};

}  // namespace wavetracer::calibration
