// SPDX-License-Identifier: Apache-2.0
// The forms are those of VaN3Twin's SionnaConnectionHandler and of the answers of its server.
#include "live/van3twin_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace wavetracer::live::van3twin {
namespace {

constexpr double most_metres = 1e12;
constexpr double no_path_loss_db = 300, no_path_delay_s = 1e5;  // the values of VaN3Twin's own server

bool take_word(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

// Splits at commas; returns false unless there are exactly so many parts.
template <size_t Count>
bool split(std::string_view text, std::array<std::string_view, Count>& parts) {
  for (size_t k = 0; k + 1 < Count; ++k) {
    const size_t comma = text.find(',');
    if (comma == text.npos) return false;
    parts[k] = text.substr(0, comma);
    text.remove_prefix(comma + 1);
  }
  parts[Count - 1] = text;
  return text.find(',') == text.npos;
}

bool is_id(std::string_view text) {
  return text.size() <= most_id_bytes && std::ranges::all_of(text, [](char c) { return c > ' ' && c < 127; });
}

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(std::abs(value) <= most_metres)) return {};
  return value;
}

std::optional<Message> location(std::string_view text) {
  std::array<std::string_view, 8>
      parts;  // id, x, y, z, bearing, and the velocity, whose direction is not that of travel
  if (!split(text, parts) || parts[0].empty() || !is_id(parts[0])) return {};
  std::array<double, 7> values{};
  for (size_t k = 0; k < values.size(); ++k) {
    const auto value = number(parts[k + 1]);
    if (!value) return {};
    values[k] = *value;
  }
  return LocationUpdate{std::string(parts[0]), {values[0], values[1], values[2]}, values[3]};
}

std::optional<Message> question(Figure figure, std::string_view text) {
  std::array<std::string_view, 2> ids;
  if (!split(text, ids) || !is_id(ids[0]) || !is_id(ids[1])) return {};
  return Question{figure, std::string(ids[0]), std::string(ids[1])};
}

bool is_origin(const std::string& id) { return id.empty() || id == "0"; }

}  // namespace

std::optional<Message> parse(std::string_view datagram) {
  if (datagram.size() > most_bytes) return {};
  std::string_view rest = datagram;
  if (take_word(rest, "LOC_UPDATE:")) return location(rest);
  if (take_word(rest, "CALC_REQUEST_PATHGAIN:")) return question(Figure::path_gain, rest);
  if (take_word(rest, "CALC_REQUEST_DELAY:")) return question(Figure::delay, rest);
  if (take_word(rest, "CALC_REQUEST_LOS:")) return question(Figure::los, rest);
  if (datagram == "SHUTDOWN_SIONNA") return Shutdown{};
  return {};
}

bool is_about_origin(const Question& question) { return is_origin(question.from) || is_origin(question.to); }

std::string confirmation(const LocationUpdate& update) { return "LOC_CONFIRM:" + update.id; }

std::string answer(const Question& question, const std::optional<Link>& link) {
  const bool has_path = link && std::isfinite(link->gain_db);
  switch (question.figure) {
    case Figure::path_gain:
      return fmt::format("CALC_DONE_PATHGAIN:{}", !link ? 0 : has_path ? -link->gain_db : no_path_loss_db);
    case Figure::delay:
      return fmt::format("CALC_DONE_DELAY:{}", !link ? 0 : has_path ? link->first_delay_s : no_path_delay_s);
    case Figure::los:
      return fmt::format("CALC_DONE_LOS:{}", !link ? "0" : link->los ? "[True]" : "[False]");
  }
  return {};
}

}  // namespace wavetracer::live::van3twin
