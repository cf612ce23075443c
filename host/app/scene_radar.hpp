// SPDX-License-Identifier: Apache-2.0
// `wavetracer scene radar`.
#pragma once
#include <CLI/App.hpp>

namespace wavetracer::app {

void add_radar(CLI::App& scene);

}  // namespace wavetracer::app
