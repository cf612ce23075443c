// SPDX-License-Identifier: Apache-2.0
// Plots a run: chooses suitable figures and draws them.
// The scene is drawn if it can still be loaded.
#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>
#include "plots/figure.hpp"
#include "plots/link_series.hpp"
#include "results/saved_run.hpp"

namespace wavetracer::plots {

// Names that --what takes; they are also the names of the files.
constexpr std::array<std::string_view, 9> plot_names{"gain",     "pdp",  "delay-time",    "doppler",      "angles",
                                                     "coverage", "rays", "range-doppler", "micro-doppler"};
constexpr size_t link_plots = 5;  // the first of these show links

struct PlotChoice {
  std::vector<std::string> what;  // some of plot_names; empty: all that suit the run
  LinkChoice link;
  std::string grid;        // for coverage; empty: every grid of the run
  std::string layer;       // for coverage, a name of coverage::layer_kinds; empty: received power or path gain
  std::string radar = {};  // for range-doppler and micro-doppler, a radar of radar.h5; empty: its first one
  std::vector<Format> formats = {Format::svg};
};

struct PlotReport {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> warnings;  // missing results, with reasons and advice
};

// Throws ConfigError for names that the run does not have and for plots that do not suit it, InputError if plots other
// than rays are asked of a run without paths, RuntimeError if a file cannot be written.
PlotReport plot_run(const SavedRun& run, const PlotChoice& choice, const std::filesystem::path& folder);

}  // namespace wavetracer::plots
