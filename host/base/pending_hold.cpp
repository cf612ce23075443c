// SPDX-License-Identifier: Apache-2.0
// There is one mutex for the process, since files get their final names seldom.
#include "base/pending_hold.hpp"

namespace wavetracer {
namespace {
std::mutex naming;
}  // namespace

std::atomic<uint64_t>& final_names() {
  static std::atomic<uint64_t> count{0};
  return count;
}

std::unique_lock<std::mutex> hold_pending() { return std::unique_lock(naming); }

}  // namespace wavetracer
