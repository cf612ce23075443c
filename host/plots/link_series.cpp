// SPDX-License-Identifier: Apache-2.0
// The run is read twice, first to find the strongest links, then to read those; once if a link is named. Links and
// paths of a frame must be sorted, as runs write them; links are sorted again, since a file may differ.
#include "plots/link_series.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include "output/path_kinds.hpp"
#include "radio/grouped_power.hpp"
#include "radio/path_power.hpp"
#include "results/run_choice.hpp"
#include "simulation/receiver_grid.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::plots {
namespace {

struct Filter {
  std::optional<uint32_t> tx, rx;
  std::vector<char> hidden;  // receivers that count only if they are named
  bool operator()(uint32_t t, uint32_t r) const { return (!tx || *tx == t) && (rx ? *rx == r : !hidden[r]); }
};

// The reverse of a link that is in the list already would lie on the same line, and is left out.
std::vector<Link> strongest_links(const SavedRun& run, const Filter& filter, size_t most) {
  std::map<Link, double> power;
  for (size_t row = 0; row < run.frame_count(); ++row) {
    const Paths paths = run.frame(row).paths;
    for (size_t first = 0, end = 0; first < paths.size(); first = end) {
      const Link link{paths.tx[first], paths.rx[first]};
      end = end_of_link(paths, first);
      if (filter(link.tx, link.rx)) power[link] += grouped_power(paths, first, end, run.frequency_hz());
    }
  }
  std::vector<std::pair<Link, double>> sorted(power.begin(), power.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  const auto backwards = [&](const Link& a, const Link& b) {
    return run.transmitters()[a.tx].name == run.receivers()[b.rx].name &&
           run.transmitters()[b.tx].name == run.receivers()[a.rx].name;
  };
  std::vector<Link> out;
  for (const auto& [link, ignored] : sorted) {
    if (out.size() == most) break;
    if (std::none_of(out.begin(), out.end(), [&, l = link](const Link& other) { return backwards(l, other); }))
      out.push_back(link);
  }
  return out;
}

LinkFigures no_figures(uint32_t frame, const Link& link) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  return {frame, link.tx, link.rx, 0, -infinity, -infinity, -infinity, nan, nan, nan, false};
}

void add_paths(const SavedFrame& frame, const Link& link, std::vector<PathPoint>& out) {
  const Paths& p = frame.paths;
  for (size_t i = 0; i < p.size(); ++i)
    if (p.tx[i] == link.tx && p.rx[i] == link.rx)
      out.push_back({frame.number, frame.time_s, path_kind(p, i), p.delay_s[i], p.gain_db[i], p.doppler_hz[i],
                     p.aod_theta_rad[i], p.aod_phi_rad[i], p.aoa_theta_rad[i], p.aoa_phi_rad[i]});
}

void add_frame(const SavedFrame& frame, double frequency_hz, LinkSeries& series) {
  std::vector<Link> sorted = series.links;
  std::sort(sorted.begin(), sorted.end());
  const std::vector<LinkFigures> figures = link_figures(frame.paths, frame.number, sorted, frequency_hz);
  for (size_t k = 0; k < series.links.size(); ++k) {
    const auto found = std::lower_bound(sorted.begin(), sorted.end(), series.links[k]) - sorted.begin();
    const LinkFigures& f = figures[static_cast<size_t>(found)];
    series.moments[k].push_back({frame.time_s, f.paths > 0 ? f : no_figures(frame.number, series.links[k])});
  }
  add_paths(frame, series.links.front(), series.paths);
}

void choose_frame(const SavedRun& run, const LinkChoice& choice, LinkSeries& series) {
  const std::vector<LinkMoment>& first = series.moments.front();
  const auto strongest = std::max_element(first.begin(), first.end(), [](const LinkMoment& a, const LinkMoment& b) {
    return a.figures.path_gain_db < b.figures.path_gain_db;
  });
  const size_t row = choice.frame ? find_frame(run, *choice.frame) : static_cast<size_t>(strongest - first.begin());
  series.frame = run.number(row);
  series.frame_time_s = run.time_s(row);
}

}  // namespace

std::vector<PathPoint> LinkSeries::paths_of_frame() const {
  std::vector<PathPoint> out;
  std::copy_if(paths.begin(), paths.end(), std::back_inserter(out), [&](const auto& p) { return p.frame == frame; });
  return out;
}

std::string link_name(const SavedRun& run, const Link& link) {
  return run.transmitters()[link.tx].name + " \u2192 " + run.receivers()[link.rx].name;
}

LinkSeries link_series(const SavedRun& run, const LinkChoice& choice, const std::vector<std::string>& grids,
                       size_t most) {
  if (choice.frame) find_frame(run, *choice.frame);
  Filter filter{find_end(run.transmitters(), choice.tx, "--tx"), find_end(run.receivers(), choice.rx, "--rx"), {}};
  for (const RadioEnd& end : run.receivers())
    filter.hidden.push_back(std::any_of(
        grids.begin(), grids.end(), [&](const std::string& grid) { return grid_cell(grid, end.name).has_value(); }));
  LinkSeries out;
  if (filter.tx && filter.rx)
    out.links = {{*filter.tx, *filter.rx}};
  else
    out.links = strongest_links(run, filter, most);
  if (!out.links.empty()) {
    out.moments.resize(out.links.size());
    for (size_t row = 0; row < run.frame_count(); ++row) add_frame(run.frame(row), run.frequency_hz(), out);
  }
  if (out.paths.empty()) {
    if (filter.tx || filter.rx)
      throw InputError(fmt::format("{}: no path from {} to {} in any frame, so there is nothing to plot",
                                   run.file().string(), filter.tx ? "\"" + choice.tx + "\"" : "any transmitter",
                                   filter.rx ? "\"" + choice.rx + "\"" : "any receiver outside of grids"));
    return {};
  }
  choose_frame(run, choice, out);
  return out;
}

}  // namespace wavetracer::plots
