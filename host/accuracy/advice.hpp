// What the rows of a study mean: which keys to set, and what may be left out knowingly.
#pragma once
#include <string>
#include <vector>
#include "accuracy/study.hpp"

namespace wavetracer::accuracy {

// The shares of the power that a recommendation may lose.
constexpr double allowed_losses[] = {1e-3, 1e-5};

// The fastest measured row of these axes, references left out, that loses at most so much of the power; null: none.
const Row* cheapest(const Study& study, const std::vector<std::string>& axes, double lost_power);

// One sentence or a few an item, with the keys to set.
std::vector<std::string> recommendations(const Study& study);

// "none", "0.31%", "?" where it is not defined.
std::string share_text(double share);

}  // namespace wavetracer::accuracy
