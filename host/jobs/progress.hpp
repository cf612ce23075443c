// SPDX-License-Identifier: Apache-2.0
// Shows progress on stderr: lines, and the state of a task: a bar on a terminal, otherwise a line now and then.
// NO_COLOR (https://no-color.org) suppresses escape sequences.
#pragma once
#include <chrono>
#include <cstdint>
#include <string>
#include "base/progress_unit.hpp"

namespace wavetracer {

// Returns text such as "elapsed 1:05, 12.3 frames/s, 0:40 left". done: of total; begun: the number that was done when
// the clock started. Rate and time left are missing until something is done.
std::string progress_words(double seconds, uint64_t begun, uint64_t done, uint64_t total, const ProgressUnit& unit);

class Progress {
 public:
  // prefix: before each line; it tells which of several processes it is.
  explicit Progress(std::string prefix = "");
  ~Progress() { end(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void line(const std::string& text);
  // what: the current step ("frame 12", "rays"); unit: of the count. The clock starts again with another unit or total.
  // A terminal gets a bar at most ten times a second; other outputs get a line every ten seconds.
  void bar(const std::string& what, uint64_t done, uint64_t total, const ProgressUnit& unit);
  // Begins a step without parts, which has no bar: only within() tells of it.
  void step(const std::string& what);
  // Adds details of the current step, if it takes long: "frame 12, half of its rays".
  void within(const std::string& words);
  // Removes the bar, before something else is printed.
  void end();

 private:
  using Clock = std::chrono::steady_clock;
  std::string prefix_;
  bool terminal_, colour_;
  size_t bar_width_ = 0;  // number of the bar's characters on the screen
  std::string what_;      // the current step
  ProgressUnit unit_;     // that of the current task
  uint64_t total_ = 0, begun_ = 0, last_done_ = 0;
  Clock::time_point start_, said_;
  void draw(const std::string& what);
};

}  // namespace wavetracer
