// SPDX-License-Identifier: Apache-2.0
// There is one rule: without line of sight, most of the power may come around edges.
#include "output/run_advice.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <optional>
#include "base/digits.hpp"

namespace wavetracer {
namespace {

// The wording of choose_features(). It does not say whether the scene has edges: only diffraction looks for them.
constexpr const char* diffraction_off = "trace.diffraction = false";

// The warning about links without a path names the same key.
bool said(const std::vector<std::string>& warnings) {
  return std::ranges::any_of(
      warnings, [](const std::string& text) { return text.find("trace.diffraction") != std::string::npos; });
}

std::optional<std::string> edges_left_out(const Run& run, const Totals& totals) {
  const auto found = run.summary.features.find("diffraction");
  const bool left_out = found != run.summary.features.end() && found->second.reason == diffraction_off;
  const uint64_t sight = totals.kinds[0];  // at most one per link
  if (!left_out || totals.counts.paths == 0 || 2 * sight >= totals.links) return {};
  if (said(run.summary.warnings) || said(totals.warnings)) return {};
  return fmt::format(
      "line of sight on {} of {} links, and trace.diffraction = false leaves out all that comes around edges: "
      "set it to true, or ask `wavetracer accuracy -c FILE` what it would add",
      grouped(sight), grouped(totals.links));
}

}  // namespace

std::vector<std::string> advice(const Run& run, const Totals& totals) {
  const std::optional<std::string> edges = edges_left_out(run, totals);
  return edges ? std::vector<std::string>{*edges} : std::vector<std::string>{};
}

}  // namespace wavetracer
