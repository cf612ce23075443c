// SPDX-License-Identifier: Apache-2.0
// Checks existence and permissions of the files and folders that a config names.
// A file may change between the check and its use; the code that opens it reports that.
#include "app/named_files.hpp"
#include <fmt/format.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include "base/digits.hpp"
#include "base/input_file.hpp"
#include "base/output_place.hpp"
#include "config/input_files.hpp"
#include "scene/city.hpp"
#include "scene/city_traffic.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::app {
namespace {

namespace fs = std::filesystem;

void check_file(const std::string& file, const std::string& key, const std::string& config_file) {
  const std::string where = config_file.empty() ? "" : config_file + ": ";
  std::error_code ignored;
  if (fs::is_directory(file, ignored))
    throw InputError(fmt::format("{}{} is \"{}\", a folder: name the file in it", where, key, file));
  if (access(file.c_str(), R_OK) != 0)
    throw InputError(
        fmt::format("{}{} is \"{}\", which cannot be read: {}; relative paths start at the config file's folder", where,
                    key, file, std::strerror(errno)));
  check_input_file(file, key.c_str());
}

// Vehicles in the streets of one city would drive through the houses of another.
void check_streets(const Config& config) {
  const auto words = [](const StreetGrid& grid) {
    return fmt::format("--blocks {}x{} --block-m {} --street-m {}", grid.blocks_x, grid.blocks_y, grid.block_m,
                       grid.street_m);
  };
  const std::string city = words(parse_traffic_options(config.scene.generate).grid),
                    traffic = words(parse_traffic_options(config.trajectories.generate).grid);
  if (city != traffic)
    throw ConfigError(
        fmt::format("{}trajectories.generate has the streets of {}, scene.generate those of {}: "
                    "vehicles would drive through houses; give both the same",
                    config.file.empty() ? "" : config.file + ": ", traffic, city));
}

}  // namespace

void check_inputs(const Config& config) {
  Config values = config;  // a copy, since slots point to values that may be written
  for (const config::NamedFile& file : config::input_files(values)) check_file(*file.path, file.key, config.file);
  if (!config.scene.generate.empty()) parse_city_options(config.scene.generate);
  if (!config.trajectories.generate.empty()) parse_traffic_options(config.trajectories.generate);
  if (!config.scene.generate.empty() && !config.trajectories.generate.empty()) check_streets(config);
}

std::string launch_in_words(const TraceConfig& trace) {
  if (trace.by_beams()) return "beams";
  return fmt::format("{}{} rays", trace.discovery == "auto" ? "beams or " : "",
                     trace.rays ? grouped(*trace.rays) : "auto");
}

void check_output_folder(const fs::path& folder) {
  if (const std::string problem = write_obstacle(folder); !problem.empty())
    throw RuntimeError(
        fmt::format("{}: cannot write there ({}); choose another folder with -o", folder.string(), problem));
}

}  // namespace wavetracer::app
