// SPDX-License-Identifier: Apache-2.0
// A figure that was asked for and cannot be made is an error; one that was not asked for and does not suit is skipped.
// Names of grids are those of the run's configuration.
#include "plots/plots.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include "base/spelling.hpp"
#include "base/times.hpp"
#include "plots/coverage_plot.hpp"
#include "plots/link_plots.hpp"
#include "plots/radar_plot.hpp"
#include "plots/rays_plot.hpp"
#include "results/link_rows.hpp"
#include "results/link_table.hpp"
#include "results/run_choice.hpp"
#include "results/saved_radar.hpp"
#include "results/saved_waypoints.hpp"
#include "results/saved_world.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::plots {
namespace {

namespace fs = std::filesystem;

constexpr size_t shown_links = 6;  // number of lines that can be told apart

class Plotter {
 public:
  Plotter(const SavedRun& run, const PlotChoice& choice, const fs::path& folder)
      : run_(run), choice_(choice), folder_(folder), world_(load_saved_world(run)) {
    report_.warnings = world_.warnings;
    for (const ReceiverGridConfig& grid : world_.config.receiver_grids) grids_.push_back(grid.name);
  }

  PlotReport plot() {
    check_choice();
    if (std::any_of(plot_names.begin(), plot_names.begin() + link_plots, [&](auto name) { return asked(name); }))
      plot_links();
    if (asked("coverage")) plot_coverage();
    if (asked("rays")) plot_rays();
    if (asked("range-doppler") || asked("micro-doppler")) plot_radar();
    return std::move(report_);
  }

 private:
  const SavedRun& run_;
  const PlotChoice& choice_;
  const fs::path& folder_;
  SavedWorld world_;
  std::vector<std::string> grids_;
  PlotReport report_;

  bool by_name(std::string_view name) const { return std::ranges::find(choice_.what, name) != choice_.what.end(); }
  bool asked(std::string_view name) const { return choice_.what.empty() || by_name(name); }

  // Tells whether a figure is drawn: it was asked for, or suits by default. `unfit`: the reason why it does not suit.
  bool wanted(std::string_view name, bool suits, const std::string& unfit) const {
    if (by_name(name) && !suits) throw ConfigError(fmt::format("--what {}: {}", name, unfit));
    return asked(name) && suits;
  }

  void check_choice() const {
    const std::vector<std::string> known(plot_names.begin(), plot_names.end());
    for (const std::string& name : choice_.what)
      if (std::ranges::find(known, name) == known.end())
        throw ConfigError(fmt::format("--what \"{}\" is no plot, there are {}{}", name, fmt::join(known, ", "),
                                      spelling_hint(name, known)));
    check_heeded();
    if (!choice_.grid.empty()) find_grid(world_.config.receiver_grids, choice_.grid);
    if (!choice_.layer.empty()) coverage::layer_kind(choice_.layer);  // throws for an unknown name
    if (run_.path_count() == 0 && choice_.what != std::vector<std::string>{"rays"})
      throw InputError(
          fmt::format("{}: the run found no path at all, so there is nothing to plot; "
                      "look at the places of its antennas, and at trace.max_depth",
                      run_.file().string()));
  }

  // Throws ConfigError for a choice that changes none of the figures that were asked for.
  void check_heeded() const {
    const auto any = [this](std::initializer_list<std::string_view> names) {
      return std::ranges::any_of(names, [this](std::string_view name) { return asked(name); });
    };
    const auto refuse = [](bool given, const char* option, const char* reason) {
      if (given) throw ConfigError(fmt::format("{}: {}; leave it out", option, reason));
    };
    const bool links = any({"gain", "pdp", "delay-time", "doppler", "angles"});
    const bool radars = any({"range-doppler", "micro-doppler"});
    const char* const no_map = grids_.empty() ? "the run has no [[receiver_grid]], so no map is drawn"
                                              : "it is about the figure coverage, which --what does not name";
    if (grids_.empty() || !asked("coverage")) {
      refuse(!choice_.layer.empty(), "--layer", no_map);
      refuse(!choice_.grid.empty(), "--grid", no_map);
      refuse(!links && !radars && !choice_.link.tx.empty(), "--tx",
             "none of the figures of --what is about a transmitter");
    }
    refuse(!radars && !choice_.radar.empty(), "--radar", "none of the figures of --what is about a radar");
    refuse(!links && !radars && !choice_.link.rx.empty(), "--rx", "none of the figures of --what is about a link");
    refuse(choice_.link.frame.has_value() && !any({"pdp", "doppler", "angles", "coverage", "rays", "range-doppler"}),
           "--frame", "the figures of --what show all frames");
  }

  void add(const Figure& figure) {
    const Drawn drawn = draw(figure, choice_.formats, folder_);
    report_.files.insert(report_.files.end(), drawn.files.begin(), drawn.files.end());
    if (!drawn.problem.empty() && std::ranges::find(report_.warnings, drawn.problem) == report_.warnings.end())
      report_.warnings.push_back(figure.name + ": " + drawn.problem);
  }

