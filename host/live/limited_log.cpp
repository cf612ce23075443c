// SPDX-License-Identifier: Apache-2.0
#include "live/limited_log.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace wavetracer::live {

LimitedLog::LimitedLog(Log log, int most_per_second) : log_(std::move(log)), most_per_second_(most_per_second) {}

void LimitedLog::say(const std::string& line, Clock::time_point now) {
  catch_up(now);
  if (said_ == 0) began_ = now;
  if (said_ == most_per_second_) {
    ++left_out_;
    return;
  }
  ++said_;
  log_(line);
}

void LimitedLog::catch_up(Clock::time_point now) {
  if (said_ == 0 || now - began_ < std::chrono::seconds(1)) return;
  finish();
  said_ = 0;
}

void LimitedLog::finish() {
  if (left_out_ > 0)
    log_(fmt::format("{} more lines about clients were left out: the log has {} of them per second at most", left_out_,
                     most_per_second_));
  left_out_ = 0;
}

}  // namespace wavetracer::live
