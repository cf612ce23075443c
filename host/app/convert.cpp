// SPDX-License-Identifier: Apache-2.0
// `wavetracer convert`: a run in the format of another program, or a map as a scene.
// The content of INPUT decides which of the two it is; --to, or a sufficient suffix of -o, decides what is written.
#include "convert/convert.hpp"
#include <fmt/format.h>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include "app/commands.hpp"
#include "app/idle_options.hpp"
#include "app/saved_frames.hpp"
#include "app/standard_streams.hpp"
#include "base/input_file.hpp"
#include "base/pending_file.hpp"
#include "base/spelling.hpp"
#include "imports/imports.hpp"
#include "jobs/interrupt.hpp"
#include "jobs/progress.hpp"
#include "motion/read.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* map_group = "Maps";  // heading of the options of maps in the help

struct ConvertOptions {
  std::string input, format, output, frames, projection, traffic;
  bool list = false;
  ImportOptions map;
};

std::string formats_in_words() {
  std::string words;
  for (const std::string& name : exporter_names()) words += (words.empty() ? "" : ", ") + name;
  return words;
}

void print_list() {
  for (const Exporter& exporter : exporters())
    std::cout << fmt::format("{:<10}{:<8}{}\n", exporter.name, *exporter.suffix ? exporter.suffix : "folder",
                             exporter.doc);
}

const Exporter& named_exporter(const std::string& name) {
  for (const Exporter& exporter : exporters())
    if (name == exporter.name) return exporter;
  throw ConfigError(fmt::format("--to {}: there is no such format{}; formats are {}", name,
                                spelling_hint(name, exporter_names()), formats_in_words()));
}

const Exporter& chosen_exporter(const ConvertOptions& options) {
  const std::string suffix = fs::path(options.output).extension().string();
  const Exporter* by_suffix = nullptr;
  for (const Exporter& exporter : exporters())
    if (*exporter.suffix && suffix == exporter.suffix) by_suffix = &exporter;
  if (options.format.empty()) {
    if (by_suffix) return *by_suffix;
    throw ConfigError(fmt::format("-o {}: the suffix of this name belongs to no format; add --to with one of {}",
                                  options.output, formats_in_words()));
  }
  const Exporter& exporter = named_exporter(options.format);
  if (by_suffix && by_suffix != &exporter)
    throw ConfigError(fmt::format("-o {}: this suffix belongs to the format {}, but --to says {}; {}", options.output,
                                  by_suffix->name, exporter.name,
                                  *exporter.suffix ? fmt::format("name it {}", exporter.suffix) : "name a folder"));
  return exporter;
}

// An output is a file or a folder; an existing OUT must be of the same kind.
void check_output(const Exporter& exporter, const fs::path& output) {
  std::error_code ignored;
  if (!fs::exists(output, ignored)) return;
  const bool folder = fs::is_directory(output, ignored);
  if (*exporter.suffix && folder)
    throw ConfigError(
        fmt::format("-o {}: this is a folder, but the format {} is one file; give the name of a file such as {}",
                    output.string(), exporter.name, (output / (std::string("run") + exporter.suffix)).string()));
  if (!*exporter.suffix && !folder)
    throw ConfigError(fmt::format("-o {}: this is a file, but the format {} is a folder; give another name",
                                  output.string(), exporter.name));
}

void export_run(const ConvertOptions& options) {
  const Exporter& exporter = chosen_exporter(options);
  if (!options.projection.empty() && !is_on_earth(exporter.name))
    throw ConfigError(
        fmt::format("--projection: the format {} has the coordinates of the scene, and no places on the "
                    "earth; leave it out",
                    exporter.name));
  check_output(exporter, options.output);
  const SavedRun run(options.input);
  ExportOptions what;
  what.output = options.output;
  what.projection = options.projection;
  const FrameRows rows = frame_rows(run, options.frames);
  what.first_row = rows.first;
  what.last_row = rows.last;
  std::optional<RemoveOnInterrupt> guard(what.output);
  PendingDirectory parent(what.output.has_parent_path() ? what.output.parent_path() : fs::path("."));
  Progress progress;
  what.at = [&progress](uint64_t done, uint64_t total) { progress.bar("converting", done, total, "frames"); };
  std::vector<std::string> warnings;
  const Written written = exporter.write(run, what, warnings);
  progress.end();
  guard.reset();
  parent.keep();
  for (const std::string& warning : warnings) std::cerr << "warning: " << warning << "\n";
  std::ostream& out = word_about(written.front());
  out << "written    " << written.front().string();
  if (written.size() > 1) out << " and " << written.size() - 1 << (written.size() > 2 ? " files" : " file");
  out << "\n";
}

// Returns the area of a file's vehicles, which the ground must cover.
Extent extent_of_traffic(const ConvertOptions& options) {
  if (options.map.net.empty() && fs::path(options.input).extension() != ".xml")
    throw ConfigError(
        fmt::format("--traffic {}: needs --net with the network that the vehicles drive on, since only then map "
                    "and vehicles have the same coordinates",
                    options.traffic));
  Extent out;
  for (const Track& track : read_trajectories(options.traffic).tracks)
    for (const Sample& sample : track.samples) out.add({sample.position_m.x, sample.position_m.y});
  return out;
}

void check_input(const fs::path& input) {
  std::error_code error;
  if (!fs::exists(input, error))
    throw InputError(
        fmt::format("{}: there is no such file or folder; name the folder of a run, its paths.h5, or a map{}",
                    input.string(), backslash_hint(input)));
}

