// SPDX-License-Identifier: Apache-2.0
// Makes sentences from rows.
// The axes rays, auto and reuse share their reference.
#include "accuracy/advice.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include "base/digits.hpp"
#include "base/times.hpp"

namespace wavetracer::accuracy {
namespace {

const Row* find(const Study& study, const std::string& axis, const std::string& name) {
  for (const Row& row : study.rows)
    if (row.setting.axis == axis && row.setting.name == name && row.measured()) return &row;
  return nullptr;
}

const Row* reference(const Study& study, const std::string& axis) {
  for (const Row& row : study.rows)
    if (row.setting.axis == axis && row.reference && row.measured() && row.paths > 0) return &row;
  return nullptr;
}

std::string keys(const Row& row) { return fmt::format("{}", fmt::join(row.setting.keys, ", ")); }

std::string decibels(const study::PathError& error) {
  return std::isnan(error.power_median_db) ? ""
                                           : fmt::format("{:.2g} dB at the median link, {:.2g} dB at the worst",
                                                         error.power_median_db, error.power_max_db);
}

// Says which rays or depth a limit needs, or that no row keeps it.
std::string limit_text(const Row* best, const Row& whole) {
  if (!best) return fmt::format("only the reference, {} ({} per frame)", keys(whole), duration_text(whole.frame_s));
  return fmt::format(
      "{} ({} per frame; loses {} of the power and {} of the paths). "
      "{}, the reference of this comparison, takes {:.3g} times as long",
      keys(*best), duration_text(best->frame_s), share_text(best->error.lost_power), share_text(best->error.lost_share),
      keys(whole), whole.frame_s / best->frame_s);
}

// Limits with the same answer share a sentence.
void add_limits(const Study& study, const std::string& what, const std::vector<std::string>& axes,
                std::vector<std::string>& out) {
  const Row* whole = reference(study, axes.front());
  if (!whole) {
    for (const Row& row : study.rows)
      if (row.reference && row.setting.axis == axes.front())
        out.push_back(fmt::format("{}: nothing to recommend, because the reference, {}, {}", what, keys(row),
                                  row.measured() ? "finds no path" : "is not measured: " + row.refusal));
    return;
  }
  std::vector<std::pair<const Row*, std::string>> answers;
  for (const double limit : allowed_losses) {
    const Row* best = cheapest(study, axes, limit);
    const std::string share = fmt::format("10^{:.0f}", std::log10(limit));
    if (!answers.empty() && answers.back().first == best)
      answers.back().second += " and " + share;
    else
      answers.emplace_back(best, share);
  }
  for (const auto& [best, shares] : answers)
    out.push_back(fmt::format("{}, at most {} of the power lost: {}", what, shares, limit_text(best, *whole)));
}

void add_deeper(const Study& study, std::vector<std::string>& out) {
  const Row* deeper = reference(study, "depth");
  const auto own = std::find_if(study.rows.begin(), study.rows.end(), [](const Row& row) {
    return row.own && row.setting.axis == "depth" && !row.reference;
  });
  if (!deeper || own == study.rows.end() || !(own->error.lost > 0)) return;
  out.push_back(fmt::format(
      "One interaction more than yours, {}, would add {} of the power and {} of the paths{}, "
      "for {:.3g} times the time",
      keys(*deeper), share_text(own->error.lost_power), share_text(own->error.lost_share),
      decibels(own->error).empty() ? "" : " (" + decibels(own->error) + ")", deeper->frame_s / own->frame_s));
}

void add_reuse(const Study& study, std::vector<std::string>& out) {
  const Row *on = find(study, "reuse", "on"), *off = find(study, "reuse", "off");
  if (!on || !off || !reference(study, "rays")) return;
  out.push_back(fmt::format(
      "Reuse from frame to frame, trace.reuse=true: {} per frame and {} of the power lost; without it {} and {}",
      duration_text(on->frame_s), share_text(on->error.lost_power), duration_text(off->frame_s),
      share_text(off->error.lost_power)));
}

// Says what the mechanism gains, on top of the user's other settings.
std::string mechanism_text(const Mechanism& mechanism, const Row& on, const Row& off) {
  std::string text = fmt::format("{} ({}): ", mechanism.words, fmt::join(mechanism.on, ", "));
  const study::PathError& error = off.error;
  if (error.lost == 0 && error.spurious == 0) {
    text += "adds no path";
  } else {
    text += fmt::format("{} more paths, {} of all power", grouped(error.lost), share_text(error.lost_power));
    if (!decibels(error).empty()) text += "; path gains change by " + decibels(error);
  }
  if (error.links_lost > 0)
    text += fmt::format("; {} no path without it",
                        error.links_lost == 1 ? "one link has" : fmt::format("{} links have", error.links_lost));
  return text + fmt::format("; a frame takes {} with it, {} without. {}", duration_text(on.frame_s),
                            duration_text(off.frame_s),
                            on.own    ? "Yours is on"
                            : off.own ? "Yours is off"
                                      : "Yours is off, as is what it needs");
}

void add_mechanisms(const Study& study, std::vector<std::string>& out) {
  for (const Mechanism& mechanism : mechanisms()) {
    const Row *on = find(study, mechanism.feature, "on"), *off = find(study, mechanism.feature, "off");
    if (on && off)
      out.push_back(mechanism_text(mechanism, *on, *off));
    else
      for (const Row& row : study.rows)
        if (row.setting.axis == mechanism.feature && row.reference && !row.measured())
          out.push_back(fmt::format("{}: not measured, because {}", mechanism.words, row.refusal));
  }
}

}  // namespace

std::string share_text(double share) {
  if (std::isnan(share)) return "?";
  if (share == 0) return "none";
  return share < 9.95e-6 ? fmt::format("{:.2g}", share) : fmt::format("{:.2g}%", 100 * share);
}

const Row* cheapest(const Study& study, const std::vector<std::string>& axes, double lost_power) {
  const Row* best = nullptr;
  for (const Row& row : study.rows) {
    const bool asked = std::find(axes.begin(), axes.end(), row.setting.axis) != axes.end();
    if (!asked || row.reference || !row.measured() || !(row.error.lost_power <= lost_power)) continue;
    if (!best || row.frame_s < best->frame_s) best = &row;
  }
  return best;
}

std::vector<std::string> recommendations(const Study& study) {
  std::vector<std::string> out;
  add_limits(study, "Rays", {"rays", "auto"}, out);
  add_reuse(study, out);
  add_limits(study, "Depth", {"depth"}, out);
  if (reference(study, "diffraction_rays")) add_limits(study, "Rays of receivers", {"diffraction_rays"}, out);
  if (reference(study, "edge_rays")) add_limits(study, "Rays of edges", {"edge_rays"}, out);
  add_deeper(study, out);
  add_mechanisms(study, out);
  return out;
}

}  // namespace wavetracer::accuracy
