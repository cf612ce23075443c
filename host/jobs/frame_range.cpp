// SPDX-License-Identifier: Apache-2.0
// Parses --frames and reports what is wrong with it.
// There must be a frame.
#include "jobs/frame_range.hpp"
#include <fmt/format.h>
#include <charconv>
#include <optional>
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

std::optional<uint32_t> number(std::string_view text) {
  uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

FrameRange parse_frames(const std::string& text, uint64_t frame_count) {
  const uint32_t last = static_cast<uint32_t>(frame_count - 1);
  if (text.empty()) return {0, last};
  const std::string there = frame_count == 1 ? "this run has frame 0 only, because no vehicle moves in it"
                                             : fmt::format("this run has {} frames, 0 to {}", frame_count, last);
  const size_t colon = text.find(':');
  const std::string_view whole = text, left = whole.substr(0, colon),
                         right = colon == std::string::npos ? left : whole.substr(colon + 1);
  const std::optional<uint32_t> a = left.empty() ? 0 : number(left), b = right.empty() ? last : number(right);
  if (!a || !b || whole == ":")
    throw ConfigError(
        fmt::format("--frames {}: give the first and the last frame as A:B, A:, :B or A; {}", text, there));
  if (*a > last || *b > last) throw ConfigError(fmt::format("--frames {}: {}", text, there));
  if (*a > *b)
    throw ConfigError(
        fmt::format("--frames {}: the first frame comes after the last; did you mean {}:{}?", text, *b, *a));
  return {*a, *b};
}

}  // namespace wavetracer