void import_map(const ConvertOptions& options) {
  if (!options.frames.empty())
    throw ConfigError(fmt::format("--frames: this option is for runs, but {} is a map", options.input));
  if (!options.format.empty() && options.format != "mitsuba")
    throw ConfigError(fmt::format("--to {}: a map can only be converted to a scene (mitsuba)", options.format));
  ImportOptions map = options.map;
  map.output = options.output;
  map.projection = options.projection;
  if (!map.projection.empty() && !map.net.empty())
    throw ConfigError("--projection and --net both say which coordinates the scene has: remove one of them");
  if (!options.traffic.empty()) map.traffic = extent_of_traffic(options);
  Progress progress;
  map.at = [&progress](uint64_t done, uint64_t total) { progress.bar("writing", done, total, "meshes"); };
  std::optional<RemoveOnInterrupt> guard(map.output / "meshes");
  const ImportSummary summary = import_city(options.input, map);
  guard.reset();
  progress.end();
  for (const std::string& warning : summary.warnings) std::cerr << "warning: " << warning << "\n";
  std::cout << describe(summary);
}

// Options that would change nothing of this input are refused.
void check_map_or_run(const CLI::App& command, const ConvertOptions& options) {
  const ImportOptions& map = options.map;
  if (!is_import(options.input))
    return refuse_group(command, map_group, fmt::format("this option is for maps, but {} is a run", options.input));
  if (is_sumo_map(options.input))
    refuse_options(command, {"--projection"}, "SUMO's polygons have the coordinates of their network");
  if (map.terrain.empty()) refuse_options(command, {"--terrain-error"}, "there is no --terrain that it is about");
  if (!map.ground)
    refuse_options(command, {"--margin", "--ground-material", "--traffic"}, "--no-ground leaves out the ground");
}

void add_map_options(CLI::App& command, ConvertOptions& options) {
  ImportOptions& map = options.map;
  const auto add = [&](const char* name, auto& value, const char* help) {
    return command.add_option(name, value, help)->group(map_group);
  };
  add("--net", map.net, "For OSM maps: the .net.xml that netconvert made from the map; the scene gets its coordinates");
  add("--traffic", options.traffic, "Trajectories (FCD, CSV) whose whole area the ground must cover too");
  add("--layer", map.layer, "For maps that GDAL opens: the layer with the buildings; all layers if not given");
  add("--height", map.height_field,
      "For maps that GDAL opens: the field with heights of buildings in metres; \"height\" if there is one");
  add("--levels", map.levels_field,
      "For maps that GDAL opens: the field with numbers of storeys; \"levels\" if there is one");
  add("--lod", map.lod,
      "For CityJSON and CityGML: the highest level of detail to build, 1, 2 or 3, or one of CityJSON's, "
      "such as 1.2; 2 if not given");
  add("--terrain", map.terrain,
      "Heights of the ground in metres, a raster that GDAL opens (GeoTIFF and others): the ground follows it, "
      "and houses stand on it");
  add("--terrain-error", map.terrain_error_m, "The most by which the ground may miss a post of the terrain, in metres")
      ->capture_default_str();
  add("--level-height", map.level_height_m, "Height of one storey of a building in metres")->capture_default_str();
  add("--default-height", map.default_height_m, "Height in metres of buildings without a height in the map")
      ->capture_default_str();
  add("--margin", map.margin_m, "Distance by which the ground extends beyond buildings, network and traffic, in metres")
      ->capture_default_str();
  add("--wall-material", map.wall_material, "ITU material if the map does not name one")->capture_default_str();
  command
      .add_flag(
          "--wall-classes", map.wall_classes,
          "Give walls classes by their tags, with a thickness and a roughness, and write their [[material]] tables "
          "to materials.toml")
      ->group(map_group);
  add("--roof-material", map.roof_material, "ITU material if the map does not name one")->capture_default_str();
  add("--ground-material", map.ground_material, "ITU material of the ground")->capture_default_str();
  command
      .add_flag("--vegetation,!--no-vegetation", map.vegetation,
                "Trees, rows of trees and woods of the map as volumes that attenuate (the default), or not: Sionna RT "
                "does not know them")
      ->group(map_group);
  command.add_flag("!--no-ground", map.ground, "Write buildings only, without ground")->group(map_group);
}

}  // namespace

void add_convert(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("convert", "Convert a run to the format of another program, or a city map to a scene");
  const auto options = std::make_shared<ConvertOptions>();
  command->add_option("INPUT", options->input,
                      "The folder of a run, its paths.h5, or a map (.osm, .osm.pbf, .poly.xml, CityJSON, CityGML, "
                      "or what GDAL opens: .gpkg, .shp, .geojson, .fgb and many more)");
  command->add_option("--to", options->format, "Format of a run: " + formats_in_words());
  command->add_option("-o,--output", options->output, "File or folder to write; which of them depends on the format");
  command->add_option("--frames", options->frames, "Frames of the run: A:B, A:, :B or A; all frames if not given");
  command->add_option(
      "--projection", options->projection,
      "PROJ string. For kml and osi: the coordinates of the scene, if no georeference.json contains them. "
      "For a map: the coordinates that the scene shall have, instead of metres about its middle");
  command->add_flag("--list", options->list, "List the formats for --to");
  add_map_options(*command, *options);
  command->callback([options, command] {
    if (options->list) return print_list();
    if (options->input.empty()) throw ConfigError("convert: give what to convert: the folder of a run, or a map");
    if (!options->format.empty() && options->format != "mitsuba") named_exporter(options->format);
    check_input(options->input);
    if (options->output.empty()) throw ConfigError("convert: give the file or folder to write with -o");
    check_map_or_run(*command, *options);
    if (is_import(options->input)) return import_map(*options);
    export_run(*options);
  });
}

}  // namespace wavetracer::app
