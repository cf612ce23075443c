// `wavetracer bench RECIPE`: experiments that vary a key and report speed beside error.
// This version has no recipe; the speed of its parts is measured by the programs of bench/.
#include <fmt/format.h>
#include <memory>
#include "app/commands.hpp"

namespace wavetracer::app {

void add_bench(CLI::App& program) {
  struct Options {
    std::string recipe, directory;
  };
  CLI::App* command = program.add_subcommand("bench", "Run an experiment by name");
  const auto options = std::make_shared<Options>();
  command->add_option("recipe", options->recipe, "Name of the experiment");
  command->add_option("-o,--output", options->directory, "Folder for the results");
  command->callback([options] {
    const std::string what = options->recipe.empty() ? "no recipe given" : "no recipe \"" + options->recipe + "\"";
    throw ConfigError("bench: " + what + ": this version has none; `./dev bench` measures the parts of the program");
  });
}

}  // namespace wavetracer::app
