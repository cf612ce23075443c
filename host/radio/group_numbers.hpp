// SPDX-License-Identifier: Apache-2.0
// Numbers of groups of paths (wavetracer/paths.hpp), from the waves that each path belongs to.
#pragma once
#include <span>

#include "wavetracer/device/field_records.h"
#include "wavetracer/paths.hpp"

namespace wavetracer {

// Sets the columns `group` and `group_weight`. waves: those of each path; shared: the records that they name. Groups of
// a link are numbered from 0 in the order in which its paths name them. Two paths without diffraction never share a
// wave. Runs on all cores.
void number_groups(Paths& paths, std::span<const device::wt_path_wave> waves,
                   std::span<const device::wt_path_waves> shared);

}  // namespace wavetracer
