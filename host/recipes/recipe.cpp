// The list of recipes, and the configs that they measure.
// Assumes that a batch never holds more rays than trace.batch_rays (host/simulation/discovery.cpp).
#include "recipes/recipe.hpp"
#include <fmt/format.h>
#include <algorithm>
#include "config/spelling.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::recipes {
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
// 50 km/h on the right-hand lane of a street.
constexpr const char* car = R"([[transmitter]]
name = "car"
position_m = [10.0, -3.0, 1.5]
velocity_m_s = [13.9, 0.0, 0.0]
)";

constexpr double step_m = 0.5;  // between frames: 54 km/h at 30 frames a second

void reject_varied_keys(const Recipe& recipe, const std::vector<std::string>& sets) {
  std::vector<std::string> varied = series_keys();
  if (recipe.study) varied.insert(varied.end(), cache_keys().begin(), cache_keys().end());
  if (recipe.frames > 1) varied.push_back("trace.batch_rays");
  const bool one_number = recipe.experiment || (recipe.study && recipe.study->rays.size() == 1);
  for (const std::string& set : sets) {
    std::string key = set.substr(0, set.find('='));
    key.erase(std::remove(key.begin(), key.end(), ' '), key.end());
    if (std::find(varied.begin(), varied.end(), key) != varied.end())
      throw ConfigError(
          fmt::format("--set {}: {} gives {} its values itself{}", set, recipe.name, key,
                      key == "trace.rays" && !one_number ? "; choose them with --rays A:B" : "; leave it out"));
  }
}

// The largest batch within `most` that the rays of a transmitter are a multiple of.
uint64_t even_batch(uint64_t rays, uint64_t most) {
  uint64_t batches = (rays + most - 1) / most;
  while (rays % batches != 0) ++batches;
  return rays / batches;
}

void only_receive(std::vector<MountConfig>& mounts) {
  std::erase_if(mounts, [](const MountConfig& mount) { return mount.role == "transmitter"; });
  for (MountConfig& mount : mounts) mount.role = "receiver";
}

}  // namespace

const std::vector<Recipe>& recipes() {
  static const std::vector<Recipe> all = [] {
    std::vector<Recipe> list = {figure_6_1()};
    const auto add = [&list](const std::vector<Recipe>& more) { list.insert(list.end(), more.begin(), more.end()); };
    add(chained_figures());
    add(open_figures());
    add(purging_figures());
    add({figure_6_13()});
    add(hashing_figures());
    add({figure_6_18(), coherence_frames(), coherence_rays()});
    add(cache_steps());
    return list;
  }();
  return all;
}

const Recipe& find_recipe(const std::string& name) {
  std::vector<std::string> names;
  std::string known;
  for (const Recipe& recipe : recipes()) {
    if (recipe.name == name) return recipe;
    names.push_back(recipe.name);
    known += (known.empty() ? "" : ", ") + recipe.name;
  }
  throw ConfigError(fmt::format("bench: no recipe \"{}\" among {}{}", name, known, config::hint(name, names)));
}

std::string recipe_list() {
  std::string text;
  for (const Recipe& recipe : recipes()) text += fmt::format("  {:<16} {}\n", recipe.name, recipe.doc);
  return text;
}

Config recipe_config(const Recipe& recipe, const std::string& file, const std::vector<std::string>& sets) {
  reject_varied_keys(recipe, sets);
  if (!file.empty()) return load_config(file, sets);
  return parse_config(built_in_city + std::string(recipe.drive ? car : mast), built_in_city_name, sets);
}

void check_recipe(const Recipe& recipe, const Config& config) {
  const std::string where = config.file.empty() ? "" : config.file + ": ";
  if ((recipe.experiment || recipe.frames > 1) && config.transmitters.empty())
    throw ConfigError(
        fmt::format("{}{} launches rays from the first [[transmitter]], and there is none, since antennas "
                    "on vehicles ([[mount]]) do not count here; add a [[transmitter]]",
                    where, recipe.name));
  if (config.trace.max_depth == 0)
    throw ConfigError(
        fmt::format("{}trace.max_depth = 0: {} looks at what rays hit; give 1 or more", where, recipe.name));
  if (!config.live_vehicles.empty())
    throw ConfigError(
        fmt::format("{}{} needs to know where vehicles are, and [[live_vehicle]] tables wait for poses; "
                    "give trajectories instead of them",
                    where, recipe.name));
}

Config point_config(const Recipe& recipe, const Config& config, uint64_t rays, bool gpu) {
  Config out = config;
  out.trace.reuse = false;
  out.trace.diffraction = false;
  out.cache.kind = "none";
  if (recipe.frames == 1) return out;
  only_receive(out.mounts);
  out.links.transmitters = {"*"};
  out.transmitters.clear();
  for (uint32_t frame = 0; frame < recipe.frames; ++frame) {
    RadioEnd place = config.transmitters.front();
    place.name += fmt::format(" at frame {}", frame);
    place.position_m[0] += step_m * frame;
    out.transmitters.push_back(place);
  }
  // As many rays as the device is given at once by default (choose_batch in host/simulation/discovery.cpp).
  out.trace.batch_rays = even_batch(rays, gpu ? uint64_t{1} << 25 : uint64_t{1} << 18);
  return out;
}

}  // namespace wavetracer::recipes
