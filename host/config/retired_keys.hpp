// Keys of earlier versions that are no more: what to do instead, in place of "unknown key".
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace wavetracer::config {

// All were switches that are off unless asked for. Runs write every key down, so `false` is read and asks for nothing.
struct RetiredKey {
  std::string_view key;  // trace.join
  std::string advice;    // what became of it and what to do
};

// nullptr where there was no such key.
const RetiredKey* find_retired(std::string_view key);

// `key=value` texts by which a configuration that was valid once is read for what its run saw, whatever it asked for.
std::vector<std::string> without_retired_keys();

}  // namespace wavetracer::config
