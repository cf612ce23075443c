// SPDX-License-Identifier: Apache-2.0
// Figures of a radar: the range-Doppler map of a frame, and the spectra of all frames over time.
#pragma once
#include "plots/figure.hpp"
#include "results/saved_radar.hpp"

namespace wavetracer::plots {

// when: ", 0.5 s" or empty. Colours cover the 70 dB below the strongest cell. A map without a finite power has no
// figure, which the caller checks by has_power.
Figure range_doppler_figure(const RadarMap& map, const std::string& when);
Figure micro_doppler_figure(const RadarMap& spectra, const std::string& of);
bool has_power(const RadarMap& map);

}  // namespace wavetracer::plots
