// A bar is one line that is written over with spaces and carriage returns, which every terminal knows.
// Anything that is no terminal gets whole lines only.
#include "app/progress.hpp"
#include <fmt/format.h>
#include <unistd.h>
#include <cstdlib>
#include <iostream>
#include <utility>

namespace wavetracer::app {

Progress::Progress(std::string prefix)
    : prefix_(std::move(prefix)), terminal_(isatty(STDERR_FILENO) == 1), colour_(false) {
  const char* no_color = std::getenv("NO_COLOR");
  colour_ = terminal_ && (no_color == nullptr || *no_color == '\0');
}

void Progress::clear_bar() {
  if (bar_width_ > 0) std::cerr << "\r" << std::string(bar_width_, ' ') << "\r" << std::flush;
  bar_width_ = 0;
}

void Progress::line(const std::string& text) {
  clear_bar();
  std::cerr << (colour_ ? "\x1b[2m" + prefix_ + text + "\x1b[0m\n" : prefix_ + text + "\n") << std::flush;
}

void Progress::bar(const std::string& what, uint64_t done, uint64_t total) {
  if (!terminal_ || total < 2) return;
  clear_bar();
  constexpr uint64_t width = 40;
  const size_t filled = static_cast<size_t>(width * done / total);
  const std::string text =
      fmt::format("{} [{}{}] {}/{}", what, std::string(filled, '#'), std::string(width - filled, '.'), done, total);
  std::cerr << text << std::flush;
  bar_width_ = text.size();
}

}  // namespace wavetracer::app
