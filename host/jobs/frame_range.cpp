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

// The ends of a range as they were typed; none where one was left out.
struct TypedRange {
  std::optional<uint32_t> first, last;
};

// Returns none for a text that is no range.
std::optional<TypedRange> typed_range(const std::string& text) {
  const size_t colon = text.find(':');
  const std::string_view whole = text, left = whole.substr(0, colon),
                         right = colon == std::string::npos ? left : whole.substr(colon + 1);
  const TypedRange out{number(left), number(right)};
  const bool known = (left.empty() || out.first) && (right.empty() || out.last);
  return known && (out.first || out.last) ? std::optional(out) : std::nullopt;
}

void check_order(const std::string& text, const TypedRange& typed) {
  if (typed.first && typed.last && *typed.first > *typed.last)
    throw ConfigError(fmt::format("--frames {}: the first frame comes after the last; did you mean {}:{}?", text,
                                  *typed.last, *typed.first));
}

std::string no_range(const std::string& text) {
  return fmt::format("--frames {}: give the first and the last frame as A:B, A:, :B or A", text);
}

}  // namespace

void check_frames(const std::string& text) {
  if (text.empty()) return;
  const std::optional<TypedRange> typed = typed_range(text);
  if (!typed) throw ConfigError(no_range(text));
  check_order(text, *typed);
}

FrameRange parse_frames(const std::string& text, uint64_t frame_count) {
  const uint32_t end = static_cast<uint32_t>(frame_count - 1);
  if (text.empty()) return {0, end};
  const std::string there = frame_count == 1 ? "this run has frame 0 only, because no vehicle moves in it"
                                             : fmt::format("this run has {} frames, 0 to {}", frame_count, end);
  const std::optional<TypedRange> typed = typed_range(text);
  if (!typed) throw ConfigError(no_range(text) + "; " + there);
  const uint32_t first = typed->first.value_or(0), last = typed->last.value_or(end);
  if (first > end || last > end) throw ConfigError(fmt::format("--frames {}: {}", text, there));
  check_order(text, {first, last});
  return {first, last};
}

}  // namespace wavetracer
