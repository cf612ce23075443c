// Progress on stderr: lines, and how far a task is: a bar on a terminal, elsewhere a line now and then.
// NO_COLOR (https://no-color.org) keeps escape sequences away.
#pragma once
#include <chrono>
#include <cstdint>
#include <string>

namespace wavetracer {

// "elapsed 1:05, 12.3 frames/s, 0:40 left". done: of total; begun: how much of it was there when the clock began. No
// rate and no time left before anything is done.
std::string progress_words(double seconds, uint64_t begun, uint64_t done, uint64_t total, const std::string& unit);

class Progress {
 public:
  // prefix: before each line, which of several processes it is.
  explicit Progress(std::string prefix = "");
  ~Progress() { end(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void line(const std::string& text);
  // what: is done now ("frame 12", "rays"); unit: of what is counted. The clock begins anew with another unit or total.
  // A terminal gets a bar ten times a second at most; anything else a line every ten seconds.
  void bar(const std::string& what, uint64_t done, uint64_t total, const std::string& unit);
  // More about what is done now, where one step of the last bar takes long: "frame 12, half of its rays".
  void within(const std::string& words);
  // The bar goes, before something else is printed.
  void end();

 private:
  using Clock = std::chrono::steady_clock;
  std::string prefix_;
  bool terminal_, colour_;
  size_t bar_width_ = 0;     // characters of the bar on the screen
  std::string what_, unit_;  // of the task in progress
  uint64_t total_ = 0, begun_ = 0, last_done_ = 0;
  Clock::time_point start_, said_;
  void draw(const std::string& what);
};

}  // namespace wavetracer
