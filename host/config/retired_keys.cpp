// SPDX-License-Identifier: Apache-2.0
// Each key has a row, which stays, since configurations of old runs stay too.
#include "config/retired_keys.hpp"

#include <algorithm>
#include <array>

namespace wavetracer::config {

namespace {

const std::array retired_keys{
    RetiredKey{"trace.join",
               "trace.join no longer exists, because rays towards the horizon find more paths in the same time: "
               "remove the key, and keep trace.directions = \"horizon\""},
};

}  // namespace

const RetiredKey* find_retired(std::string_view key) {
  const auto found = std::ranges::find(retired_keys, key, &RetiredKey::key);
  return found == retired_keys.end() ? nullptr : &*found;
}

std::vector<std::string> without_retired_keys() {
  std::vector<std::string> out;
  for (const RetiredKey& retired : retired_keys) out.push_back(std::string(retired.key) + "=false");
  return out;
}

}  // namespace wavetracer::config
