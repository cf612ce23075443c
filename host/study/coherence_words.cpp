// The words of coherence-frames and coherence-rays: a number a depth, and what they mean for the claims.
// Correlations and shares have two decimals; whoever compares them with the table rounds likewise.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include "study/coherence_frames.hpp"
#include "study/coherence_rays.hpp"
#include "study/ray_counts.hpp"

namespace wavetracer::study {
namespace {

// Figure 6.13: correlation of subsequent frames, on average.
constexpr double claimed_average = 0.25;

std::string number(double value) {
  if (std::isnan(value)) return "undefined";
  return fmt::format("{:.2f}", std::round(100 * value) / 100 + 0.0);  // + 0.0: no minus before a zero
}

// "1 and 3"
std::string list(const std::vector<std::string>& words) {
  std::string text;
  for (size_t i = 0; i < words.size(); ++i) text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return text;
}

// A column a depth.
NumberTable depth_table(const std::string& caption, size_t depths) {
  NumberTable table{.caption = caption, .heads = {""}, .rows = {}};
  for (size_t depth = 1; depth <= depths; ++depth) table.heads.push_back(fmt::format("depth {}", depth));
  return table;
}

void add(NumberTable& table, const std::string& what, const std::vector<double>& values) {
  table.rows.push_back({what});
  for (const double value : values) table.rows.back().push_back(number(value));
  table.rows.back().resize(table.heads.size(), "undefined");
}

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
  std::vector<study::RunningMean> means;
  for (const FramePair& row : rows) {
    if (row.against != "previous") continue;
    means.resize(std::max<size_t>(means.size(), row.depth));
    if (!std::isnan(value(row))) means[row.depth - 1].add(value(row));
  }
  std::vector<double> out;
  for (const study::RunningMean& mean : means) out.push_back(mean.mean());
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
                               double study::LagCoherence::*value) {
  std::vector<double> out;
  for (uint32_t depth = 1; const LagRow* row = find_lag(rows, directions, depth, 1); ++depth)
    out.push_back(row->found.*value);
  return out;
}

// The first lag at which points correlate by less than half.
std::string half_lag(const std::vector<LagRow>& rows, const std::string& directions, uint32_t depth) {
  for (const LagRow& row : rows)
    if (row.directions == directions && row.depth == depth && row.found.points < 0.5) return grouped(row.found.lag);
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

Words frame_pairs_words(const std::vector<FramePair>& rows, const Drive& drive, const std::string& device) {
  const auto total = [](const FramePair& row) { return row.found.points.total; };
  const auto by_place = [](const FramePair& row) { return row.by_place; };
  const auto both = [](const FramePair& row) { return row.found.both; };
  const auto surface = [](const FramePair& row) { return row.found.same_surface; };
  const auto sequence = [](const FramePair& row) { return row.found.same_sequence; };
  const uint32_t last = rows.back().frame;
  const std::vector<double> paired = previous_means(rows, total), placed = previous_means(rows, by_place);
  const std::string paragraph = fmt::format(
      "The thesis finds subsequent frames of traffic to correlate by about 25% on average, from less than 5% to almost "
      "50%, by equation 6.4 (section 6.3.2, figure 6.13), which leaves open which points are paired and, as printed, "
      "is not divided by the root of three. Measured on {}, {} rays of a transmitter that drives {:.1f} m through a "
      "standing scene in {} frames; subsequent ones are {:.3f} m apart. The last row is the share of rays for which a "
      "sequence of the first frame, {:g} s old, still stands.",
      device, grouped(experiment_rays), drive.moved_m(last), last + 1, drive.moved_m(1), drive.time_s(last));
  NumberTable table = depth_table("Correlations of points, and shares of rays:", paired.size());
  add(table, "subsequent frames, points paired by ray and bounce", paired);
  add(table, "subsequent frames, points paired by place", placed);
  add(table, "last frame with the first, points paired by ray and bounce", last_values(rows, total));
  using Values = std::vector<double> (*)(const std::vector<FramePair>&, const FrameValue&);
  for (const auto& [frames, values] :
       {std::pair<const char*, Values>{"subsequent frames", previous_means}, {"last frame and first", last_values}}) {
    add(table, fmt::format("{}: rays that hit in both of those that hit in one", frames), values(rows, both));
    add(table, fmt::format("{}: of these, on the same surface", frames), values(rows, surface));
    add(table, fmt::format("{}: of these, after the same surfaces", frames), values(rows, sequence));
  }
  return {paragraph,
          {{"subsequent frames correlate by more than 25%",
            fmt::format("{} if paired by ray and bounce, {} if paired by place", where_greater(paired, claimed_average),
                        where_greater(placed, claimed_average))}},
          table};
}

Words lags_words(const std::vector<LagRow>& rows, const std::string& device) {
  const std::vector<double> hilbert = neighbours(rows, "hilbert", &study::LagCoherence::points);
  const std::vector<double> same = neighbours(rows, "hilbert", &study::LagCoherence::same_surface);
  const std::string paragraph = fmt::format(
      "The thesis takes the autocorrelation of results along the rays of a frame (equation 3.4) for the measure of "
      "coherence inside it, expects that of a group of coherent rays only one need be traced (section 3.2.2), and "
      "gives no values. Measured on {} with {} rays. Fibonacci rays have their neighbours elsewhere: first hits "
      "correlate most, by {}. Tracing one ray for each two in hilbert order gives the other the wrong surface in the "
      "share of the last row.",
      device, grouped(experiment_rays), greatest_words(rows, "fibonacci"));
  NumberTable table = depth_table("Rays launched one after the other:", hilbert.size());
  for (const char* directions : {"hilbert", "fibonacci", "random"})
    add(table, fmt::format("hit points correlate, {}", directions),
        neighbours(rows, directions, &study::LagCoherence::points));
  table.rows.push_back({"lag at which that falls below a half, hilbert"});
  for (uint32_t depth = 1; depth <= hilbert.size(); ++depth)
    table.rows.back().push_back(half_lag(rows, "hilbert", depth));
  for (const char* directions : {"hilbert", "fibonacci", "random"})
    add(table, fmt::format("both hit the same surface, {}", directions),
        neighbours(rows, directions, &study::LagCoherence::same_surface));
  std::vector<double> wrong;
  for (const double share : same) wrong.push_back(1 - share);
  add(table, "the wrong surface, hilbert", wrong);
  return {paragraph, {}, table};
}

}  // namespace wavetracer::study
