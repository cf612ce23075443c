// Carries a recipe out: measures point by point, then writes NAME.csv, NAME.gp, NAME.svg and NAME.md to a folder.
// Assumes that nothing else keeps the device busy; what others do to the CPU hits all series alike.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>
#include "study/ray_counts.hpp"
#include "study/recipe.hpp"

namespace wavetracer::study {

struct Request {
  Config config;                 // see recipe_config; output.directory is where the files go
  std::string device;            // as Simulation takes it
  std::optional<RayRange> rays;  // not given: those of the figure
  uint32_t repeats = 5;
  uint64_t frames = 0;       // of a drive; 0: what suits the device
  bool quick = false;        // fewer rays and frames
  std::string command_line;  // for the report
};

// What the program lends: a line of progress, and whether the user wants to stop.
struct Host {
  std::function<void(const std::string&)> say;
  std::function<bool()> interrupted;
};

// What an experiment leaves to be written.
struct Findings {
  DeviceSummary device;
  std::string table, script;       // NAME.csv and NAME.gp
  Words words;                     // of the report
  std::string caption;             // of its plot
  std::vector<std::string> notes;  // lines of the report: how it was measured
  size_t points = 0, planned = 0;  // measured, and asked for; nothing is written where none was
};

// What a recipe with a study shows of it.
Findings show(const Recipe& recipe, const CacheMeasurement& measured, const Request& request);

Findings find_out(const Recipe& recipe, const Request& request, const Host& host);

struct Report {
  std::string text;                          // for the terminal
  std::vector<std::filesystem::path> files;  // empty: stopped before the first point
  size_t points = 0, planned = 0;            // measured, and asked for: ray counts of a figure
};

// Writes the files of findings that have points.
Report write_report(const Recipe& recipe, const Request& request, const Findings& found, const Host& host);

// A stop is heeded after the point in progress. Throws ConfigError, InputError, DeviceError or RuntimeError.
Report run_recipe(const Recipe& recipe, const Request& request, const Host& host);

}  // namespace wavetracer::study
