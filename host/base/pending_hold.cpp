// One mutex for all of a process: names appear seldom.
#include "base/pending_hold.hpp"

namespace wavetracer {
namespace {
std::mutex naming;
}  // namespace

std::unique_lock<std::mutex> hold_pending() { return std::unique_lock(naming); }

}  // namespace wavetracer
