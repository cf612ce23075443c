// Words and numbers of the closing report.
// Counts are sums over the frames; links are those of the last one.
#include "app/report.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include "output/advice.hpp"

namespace wavetracer::app {
namespace {

constexpr size_t shown_links = 10;

// 12.3 G, 45.6 M, 789 k, 12
std::string scaled(double x) {
  for (const auto& [limit, letter] : {std::pair{1e9, " G"}, {1e6, " M"}, {1e3, " k"}})
    if (x >= limit) return fmt::format("{:.3g}{}", x / limit, letter);
  return fmt::format("{:.3g} ", x);
}

std::string duration(double seconds) {
  return seconds < 1 ? fmt::format("{:.3g} ms", seconds * 1e3) : fmt::format("{:.3g} s", seconds);
}

// Of one frame, how it was timed; of many, how they follow each other.
std::string frame_line(const Run& run, const Totals& totals) {
  const double median_s = median_seconds(totals, "frame"), sum_s = sum_seconds(totals, "frame");
  const uint32_t repeats = run.summary.repeat_count;
  if (totals.frames == 1)
    return fmt::format("frame      {} ({})\n", duration(median_s),
                       repeats > 1 ? fmt::format("median of {}", repeats)
                                   : "the first, so not warm: --repeat 5 gives the median of five");
  const double span_s = totals.end_s - totals.start_s;
  std::string line = fmt::format("frames     {} from {:g} to {:g} s in steps of {:.6g} s; median {}", totals.frames,
                                 totals.start_s, totals.end_s, span_s / static_cast<double>(totals.frames - 1),
                                 duration(median_s));
  if (sum_s > 0) line += fmt::format(", {:.3g} frames/s", static_cast<double>(totals.frames) / sum_s);
  if (repeats > 1)
    line += fmt::format("; each {} times{}", repeats, run.config.trace.reuse ? ", reusing nothing" : "");
  return line + "\n";
}

// How much the ray cache answered, and how full it is.
std::string cache_line(const CacheSummary& cache) {
  if (!cache.on) return "";
  const auto percent = [](uint64_t part, uint64_t whole) {
    return whole > 0 ? 100 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
  };
  return fmt::format("cache      {:.3g}% of {} look-ups answered, {:.3g}% of {} entries in use\n",
                     percent(cache.hits, cache.lookups), cache.lookups, percent(cache.used, cache.entries),
                     cache.entries);
}

// What became of sequences: paths are solved for, or are what the spheres of receivers caught.
std::string sequence_line(const Run& run, const FrameCounts& n) {
  if (run.config.trace.reception == "sphere")
    return fmt::format("sequences  {} distinct, {} segments passed receivers\n", n.sequences, n.receptions);
  return fmt::format("sequences  {} distinct, {} candidates, {} solved\n", n.sequences, n.candidates, n.solved);
}

// line_of_sight -> line of sight
std::string spaced(std::string_view key) {
  std::string words(key);
  std::ranges::replace(words, '_', ' ');
  return words;
}

// What was computed, and of what the configuration asks for beyond that, why not.
std::string feature_line(const Run& run) {
  const TraceConfig& trace = run.config.trace;
  const std::pair<const char*, bool> features[] = {
      {"reflection", trace.reflection},
      {"diffraction", trace.diffraction},
      {"double_diffraction", trace.diffraction && trace.max_diffractions > 1},
      {"transmission", trace.transmission},
      {"scattering", trace.scattering}};
  std::string on, off;
  for (const auto& [key, asked] : features) {
    const auto found = run.summary.features.find(key);
    if (found == run.summary.features.end()) continue;
    if (found->second.on)
      on += (on.empty() ? "" : ", ") + spaced(key);
    else if (asked)
      off += fmt::format("; no {}: {}", spaced(key), found->second.reason);
  }
  return fmt::format("features   {}{}\n", on.empty() ? "line of sight alone" : on, off);
}

// By their most special interaction, see path_kinds.hpp.
std::string path_line(const Totals& totals) {
  std::string kinds;
  for (size_t i = 0; i < path_kinds.size(); ++i)
    if (totals.kinds[i] > 0)
      kinds += fmt::format("{}{} {}", kinds.empty() ? ": " : ", ", totals.kinds[i], spaced(path_kinds[i]));
  return fmt::format("paths      {}{}\n", totals.counts.paths, kinds);
}

// What rays may have missed; nothing where that is not known.
std::string missed_line(const Run& run, const Totals& totals) {
  if (totals.missed.frames == 0) return "";
  const Missed missed = estimate_missed(totals.missed);
  const std::string about =
      missed.paths.estimate < 0.5 ? "probably none" : fmt::format("about {:.0f}", missed.paths.estimate);
  return fmt::format("missed     {} of {} paths ({:.0f} to {:.0f}), {:.1g} of the power ({:.1g} to {:.1g}): {}\n",
                     about, totals.counts.paths, missed.paths.low, std::ceil(missed.paths.high),
                     missed.power_share.estimate, missed.power_share.low, missed.power_share.high,
                     run.config.trace.rays == 0 ? "a higher trace.recall finds more" : "more trace.rays find more");
}

std::string count_lines(const Run& run, const Totals& totals) {
  const FrameCounts& n = totals.counts;
  const uint64_t traced = traced_segments(totals);
  std::string rate;
  if (const double trace_s = sum_seconds(totals, "trace"); trace_s > 0)
    rate = fmt::format(", {}rays/s while tracing", scaled(static_cast<double>(traced) / trace_s));
  return fmt::format("rays       {} launched, {} traced over all depths, {} hits{}\n", n.rays, traced, n.hits, rate) +
         cache_line(totals.cache) + sequence_line(run, n) + path_line(totals) + frame_line(run, totals);
}

std::string link_lines(const Run& run, const Results& results) {
  const bool many = results.totals.frames > 1;
  std::vector<LinkFigures> links = results.last_links;
  if (links.empty()) return fmt::format("links      {}, see links.csv\n", results.totals.links);
  std::stable_sort(links.begin(), links.end(),
                   [](const LinkFigures& a, const LinkFigures& b) { return a.path_gain_db > b.path_gain_db; });
  const size_t shown = std::min(links.size(), shown_links);
  const auto name = [&](const LinkFigures& l) {
    return run.config.transmitters[l.tx].name + " -> " + run.config.receivers[l.rx].name;
  };
  size_t width = 0;
  for (size_t i = 0; i < shown; ++i) width = std::max(width, name(links[i]).size());
  std::string out =
      many ? fmt::format("links      {} in all frames; the strongest of the {} in frame {}:\n", results.totals.links,
                         links.size(), results.last_frame)
           : fmt::format("links      {}, the strongest first:\n", links.size());
  for (size_t i = 0; i < shown; ++i) {
    const LinkFigures& l = links[i];
    out += fmt::format("  {:<{}}  {:>5} paths", name(l), width, l.paths);
    if (l.paths > 0)
      out += fmt::format("  path gain {:7.2f} dB  delay spread {:7.2f} ns  LOS {}", l.path_gain_db,
                         l.rms_delay_spread_s * 1e9, l.los ? "yes" : "no");
    out += "\n";
  }
  if (links.size() > shown) out += fmt::format("  ... and {} more in links.csv\n", links.size() - shown);
  return out;
}

}  // namespace

std::string report(const Run& run, const Results& results) {
  const Scene& scene = run.scene;
  const DeviceSummary& device = run.summary.device;
  const glm::dvec3 extent = scene.upper - scene.lower;
  std::string out = fmt::format("device     {} ({}, {})\n", device.name, device.platform, device.gpu ? "GPU" : "CPU");
  out += fmt::format("scene      {}: {:.0f} x {:.0f} x {:.0f} m, {} triangles in {} surfaces\n",
                     run.config.scene.file.empty() ? "city " + run.config.scene.generate : run.config.scene.file,
                     extent.x, extent.y, extent.z, scene.triangles.size(), scene.surfaces.size());
  if (!run.instances.empty())
    out += fmt::format("vehicles   {} of {} models\n", run.instances.size(), run.models.size());
  if (!run.summary.order.reason.empty()) out += "order      " + run.summary.order.reason + "\n";
  out += feature_line(run) + count_lines(run, results.totals) + link_lines(run, results) +
         missed_line(run, results.totals);
  for (const std::string& text : advice(run, results.totals)) out += "advice     " + text + "\n";
  out += "written    ";
  for (size_t i = 0; i < results.files.size(); ++i) out += (i == 0 ? "" : ", ") + results.files[i].string();
  return out + "\n";
}

}  // namespace wavetracer::app
