// SPDX-License-Identifier: Apache-2.0
// The tables [[target_model]], [[target_part]] and [[target]]: points that scatter by radar cross sections
// (docs/targets.md).
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "wavetracer/choice.hpp"

namespace wavetracer {

// Laws of 3GPP TR 38.901 V19, 7.9.2.1, one of the user's own, or the facets of the vehicle's body. -points: with a
// point on each side and the roof.
using TargetKind = Choice<"custom", "person", "person-aspects", "uav-small", "uav-large", "vehicle", "vehicle-points",
                          "agv", "agv-points", "body">;

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

  std::optional<double> piece_m = {};  // with kind = "body": largest edge of a piece; not given: 0.25
  std::optional<uint32_t> bounces =
      {};  // with kind = "body": facets in a chain, the last of which scatters; not given: 1

  bool custom() const { return kind == "custom"; }
  bool body() const { return kind == "body"; }
  bool bounces_within() const { return body() && bounces.value_or(1) > 1; }
};

// A wheel rolls with its vehicle; a limb swings as it walks.
using TargetPartKind = Choice<"wheel", "limb">;

struct TargetPartConfig {  // [[target_part]]: points that move on the targets of a model
  std::string model;       // name of the [[target_model]]
  TargetPartKind kind = "wheel";
  std::array<double, 3> pivot_m{0, 0, 0};  // centre of the wheel or joint of the limb: ahead, left, up
  std::array<double, 3> axis{0, 1, 0};     // the axis about which it turns or swings: ahead, left, up
  std::optional<double> radius_m = {};     // a wheel's
  std::optional<double> length_m = {};     // a limb's, which hangs down from the joint
  std::optional<double> swing_deg = {};    // a limb's: the largest angle from hanging down
  std::optional<double> stride_m = {};     // a limb's: the way in which it swings forth and back once
  double phase_deg = 0;                    // phase of turn or swing where the track begins
  uint32_t points = 4;                     // around the rim, or from the joint to the end of the limb
  double rcs_dbsm = 0;                     // the same for each point

  bool wheel() const { return kind == "wheel"; }
};

struct TargetConfig {  // [[target]]: a target that stands
  std::string name, model;
  std::array<double, 3> position_m{0, 0, 0};       // the middle of its footprint, file coordinates
  std::array<double, 3> orientation_deg{0, 0, 0};  // yaw, pitch, roll (intrinsic z, y, x)
  std::array<double, 3> velocity_m_s{0, 0, 0};     // file axes; for Doppler shifts only
  std::string vehicle_type = {};                   // the type whose body stands there; empty: there is none
};

}  // namespace wavetracer
