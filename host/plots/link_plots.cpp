// SPDX-License-Identifier: Apache-2.0
// Data are written as doubles that read back the same; units are changed in the scripts alone.
// Weak points are drawn first, so that strong ones lie on top.
#include "plots/link_plots.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include "base/csv.hpp"
#include "base/times.hpp"
#include "output/path_kinds.hpp"
#include "plots/gnuplot.hpp"
#include "radio/link_budget.hpp"

namespace wavetracer::plots {
namespace {

constexpr double shown_span_db = 80;  // range below the strongest path

std::string first_link(const SavedRun& run, const LinkSeries& series) { return link_name(run, series.links.front()); }

std::string frame_title(const char* what, const SavedRun& run, const LinkSeries& series) {
  std::string at =
      run.frame_count() > 1 ? fmt::format(", frame {} at {} s", series.frame, time_text(series.frame_time_s)) : "";
  return fmt::format("{}, {}{}", what, first_link(run, series), at);
}

std::vector<PathPoint> weakest_first(const LinkSeries& series) {
  std::vector<PathPoint> out = series.paths_of_frame();
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.gain_db < b.gain_db; });
  return out;
}

std::vector<double> gains(const std::vector<PathPoint>& paths) {
  std::vector<double> out;
  for (const PathPoint& p : paths) out.push_back(p.gain_db);
  return out;
}

// Writes one frame's paths with every column that a plot of them may need.
std::string path_table(const std::vector<PathPoint>& paths) {
  constexpr double degree = std::numbers::pi / 180;
  Csv table({"frame", "time_s", "kind", "kind_name", "delay_s", "gain_db", "doppler_hz", "departure_azimuth_deg",
             "departure_elevation_deg", "arrival_azimuth_deg", "arrival_elevation_deg"});
  const auto azimuth = [](double phi_rad) { return std::remainder(phi_rad, 2 * std::numbers::pi) / degree; };
  for (const PathPoint& p : paths)
    table.add(p.frame, p.time_s, p.kind, path_kinds[p.kind].word, p.delay_s, p.gain_db, p.doppler_hz,
              azimuth(p.aod_phi_rad), 90 - p.aod_theta_rad / degree, azimuth(p.aoa_phi_rad),
              90 - p.aoa_theta_rad / degree);
  return table.text();
}

// Returns the range of the delay axis: all delays and a small margin, but nothing below zero.
std::string delay_range(const std::vector<PathPoint>& paths) {
  const auto [first, last] = std::ranges::minmax_element(paths, {}, &PathPoint::delay_s);
  const double lower_ns = 1e9 * first->delay_s, upper_ns = 1e9 * last->delay_s;
  const double beside_ns = std::max(0.03 * (upper_ns - lower_ns), 1.0);
  return fmt::format("set xrange [{:.3f}:{:.3f}]\n", std::max(lower_ns - beside_ns, 0.0), upper_ns + beside_ns);
}

struct Shown {
  double lower_db, upper_db;
};

Shown shown_gains(const std::vector<double>& values) {
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  const double upper = 5 * std::ceil(*highest / 5 + 0.4);
  return {std::max(5 * std::floor(*lowest / 5 - 0.4), upper - shown_span_db), upper};
}

// Adds an axis of received powers beside the gains, if the configuration has a link budget.
std::string power_axis(const RadioConfig& radio) {
  if (!radio.transmit_power_dbm) return "";
  const std::string noise = radio.bandwidth_hz ? fmt::format(", noise {:.1f} dBm", noise_dbm(radio)) : "";
  return fmt::format(
      "set ytics nomirror\n"
      "set link y2 via y + {0} inverse y - ({0})\n"
      "set y2tics\n"
      "set y2label 'received power (dBm){1}'\n",
      *radio.transmit_power_dbm, noise);
}

// The axis of times. It starts at the first time if the six digits of gnuplot's labels could not tell the times apart
// otherwise.
struct TimeAxis {
  double zero_s;
  explicit TimeAxis(const std::vector<LinkMoment>& moments) {
    const double first_s = moments.front().time_s, last_s = moments.back().time_s;
    zero_s = last_s > first_s && std::abs(first_s) > 1e4 * (last_s - first_s) ? std::floor(first_s) : 0;
  }
  std::string label() const {
    return zero_s == 0 ? "set xlabel 'time (s)'\n"
                       : fmt::format("set xlabel 'time after {} s (s)'\n", time_text(zero_s));
  }
  // Returns the expression of the time column for gnuplot.
  std::string column(int number) const {
    return zero_s == 0 ? fmt::format("${}", number) : fmt::format("(${} - {})", number, zero_s);
  }
};

}  // namespace

