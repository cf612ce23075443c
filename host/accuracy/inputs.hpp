// SPDX-License-Identifier: Apache-2.0
// Computes the effect of input errors on the results: positions of antennas and vehicles, heights, and materials of
// walls are varied together and one after the other, and every link gets an interval of gain and delay spread.
// Sequences of surfaces are kept from sample to sample (trace.reuse): only some samples launch rays.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>
#include "accuracy/input_errors.hpp"
#include "plots/figure.hpp"
#include "study/run.hpp"
#include "wavetracer/late.hpp"

namespace wavetracer::accuracy {

struct InputRequest {
  std::string file;               // file of the configuration
  std::vector<std::string> sets;  // in the form of --set
  std::string device;
  uint32_t frames = 5, samples = 64, discover_every = 8;
  uint64_t seed = 1;
  InputErrors errors;
};

struct InputInterval {
  double nominal, low, middle, high;  // low and high: 5% and 95% of the samples
};

struct InputRow {
  uint32_t frame = 0;
  std::string tx, rx;
  uint32_t samples = 0;  // samples in which the link has a path
  InputInterval gain_db{}, delay_spread_ns{};
  // Variance that each input makes alone, as a share of the sum of these; and that sum divided by the variance of all
  // together: 1 if effects add up. NaN if nothing varies.
  std::array<double, input_count> gain_share{}, delay_spread_share{};
  double gain_explained = 0, delay_spread_explained = 0;
};

struct InputStudy {
  std::vector<InputRow> rows;
  std::array<bool, input_count> varied{};
  uint32_t samples = 0;
  uint64_t frames_run = 0, frames_with_rays = 0;  // over all samples
  LateCounts late;                                // paths that samples without rays lacked
  double nominal_s = 0, sample_s = 0;             // time of the first frame, and average time of a sample
  bool stopped = false;
};

// Returns rows of the frames that are complete, even if it was interrupted. Throws ConfigError if there is no link or
// sequences cannot be kept, and the errors of Simulation.
InputStudy study_inputs(const InputRequest& request, const study::Host& host);

// Returns inputs.csv, a row per link and frame, and lines for a terminal: medians over links and the widest intervals.
std::string inputs_csv(const InputStudy& study);
std::string inputs_text(const InputStudy& study);
// Plots the share of links with intervals up to a width. There must be a row.
plots::Figure inputs_figure(const InputStudy& study);

}  // namespace wavetracer::accuracy
