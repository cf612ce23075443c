// Figure 6.1: tracing time against the number of rays, for every order and launch shape.
// Claims: A. Zhdanov, TU Munich, 2014, section 6.2.3 and figure 6.18.
#include <fmt/format.h>
#include <algorithm>
#include "study/ray_counts.hpp"
#include "study/recipe.hpp"
#include "study/words.hpp"

namespace wavetracer::study {
namespace {

// H3DH and HZ have the largest gains of the thesis' six.
bool best_are_histograms(const std::vector<Row>& rows, uint64_t rays, double Row::*gain) {
  const auto of = [&](const char* method) { return find_row(rows, ordered(method), rays)->*gain; };
  const double ours = std::min(of("hilbert3d-histogram"), of("morton-histogram"));
  return ours >= of("morton") && ours >= of("hilbert3d-histogram-hilbert2d") &&
         ours >= of("hilbert3d-histogram-hilbert3d");
}

bool worst_is_unordered(const std::vector<Row>& rows, uint64_t rays, double Row::*gain) {
  for (const char* method : {"morton", "hilbert3d-histogram", "morton-histogram", "hilbert3d-histogram-hilbert2d",
                             "hilbert3d-histogram-hilbert3d"})
    if (find_row(rows, ordered(method), rays)->*gain < 1) return false;
  return true;
}

std::string yes_no(bool unpaid, bool paid) {
  const auto word = [](bool yes) { return yes ? "yes" : "no"; };
  return fmt::format("{} with the sort not paid, {} with it paid", word(unpaid), word(paid));
}

// The best that a launch in two or three dimensions gains over the same order in one.
double best_of_shapes(const std::vector<Row>& rows, uint64_t rays) {
  const Series h3dh = ordered("hilbert3d-histogram");
  const auto time = [&](const Series& series) { return find_row(rows, series, rays)->times.unpaid_s; };
  double best = 0;
  for (const char* shape : {"2d", "3d"})
    for (const Series& series : {unordered(), h3dh})
      best = std::max(best, time(series) / time(with_shape(series, shape)));
  for (const char* mapped : {"hilbert3d-histogram-hilbert2d", "hilbert3d-histogram-hilbert3d"})
    best = std::max(best, time(h3dh) / time(ordered(mapped)));
  return best;
}

Words words(const std::vector<Row>& rows, const std::string& device) {
  const uint64_t most = rows.back().rays;
  const std::string paragraph = fmt::format(
      "The thesis finds H3DH and HZ the fastest of its six orders and no order (WS) the slowest at every number of "
      "rays, buffers mapped to two and three dimensions no faster than H3DH (section 6.2.3), and reordering to take "
      "23% less time at 1,000 rays and to give 2.5 times the speed at 49,000 (figure 6.18). Measured on {}.{} Rays "
      "born in order need no sort.",
      device, reason_words(rows));
  std::vector<Verdict> verdicts = gain_verdicts(rows);
  verdicts.push_back(
      {fmt::format("H3DH and HZ are the fastest of the six orders, at {} rays", grouped(most)),
       yes_no(best_are_histograms(rows, most, &Row::gain_unpaid), best_are_histograms(rows, most, &Row::gain_paid))});
  verdicts.push_back(
      {fmt::format("WS is the slowest, at {} rays", grouped(most)),
       yes_no(worst_is_unordered(rows, most, &Row::gain_unpaid), worst_is_unordered(rows, most, &Row::gain_paid))});
  verdicts.push_back({"launches in two or three dimensions gain nothing over the same order in one",
                      fmt::format("a factor of {:.2f} at most", best_of_shapes(rows, most))});
  return {paragraph, verdicts, gain_table(rows)};
}

}  // namespace

Recipe figure_6_1() {
  Series direction_origin = ordered("direction-origin");
  direction_origin.each_depth = true;  // what it is for: rays that no longer share their origin
  const Series h3dh = ordered("hilbert3d-histogram");
  return {.name = "figure-6.1",
          .doc = "time against 1,000 to 10,000,000 rays, for every order and launch shape",
          .title = "Ray orders and launch shapes",
          .series = {unordered(), ordered("morton"), h3dh, ordered("morton-histogram"),
                     ordered("hilbert3d-histogram-hilbert2d"), ordered("hilbert3d-histogram-hilbert3d"),
                     direction_origin, born_ordered(), with_shape(unordered(), "2d"), with_shape(unordered(), "3d"),
                     with_shape(h3dh, "2d"), with_shape(h3dh, "3d")},
          .words = words};
}

}  // namespace wavetracer::study
