// SPDX-License-Identifier: Apache-2.0
// Compares a configuration with measured values, fits its materials and antennas to them, and judges the fit by points
// that were held out of it.
#pragma once
#include <glm/vec3.hpp>
#include <string>
#include <vector>
#include "calibration/agreement.hpp"
#include "calibration/computed.hpp"
#include "calibration/fit.hpp"
#include "calibration/measured.hpp"
#include "calibration/parameters.hpp"
#include "study/run.hpp"
#include "wavetracer/choice.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer::calibration {

// The points that share an offset between measured and computed levels.
using Offsets = Choice<"all", "file", "tx", "none">;

// The measured spreads that the fit uses; the others are only compared.
using FittedSpreads = Choice<"all", "delay", "azimuth", "none">;

struct Request {
  std::string config;             // file of the configuration
  std::vector<std::string> sets;  // in the form of --set
  std::vector<std::string> measured;
  std::string level, device;
  std::string crs = {};                       // see MeasuredOptions
  std::vector<std::string> patterns = {"*"};  // of chosen_parameters(); empty: nothing but offsets
  Offsets offsets = "all";
  FittedSpreads spreads = "none";
  double profile_bin_ns = 0;             // the fit uses profiles of delays in bins of this width; 0: it uses none
  double prior = 1;                      // usual standard deviations are multiplied by it
  std::vector<std::string> errors = {};  // NAME=VALUE, see Priors
  uint32_t folds = 4;                    // blocks of places, each of which is held out once; 0 or 1: none are
};

struct FittedPoint {
  size_t file = 0, point = 0;  // in Calibration::files
  std::string tx;
  glm::dvec3 place_m{0};  // file coordinates of the scene
  double measured_db = 0;
  // Values of the configuration, of the fit to all points, and of the fit to all blocks but the point's own. Offsets
  // are those of the last two; they are not in the gains.
  Computed before{}, after{}, held_out{};
  double offset_db = 0, offset_held_out_db = 0;
  uint32_t fold = 0;  // block of the point
};

struct Calibration {
  Config config;  // that of the request, with the fitted values
  std::vector<MeasuredFile> files;
  std::vector<FittedPoint> points;
  std::vector<Parameter> parameters;
  FitResult fit;
  std::vector<std::string> offset_names;
  std::vector<Agreement> agreements;
  double profile_bin_ns = 0;  // that of the request
  DeviceSummary device;
  std::vector<std::string> notes, warnings;
  size_t paths = 0, paths_that_matter = 0, evaluations = 0;
  size_t frames_solved = 0;       // for other places of ends
  double solve_s = 0, fit_s = 0;  // times of finding the paths, and of all fits
  bool stopped = false;           // it was interrupted, and nothing below `files` is complete
};

// Throws ConfigError, InputError or DeviceError.
Calibration calibrate(const Request& request, const study::Host& host);

}  // namespace wavetracer::calibration
