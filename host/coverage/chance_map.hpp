// SPDX-License-Identifier: Apache-2.0
// Maps over samples of the inputs: for each cell the mean and the deviation of its path gain, and the probability that
// a value reaches a threshold. A sample adds to sums, so memory grows with cells and not with samples.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>
#include "coverage/coverage_map.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/link_figures.hpp"

namespace wavetracer::coverage {

// Returns the names of values that may have a threshold: rows of layer_kinds.
std::vector<std::string> tested_names();

// Reads NAME=VALUE texts of an option; each name may be there once. Throws ConfigError, which names the option.
std::vector<Threshold> read_thresholds(const std::vector<std::string>& texts, const std::string& option);

class ChanceMap {
 public:
  // map: with its shape, transmitters, `tx` and thresholds. cell_of: cell of each receiver, or no_cell.
  ChanceMap(Map map, std::vector<uint32_t> cell_of, const RadioConfig& radio);

  // Sets the values of cells without errors of the inputs.
  void set_nominal(std::span<const LinkFigures> links);
  void add_sample(std::span<const LinkFigures> links);
  // Returns the map with its layers: the path gain without errors, and those of chance_kinds.
  Map finish();

 private:
  std::vector<Cell> cells(std::span<const LinkFigures> links) const;

  Map map_;
  std::vector<uint32_t> cell_of_;
  const RadioConfig radio_;
};

}  // namespace wavetracer::coverage
