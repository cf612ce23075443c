// SPDX-License-Identifier: Apache-2.0
// Places in pixels become shares of the page, whose origin is below on the left.
// Keys have three columns.
#include "study/panels.hpp"
#include <fmt/format.h>
#include <algorithm>

namespace wavetracer::study {
namespace {

constexpr double title_px = 75, panel_px = 230, gap_px = 105, left_px = 85, right_px = 15, between_px = 95,
                 key_line_px = 17;
constexpr size_t columns_of_keys = 3;

// Adds the settings in blocks of equal size, with `reference` in each if it is not empty.
void add_blocks(const std::vector<std::string>& settings, const std::string& reference,
                std::vector<std::vector<std::string>>& blocks) {
  const size_t room = most_lines - (reference.empty() ? 0 : 1), count = (settings.size() + room - 1) / room;
  for (size_t i = 0; i < count; ++i) {
    std::vector<std::string> block;
    if (!reference.empty()) block.push_back(reference);
    const size_t begin = settings.size() * i / count, end = settings.size() * (i + 1) / count;
    for (size_t at = begin; at < end; ++at) block.push_back(settings[at]);
    blocks.push_back(std::move(block));
  }
}

}  // namespace

std::vector<std::vector<std::string>> line_blocks(const std::vector<std::string>& settings) {
  if (settings.size() <= most_lines) return {settings};
  std::vector<std::string> printed, others;
  const std::string reference = settings.front().starts_with("no cache") ? settings.front() : "";
  for (const std::string& setting : settings)
    if (reference.empty() || setting != reference)
      (setting.starts_with("printed ") ? printed : others).push_back(setting);
  std::vector<std::vector<std::string>> blocks;
  add_blocks(others, reference, blocks);
  add_blocks(printed, reference, blocks);
  return blocks;
}

PanelPage::PanelPage(const std::vector<size_t>& lines, size_t panels, size_t a_row)
    : columns_(std::clamp<size_t>(a_row, 1, 2)), rows_((panels + columns_ - 1) / columns_) {
  double at = title_px;
  for (const size_t count : lines) {
    tops_px_.push_back(at);
    at += static_cast<double>(rows_) * (panel_px + gap_px) - 40;
    keys_px_.push_back(at);
    key_rows_.push_back((count + columns_of_keys - 1) / columns_of_keys);
    at += key_line_px * static_cast<double>(key_rows_.back()) + 55;
  }
  height_px_ = at - 30;
}

std::string PanelPage::margins(size_t block, size_t panel) const {
  const auto column = static_cast<double>(panel % columns_), row = static_cast<double>(panel / columns_),
             columns = static_cast<double>(columns_);
  const double width = (page_width_px - left_px - right_px - (columns - 1) * between_px) / columns,
               left = left_px + column * (width + between_px), top = tops_px_[block] + row * (panel_px + gap_px);
  const auto across = [](double px) { return px / page_width_px; };
  const auto up = [this](double px) { return 1 - px / height_px_; };
  return fmt::format(
      "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\nset tmargin at screen {:.4f}\nset bmargin at screen "
      "{:.4f}\n",
      across(left), across(left + width), up(top), up(top + panel_px));
}

std::string PanelPage::key(size_t block) const {
  return fmt::format(
      "set key at screen 0.5, {:.4f} center top Left reverse noenhanced vertical maxrows {} samplen 2 font ',11'\n",
      1 - keys_px_[block] / height_px_, key_rows_[block]);
}

}  // namespace wavetracer::study
