// Levels of refine, with compaction of the samples that are worth four more.
// All samples of a level are counted before any is judged, so the launch does not depend on batches.
#include "simulation/refinement.hpp"

#include <bit>
#include <utility>

namespace wavetracer {

namespace {

// 12,288 rays a launcher to begin with: cells of two degrees, the streets and facades that a vehicle sees.
constexpr uint32_t first_level = 6;

// Sequences that so few samples have met are refined. On the streets of munich 2 finds more than 0.99 of the paths, 4
// more than 0.998, 8 all that are known (bench_recall).
uint32_t rare(double recall) { return recall <= 0.99 ? 2 : recall <= 0.999 ? 4 : 8; }

LaunchDirections directions_of(uint32_t level) {
  return LaunchDirections("hilbert", uint64_t{sample_faces} << (2 * level), 0);
}

}  // namespace

Refinement::Refinement(gpu::Context& context, const TraceConfig& config)
    : context_(context),
      config_(config),
      generate_(context, directions_of(first_level)),
      refine_(context),
      compact_(context, context.info().cpu ? 16 : 128),
      scan_(context),
      block_(context.info().cpu ? 16 : 128) {}

void Refinement::start(const std::vector<Launcher>& launchers, uint64_t slots) {
  std::vector<float> records;
  for (const Launcher& l : launchers) {
    for (int axis = 0; axis < 3; ++axis) records.push_back(static_cast<float>(l.position_m[axis]));
    records.push_back(0);
    records.push_back(std::bit_cast<float>(WT_ROOT | l.transmitter));
    records.push_back(std::bit_cast<float>(l.source));
    records.insert(records.end(), {0, 0});
  }
  launchers_ = context_.buffer(records, "launchers");
  if (hits_.size() != slots) hits_ = context_.buffer<uint32_t>(slots, "hits of sequences");
  context_.fill(hits_, 0, "refine");

  const auto cells = static_cast<uint32_t>(uint64_t{sample_faces} << (2 * first_level));
  const uint64_t count = uint64_t{cells} * launchers.size();
  if (level_.capacity < count + 16) level_ = make_sample_list(context_, count);
  std::vector<uint32_t> plane(count);
  for (size_t i = 0; i < count; ++i) plane[i] = static_cast<uint32_t>(i % cells);
  level_.samples.write(plane, 0, "refine");
  for (size_t i = 0; i < count; ++i) plane[i] = static_cast<uint32_t>(i / cells);
  level_.samples.write(plane, level_.capacity, "refine");
  level_.count = static_cast<uint32_t>(count);
  level_.level = first_level;
  most_ = config_.max_rays * launchers.size();
  launched_ = count;
  capped_ = false;
}

void Refinement::generate(RayQueue& queue, uint32_t first, uint32_t count) {
  generate_.samples(queue, level_, first, count, launchers_, directions_of(level_.level));
}

void Refinement::descend() {
  refine_.count_ends(level_, hits_);
  const MetSequences met = refine_.met(hits_);
  share_once_ = met.all ? static_cast<double>(met.once) / met.all : 0;
  const uint32_t samples = std::exchange(level_.count, 0);
  if (samples == 0 || share_once_ <= 1 - config_.recall || level_.level == finest_level) return;
  level_.count = samples;
  if (marks_.size() < samples) {
    marks_ = context_.buffer<float>(samples, "marks");
    list_ = context_.buffer<uint32_t>(samples, "marked samples");
    blocks_ = context_.buffer<uint32_t>(samples / block_ + 1, "marks of blocks");
  }
  refine_.mark(level_, hits_, rare(config_.recall), marks_);
  compact_.count_blocks(marks_, 0, samples, blocks_);
  const uint32_t marked = scan_(blocks_, (samples + block_ - 1) / block_);
  level_.count = 0;
  if (marked == 0) return;
  capped_ = launched_ + 4 * uint64_t{marked} > most_;
  if (capped_) return;
  compact_(marks_, 0, samples, blocks_, list_);
  if (next_.capacity < 4 * uint64_t{marked} + 16) next_ = make_sample_list(context_, 4 * uint64_t{marked});
  refine_.split(level_, list_, marked, next_);
  std::swap(level_, next_);
  launched_ += level_.count;
}

}  // namespace wavetracer
