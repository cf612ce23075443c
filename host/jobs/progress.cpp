// SPDX-License-Identifier: Apache-2.0
// A bar is one line that is overwritten with spaces and carriage returns, which every terminal knows.
// Outputs that are no terminal only get whole lines.
#include "jobs/progress.hpp"
#include <fmt/format.h>
#include <unistd.h>
#include <cstdlib>
#include <iostream>
#include <utility>
#include "base/digits.hpp"

namespace wavetracer {
namespace {

constexpr double bar_interval_s = 0.1, line_interval_s = 10;

// The time left of uneven units is not told before this share of them.
constexpr double told_share = 0.01;

// such as 1:05, 1:02:03
std::string clock_time(double seconds) {
  const auto whole = static_cast<uint64_t>(seconds + 0.5);
  const uint64_t hours = whole / 3600, minutes = whole / 60 % 60;
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60)
                   : fmt::format("{}:{:02}", minutes, whole % 60);
}

}  // namespace

Progress::Progress(std::string prefix)
    : prefix_(std::move(prefix)), terminal_(isatty(STDERR_FILENO) == 1), colour_(false) {
  const char* no_color = std::getenv("NO_COLOR");
  colour_ = terminal_ && (no_color == nullptr || *no_color == '\0');
}

void Progress::end() {
  if (bar_width_ > 0) std::cerr << "\r" << std::string(bar_width_, ' ') << "\r" << std::flush;
  bar_width_ = 0;
}

void Progress::line(const std::string& text) {
  end();
  std::cerr << (colour_ ? "\x1b[2m" + prefix_ + text + "\x1b[0m\n" : prefix_ + text + "\n") << std::flush;
}

void Progress::bar(const std::string& what, uint64_t done, uint64_t total, const ProgressUnit& unit) {
  if (total < 2) {
    total_ = 0;  // within() has no bar to add to
    return;
  }
  const bool first = unit != unit_ || total != total_ || done < last_done_;
  what_ = what;
  last_done_ = done;
  if (first) {
    unit_ = unit;
    total_ = total;
    begun_ = done;
    start_ = said_ = Clock::now();
    if (terminal_) said_ -= std::chrono::seconds(1);  // it is drawn at once
  }
  draw(what);
}

void Progress::step(const std::string& what) {
  what_ = what;
  unit_ = {};
  total_ = 1;
  begun_ = last_done_ = 0;
  start_ = said_ = Clock::now();
}

void Progress::within(const std::string& words) {
  if (total_ > 0) draw(what_ + ", " + words);
}

void Progress::draw(const std::string& what) {
  const Clock::time_point now = Clock::now();
  const auto since = [now](Clock::time_point then) { return std::chrono::duration<double>(now - then).count(); };
  if (since(said_) < (terminal_ ? bar_interval_s : line_interval_s)) return;
  said_ = now;
  const std::string words = progress_words(since(start_), begun_, last_done_, total_, unit_);
  if (unit_.name.empty() && !terminal_) return line(what + ", " + words);
  if (!terminal_)
    return line(fmt::format("{}: {} of {} {}, {}", what, grouped(last_done_), grouped(total_), unit_.name, words));
  end();
  constexpr double width = 30;
  const auto filled = static_cast<size_t>(width * static_cast<double>(last_done_) / static_cast<double>(total_));
  const std::string text = unit_.name.empty() ? what + ", " + words
                                              : fmt::format("{} [{}{}] {}/{}, {}", what, std::string(filled, '#'),
                                                            std::string(size_t{30} - filled, '.'), grouped(last_done_),
                                                            grouped(total_), words);
  std::cerr << text << std::flush;
  bar_width_ = text.size();
}

std::string progress_words(double seconds, uint64_t begun, uint64_t done, uint64_t total, const ProgressUnit& unit) {
  std::string out = "elapsed " + clock_time(seconds);
  if (done <= begun || seconds <= 0) return out;
  const double rate = static_cast<double>(done - begun) / seconds;
  out += fmt::format(", {}{}/s", short_number(rate), unit.name);
  if (!unit.even && static_cast<double>(done) < told_share * static_cast<double>(total)) return out;
  return out + fmt::format(", {} left", clock_time(static_cast<double>(total - done) / rate));
}

}  // namespace wavetracer
