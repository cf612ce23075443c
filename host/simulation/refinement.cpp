// SPDX-License-Identifier: Apache-2.0
// Runs the levels of refine, with compaction of the samples that are worth four more. All samples of a level are
// counted before any is tested, so the launch does not depend on batches.
#include "simulation/refinement.hpp"

#include <algorithm>
#include <bit>

namespace wavetracer {

namespace {

// A launch begins with 49,152 rays for each launcher: a quarter of that misses whole groups of sequences, and then
// nothing is rare (bench_cases). Frames that have the sequences of earlier ones begin with 3,072, and refine half as
// much.
constexpr uint32_t first_level = 7, first_level_again = 5;

// On a ground of many surfaces a launch begins finer, by one level for a recall of 0.99, which it then reaches, and by
// two levels for a higher one: up to 4.5% of the paths were lost without, then less than 1% and 0.2% (bench_cases,
// hills_10 to hills_100; docs/method.md).
uint32_t finer_level(bool hilly, double recall) { return !hilly ? 0 : recall <= 0.99 ? 1 : 2; }

// Sequences that at most this many samples have met are refined. On the streets of munich 2 finds more than 0.99 of the
// paths, 4 more than 0.998, 8 all that are known (bench_discovery).
uint32_t rare(double recall) { return recall <= 0.99 ? 2 : recall <= 0.999 ? 4 : 8; }

LaunchDirections directions_of(Directions directions, uint32_t level) {
  return LaunchDirections(directions, uint64_t{sample_faces} << (2 * level), 0);
}

// The first level of a frame, or the finest that trace.max_rays allows.
uint32_t level_of(uint64_t frame, uint32_t finer, uint64_t max_rays) {
  uint32_t level = (frame == 0 ? first_level : first_level_again) + finer;
  while (level > 0 && uint64_t{sample_faces} << (2 * level) > max_rays) --level;
  return level;
}

// Turns by atan(4 / 3) in each frame, which is no rational part of a full turn; it uses + and * only, so it is the same
// everywhere.
DirectionTurn turn_of(uint64_t frame) {
  double cosine = 1, sine = 0;
  for (uint64_t i = 0; i < frame % 1000; ++i) {
    const double c = 0.6 * cosine - 0.8 * sine;
    sine = 0.8 * cosine + 0.6 * sine;
    cosine = c;
  }
  const auto turn = static_cast<uint32_t>(frame % 1000 * 633866811);  // in 2^32 parts of a turn: the same angle
  return {static_cast<float>(cosine), static_cast<float>(sine), turn};
}

}  // namespace

Refinement::Refinement(gpu::Context& context, const TraceConfig& config, std::shared_ptr<const LaunchHeights> heights,
                       bool hilly)
    : context_(context),
      config_(config),
      heights_(std::move(heights)),
      finer_(finer_level(hilly, config.recall)),
      generate_(context, directions_of(config.directions, finest_level), heights_),
      refine_(context),
      compact_(context),
      scan_(context) {}

void Refinement::start(const std::vector<Launcher>& launchers, uint64_t slots, uint64_t frame) {
  std::vector<float> records;
  for (const Launcher& l : launchers) {
    for (int axis = 0; axis < 3; ++axis) records.push_back(static_cast<float>(l.position_m[axis]));
    records.push_back(0);
    records.push_back(std::bit_cast<float>(WT_ROOT | l.transmitter));
    records.push_back(std::bit_cast<float>(l.source));
    records.push_back(std::bit_cast<float>(heights_->place(l.heights)));
    records.push_back(std::bit_cast<float>(l.window ? 1u : 0u));
  }
  launchers_ = context_.buffer(records, "launchers");
  if (hits_.size() != slots) hits_ = context_.buffer<uint32_t>(slots, "hits of sequences");
  context_.fill(hits_, 0, Stage::refine);
  // From high above walls are seen edge on: of 42 paths of a platform at 20 km two were lost, one level finer none.
  const uint32_t finer = finer_ + (std::ranges::any_of(launchers, &Launcher::window) ? 1 : 0);
  begin_level(launchers.size(), level_of(frame, finer, config_.max_rays));
  turn_ = turn_of(frame);
  rare_ = frame == 0 ? rare(config_.recall) : rare(config_.recall) / 2;
  most_ = config_.max_rays * launchers.size();
  launched_ = lists_[0].count;
  end_ = LaunchEnd::recall;
}

void Refinement::begin_level(uint64_t launcher_count, uint32_t level) {
  current_ = 0;
  SampleList& list = lists_[0];
  // The numbers of samples do not suffice: four launchers have as many samples as one has a level further down.
  if (first_launchers_ == launcher_count && list.level == level) return;  // as in the frame before
  first_launchers_ = 0;
  list.level = level;
  const uint64_t count = list.cells() * launcher_count;
  if (list.capacity < count + 16) list = make_sample_list(context_, count);
  list.level = level;
  list.count = static_cast<uint32_t>(count);
  std::vector<uint32_t> plane(count);
  for (size_t i = 0; i < count; ++i) plane[i] = static_cast<uint32_t>(i % list.cells());
  list.samples.write(plane, 0, Stage::refine);
  for (size_t i = 0; i < count; ++i) plane[i] = static_cast<uint32_t>(i / list.cells());
  list.samples.write(plane, list.capacity, Stage::refine);
  first_launchers_ = launcher_count;
}

void Refinement::generate(RayQueue& queue, uint32_t first, uint32_t count) {
  SampleList& list = lists_[current_];
  generate_.samples(queue, list, first, count, launchers_, directions_of(config_.directions, list.level), turn_);
}

bool Refinement::ends(LaunchEnd reason) {
  end_ = reason;
  return false;
}

bool Refinement::descend() {
  const SampleList& level = lists_[current_];
  refine_.count_ends(level, hits_);
  const MetSequences met = refine_.met(hits_);
  share_once_ = met.all ? static_cast<double>(met.once) / met.all : 0;
  if (share_once_ <= 1 - config_.recall) return ends(LaunchEnd::recall);
  if (level.level == finest_level) return ends(LaunchEnd::finest);
  if (marks_.size() < level.count) {
    list_ = context_.buffer<uint32_t>(level.count, "marked samples");
    blocks_ = context_.buffer<uint32_t>(compact_.blocks(level.count) + 1, "marks of blocks");
    marks_ = context_.buffer<float>(level.count, "marks");  // last, since its size is the room that there is
  }
  refine_.mark(level, hits_, rare_, marks_);
  compact_.count_blocks(marks_, 0, level.count, blocks_);
  const uint32_t marked = scan_(blocks_, compact_.blocks(level.count));
  if (marked == 0) return ends(LaunchEnd::nothing_rare);
  if (launched_ + 4 * uint64_t{marked} > most_) return ends(LaunchEnd::max_rays);
  compact_(marks_, 0, level.count, blocks_, list_);
  const size_t other = current_ == 1 ? 2 : 1;
  if (lists_[other].capacity < 4 * uint64_t{marked} + 16)
    lists_[other] = make_sample_list(context_, 4 * uint64_t{marked});
  refine_.split(level, list_, marked, lists_[other]);
  current_ = other;
  launched_ += lists_[other].count;
  return true;
}

}  // namespace wavetracer
