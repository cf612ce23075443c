// SPDX-License-Identifier: Apache-2.0
// Each figure has its own clock: the bar's clock starts again with each.
#include "app/study_host.hpp"
#include <fmt/format.h>
#include <unistd.h>
#include <chrono>
#include <iostream>
#include <memory>
#include <utility>
#include "app/named_files.hpp"
#include "jobs/interrupt.hpp"
#include "jobs/solve_frame.hpp"

namespace wavetracer::app {

study::Host study_host(Progress& progress) {
  using Clock = std::chrono::steady_clock;
  const auto say = [&progress](const std::string& text) { progress.line(text); };
  const auto at = [&progress, start = Clock::now()](const std::string& what, uint64_t done, uint64_t total,
                                                    const ProgressUnit& unit) {
    if (total == 1) return progress.step(what);
    if (unit.name != "figures") return progress.bar(what, done, total, unit);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    progress.line(
        fmt::format("{}: figure {} of {}, {}", what, done + 1, total, progress_words(seconds, 0, done, total, unit)));
  };
  const auto watch = [&progress](const FrameProgress& frame) {
    progress.within(words_of(frame));
    return !interrupted();
  };
  const auto at_once = [](std::function<void()> end) -> std::shared_ptr<void> {
    const bool keeps = static_cast<bool>(end);
    const auto clean_up = [end = std::move(end)] {
      if (isatty(STDERR_FILENO) == 1) std::cerr << "\n";  // below the bar
      if (end) end();
    };
    return std::make_shared<EndOnInterrupt>(
        clean_up, keeps ? "" : "interrupted before the first result; nothing new was written");
  };
  return {say, interrupted, at, watch, at_once};
}

std::filesystem::path begin_study(const std::string& directory) {
  std::filesystem::path folder = std::filesystem::absolute(directory).lexically_normal();
  check_output_folder(folder);
  catch_interrupts();
  return folder;
}

}  // namespace wavetracer::app
