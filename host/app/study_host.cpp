// SPDX-License-Identifier: Apache-2.0
// Each figure has its own clock: the bar's clock starts again with each.
#include "app/study_host.hpp"
#include <fmt/format.h>
#include <chrono>
#include "app/named_files.hpp"
#include "jobs/interrupt.hpp"

namespace wavetracer::app {

study::Host study_host(Progress& progress) {
  using Clock = std::chrono::steady_clock;
  const auto say = [&progress](const std::string& text) { progress.line(text); };
  const auto at = [&progress, start = Clock::now()](const std::string& what, uint64_t done, uint64_t total,
                                                    const std::string& unit) {
    if (unit != "figures") return progress.bar(what, done, total, unit);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    progress.line(
        fmt::format("{}: figure {} of {}, {}", what, done + 1, total, progress_words(seconds, 0, done, total, unit)));
  };
  return {say, interrupted, at};
}

std::filesystem::path begin_study(const std::string& directory) {
  std::filesystem::path folder = std::filesystem::absolute(directory).lexically_normal();
  check_output_folder(folder);
  catch_interrupts();
  return folder;
}

}  // namespace wavetracer::app
