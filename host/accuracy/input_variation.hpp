// SPDX-License-Identifier: Apache-2.0
// Samples of the inputs: a Latin hypercube with columns for each antenna, vehicle and material. A seed gives the same
// samples for every frame, and whichever inputs are varied.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>
#include "accuracy/input_errors.hpp"
#include "radio/field_tables.hpp"
#include "simulation/run_plan.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer::accuracy {

// Reads the configuration of a study, without ray cache and waypoints. Throws ConfigError if it has [[live_vehicle]]
// tables, and the errors of load_config.
Config varied_config(const std::string& file, const std::vector<std::string>& sets);

class InputVariation {
 public:
  // plan outlives this. at_rest: for each receiver, whether it stays where it is; it has no columns then.
  InputVariation(const RunPlan& plan, const InputErrors& errors, uint32_t samples, uint64_t seed,
                 const std::vector<bool>& at_rest);

  // The inputs that have an error, and that the run has at all.
  Varied varied() const;
  // Materials without errors.
  const std::vector<device::wt_material>& materials() const { return materials_; }
  // Adds the errors of a sample to the inputs that are varied.
  void apply(size_t sample, const Varied& varied, WorldState& state, std::vector<device::wt_material>& materials) const;

 private:
  glm::dvec3 vehicle_shift(const std::vector<double>& row, size_t i) const;
  void move(EndState& end, const std::vector<double>& row, size_t at, const Varied& varied) const;

  const RunPlan& plan_;
  const InputErrors errors_;
  const std::vector<device::wt_material> materials_;
  std::vector<size_t> receivers_;               // first column of each receiver, or no_column
  size_t vehicles_ = 0, first_material_ = 0;    // first columns
  std::vector<std::vector<double>> hypercube_;  // a row for each sample
};

}  // namespace wavetracer::accuracy
