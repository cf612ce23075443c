// SPDX-License-Identifier: Apache-2.0
#include "app/map_formats.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include "base/spelling.hpp"
#include "coverage/write_map.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::app {

CLI::Option* add_map_formats(CLI::App& command, std::vector<std::string>& formats) {
  return command
      .add_option(
          "--format", formats,
          fmt::format("Formats of maps to write, separated by commas: {}", fmt::join(coverage::format_names, ", ")))
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
}

void check_map_formats(const std::vector<std::string>& formats) {
  const std::vector<std::string> known(coverage::format_names.begin(), coverage::format_names.end());
  for (const std::string& format : formats)
    if (std::ranges::find(known, format) == known.end())
      throw ConfigError(fmt::format("--format \"{}\" is no format of a map, there are {}{}", format,
                                    fmt::join(known, ", "), spelling_hint(format, known)));
}

bool has_format(const std::vector<std::string>& formats, const std::string& format) {
  return std::ranges::find(formats, format) != formats.end();
}

std::string place_warning(const std::vector<std::string>& formats, const std::optional<Georeference>& georeference) {
  if (!has_format(formats, "geotiff") || georeference) return "";
  return "where on the earth the scene is, is not known: the files of geotiff have its own coordinates in metres, in a "
         "local system; a georeference.json beside the scene file would say it";
}

}  // namespace wavetracer::app
