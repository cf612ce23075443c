// Words and numbers of the closing report. Links are sorted by gain, the strongest first.
// It assumes at least one frame; where there are more, the links are those of the first.
#include "app/report.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include "radio/links.hpp"

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

std::string frame_lines(const RunData& run) {
  const FrameResult& frame = run.frames.front();
  const FrameCounts& n = frame.counts;
  const double whole = frame.seconds.at("frame");
  const auto trace = frame.seconds.find("trace");
  std::string rate;
  if (trace != frame.seconds.end() && trace->second > 0)
    rate = fmt::format(", {}rays/s while tracing", scaled(static_cast<double>(n.segments) / trace->second));
  const std::string timing = run.summary.repeat_count > 1
                                 ? fmt::format("median of {}", run.summary.repeat_count)
                                 : "the first, so not warm: --repeat 5 gives the median of five";
  return fmt::format("rays       {} launched, {} traced over all depths, {} hits{}\n", n.rays, n.segments, n.hits,
                     rate) +
         fmt::format("sequences  {} distinct, {} candidates, {} solved\n", n.sequences, n.candidates, n.solved) +
         fmt::format("paths      {}\n", n.paths) + fmt::format("frame      {} ({})\n", duration(whole), timing);
}

std::string link_lines(const RunData& run) {
  const auto& transmitters = run.config.transmitters;
  const auto& receivers = run.config.receivers;
  std::vector<LinkFigures> links =
      link_figures(run.frames.front().paths, run.first_frame, static_cast<uint32_t>(transmitters.size()),
                   static_cast<uint32_t>(receivers.size()));
  std::stable_sort(links.begin(), links.end(),
                   [](const LinkFigures& a, const LinkFigures& b) { return a.path_gain_db > b.path_gain_db; });
  size_t width = 0;
  const auto name = [&](const LinkFigures& l) { return transmitters[l.tx].name + " -> " + receivers[l.rx].name; };
  for (size_t i = 0; i < std::min(links.size(), shown_links); ++i) width = std::max(width, name(links[i]).size());
  std::string out;
  for (size_t i = 0; i < std::min(links.size(), shown_links); ++i) {
    const LinkFigures& l = links[i];
    out += fmt::format("  {:<{}}  {:>5} paths", name(l), width, l.paths);
    if (l.paths > 0)
      out += fmt::format("  path gain {:7.2f} dB  delay spread {:7.2f} ns  LOS {}", l.path_gain_db,
                         l.rms_delay_spread_s * 1e9, l.los ? "yes" : "no");
    out += "\n";
  }
  if (links.size() > shown_links) out += fmt::format("  ... and {} more in links.csv\n", links.size() - shown_links);
  return fmt::format("links      {}, the strongest first:\n", links.size()) + out;
}

}  // namespace

std::string report(const RunData& run, const std::vector<std::filesystem::path>& files) {
  const Scene& scene = run.scene;
  const DeviceSummary& device = run.summary.device;
  const glm::dvec3 extent = scene.upper - scene.lower;
  std::string out = fmt::format("device     {} ({}, {})\n", device.name, device.platform, device.gpu ? "GPU" : "CPU");
  out += fmt::format("scene      {}: {:.0f} x {:.0f} x {:.0f} m, {} triangles in {} surfaces\n",
                     run.config.scene.file.empty() ? "city " + run.config.scene.generate : run.config.scene.file,
                     extent.x, extent.y, extent.z, scene.triangles.size(), scene.surfaces.size());
  if (!run.summary.order.reason.empty()) out += "order      " + run.summary.order.reason + "\n";
  out += frame_lines(run) + link_lines(run);
  out += "written    ";
  for (size_t i = 0; i < files.size(); ++i) out += (i == 0 ? "" : ", ") + files[i].string();
  return out + "\n";
}

}  // namespace wavetracer::app
