// SPDX-License-Identifier: Apache-2.0
// The scene of figure 6.5 for tests that need any world of the thesis.
#pragma once
#include "study/experiment.hpp"

namespace wavetracer::study {

inline Config city() { return experiment_config(find_experiment("figure-6.5"), "", {}); }

}  // namespace wavetracer::study
