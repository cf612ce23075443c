// `wavetracer scene info` and `wavetracer scene city`.
// Neither needs a device.
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <utility>
#include "app/commands.hpp"
#include "app/inputs.hpp"
#include "config/config_file.hpp"
#include "scene/city.hpp"
#include "scene/info.hpp"
#include "scene/load.hpp"

namespace wavetracer::app {
namespace {

void add_info(CLI::App& scene) {
  struct Options {
    std::string file, up = "auto", default_material;
    double scale = 1;
  };
  CLI::App* command = scene.add_subcommand("info", "Print what is understood of a scene file");
  const auto options = std::make_shared<Options>();
  command->add_option("file", options->file, "Scene file (XML, OBJ, GLB, glTF, PLY)")->required();
  command->add_option("--scale", options->scale, "As scene.scale: metres a file unit")->check(CLI::PositiveNumber);
  command->add_option("--up", options->up, "As scene.up")->check(CLI::IsMember({"auto", "y", "z"}));
  command->add_option("--default-material", options->default_material, "As scene.default_material");
  command->callback([options] {
    SceneConfig config;
    config.file = options->file;
    config.scale = options->scale;
    config.up = options->up;
    config.default_material = options->default_material;
    std::cout << describe_scene(load_scene_file(options->file, config));
  });
}

void add_city(CLI::App& scene) {
  struct Options {
    std::string directory = "city";
    // Each is handed on as it is: parse_city_options, which scene.generate uses too, is the one parser of them.
    std::vector<std::pair<std::string, std::string>> values = {{"--seed", ""},     {"--blocks", ""}, {"--block-m", ""},
                                                               {"--street-m", ""}, {"--floors", ""}, {"--ground", ""}};
  };
  CLI::App* command = scene.add_subcommand("city", "Write a generated city as Mitsuba XML with PLY meshes");
  const auto options = std::make_shared<Options>();
  command->add_option("-o,--output", options->directory, "Folder to write to")->capture_default_str();
  const std::vector<std::string> docs = {"Random choices; the same seed gives the same city",
                                         "Blocks in x and y, such as 6x6",
                                         "Side of a block in metres",
                                         "Width of the streets in metres",
                                         "Storeys, such as 3:9",
                                         "ITU material of the ground"};
  for (size_t i = 0; i < docs.size(); ++i)
    command->add_option(options->values[i].first, options->values[i].second, docs[i]);
  command->callback([options] {
    std::string text;
    for (const auto& [key, value] : options->values)
      if (!value.empty()) text += key + "=" + value + " ";
    const CityOptions city = parse_city_options(text);
    write_city(city, options->directory);
    std::cout << fmt::format("{}/city.xml: written. Places for antennas, in metres:\n", options->directory);
    for (const CityPosition& place : example_positions(city))
      std::cout << fmt::format("  {:<46} [{:g}, {:g}, {:g}]\n", place.name, place.position_m[0], place.position_m[1],
                               place.position_m[2]);
  });
}

}  // namespace

void add_scene(CLI::App& program) {
  CLI::App* scene = program.add_subcommand("scene", "Look at scene files, or generate one");
  scene->require_subcommand(1);
  add_info(*scene);
  add_city(*scene);
}

}  // namespace wavetracer::app
