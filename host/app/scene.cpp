// SPDX-License-Identifier: Apache-2.0
// `wavetracer scene info`, `wavetracer scene materials` and `wavetracer scene city`.
// None needs a device.
#include <fmt/format.h>
#include <filesystem>
#include <iostream>
#include <memory>
#include "app/commands.hpp"
#include "app/materials.hpp"
#include "app/named_files.hpp"
#include "app/number_range.hpp"
#include "app/scene_radar.hpp"
#include "base/file.hpp"
#include "motion/fcd_writer.hpp"
#include "scene/city.hpp"
#include "scene/city_traffic.hpp"
#include "scene/info.hpp"
#include "scene/load.hpp"
#include "wavetracer/config_file.hpp"

namespace wavetracer::app {
namespace {

void add_info(CLI::App& scene) {
  struct Options {
    std::string file, up = "auto", default_material;
    double scale = 1;
    bool edges = false;
  };
  CLI::App* command = scene.add_subcommand("info", "Print the contents of a scene file");
  const auto options = std::make_shared<Options>();
  command->add_option("file", options->file, "Scene file (XML, OBJ, GLB, glTF, PLY)")->required();
  command->add_option("--scale", options->scale, "Metres per file unit, like the key scene.scale")
      ->check(positive_number());
  command->add_option("--up", options->up, "Axis of the file that points up, like the key scene.up")
      ->check(CLI::IsMember(std::vector<std::string>(UpAxis::words.begin(), UpAxis::words.end())));
  command->add_option("--default-material", options->default_material,
                      "Radio material of meshes that name none, like the key scene.default_material");
  command->add_flag("--edges", options->edges, "Instead, list the edges that can diffract");
  command->callback([options] {
    SceneConfig config;
    config.file = options->file;
    config.scale = options->scale;
    config.up = UpAxis::named(options->up);
    config.default_material = options->default_material;
    const Scene loaded = load_scene_file(options->file, config);
    std::cout << (options->edges ? describe_edges(loaded) : describe_scene(loaded));
  });
}

void add_materials(CLI::App& scene) {
  struct Options {
    double frequency_hz = RadioConfig{}.frequency_hz;
    std::string edition = ItuEdition{}.text();
  };
  CLI::App* command = scene.add_subcommand(
      "materials", "List the radio materials that are known by name, with their values at a frequency");
  const auto options = std::make_shared<Options>();
  command->add_option("--frequency", options->frequency_hz, "Frequency in Hz, like the key radio.frequency_hz")
      ->check(number_range(1e6, 1e12))
      ->capture_default_str();
  command->add_option("--edition", options->edition, "Edition of ITU-R P.2040, like the key scene.itu_edition")
      ->check(CLI::IsMember(std::vector<std::string>(ItuEdition::words.begin(), ItuEdition::words.end())))
      ->capture_default_str();
  command->callback(
      [options] { std::cout << materials_table(ItuEdition::named(options->edition), options->frequency_hz); });
}

// The configuration beside drive.fcd.xml; {} stand for the road-side unit's x, y and z.
constexpr const char* drive_config =
    R"(# Every vehicle of drive.fcd.xml to every other within 300 m, and to a road-side unit.
# Run it with `wavetracer run -c drive.toml`; `wavetracer init` prints every key there is.

[scene]
file = "city.xml"

[trajectories]
file = "drive.fcd.xml"  # as SUMO writes it (--fcd-output, --precision 6)

# An antenna above the middle of the roof of a passenger car. Vans and trucks are higher; a table of its own for each,
# with on = "delivery" or on = "truck", puts it on their roofs.
[[mount]]
name = "roof"
on = "*"                    # ids or types of vehicles
role = "both"               # sends and receives
offset_m = [0.0, 0.0, 1.6]  # ahead, left, up from the middle of the vehicle, on the ground

# The road-side unit on its mast sends and receives, too.
[[station]]
name = "rsu"
position_m = [{0:.1f}, {1:.1f}, {2:.1f}]

[links]
max_distance_m = 300  # pairs farther apart are not computed

[trace]
rays = 200000  # a transmitter
max_depth = 5  # reflections
)";

void write_drive(const CityOptions& city, const TrafficOptions& options, const std::filesystem::path& folder) {
  const Trajectories drive = generate_traffic(options);
  write_city(city, folder);
  write_file(folder / "drive.fcd.xml", format_fcd(drive));
  const auto rsu = example_positions(city).front().position_m;  // a copy: the list exists for this line only
  write_file(folder / "drive.toml", fmt::format(drive_config, rsu[0], rsu[1], rsu[2]));
  std::cout << fmt::format("{0}/drive.fcd.xml: written, {1} vehicles for {2:g} s\n", folder.string(),
                           drive.tracks.size(), drive.last_time_s)
            << fmt::format("{}/drive.toml: written, a configuration to trace it\n", folder.string());
}

// Options of a city are separated by blanks. Returns a message for a value that is not one word.
std::string one_word(const std::string& value) {
  return value.find_first_of(" \t\r\n") == std::string::npos ? "" : fmt::format("'{}' must have no blanks", value);
}

void add_city(CLI::App& scene) {
  struct Option {
    const char *key, *doc;
    bool traffic;
    std::string value = {};
  };
  struct Options {
    std::string directory = "city";
    // Each option is passed on unchanged: city_options.cpp, which serves the configuration too, is the one parser.
    std::vector<Option> given = {
        {"--seed", "Seed of the random numbers; the same seed gives the same city and drive", false},
        {"--blocks", "Number of blocks in x and y, such as 6x6", false},
        {"--block-m", "Side of a block in metres", false},
        {"--street-m", "Width of the streets in metres", false},
        {"--floors", "Smallest and largest number of storeys, such as 3:9", false},
        {"--ground", "ITU material of the ground", false},
        {"--vehicles", "Number of vehicles that drive through the streets; their trajectories are written too", true},
        {"--seconds", "Length of the drive in seconds", true},
        {"--step", "Time between the positions of a vehicle in seconds", true}};
  };
  CLI::App* command = scene.add_subcommand(
      "city", "Generate a city and write it as Mitsuba XML with PLY meshes, with traffic if asked for");
  const auto options = std::make_shared<Options>();
  command->add_option("-o,--output", options->directory, "Folder to write to")->capture_default_str();
  for (Option& option : options->given) command->add_option(option.key, option.value, option.doc)->check(one_word);
  command->callback([options] {
    std::string text;
    bool drive = false;
    for (const Option& option : options->given) {
      if (option.value.empty()) continue;
      text += fmt::format("{}={} ", option.key, option.value);
      drive |= option.traffic;
    }
    const CityOptions city = parse_city_options(text);
    if (drive)
      write_drive(city, parse_traffic_options(text), options->directory);
    else
      write_city(city, options->directory);
    std::cout << fmt::format("{}/city.xml: written. Places for antennas, in metres:\n", options->directory);
    for (const CityPosition& place : example_positions(city))
      std::cout << fmt::format("  {:<46} [{:g}, {:g}, {:g}]\n", place.name, place.position_m[0], place.position_m[1],
                               place.position_m[2]);
  });
}

}  // namespace

void add_scene(CLI::App& program) {
  CLI::App* scene = program.add_subcommand(
      "scene", "Print what a scene file contains or sends back to a radar, list radio materials, or generate a city");
  scene->require_subcommand(1);
  add_info(*scene);
  add_materials(*scene);
  add_city(*scene);
  add_radar(*scene);
}

}  // namespace wavetracer::app
