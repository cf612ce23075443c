// SPDX-License-Identifier: Apache-2.0
// Words and numbers of the closing report. Counts are sums over the frames.
#include "app/report.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include "app/missed_line.hpp"
#include "app/written_files.hpp"
#include "base/digits.hpp"
#include "base/times.hpp"
#include "output/run_advice.hpp"
#include "wavetracer/interaction_kinds.hpp"
#include "wavetracer/stages.hpp"

namespace wavetracer::app {
namespace {
constexpr size_t shown_pairs = 3;  // number of the strongest pairs, and of the weakest

// For one frame it says how it was timed; for many, how their times are distributed.
std::string frame_line(const Run& run, const Totals& totals) {
  const double median_s = median_seconds(totals, "frame"), sum_s = sum_seconds(totals, "frame");
  const uint32_t repeats = run.summary.repeat_count;
  if (totals.frames == 1)
    return fmt::format("frame      {} ({})\n", duration_text(median_s),
                       repeats > 1
                           ? fmt::format("median of {}", repeats)
                           : "the first frame, which includes start-up work; --repeat 5 gives the median of five");
  const double span_s = totals.end_s - totals.start_s;
  std::string line = fmt::format("frames     {} from {} to {} s in steps of {:.6g} s; median {}", totals.frames,
                                 time_text(totals.start_s), time_text(totals.end_s),
                                 span_s / static_cast<double>(totals.frames - 1), duration_text(median_s));
  if (sum_s > 0) line += fmt::format(", {:.3g} frames/s", static_cast<double>(totals.frames) / sum_s);
  if (repeats > 1) line += fmt::format("; each {} times", repeats);
  return line + "\n";
}

// Says how much the ray cache answered, and how full it is.
std::string cache_line(const CacheSummary& cache) {
  if (!cache.on) return "";
  const auto percent = [](uint64_t part, uint64_t whole) {
    return whole > 0 ? 100 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
  };
  std::string line = fmt::format("cache      {:.3g}% of {} look-ups answered, {:.3g}% of {} entries in use\n",
                                 percent(cache.hits, cache.lookups), grouped(cache.lookups),
                                 percent(cache.used, cache.entries), grouped(cache.entries));
  if (cache.groups > 0)
    line += fmt::format("           {} groups of equal keys inside of frames: {} segments traced, {} took their hits\n",
                        grouped(cache.groups), grouped(cache.traced), grouped(cache.shared));
  return line;
}

// Says what sequences were used for: paths were solved from them, or the spheres of receivers caught the paths.
std::string sequence_line(const Run& run, const FrameCounts& n) {
  if (run.config.trace.by_spheres())
    return fmt::format("sequences  {} distinct, {} segments passed receivers\n", grouped(n.sequences),
                       grouped(n.receptions));
  return fmt::format("sequences  {} distinct, {} candidates, {} solved\n", grouped(n.sequences), grouped(n.candidates),
                     grouped(n.solved));
}

// Turns "line_of_sight" into "line of sight".
std::string spaced(std::string_view key) {
  std::string words(key);
  std::ranges::replace(words, '_', ' ');
  return words;
}

// Says what was computed, and why other features that the configuration asks for were not.
std::string feature_line(const Run& run) {
  const TraceConfig& trace = run.config.trace;
  std::vector<std::pair<std::string, bool>> features;
  for (const InteractionKind& kind : interaction_kinds) {
    const bool can_be = kind.code != target_point || !run.config.target_models.empty();
    features.emplace_back(kind.word, can_be && trace.*kind.asked_for);
    if (kind.code == diffraction)
      features.emplace_back("double_diffraction", trace.diffraction && trace.max_diffractions > 1);
    if (kind.code == scattering) features.emplace_back("scattering_reflections", trace.reflects_scattered());
  }
  features.insert(features.end(), {{"scattering_diffraction", trace.scattering_diffraction},
                                   {"vegetation", false},
                                   {"air", false},
                                   {"beams", trace.discovery == "auto"}});
  std::string on, off;
  for (const auto& [key, asked] : features) {
    const auto found = run.summary.features.find(key);
    if (found == run.summary.features.end()) continue;
    if (found->second.on)
      on += (on.empty() ? "" : ", ") + spaced(key);
    else if (asked)
      off += fmt::format("; no {}: {}", spaced(key), found->second.reason);
  }
  if (const auto floor_db = trace.diffraction_floor_db; trace.diffraction && floor_db)
    off += fmt::format("; paths over edges that are surely below {} dB are left out", *floor_db);
  return fmt::format("features   {}{}\n", on.empty() ? "line of sight alone" : on, off);
}

// Paths are counted by their most special interaction, see path_kinds.hpp.
std::string path_line(const Totals& totals) {
  std::string kinds;
  for (size_t i = 0; i < path_kinds.size(); ++i)
    if (totals.kinds[i] > 0)
      kinds +=
          fmt::format("{}{} {}", kinds.empty() ? ": " : ", ", grouped(totals.kinds[i]), spaced(path_kinds[i].word));
  return fmt::format("paths      {}{}\n", grouped(totals.counts.paths), kinds);
}

// Says how many paths the floors of scattering and of targets have left out; empty if there are none.
std::string weak_line(const FrameCounts& n) {
  const std::string floors = "trace.scattering_floor_db or target_floor_db";
  return n.weak == 0 ? "" : fmt::format("left out   {} paths that scatter, each below {}\n", grouped(n.weak), floors);
}

// Says what beams have not followed; empty without beams.
std::string certificate_line(const Totals& totals) {
  const Certificate& of = totals.certificate;
  if (of.frames == 0) return "";
  const char* const steps = of.edges == 0 ? "reflections" : "interactions";
  const std::string number = of.any_depth ? "any number of" : fmt::format("up to {}", of.depth);
  std::string out = fmt::format("complete   every path of {} {}", number, steps);
  if (of.edges > 0) out += fmt::format(", up to {} of them at edges", of.edges);
  if (of.floor_db) out += fmt::format(" with a gain of {} dB or more between isotropic antennas", *of.floor_db);
  out +=
      fmt::format(", but for beams of {:.2g} sr in all, {:.2g} of the directions", of.left_out_sr, of.left_out_share());
  if (of.left_out_power > 0)
    out += fmt::format("; a link misses at most {:.0f} dB through them{}", 10 * std::log10(of.left_out_power),
                       of.edges > 0 ? " by paths without an edge" : "");
  if (of.floor_db)
    out += fmt::format("\n           weaker beams, with {:.2g} of the power, were not followed", of.weak_share());
  return out + "\n";
}

// Says what tracing did, for users who tune it.
std::string tracing_lines(const Run& run, const Totals& totals) {
  const FrameCounts& n = totals.counts;
  std::string rate;
  if (const double per_second = segments_per_second(totals); per_second > 0)
    rate = fmt::format(", {}rays/s while tracing", short_number(per_second));
  const std::string order = run.summary.order.reason.empty() ? "" : "order      " + run.summary.order.reason + "\n";
  return order +
         fmt::format("rays       {} launched, {} traced over all depths, {} hits{}\n", grouped(n.rays),
                     grouped(traced_segments(totals)), grouped(n.hits), rate) +
         cache_line(totals.cache) + sequence_line(run, n);
}

std::string percent(uint64_t part, uint64_t whole) {
  return whole > 0 ? fmt::format("{:.3g}%", 100 * static_cast<double>(part) / static_cast<double>(whole)) : "none";
}

std::string quantile_words(const Quantiles& of, double scale, const char* unit) {
  return fmt::format("median {:.1f} {}, a tenth below {:.1f} and a tenth above {:.1f}", scale * of.median, unit,
                     scale * of.low, scale * of.high);
}

std::string pair_lines(const char* title, std::span<const PairSummary> pairs, bool drive) {
  size_t width = 0;
  for (const PairSummary& pair : pairs) width = std::max(width, pair.name.size());
  std::string out;
  for (const PairSummary& pair : pairs) {
    const std::string sight = drive               ? percent(pair.los_rows, pair.rows) + " in line of sight"
                              : pair.los_rows > 0 ? std::string("line of sight")
                                                  : std::string("no line of sight");
    out += fmt::format("{:<11}{:<{}}  {:7.2f} dB  delay spread {:7.2f} ns  {}\n", out.empty() ? title : "", pair.name,
                       width, pair.mean_gain_db, 1e9 * pair.mean_delay_spread_s, sight);
  }
  return out;
}

// Describes links, their gains and delay spreads, and the strongest and weakest pairs.
std::string link_lines(const LinkStatistics& links, bool drive) {
  std::string out =
      fmt::format("links      {} asked for{}, {} with a path ({}), {} in line of sight ({})\n", grouped(links.asked),
                  drive ? " in all frames" : "", grouped(links.with_path), percent(links.with_path, links.asked),
                  grouped(links.los), percent(links.los, links.asked));
  if (links.with_path == 0) return out;
  out += "path gain  " + quantile_words(links.gain_db, 1, "dB") + "\n";
  out += "delays     spread: " + quantile_words(links.delay_spread_s, 1e9, "ns") + "\n";
  const std::span<const PairSummary> pairs = links.pairs;
  const size_t strong = std::min(pairs.size(), shown_pairs), weak = std::min(pairs.size() - strong, shown_pairs);
  return out + pair_lines("strongest", pairs.first(strong), drive) + pair_lines("weakest", pairs.last(weak), drive);
}

std::string grid_lines(const LinkStatistics& links) {
  std::string out;
  for (const GridSummary& grid : links.grids)
    out += fmt::format("coverage   {}: {} of {} cells{}\n", grid.name, percent(grid.covered, grid.cells),
                       grouped(grid.cells),
                       grid.covered > 0 ? "; path gain " + quantile_words(grid.gain_db, 1, "dB") : "");
  return out;
}

// Says which paths the configuration leaves out of paths.h5.
std::string left_out_line(const Run& run, const Totals& totals) {
  const LeftOutPaths& gone = totals.left_out;
  if (gone.paths == 0) return "";
  if (!run.config.output.paths)
    return "left out   all paths are summed in links.csv, and paths.h5 has none (output.paths)\n";
  return fmt::format(
      "left out   {} of {} paths, with {:.2g}% of the power, are not in paths.h5, as output.min_gain_db, "
      "dynamic_range_db and max_paths_per_link ask\n",
      grouped(gone.paths), grouped(totals.counts.paths), 100 * gone.power / gone.all);
}

// Says how much the paths over edges have that trace.diffraction_range_db leaves out; empty where there are none.
std::string range_line(const Run& run, const Totals& totals) {
  if (totals.left_out_at_edges <= 0) return "";
  return fmt::format(
      "left out   paths over edges that are surely {:g} dB below the strongest path of their link without edges "
      "(trace.diffraction_range_db): they add at most {:.1g} dB to any link\n",
      run.summary.diffraction_range_db, 10 * std::log10(1 + totals.left_out_at_edges));
}

// If the device had to be checked, that has compiled most kernels.
std::string compile_line(const Run& run) {
  const StageSeconds& seconds = run.summary.setup_seconds;
  if (!seconds.contains("compile")) return "";
  const auto check = seconds.find("device check");
  return fmt::format("compiled   in {}\n",
                     duration_text(seconds.at("compile") + (check == seconds.end() ? 0.0 : check->second)));
}

// Says what frames without rays may lack.
std::string late_line(const Run& run, const Totals& totals) {
  const LateCounts& late = totals.late;
  if (late.discoveries == 0) return "";
  const std::string when =
      fmt::format("new when rays were launched again, every {} s", run.config.trace.discover_every_s);
  if (late.paths == 0) return fmt::format("late       no path was {}\n", when);
  return fmt::format(
      "late       {} paths with {:.1g} of the power (at most {:.1g}) were {}: frames before that may lack them\n",
      grouped(late.paths), late.power_share(), late.largest_share, when);
}

}  // namespace

std::string report(const Run& run, const Results& results, bool verbose) {
  const Scene& scene = run.scene;
  const Totals& totals = results.totals;
  const DeviceSummary& device = run.summary.device;
  const glm::dvec3 extent = scene.upper - scene.lower;
  std::string out = fmt::format("device     {} ({}, {})\n", device.name, device.platform, device.gpu ? "GPU" : "CPU");
  out += fmt::format("scene      {}: {:.0f} x {:.0f} x {:.0f} m, {} triangles in {} surfaces\n",
                     run.config.scene.file.empty() ? "city " + run.config.scene.generate : run.config.scene.file,
                     extent.x, extent.y, extent.z, grouped(scene.triangles.size()), grouped(scene.surfaces.size()));
  if (const LoadReport& load = scene.report; load.flattened_vertices > 0)
    out += fmt::format("flattened  {} vertices moved onto the planes of their surfaces, by {:.2g} mm at most\n",
                       grouped(load.flattened_vertices), load.flattened_by_m * 1000);
  if (!run.instances.empty())
    out += fmt::format("vehicles   {} of {} models\n", grouped(run.instances.size()), run.models.size());
  out += feature_line(run);
  if (verbose) out += tracing_lines(run, totals);
  out += path_line(totals) + weak_line(totals.counts) + left_out_line(run, totals) + range_line(run, totals) +
         missed_line(run, totals) + certificate_line(totals) + late_line(run, totals) +
         link_lines(results.links, totals.frames > 1) + grid_lines(results.links) + compile_line(run) +
         frame_line(run, totals);
  for (const std::string& text : advice(run, totals)) out += "advice     " + text + "\n";
  return out + written_line(results.files);
}

}  // namespace wavetracer::app
