// SPDX-License-Identifier: Apache-2.0
// The tables [[target_model]] and [[target]]: points that scatter by radar cross sections (docs/targets.md).
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "wavetracer/choice.hpp"

namespace wavetracer {

// Laws of 3GPP TR 38.901 V19, 7.9.2.1, or one of the user's own. -points: with a point on each side and the roof.
using TargetKind = Choice<"custom", "person", "person-aspects", "uav-small", "uav-large", "vehicle", "vehicle-points",
                          "agv", "agv-points">;

struct TargetModelConfig {  // [[target_model]]
  std::string name;
  std::string on;  // ids or types of vehicles that are such a target, * and ? as in shells
  TargetKind kind = "custom";
  std::vector<std::array<double, 3>> points_m = {};  // from the middle of the footprint: ahead, left, up
  std::vector<double> rcs_dbsm = {};                 // with kind = "custom": of each point, or one of all
  // With kind = "custom": a row for each lobe: point, azimuth and its width, zenith and its width, degrees, peak in
  // dBsm, range in dB.
  std::vector<std::array<double, 7>> lobes = {};
  std::array<double, 3> bistatic_db{0, 0, 0};        // with kind = "custom": k of wt_target_law
  std::optional<double> xpr_db = {};                 // not given: that of the kind
  std::optional<std::array<double, 3>> size_m = {};  // length, width, height; not given: that of the vehicle or kind

  bool custom() const { return kind == "custom"; }
};

struct TargetConfig {  // [[target]]: a target that stands
  std::string name, model;
  std::array<double, 3> position_m{0, 0, 0};       // the middle of its footprint, file coordinates
  std::array<double, 3> orientation_deg{0, 0, 0};  // yaw, pitch, roll (intrinsic z, y, x)
  std::array<double, 3> velocity_m_s{0, 0, 0};     // file axes; for Doppler shifts only
};

}  // namespace wavetracer
