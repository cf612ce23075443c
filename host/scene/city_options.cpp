// SPDX-License-Identifier: Apache-2.0
// Parses the options of `wavetracer scene city` and of the keys scene.generate and trajectories.generate.
// Options are separated by blanks; values hold no blanks.
#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "scene/city.hpp"
#include "scene/city_traffic.hpp"
#include "scene/materials.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr std::string_view usage =
    "options: --seed N, --blocks NXxNY, --block-m N, --street-m N, --floors MIN:MAX, --ground ITU_MATERIAL, "
    "--vehicles N, --seconds S, --step S";

struct Options {
  CityOptions city;
  TrafficOptions traffic;  // the seed and the grid are taken from the city instead
};

[[noreturn]] void fail(const std::string& what) { throw ConfigError(fmt::format("city: {}; {}", what, usage)); }

template <class T>
std::optional<T> number(std::string_view text, T least, T most) {
  T value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < least || value > most) return std::nullopt;
  return value;
}

template <class T>
T whole(std::string_view key, std::string_view text, T least, T most) {
  const std::optional<T> value = number(text, least, most);
  if (!value) fail(fmt::format("{} '{}' must be an integer from {} to {}", key, text, least, most));
  return *value;
}

double seconds(std::string_view key, std::string_view text, double most) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value > 0 && value <= most)) {
    fail(fmt::format("{} '{}' must be a number of seconds above 0, up to {}", key, text, most));
  }
  return value;
}

// Parses "6x4" or "3:9"; where that makes sense, a single number stands for both.
std::pair<uint32_t, uint32_t> two(std::string_view key, std::string_view text, char separator) {
  constexpr uint32_t most = 100;
  const size_t at = text.find(separator);
  const std::optional<uint32_t> first = number<uint32_t>(text.substr(0, at), 1, most),
                                second = at == std::string_view::npos ? first
                                                                      : number<uint32_t>(text.substr(at + 1), 1, most);
  if (!first || !second)
    fail(
        fmt::format("{} '{}' must be one or two integers from 1 to {}, such as 3 or 3{}9", key, text, most, separator));
  return {*first, *second};
}

void set(Options& all, std::string_view key, std::string_view value) {
  CityOptions& options = all.city;
  if (key == "--seed") {
    options.seed = whole<uint64_t>(key, value, 0, std::numeric_limits<uint64_t>::max());
  } else if (key == "--blocks") {
    std::tie(options.blocks_x, options.blocks_y) = two(key, value, 'x');
  } else if (key == "--block-m") {
    options.block_m = whole<uint32_t>(key, value, 60, 200);  // below 60 m the lots would have no room
  } else if (key == "--street-m") {
    options.street_m = whole<uint32_t>(key, value, 4, 100);
  } else if (key == "--floors") {
    std::tie(options.min_floors, options.max_floors) = two(key, value, ':');
    if (options.min_floors > options.max_floors)
      fail(fmt::format("--floors '{}': the minimum is above the maximum", value));
  } else if (key == "--ground") {
    options.ground = value;
    for (const Material& m : itu_materials()) {
      if (m.name == value) return;
    }
    fail(fmt::format("--ground '{}' is not an ITU material", value));
  } else if (key == "--vehicles") {
    all.traffic.vehicles = whole<uint32_t>(key, value, 1, 1000000);
  } else if (key == "--seconds") {
    all.traffic.duration_s = seconds(key, value, 86400);
  } else if (key == "--step") {
    all.traffic.step_s = seconds(key, value, 10);
  } else {
    fail(fmt::format("unknown option '{}'", key));
  }
}

Options parse(std::string_view text) {
  std::vector<std::string_view> words;
  constexpr std::string_view blanks = " \t\r\n";
  for (size_t begin = text.find_first_not_of(blanks); begin != std::string_view::npos;) {
    const size_t end = std::min(text.find_first_of(blanks, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(blanks, end);
  }
  Options options;
  for (size_t i = 0; i < words.size(); ++i) {
    const size_t equals = words[i].find('=');
    if (equals != std::string_view::npos) {
      set(options, words[i].substr(0, equals), words[i].substr(equals + 1));
    } else if (i + 1 < words.size()) {
      set(options, words[i], words[i + 1]);
      ++i;
    } else {
      set(options, words[i], "");
    }
  }
  return options;
}

}  // namespace

CityOptions parse_city_options(std::string_view text) { return parse(text).city; }

TrafficOptions parse_traffic_options(std::string_view text) {
  Options options = parse(text);
  const CityOptions& city = options.city;
  options.traffic.grid = {city.blocks_x, city.blocks_y, city.block_m, city.street_m};
  options.traffic.seed = city.seed;
  return options.traffic;
}

}  // namespace wavetracer
