// The paragraphs of coherence-frames and coherence-rays: lists of a number a depth, and what they mean for the claims.
// Correlations and shares have two decimals; whoever compares them with the table rounds likewise.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include "recipes/coherence_frames.hpp"
#include "recipes/coherence_rays.hpp"
#include "recipes/ray_counts.hpp"

namespace wavetracer::recipes {
namespace {

// Figure 6.13: correlation of subsequent frames, on average.
constexpr double claimed_average = 0.25;

std::string number(double value) {
  if (std::isnan(value)) return "undefined";
  return fmt::format("{:.2f}", std::round(100 * value) / 100 + 0.0);  // + 0.0: no minus before a zero
}

// "0.99, 0.97 and 0.95"
std::string list(const std::vector<std::string>& words) {
  std::string text;
  for (size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return text;
}

std::string numbers(const std::vector<double>& values) {
  std::vector<std::string> words;
  for (const double value : values) words.push_back(number(value));
  return list(words);
}

std::string depths_words(size_t depths) { return depths == 1 ? "depth 1" : fmt::format("depths 1 to {}", depths); }

// Where values are greater than the bound: "at every depth", "at no depth", "at depths 1 and 3".
std::string where_greater(const std::vector<double>& values, double bound) {
  std::vector<std::string> words;
  for (size_t i = 0; i < values.size(); ++i)
    if (values[i] > bound) words.push_back(std::to_string(i + 1));
  if (words.empty()) return "at no depth";
  if (words.size() == values.size()) return "at every depth";
  return (words.size() == 1 ? "at depth " : "at depths ") + list(words);
}

using FrameValue = std::function<double(const FramePair&)>;

// A value a depth: the mean over all frames against their previous ones, where it is defined.
std::vector<double> previous_means(const std::vector<FramePair>& rows, const FrameValue& value) {
  std::vector<report::RunningMean> means;
  for (const FramePair& row : rows) {
    if (row.against != "previous") continue;
    means.resize(std::max<size_t>(means.size(), row.depth));
    if (!std::isnan(value(row))) means[row.depth - 1].add(value(row));
  }
  std::vector<double> out;
  for (const report::RunningMean& mean : means) out.push_back(mean.mean());
  return out;
}

// A value a depth, of the last frame against the first.
std::vector<double> last_values(const std::vector<FramePair>& rows, const FrameValue& value) {
  std::vector<double> out;
  for (const FramePair& row : rows)
    if (row.against == "first" && row.frame == rows.back().frame) out.push_back(value(row));
  return out;
}

const LagRow* find_lag(const std::vector<LagRow>& rows, const std::string& directions, uint32_t depth, uint32_t lag) {
  for (const LagRow& row : rows)
    if (row.directions == directions && row.depth == depth && row.found.lag == lag) return &row;
  return nullptr;
}

// A value a depth, of neighbours.
std::vector<double> neighbours(const std::vector<LagRow>& rows, const std::string& directions,
                               double report::LagCoherence::*value) {
  std::vector<double> out;
  for (uint32_t depth = 1; const LagRow* row = find_lag(rows, directions, depth, 1); ++depth)
    out.push_back(row->found.*value);
  return out;
}

// The first lag at which points correlate by less than half.
std::string half_lag(const std::vector<LagRow>& rows, const std::string& directions, uint32_t depth) {
  for (const LagRow& row : rows)
    if (row.directions == directions && row.depth == depth && row.found.points < 0.5)
      return grouped(row.found.lag);
  return "none measured";
}

// "0.98 at lag 987": where points of first hits correlate most.
std::string greatest_words(const std::vector<LagRow>& rows, const std::string& directions) {
  const LagRow* best = nullptr;
  for (const LagRow& row : rows)
    if (row.directions == directions && row.depth == 1 && (!best || row.found.points > best->found.points)) best = &row;
  return best ? fmt::format("{} at lag {}", number(best->found.points), grouped(best->found.lag)) : "undefined";
}

}  // namespace

std::string frame_pairs_paragraph(const std::vector<FramePair>& rows, const Drive& drive, const std::string& device) {
  const auto total = [](const FramePair& row) { return row.found.points.total; };
  const auto by_place = [](const FramePair& row) { return row.by_place; };
  const auto both = [](const FramePair& row) { return row.found.both; };
  const auto surface = [](const FramePair& row) { return row.found.same_surface; };
  const auto sequence = [](const FramePair& row) { return row.found.same_sequence; };
  const uint32_t last = rows.back().frame;
  const std::vector<double> paired = previous_means(rows, total), placed = previous_means(rows, by_place);
  return fmt::format(
      "The thesis finds subsequent frames of traffic to correlate by about 25% on average, from less than 5% to almost "
      "50%, by equation 6.4 (section 6.3.2, figure 6.13), which leaves open which points are paired and, as printed, "
      "is not divided by the root of three. Measured on {}, {} rays of a transmitter that drives {:.1f} m through a "
      "standing scene in {} frames, points paired by ray and bounce, at {}: subsequent frames, {:.3f} m apart, "
      "correlate by {} on average; the last frame with the first by {}. Paired by their place among the hits, "
      "subsequent frames correlate by {}. The claimed 25% is exceeded {} if paired by ray and bounce, and {} if paired "
      "by place. Of the rays that hit in one of two subsequent frames, a share of {} hit in both; of these, {} hit the "
      "same surface and {} have met the same surfaces so far. Of the last frame and the first these shares are {}; {}; "
      "and {}: the last is the share of rays for which a sequence of the first frame, {:g} s old, still stands.",
      device, grouped(experiment_rays), drive.moved_m(last), last + 1, depths_words(paired.size()), drive.moved_m(1),
      numbers(paired), numbers(last_values(rows, total)), numbers(placed), where_greater(paired, claimed_average),
      where_greater(placed, claimed_average), numbers(previous_means(rows, both)),
      numbers(previous_means(rows, surface)), numbers(previous_means(rows, sequence)),
      numbers(last_values(rows, both)), numbers(last_values(rows, surface)), numbers(last_values(rows, sequence)),
      drive.time_s(last));
}

std::string lags_paragraph(const std::vector<LagRow>& rows, const std::string& device) {
  const std::vector<double> hilbert = neighbours(rows, "hilbert", &report::LagCoherence::points);
  const std::vector<double> same = neighbours(rows, "hilbert", &report::LagCoherence::same_surface);
  std::vector<std::string> half;
  std::vector<double> wrong;
  for (uint32_t depth = 1; depth <= hilbert.size(); ++depth) {
    half.push_back(half_lag(rows, "hilbert", depth));
    wrong.push_back(1 - same[depth - 1]);
  }
  return fmt::format(
      "The thesis takes the autocorrelation of results along the rays of a frame (equation 3.4) for the measure of "
      "coherence inside it, expects that of a group of coherent rays only one need be traced (section 3.2.2), and "
      "gives no values. Measured on {} with {} rays, at {}: hit points of rays launched one after the other correlate "
      "by {} in hilbert order, {} in fibonacci order and {} in random order. In hilbert order the correlation falls "
      "below a half at lags of {}; fibonacci rays have their neighbours elsewhere, first hits correlating most, by {}. "
      "Successive rays that both hit do so on the same surface in shares of {} (hilbert), {} (fibonacci) and {} "
      "(random). So at this number of rays, tracing one ray for each two in hilbert order gives the other the wrong "
      "surface in a share of {}.",
      device, grouped(experiment_rays), depths_words(hilbert.size()), numbers(hilbert),
      numbers(neighbours(rows, "fibonacci", &report::LagCoherence::points)),
      numbers(neighbours(rows, "random", &report::LagCoherence::points)), list(half), greatest_words(rows, "fibonacci"),
      numbers(same), numbers(neighbours(rows, "fibonacci", &report::LagCoherence::same_surface)),
      numbers(neighbours(rows, "random", &report::LagCoherence::same_surface)), numbers(wrong));
}

}  // namespace wavetracer::recipes
