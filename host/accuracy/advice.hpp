// SPDX-License-Identifier: Apache-2.0
// Explains the rows of a study: which keys to set, and which effects may be left out.
#pragma once
#include <string>
#include <vector>
#include "accuracy/study.hpp"

namespace wavetracer::accuracy {

// Shares of the power that a recommendation may lose.
constexpr double allowed_losses[] = {1e-3, 1e-5};

// Returns the fastest measured row of these axes, except references, that loses at most this share of the power, or
// null if there is none.
const Row* cheapest(const Study& study, const std::vector<std::string>& axes, double lost_power);

// Returns one or more sentences per item, with the keys to set.
std::vector<std::string> recommendations(const Study& study);

// Returns "none", "0.31%", or "?" if the share is undefined.
std::string share_text(double share);

}  // namespace wavetracer::accuracy
