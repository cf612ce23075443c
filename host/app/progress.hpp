// Progress on stderr: lines, and on a terminal a bar.
// NO_COLOR (https://no-color.org) keeps escape sequences away.
#pragma once
#include <cstdint>
#include <string>

namespace wavetracer::app {

class Progress {
 public:
  // prefix: before each line, which of several processes it is.
  explicit Progress(std::string prefix = "");
  ~Progress() { clear_bar(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void line(const std::string& text);
  void bar(const std::string& what, uint64_t done, uint64_t total);

 private:
  std::string prefix_;
  bool terminal_, colour_;
  size_t bar_width_ = 0;  // characters of the bar on the screen
  void clear_bar();
};

}  // namespace wavetracer::app