  void plot_links() {
    // A grid's receivers have links too, but they are shown as a map unless one of them is named.
    const bool by_default = choice_.what.empty() && choice_.link.rx.empty() && !grids_.empty();
    LinkSeries series;
    try {
      series = link_series(run_, choice_.link, grids_, shown_links);
    } catch (const InputError&) {
      if (!by_default) throw;
    }
    if (series.links.empty()) {
      if (!by_default)
        throw ConfigError("only receivers of grids have paths: name one with --rx, or use --what coverage");
      return;
    }
    const bool drive = run_.frame_count() > 1;
    const std::string still = "the run has one frame only, and nothing changes with time";
    if (wanted("gain", drive, still)) add(gain_figure(run_, series, world_.config.radio));
    if (wanted("delay-time", drive, still)) add(delay_time_figure(run_, series));
    const std::vector<PathPoint> paths = series.paths_of_frame();
    const std::string none = fmt::format("{} has no path in frame {}: choose another one with --frame",
                                         link_name(run_, series.links.front()), series.frame);
    if (wanted("pdp", !paths.empty(), none)) add(delay_figure(run_, series));
    if (wanted("angles", !paths.empty(), none)) add(angle_figure(run_, series));
    const bool moving = std::ranges::any_of(paths, [](const PathPoint& p) { return p.doppler_hz != 0; });
    if (wanted("doppler", !paths.empty() && (moving || by_name("doppler")), none)) add(doppler_figure(run_, series));
    if (paths.empty() && choice_.what.empty()) report_.warnings.push_back(none);
  }

  void plot_coverage() {
    if (!wanted("coverage", !grids_.empty(), "the run has no [[receiver_grid]]")) return;
    const auto tx = find_end(run_.transmitters(), choice_.link.tx, "--tx");
    const RadioConfig& radio = world_.config.radio;
    const coverage::LayerKind& layer = shown_layer(choice_.layer, radio);
    const size_t row = choice_.link.frame ? find_frame(run_, *choice_.link.frame) : 0;
    const SavedFrame frame = run_.frame(row);
    const std::vector<LinkRow> links = link_rows(frame, link_table(run_), run_.first_link(row), run_.frequency_hz());
    for (size_t k = 0; k < grids_.size(); ++k) {
      if (!choice_.grid.empty() && grids_[k] != choice_.grid) continue;
      const coverage::Map map =
          coverage::coverage_map(run_, radio, frame, links, world_.config.receiver_grids[k], {tx, {}, layer.of_areas});
      if (!choice_.layer.empty()) coverage::check_layer(layer, radio, map, "--layer");
      if (std::ranges::all_of(map.values(layer), [](double value) { return std::isnan(value); }))
        report_.warnings.push_back(fmt::format("coverage: {} to the grid \"{}\" in frame {}{}",
                                               map.reached_cells() == 0 ? "no path" : fmt::format("no {}", layer.name),
                                               grids_[k], frame.number, tx ? " from \"" + choice_.link.tx + "\"" : ""));
      else
        add(coverage_figure(run_, frame, k == 0 ? "coverage" : fmt::format("coverage_{}", k + 1), map, layer,
                            world_.scene, radio));
    }
  }

  void plot_rays() {
    const std::optional<SavedWaypoints> waypoints = saved_waypoints(run_);
    if (!wanted("rays", waypoints.has_value(), "the run has no waypoints.h5: give output.waypoints a number of rays"))
      return;
    const size_t row = choice_.link.frame ? find_frame(run_, *choice_.link.frame) : 0;
    const WaypointRows rows = waypoints->frame(run_.number(row));
    if (ray_segments(rows, 1).empty())
      report_.warnings.push_back(
          fmt::format("rays: none of the sampled rays of frame {} meets anything", run_.number(row)));
    else
      add(rays_figure(rows, run_.frame_count() > 1 ? fmt::format(", {} s", time_text(run_.time_s(row))) : "",
                      world_.scene));
  }

  // Without --what, --tx and --rx name the ends of other figures, too, which need not be those of a radar.
  std::optional<SavedRadar> chosen_radar() const {
    if (choice_.what.empty() && choice_.radar.empty()) return saved_radar(run_);
    return saved_radar(run_, {choice_.radar, find_end(run_.transmitters(), choice_.link.tx, "--tx"),
                              find_end(run_.receivers(), choice_.link.rx, "--rx")});
  }

  void plot_radar() {
    const std::optional<SavedRadar> radar = chosen_radar();
    const std::string missing =
        "the run has no radar.h5: give the configuration a [[radar]], or make it by `python3 -m wavetracer.radar RUN`";
    if (!choice_.radar.empty() && !radar) throw ConfigError("--radar: " + missing);
    const std::string of = radar ? fmt::format(" of {}, {} to {}", radar->name(), run_.transmitters()[radar->tx()].name,
                                               run_.receivers()[radar->rx()].name)
                                 : "";
    if (wanted("range-doppler", radar.has_value(), missing)) {
      const auto row =
          static_cast<size_t>(std::ranges::find(radar->frames(), choice_.link.frame.value_or(radar->frames()[0])) -
                              radar->frames().begin());
      if (row == radar->frames().size())
        throw ConfigError(fmt::format("--frame {}: radar.h5 has no such frame, only {} of them from {} to {}",
                                      *choice_.link.frame, row, radar->frames().front(), radar->frames().back()));
      const RadarMap map = radar->range_doppler(row);
      if (has_power(map))
        add(range_doppler_figure(
            map, of + (run_.frame_count() > 1 ? fmt::format(", {} s", time_text(radar->times_s()[row])) : "")));
      else
        report_.warnings.push_back(
            fmt::format("range-doppler: the radar hears nothing in frame {}", radar->frames()[row]));
    }
    const std::optional<RadarMap> spectra = radar ? radar->spectrogram() : std::nullopt;
    const bool several = spectra && spectra->rows.size() > 1;
    if (wanted("micro-doppler", several, radar ? "radar.h5 has no spectrogram of two times or more" : missing) &&
        has_power(*spectra))
      add(micro_doppler_figure(*spectra, of));
  }
};

}  // namespace

PlotReport plot_run(const SavedRun& run, const PlotChoice& choice, const fs::path& folder) {
  return Plotter(run, choice, folder).plot();
}

}  // namespace wavetracer::plots
