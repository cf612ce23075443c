// SPDX-License-Identifier: Apache-2.0
// Names and numbers that a run does not have are errors that say what is near.
#include "results/run_choice.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include "base/spelling.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

std::optional<uint32_t> find_end(const std::vector<RadioEnd>& ends, const std::string& name,
                                 const std::string& option) {
  if (name.empty()) return {};
  std::vector<std::pair<size_t, const std::string*>> near;
  for (uint32_t i = 0; i < ends.size(); ++i) {
    if (ends[i].name == name) return i;
    near.emplace_back(edit_distance(name, ends[i].name), &ends[i].name);
  }
  const size_t shown = std::min<size_t>(near.size(), 3);
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(shown), near.end(),
                    [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string nearest;
  for (size_t i = 0; i < shown; ++i) nearest += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", *near[i].second);
  throw ConfigError(fmt::format("{} \"{}\" is not the name of a {} of the run; {}", option, name,
                                option == "--tx" ? "transmitter" : "receiver",
                                shown == 0   ? "there is none"
                                : shown == 1 ? "there is " + nearest
                                             : "the nearest are " + nearest));
}

size_t find_frame(const SavedRun& run, uint32_t number) {
  for (size_t row = 0; row < run.frame_count(); ++row)
    if (run.number(row) == number) return row;
  throw ConfigError(
      fmt::format("--frame {}: the run has frames {} to {}", number, run.number(0), run.number(run.frame_count() - 1)));
}

const ReceiverGridConfig& find_grid(const std::vector<ReceiverGridConfig>& grids, const std::string& name) {
  std::vector<std::string> known;
  for (const ReceiverGridConfig& grid : grids) {
    if (grid.name == name) return grid;
    known.push_back(grid.name);
  }
  throw ConfigError(fmt::format("--grid \"{}\" is not the name of a [[receiver_grid]] of the run, which has {}{}", name,
                                known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", ")),
                                spelling_hint(name, known)));
}

}  // namespace wavetracer
