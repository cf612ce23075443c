// SPDX-License-Identifier: Apache-2.0
// The list of experiments, and the configs that they measure.
// Built-in configs are text, which is read like a file.
#include "study/experiment.hpp"
#include <fmt/format.h>
#include <algorithm>
#include "base/spelling.hpp"
#include "study/worlds.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::study {
namespace {

// Scene and receivers of configs/city.toml, and its transmitter.
constexpr const char* built_in_city = R"([scene]
generate = "--seed 1 --blocks 6x6"
[[receiver]]
name = "car-1"
position_m = [60.0, -3.0, 1.5]
[[receiver]]
name = "car-2"
position_m = [97.5, -20.0, 1.5]
)";
constexpr const char* mast = R"([[transmitter]]
name = "rsu"
position_m = [8.0, 8.0, 6.0]
)";
// More transmitters, on other streets and at the edge of the city.
constexpr const char* more_masts = R"([[transmitter]]
name = "rsu-2"
position_m = [97.5, 97.5, 6.0]
[[transmitter]]
name = "rsu-3"
position_m = [-97.5, -97.5, 6.0]
[[transmitter]]
name = "rsu-4"
position_m = [150.0, 0.0, 20.0]
)";
// A car at 50 km/h in the right-hand lane of a street.
constexpr const char* car = R"([[transmitter]]
name = "car"
position_m = [10.0, -3.0, 1.5]
velocity_m_s = [13.9, 0.0, 0.0]
)";

void reject_varied_keys(const Experiment& experiment, const std::vector<std::string>& sets) {
  std::vector<std::string> varied = series_keys();
  if (experiment.study()) varied.insert(varied.end(), cache_keys().begin(), cache_keys().end());
  for (const std::string& set : sets) {
    std::string key = set.substr(0, set.find('='));
    std::erase(key, ' ');
    if (std::ranges::find(varied, key) != varied.end())
      throw ConfigError(fmt::format(
          "--set {}: {} gives {} its values itself{}", set, experiment.name, key,
          key == "trace.rays" && !experiment.one_ray_count() ? "; choose them with --rays A:B" : "; leave it out"));
  }
}

}  // namespace

bool Experiment::one_ray_count() const {
  return as<FrameFigure>() || as<LagFigure>() || (study() && study()->rays.size() == 1);
}

bool Experiment::moves() const { return as<FrameFigure>() || (as<OrderFigure>() && as<OrderFigure>()->moves); }

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> all = [] {
    std::vector<Experiment> list;
    for (const auto* more : {&standing_figures(), &traffic_figures(), &hashing_figures(), &further_experiments(),
                             &innerframe_experiments()})
      list.insert(list.end(), more->begin(), more->end());
    return list;
  }();
  return all;
}

const Experiment& find_experiment(const std::string& name) {
  std::vector<std::string> names;
  for (const Experiment& experiment : experiments()) {
    if (experiment.name == name) return experiment;
    names.push_back(experiment.name);
  }
  throw ConfigError(
      fmt::format("thesis: no experiment \"{}\" among {}{}", name, fmt::join(names, ", "), spelling_hint(name, names)));
}

std::string experiment_list() {
  std::string text;
  for (const Experiment& experiment : experiments())
    text += fmt::format("  {:<18} {}\n", experiment.name, experiment.doc);
  return text;
}

Config experiment_config(const Experiment& experiment, const std::string& file, const std::vector<std::string>& sets) {
  reject_varied_keys(experiment, sets);
  if (!file.empty()) return load_config(file, sets);
  std::string ends = experiment.as<FrameFigure>() ? car : mast;
  if (experiment.study() && experiment.study()->by_transmitter) ends += more_masts;
  return parse_config(built_in_city + ends, built_in_city_name, sets);
}

void check_experiment(const Experiment& experiment, const Config& config) {
  const std::string where = config.file.empty() ? "" : config.file + ": ";
  if (config.trace.max_depth == 0)
    throw ConfigError(
        fmt::format("{}trace.max_depth = 0: {} looks at what rays hit; give 1 or more", where, experiment.name));
  if (!config.live_vehicles.empty())
    throw ConfigError(fmt::format(
        "{}{} needs to know where vehicles are, and [[live_vehicle]] tables need a client that sends poses; "
        "give trajectories instead of them",
        where, experiment.name));
}

Config point_config(const OrderFigure& figure, const Config& config, uint64_t frames) {
  Config out = figure.moves ? moving_world(config, "moving", frames) : config;
  out.trace.reuse = false;
  out.trace.diffraction = false;
  out.cache.kind = "none";
  return out;
}

}  // namespace wavetracer::study
