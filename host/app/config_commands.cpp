// `wavetracer validate` and `wavetracer init`.
// Neither needs a device.
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include "app/commands.hpp"
#include "app/inputs.hpp"
#include "config/config_file.hpp"

namespace wavetracer::app {

void add_validate(CLI::App& program) {
  struct Options {
    std::string file;
    std::vector<std::string> sets;
  };
  CLI::App* command = program.add_subcommand("validate", "Check a config file, and that the files it names exist");
  const auto options = std::make_shared<Options>();
  command->add_option("-c,--config", options->file, "Config file (TOML)")->required();
  command->add_option("--set", options->sets, "KEY=VALUE over the file; may be repeated")->allow_extra_args(false);
  command->callback([options] {
    const Config config = load_config(options->file, options->sets);
    check_inputs(config);
    const std::string scene =
        config.scene.file.empty() ? "city \"" + config.scene.generate + "\"" : "scene " + config.scene.file;
    const std::string mounted =
        config.mounts.empty() ? "" : fmt::format(", antennas a vehicle: {}", config.mounts.size());
    std::cout << fmt::format("{}: ok\n{}; standing transmitters: {}, receivers: {}{}; {} rays each, depth {}, {:g} GHz\n",
                             options->file, scene, config.transmitters.size(), config.receivers.size(), mounted,
                             rays_in_words(config.trace), config.trace.max_depth, config.radio.frequency_hz / 1e9);
  });
}

void add_init(CLI::App& program) {
  CLI::App* command = program.add_subcommand("init", "Print a config file with every key explained; it runs as it is");
  command->callback([] { std::cout << commented_config(); });
}

}  // namespace wavetracer::app
