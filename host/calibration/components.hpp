// SPDX-License-Identifier: Apache-2.0
// Gathers components of links, such as those of a channel sounder, into points.
#pragma once
#include <map>
#include <string>
#include <tuple>
#include <vector>
#include "calibration/measured.hpp"
#include "calibration/spreads.hpp"

namespace wavetracer::calibration {

struct Component {
  double delay_ns = 0, azimuth_deg = 0;  // azimuth: counter-clockwise from x; 0 if the file has none
};

class Components {
 public:
  // Adds a component of the point, whose level is the component's own. position: the name of its place; empty: its
  // coordinates are that. Returns the point of the first component of the same position if the place or the group of
  // the two differ, else nullptr.
  const MeasuredPoint* add(const MeasuredPoint& point, const std::string& position, const Component& component);
  // Returns a point for each place and link, in the order of their first components: the level is the sum of the
  // powers. with_delays, with_azimuths: the file has them; without delays points have no components. A spread of 0, as
  // of one component, is not given.
  std::vector<MeasuredPoint> points(bool with_delays, bool with_azimuths) const;

 private:
  struct Gathered {
    MeasuredPoint first;
    Spreads spreads;
    std::vector<DelayPower> components;
  };
  // position or place, tx, rx, orientation
  using Key = std::tuple<std::string, std::array<double, 3>, std::string, std::string, std::array<double, 3>>;
  std::map<Key, size_t> known_;
  std::vector<Gathered> gathered_;
};

}  // namespace wavetracer::calibration
