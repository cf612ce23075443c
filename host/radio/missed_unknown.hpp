// SPDX-License-Identifier: Apache-2.0
// Words for runs that do not know what their rays have missed.
#pragma once
#include <string>

#include "wavetracer/config.hpp"

namespace wavetracer {

// The reason, for frames that count as MissedCounts::unknown under this configuration: a clause without a full stop.
std::string missed_unknown_reason(const Config& config);

}  // namespace wavetracer
