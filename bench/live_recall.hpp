// SPDX-License-Identifier: Apache-2.0
// The paths of answers that others lack.
#pragma once
#include <cstddef>
#include <nlohmann/json.hpp>

namespace wavetracer::bench {

struct LiveRecall {
  size_t reference = 0, found = 0;
  double power = 0, found_power = 0;

  // Adds the paths of two answers in JSON: those of one link are the same if their delays agree within 1e-12 s, and
  // each is matched once.
  void add(const nlohmann::json& reference, const nlohmann::json& mine);
};

}  // namespace wavetracer::bench
