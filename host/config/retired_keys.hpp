// SPDX-License-Identifier: Apache-2.0
// Keys of earlier versions that no longer exist, with advice instead of "unknown key".
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace wavetracer::config {

// All were switches that are off by default. Runs write down every key, so `false` is accepted and has no effect.
struct RetiredKey {
  std::string_view key;  // such as trace.join
  std::string advice;    // the change of the key, and what to do
};

// Returns nullptr if there was no such key.
const RetiredKey* find_retired(std::string_view key);

// Returns `key=value` texts that make a configuration of an older version valid, for reading what its run saw, even if
// it asked for a retired feature.
std::vector<std::string> without_retired_keys();

}  // namespace wavetracer::config
