// SPDX-License-Identifier: Apache-2.0
// Numbers of groups of paths (wavetracer/paths.hpp), from the waves that each path belongs to.
#pragma once
#include <span>
#include <vector>

#include "wavetracer/device/field_records.h"
#include "wavetracer/paths.hpp"

namespace wavetracer {

// The columns of groups, a row per path, as Paths has them.
struct GroupColumns {
  std::vector<GroupNumbers> group;
  std::vector<GroupWeights> weight;
};

// Returns the columns of groups. waves: those of each path, link by link; shared: the records that they name. Groups of
// a link are numbered from 0 in the order in which its paths name them. Two paths without diffraction never share a
// wave. room: columns whose memory may be used. Runs on all cores.
GroupColumns number_groups(std::span<const device::wt_path_wave> waves, std::span<const device::wt_path_waves> shared,
                           GroupColumns room = {});

}  // namespace wavetracer