Figure gain_figure(const SavedRun& run, const LinkSeries& series, const RadioConfig& radio) {
  Csv table({"link", "tx", "rx", "frame", "time_s", "paths", "path_gain_db", "mean_delay_s", "rms_delay_spread_s",
             "doppler_spread_hz", "los", "narrowband_gain_db", "received_dbm", "snr_db", "sum_of_powers_db"});
  const TimeAxis axis(series.moments.front());
  const std::string time = axis.column(5);
  std::string plot = "plot ";
  for (size_t k = 0; k < series.links.size(); ++k) {
    const Link& link = series.links[k];
    for (const auto& [time_s, f] : series.moments[k]) {
      const LinkBudget budget = link_budget(radio, f.paths > 0 ? f.path_gain_db : NAN);
      table.add(k + 1, run.transmitters()[link.tx].name, run.receivers()[link.rx].name, f.frame, time_s, f.paths,
                f.paths > 0 ? f.path_gain_db : NAN, f.mean_delay_s, f.rms_delay_spread_s, f.doppler_spread_hz, f.los,
                f.paths > 0 ? f.narrowband_gain_db : NAN, budget.received_dbm, budget.snr_db,
                f.paths > 0 ? f.sum_of_powers_db : NAN);
    }
    const std::string_view colour = colours[k % colours.size()];
    plot += fmt::format(
        "{0}'gain.csv' using ($1 == {1} ? {4} : NaN):7 with lines linecolor '{2}' linewidth 1.5 title '{3}' "
        "noenhanced, \\\n"
        "  '' using ($1 == {1} ? {4} : NaN):12 with lines linecolor '{2}' linewidth 0.6 dashtype 3 notitle, \\\n"
        "  '' using ($1 == {1} && $11 == 1 ? {4} : NaN):7 with points pointtype 7 pointsize 0.5 linecolor '{2}' "
        "notitle",
        k == 0 ? "" : ", \\\n  ", k + 1, colour, quoted(link_name(run, link)), time);
  }
  return {"gain",
          "Path gain along the drive",
          {{"gain.csv", table.text()}},
          power_axis(radio) + axis.label() +
              "set ylabel 'path gain (dB)'\n"
              "set key outside right top Left reverse samplen 2\n" +
              plot +
              ", \\\n  NaN with points pointtype 7 pointsize 0.5 linecolor '#444444' title 'line of sight', \\\n"
              "  NaN with lines linecolor '#444444' linewidth 0.6 dashtype 3 title 'narrowband gain'\n"};
}

Figure delay_figure(const SavedRun& run, const LinkSeries& series) {
  const std::vector<PathPoint> paths = weakest_first(series);
  const Shown shown = shown_gains(gains(paths));
  std::string plot;
  for (size_t kind = 0; kind < path_kinds.size(); ++kind) {
    if (std::none_of(paths.begin(), paths.end(), [&](const auto& p) { return p.kind == kind; })) continue;
    std::string name(path_kinds[kind].word);
    std::replace(name.begin(), name.end(), '_', ' ');
    const std::string_view colour = colours[path_kinds[kind].plot];
    plot += fmt::format(
        "{0}'pdp.csv' using ($3 == {1} && $6 > floor_db ? 1e9 * $5 : NaN):(floor_db):(0):($6 - floor_db) "
        "with vectors nohead linecolor '{2}' linewidth 1.5 notitle, \\\n"
        "  '' using ($3 == {1} ? 1e9 * $5 : NaN):6 with points pointtype 7 pointsize 0.6 linecolor '{2}' title '{3}'",
        plot.empty() ? "plot " : ", \\\n  ", kind, colour, name);
  }
  return {"pdp",
          frame_title("Power delay profile", run, series),
          {{"pdp.csv", path_table(paths)}},
          fmt::format("floor_db = {}\n"
                      "set yrange [floor_db:{}]\n"
                      "{}"
                      "set xlabel 'delay (ns)'\n"
                      "set ylabel 'path gain (dB)'\n"
                      "set key right top Left reverse samplen 1\n",
                      shown.lower_db, shown.upper_db, delay_range(paths)) +
              plot + "\n"};
}

