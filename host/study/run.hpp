// Carries an experiment out: measures point by point, then writes NAME.csv, NAME.gp, NAME.svg and NAME.md to a folder.
// Assumes that nothing else keeps the device busy; what others do to the CPU hits all series alike.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>
#include "study/coherence_rays.hpp"
#include "study/experiment.hpp"
#include "study/ray_counts.hpp"

namespace wavetracer::study {

struct Request {
  Config config;                 // see experiment_config; output.directory is where the files go
  std::string device;            // as Simulation takes it
  std::optional<RayRange> rays;  // not given: those of the figure
  uint32_t repeats = 5;
  uint64_t frames = 0;                 // of a drive; 0: what suits the device
  bool quick = false;                  // fewer rays and frames
  std::optional<double> minutes = {};  // after which a figure of orders begins no more points; else: by device
  std::string command_line;            // for the report
};

// What the program lends: a line of progress, whether the user wants to stop, and how far a task is.
struct Host {
  std::function<void(const std::string&)> say;
  std::function<bool()> interrupted;
  // what: is measured now; done: of total; unit: of what is counted ("rays"). May be left out.
  std::function<void(const std::string& what, uint64_t done, uint64_t total, const std::string& unit)> at = {};
  void tell(const std::string& what, uint64_t done, uint64_t total, const std::string& unit) const {
    if (at) at(what, done, total, unit);
  }
};

// What an experiment leaves to be written.
struct Findings {
  DeviceSummary device;
  size_t points = 0, planned = 0;    // measured, and asked for; nothing is written where none was
  std::string table{}, script{};     // NAME.csv and NAME.gp
  Words words{};                     // of the report
  std::vector<std::string> notes{};  // lines of the report: how it was measured
};

// One function for each kind of figure. A stop is heeded after the point in progress. Throws ConfigError, InputError,
// DeviceError or RuntimeError.
Findings measure(const OrderFigure& figure, const Experiment& experiment, const Request& request, const Host& host);
Findings measure(const CacheFigure& figure, const Experiment& experiment, const Request& request, const Host& host);
Findings measure(const FrameFigure& figure, const Experiment& experiment, const Request& request, const Host& host);
Findings measure(const LagFigure& figure, const Experiment& experiment, const Request& request, const Host& host);

// What figures say of their rows.
Words order_words(const Experiment& experiment, const std::vector<OrderRow>& rows, const std::string& device);
Words frame_words(const Experiment& experiment, const std::vector<FramePair>& rows, const Drive& drive,
                  const std::string& world, const std::string& device);
Words lag_words(const Experiment& experiment, const std::vector<LagRow>& rows, const std::string& device);
// What a figure of caches shows of its study.
Findings show(const Experiment& experiment, const CacheMeasurement& measured, const Request& request);

// The measurement that fits the experiment. Throws ConfigError also where the request asks for what it cannot give.
Findings find_out(const Experiment& experiment, const Request& request, const Host& host);

struct Report {
  std::string text;                          // for the terminal
  std::vector<std::filesystem::path> files;  // empty: stopped before the first point
  size_t points = 0, planned = 0;            // measured, and asked for: numbers of rays of a figure
};

// Writes the files of findings that have points.
Report write_report(const Experiment& experiment, const Request& request, const Findings& found, const Host& host);

Report run_experiment(const Experiment& experiment, const Request& request, const Host& host);

}  // namespace wavetracer::study
