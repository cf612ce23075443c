// SPDX-License-Identifier: Apache-2.0
// `wavetracer validate` and `wavetracer init`.
// Neither needs a device.
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include "app/commands.hpp"
#include "app/first_configs.hpp"
#include "app/named_files.hpp"
#include "config/contradictions.hpp"
#include "imports/road_network.hpp"
#include "radio/codebook.hpp"
#include "radio/field_tables.hpp"
#include "scene/load.hpp"
#include "scene/materials.hpp"
#include "simulation/feature_choice.hpp"
#include "simulation/place_warnings.hpp"
#include "simulation/ray_cache.hpp"
#include "simulation/world.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::app {

namespace {

// Throws the errors of a run: for a material that is unknown at the frequency, an invalid pattern file or codebook, a
// cache that is too small for its transmitters.
void check_run(const Config& config, const Scene& scene, const World& world) {
  Config radio = config;
  radio.transmitters = world.transmitters.ends;
  radio.receivers = world.receivers.ends;
  radio.trace = with_features(config.trace, choose_features(radio, scene, world));
  make_field_tables(scene, radio, world.fleet.models, world.fleet.instances);
  for (const ArrayConfig& array : config.arrays) {
    RadioEnd end;
    end.array = array.name;
    codebook_of(config, end);
  }
  check_cache(radio, world);
}

// Returns the warnings of a run about the scene, fixed ends and vehicles, which it loads for that.
std::vector<std::string> world_warnings(const Config& config) {
  const Scene scene = load_scene(config);
  const World world = make_world(config, scene);
  check_run(config, scene, world);
  known_streets(config);
  std::vector<std::string> out = scene.report.warnings;
  drop_used(out, world.fleet.models);
  for (const auto& more :
       {config::idle_settings(config), world.warnings, place_warnings(config, Surroundings(scene), world)})
    out.insert(out.end(), more.begin(), more.end());
  return out;
}

}  // namespace

void add_validate(CLI::App& program) {
  struct Options {
    std::string file;
    std::vector<std::string> sets;
  };
  CLI::App* command = program.add_subcommand(
      "validate", "Check a config file, the files that it names, and the places of its antennas and vehicles");
  const auto options = std::make_shared<Options>();
  command->add_option("-c,--config", options->file, "Config file (TOML)")->required();
  command
      ->add_option("--set", options->sets, "KEY=VALUE: set a key of the config, overriding the file; may be repeated")
      ->allow_extra_args(false);
  command->callback([options] {
    const Config config = load_config(options->file, options->sets);
    check_inputs(config);
    for (const std::string& warning : world_warnings(config)) std::cerr << "warning: " << warning << "\n";
    const std::string scene =
        config.scene.file.empty() ? "city \"" + config.scene.generate + "\"" : "scene " + config.scene.file;
    const std::string standing = config.stations.empty() ? "" : fmt::format(", stations: {}", config.stations.size());
    const std::string mounted =
        config.mounts.empty() ? "" : fmt::format(", antennas per vehicle: {}", config.mounts.size());
    std::cout << fmt::format(
        "{}: ok\n{}; fixed transmitters: {}, fixed receivers: {}{}{}; {} per transmitter, depth {}, {:g} GHz\n",
        options->file, scene, config.transmitters.size(), config.receivers.size(), standing, mounted,
        launch_in_words(config.trace), config.trace.max_depth, config.radio.frequency_hz / 1e9);
  });
}

void add_init(CLI::App& program) {
  struct Options {
    bool minimal = false, sumo = false, coverage = false;
  };
  CLI::App* command = program.add_subcommand("init", "Print a config file with every key explained; it runs as it is");
  const auto options = std::make_shared<Options>();
  command->add_flag("--minimal", options->minimal, "Print a short file instead: two antennas in a generated city");
  command->add_flag("--sumo", options->sumo,
                    "Print a file for SUMO vehicles on a map instead; put the names of your files into it");
  command->add_flag("--coverage", options->coverage, "Print a file for a coverage map of one antenna instead");
  command->callback([options] {
    if (options->minimal + options->sumo + options->coverage > 1)
      throw ConfigError("init: --minimal, --sumo and --coverage print different files: give only one of them");
    std::cout << (options->minimal    ? minimal_config
                  : options->sumo     ? sumo_config
                  : options->coverage ? coverage_config
                                      : commented_config());
  });
}

}  // namespace wavetracer::app
