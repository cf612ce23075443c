// SPDX-License-Identifier: Apache-2.0
// `wavetracer coverage` makes maps of a run's receiver grid: signal, noise, interference and the best server of cells.
// It needs no device.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include "app/commands.hpp"
#include "app/map_formats.hpp"
#include "app/saved_frames.hpp"
#include "base/digits.hpp"
#include "config/retired_keys.hpp"
#include "coverage/coverage_map.hpp"
#include "coverage/kml.hpp"
#include "coverage/street_cells.hpp"
#include "coverage/write_map.hpp"
#include "imports/road_network.hpp"
#include "results/link_table.hpp"
#include "results/run_choice.hpp"
#include "wavetracer/config_file.hpp"

namespace wavetracer::app {
namespace {

struct CoverageOptions {
  std::string run, folder, grid, tx, frames;
  std::optional<uint32_t> frame;
  bool on_streets = false;
  std::vector<std::string> layers, formats = {"csv"};
};

const ReceiverGridConfig& chosen_grid(const Config& config, const std::string& name) {
  const std::vector<ReceiverGridConfig>& grids = config.receiver_grids;
  if (grids.empty()) throw InputError("the run has no [[receiver_grid]], of which a map could be made");
  if (!name.empty()) return find_grid(grids, name);
  std::vector<std::string> known;
  for (const ReceiverGridConfig& grid : grids) known.push_back(grid.name);
  if (known.size() > 1)
    throw ConfigError(
        fmt::format("the run has {} grids: name one with --grid, of {}", known.size(), fmt::join(known, ", ")));
  return grids.front();
}

// Returns --frames in the words of frame_rows: "all" is an empty text, and a range A-B is A:B.
std::string range_in_words(std::string text) {
  if (text == "all") return "";
  const size_t dash = text.find('-');
  if (dash != std::string::npos && dash > 0 && text.find(':') == std::string::npos) text[dash] = ':';
  return text;
}

FrameRows chosen_rows(const SavedRun& run, const CoverageOptions& options) {
  if (!options.frames.empty()) return frame_rows(run, range_in_words(options.frames));
  const size_t row = options.frame ? find_frame(run, *options.frame) : 0;
  return {row, row};
}

void warn(const std::string& text) { std::cerr << "wavetracer: warning: " << text << "\n"; }

// Leaves the cells on streets in the maps. They are those of one grid.
void keep_cells_on_streets(std::vector<coverage::Map>& maps, const Config& config) {
  if (maps.front().plane)
    throw ConfigError(
        fmt::format("--on-streets: the grid \"{}\" stands upright, and streets lie on the ground", maps.front().grid));
  const std::vector<Street> streets = known_streets(config);
  if (streets.empty())
    throw ConfigError(
        "--on-streets: no streets are known; give the configuration of the run a SUMO network with scene.streets");
  const std::vector<bool> on = coverage::cells_on_streets(maps.front(), streets);
  for (coverage::Map& map : maps) coverage::keep_streets(map, on);
  std::cerr << fmt::format("wavetracer: {} of {} cells are on streets\n",
                           grouped(static_cast<uint64_t>(std::ranges::count(on, true))), grouped(on.size()));
}

void make_coverage(const CoverageOptions& options) {
  check_map_formats(options.formats);
  const SavedRun run(options.run);
  const Config config = parse_config(run.config_text(), run.file().string(), config::without_retired_keys());
  const ReceiverGridConfig& grid = chosen_grid(config, options.grid);
  coverage::check_formats_of(grid.name, grid.vertical(), options.formats);
  const auto tx = find_end(run.transmitters(), options.tx, "--tx");
  const std::string& scene = config.scene.file;
  const std::optional<Georeference> georeference = scene.empty() ? std::nullopt : find_georeference(scene);
  const auto wanted = [&](const char* format) {
    return std::ranges::find(options.formats, format) != options.formats.end();
  };
  if (wanted("kml")) coverage::georeference_for_kml(georeference, scene);  // refuse it before frames are read
  const FrameRows rows = chosen_rows(run, options);
  const LinkTable table = link_table(run);
  if (!table.warning.empty()) warn(table.warning);
  std::vector<coverage::Map> maps = coverage::coverage_maps(run, config.radio, rows.first, rows.last, table, grid,
                                                            {.tx = tx, .layers = options.layers});
  if (options.on_streets) keep_cells_on_streets(maps, config);
  for (const std::string& problem : maps.front().left_out) warn(problem);
  const auto noted = std::ranges::find_if(maps, [](const coverage::Map& map) { return !map.notes.empty(); });
  if (noted != maps.end()) warn(fmt::format("frame {}: {}", noted->frame, noted->notes.front()));
  if (std::ranges::all_of(maps, [](const coverage::Map& map) { return map.reached_cells() == 0; }))
    warn(fmt::format("no path to the grid \"{}\" in {}{}: {}", grid.name,
                     maps.size() == 1 ? fmt::format("frame {}", maps.front().frame)
                                      : fmt::format("frames {} to {}", maps.front().frame, maps.back().frame),
                     tx ? " from \"" + options.tx + "\"" : "",
                     maps.size() == 1 ? "the map is empty" : "the maps are empty"));
  if (const std::string words = place_warning(options.formats, georeference); !words.empty()) warn(words);
  const std::filesystem::path folder =
      options.folder.empty() ? run.file().parent_path() / "coverage" : std::filesystem::path(options.folder);
  const coverage::MapsToWrite what{maps, !options.frames.empty(), options.formats, georeference};
  for (const std::filesystem::path& file : coverage::write_maps(what, folder)) std::cout << file.string() << "\n";
}

}  // namespace

void add_coverage(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "coverage", "Write maps of a run's [[receiver_grid]]: tables, arrays, GeoTIFF, pictures, KML");
  const auto options = std::make_shared<CoverageOptions>();
  command->add_option("RUN", options->run, "Folder of a run, or its paths.h5")->required();
  command->add_option("-o,--output", options->folder,
                      "Folder for the files; the folder coverage in the folder of the run if not given");
  command->add_option("--grid", options->grid, "Name of a [[receiver_grid]]; needed if the run has several");
  command->add_option("--tx", options->tx,
                      "Name of the transmitter that serves all cells; the strongest of each cell if not given");
  CLI::Option* const frame =
      command->add_option("--frame", options->frame, "Number of the frame; the first frame if not given");
  command
      ->add_option("--frames", options->frames,
                   "Numbers of several frames, each of which gets a map: A:B, A-B, A:, :B, A or all")
      ->excludes(frame);
  command
      ->add_option("--layers", options->layers,
                   fmt::format("Layers to write, separated by commas: {}; all that the run can tell if not given",
                               fmt::join(coverage::layer_names(), ", ")))
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_flag("--on-streets", options->on_streets,
                    "Leave out the cells that are on no street: those of scene.streets, or of the generated city");
  add_map_formats(*command, options->formats);
  command->callback([options] { make_coverage(*options); });
}

}  // namespace wavetracer::app
