// SPDX-License-Identifier: Apache-2.0
// A log for lines that clients cause: so many per second are passed on, and the number of the others is said later.
#pragma once
#include <string>

#include "live/server.hpp"
#include "live/solver.hpp"

namespace wavetracer::live {

class LimitedLog {
 public:
  LimitedLog(Log log, int most_per_second);
  void say(const std::string& line, Clock::time_point now);
  // Says how many lines were left out, once a second has passed since the first line of their second. Call it often.
  void catch_up(Clock::time_point now);
  // The same at once, at the end.
  void finish();

 private:
  Log log_;
  int most_per_second_, said_ = 0;
  long left_out_ = 0;
  Clock::time_point began_ = {};  // the begin of the present second
};

}  // namespace wavetracer::live