Figure delay_time_figure(const SavedRun& run, const LinkSeries& series) {
  constexpr size_t most_columns = 1000, rows = 150;
  const std::vector<LinkMoment>& moments = series.moments.front();
  const size_t frames = moments.size(), columns = std::min(frames, most_columns);
  const auto column_of = [&](size_t frame) { return frame * columns / frames; };
  double strongest = -INFINITY, first_s = INFINITY, last_s = -INFINITY;
  for (const PathPoint& p : series.paths) strongest = std::max(strongest, p.gain_db);
  for (const PathPoint& p : series.paths)
    if (p.gain_db > strongest - shown_span_db) {
      first_s = std::min(first_s, p.delay_s);
      last_s = std::max(last_s, p.delay_s);
    }
  const double step_s = std::max((last_s - first_s) / (rows - 1), 1e-12);  // positions are the middles of cells
  std::vector<double> power(columns * rows, 0), frames_of(columns, 0);
  for (size_t k = 0, i = 0; k < frames; ++k) {
    frames_of[column_of(k)] += 1;
    for (; i < series.paths.size() && series.paths[i].frame == moments[k].figures.frame; ++i) {
      const double row = std::round((series.paths[i].delay_s - first_s) / step_s);
      if (row >= 0 && row < rows)
        power[column_of(k) * rows + static_cast<size_t>(row)] += std::pow(10, series.paths[i].gain_db / 10);
    }
  }
  const TimeAxis axis(moments);
  const double from_s = moments.front().time_s, to_s = moments.back().time_s;
  const double column_s = columns > 1 ? (to_s - from_s) / static_cast<double>(columns - 1) : 1;
  Csv table({"time_s", "delay_s", "gain_db"});
  std::vector<double> cells;
  for (size_t c = 0; c < columns; ++c)
    for (size_t r = 0; r < rows; ++r) {
      const double p = power[c * rows + r] / frames_of[c];
      cells.push_back(p > 0 ? 10 * std::log10(p) : NAN);
      table.add(from_s + static_cast<double>(c) * column_s, first_s + static_cast<double>(r) * step_s, cells.back());
    }
  return {"delay-time",
          "Power by delay along the drive, " + first_link(run, series),
          {{"delay-time.csv", table.text()}},
          colour_range(cells, shown_span_db) + axis.label() +
              "unset grid\n"
              "set ylabel 'delay (ns)'\n"
              "set cblabel 'path gain (dB)'\n"
              "set autoscale fix\n"
              "set yrange [0<*:]\n"
              "set key off\n"
              "plot 'delay-time.csv' using (" +
              axis.column(1) + "):(1e9 * $2):3 with image\n"};
}

Figure doppler_figure(const SavedRun& run, const LinkSeries& series) {
  const std::vector<PathPoint> paths = weakest_first(series);
  return {"doppler",
          frame_title("Paths by delay and Doppler shift", run, series),
          {{"doppler.csv", path_table(paths)}},
          colour_range(gains(paths), shown_span_db) +
              "set xlabel 'delay (ns)'\n"
              "set ylabel 'Doppler shift (Hz)'\n"
              "set cblabel 'path gain (dB)'\n"
              "set offsets 0, 0, graph 0.06, graph 0.06\n"
              "set key off\n" +
              delay_range(paths) +
              "plot 'doppler.csv' using (1e9 * $5):7:6 with points pointtype 7 pointsize 0.9 palette\n"};
}

Figure angle_figure(const SavedRun& run, const LinkSeries& series) {
  const std::vector<PathPoint> paths = weakest_first(series);
  return {"angles",
          frame_title("Directions of paths", run, series),
          {{"angles.csv", path_table(paths)}},
          colour_range(gains(paths), shown_span_db) + "set multiplot layout 1,2 title '" +
              quoted(frame_title("Directions of paths", run, series)) +
              "' noenhanced margins 0.08,0.87,0.15,0.84 spacing 0.05\n"
              "set xlabel 'azimuth (degrees)'\n"
              "set xrange [-180:180]\n"
              "set xtics 90\n"
              "stats 'angles.csv' using 9 skip 1 name 'departure' nooutput\n"
              "stats 'angles.csv' using 11 skip 1 name 'arrival' nooutput\n"
              "lower = (departure_min < arrival_min ? departure_min : arrival_min) - 5\n"
              "upper = (departure_max > arrival_max ? departure_max : arrival_max) + 5\n"
              "set yrange [lower > -90 ? lower : -90 : upper < 90 ? upper : 90]\n"
              "set key off\n"
              "set title 'departure'\n"
              "set ylabel 'elevation (degrees)'\n"
              "unset colorbox\n"
              "plot 'angles.csv' using 8:9:6 with points pointtype 7 pointsize 0.9 palette\n"
              "set title 'arrival'\n"
              "set colorbox\n"
              "set cblabel 'path gain (dB)'\n"
              "unset ylabel\n"
              "set format y ''\n"
              "plot 'angles.csv' using 10:11:6 with points pointtype 7 pointsize 0.9 palette\n"
              "unset multiplot\n",
          1000,
          460};
}

}  // namespace wavetracer::plots
