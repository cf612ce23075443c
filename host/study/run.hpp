// SPDX-License-Identifier: Apache-2.0
// Carries an experiment out: measures point by point, then writes NAME.csv, NAME.gp, NAME.svg and NAME.md to a folder.
// Nothing else may use the device; other load of the CPU affects all series alike.
#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include "base/progress_unit.hpp"
#include "plots/figure.hpp"
#include "study/coherence_rays.hpp"
#include "study/experiment.hpp"
#include "study/ray_counts.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::study {

struct Request {
  Config config;                 // see experiment_config; files go to output.directory
  std::string device;            // in the form of Simulation's argument
  std::optional<RayRange> rays;  // not given: those of the figure
  uint32_t repeats = 5;
  uint64_t frames = 0;                 // frames of a drive; 0: a number that suits the device
  bool quick = false;                  // uses fewer rays and frames
  std::optional<double> minutes = {};  // a figure of orders starts no more points after this time; default: by device
  std::string command_line;            // printed in the report
};

// Rays of an experiment that begins with few of them: a frame of few takes nearly as long as one of many.
inline const ProgressUnit rays_from_few{"rays", false};

// Services of the program: it prints lines of progress, tells whether the user wants to stop, and shows the state of a
// task.
struct Host {
  std::function<void(const std::string&)> say;
  std::function<bool()> interrupted;
  // what: the current measurement; done: of total; unit: of the count. It may be empty.
  std::function<void(const std::string& what, uint64_t done, uint64_t total, const ProgressUnit& unit)> at = {};
  // Watches every frame: it shows how far the frame is, and gives it up if the user wants to stop.
  FrameObserver watch = {};
  // Returns a guard for work that cannot stop midway, such as compiling kernels. If the user wants to stop while it
  // exists, `end` is called on another thread, and the program ends.
  std::function<std::shared_ptr<void>(std::function<void()> end)> at_once = {};
  void tell(const std::string& what, uint64_t done, uint64_t total, const ProgressUnit& unit) const {
    if (at) at(what, done, total, unit);
  }
  std::shared_ptr<void> guard(std::function<void()> end = {}) const {
    return at_once ? at_once(std::move(end)) : nullptr;
  }
};

// The results of an experiment, before they are written.
struct Findings {
  DeviceSummary device;
  size_t points = 0, planned = 0;    // measured and requested points; nothing is written if none was measured
  plots::Figure figure{};            // NAME.csv and NAME.gp
  Words words{};                     // text of the report
  std::vector<std::string> notes{};  // lines of the report that say how it was measured
};

// One function for each kind of figure. A stop takes effect after the point in progress. Throws ConfigError,
// InputError, DeviceError or RuntimeError.
Findings measure(const OrderFigure& figure, const Experiment& experiment, const Request& request, const Host& host);
Findings measure(const CacheFigure& figure, const Experiment& experiment, const Request& request, const Host& host);
Findings measure(const FrameFigure& figure, const Experiment& experiment, const Request& request, const Host& host);
Findings measure(const LagFigure& figure, const Experiment& experiment, const Request& request, const Host& host);

// Return the words of figures about their rows.
Words order_words(const Experiment& experiment, const std::vector<OrderRow>& rows, const std::string& device);
Words frame_words(const Experiment& experiment, const std::vector<FramePair>& rows, const Drive& drive,
                  const std::string& world, const std::string& device);
Words lag_words(const Experiment& experiment, const std::vector<LagRow>& rows, const std::string& device);
// Returns what a figure of caches shows of its study.
Findings show(const Experiment& experiment, const CacheMeasurement& measured, const Request& request);

// Makes the measurement for the experiment. Throws ConfigError also if the request asks for something that the
// experiment does not have.
Findings find_out(const Experiment& experiment, const Request& request, const Host& host);

struct Report {
  std::string text;                          // printed on the terminal
  std::vector<std::filesystem::path> files;  // empty if it was stopped before the first point
  size_t points = 0, planned = 0;            // measured and requested points: numbers of rays of a figure
};

// Writes the files of findings that have points.
Report write_report(const Experiment& experiment, const Request& request, const Findings& found, const Host& host);

Report run_experiment(const Experiment& experiment, const Request& request, const Host& host);

}  // namespace wavetracer::study
