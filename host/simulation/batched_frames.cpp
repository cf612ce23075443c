// SPDX-License-Identifier: Apache-2.0
// Rays are launched for each batch, unless batches share what they find (FrameLoop::batches_share).
#include "simulation/batched_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/stopwatch.hpp"
#include "simulation/joined_batches.hpp"
#include "simulation/receiver_batches.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer {
namespace {

// The links of the frame that are computed.
std::vector<Link> links_of(const FrameTask& task, const LinkPart& part) {
  std::vector<Link> out = task.pose().links;
  const auto [first, end] = part.transmitters();
  std::erase_if(out, [first = first, end = end](const Link& link) { return link.tx < first || link.tx >= end; });
  return out;
}

}  // namespace

FrameResult BatchedFrames::run(const TaskOf& task, const LinkPart& links) {
  const RunPlan& plan = *setup_.plan;
  const bool whole = plan.reuse || !block_obstacle(plan.asked).empty();
  const auto receivers = static_cast<uint32_t>(plan.world.receivers.ends.size());
  if (whole || receivers < 2) return loop_.run(task(links));
  std::deque<ReceiverRange> left;
  for (const ReceiverRange& batch :
       receiver_batches(plan.trace, receivers, setup_.context.info().global_memory, fitting_, summed_))
    left.push_back({batch.first, std::min(batch.end, receivers)});
  if (left.size() == 1) {
    try {
      return loop_.run(task(links));
    } catch (const gpu::BufferError&) {
      halve(left);
    }
  }
  return run_batches(task, links, std::move(left));
}

// Splits the first batch into two, and later frames begin with none that is longer.
void BatchedFrames::halve(std::deque<ReceiverRange>& left) {
  const auto [first, end] = left.front();
  const uint32_t middle = first + (end - first + 1) / 2;
  fitting_ = middle - first;
  left.front() = {middle, end};
  left.push_front({first, middle});
}

FrameResult BatchedFrames::run_batches(const TaskOf& task, const LinkPart& links, std::deque<ReceiverRange> left) {
  const FrameNames names = FrameNames::of(setup_.plan->asked);
  Stopwatch whole;
  JoinedBatches parts(links_of(task(links), links), loop_.take_room());
  LeftOut left_out;  // links of a batch are those of its receivers, so no link is here twice
  while (!left.empty()) {
    setup_.frame_watch->set_part(parts.size(), parts.size() + left.size());
    try {
      loop_.give_room(parts.add(loop_.run(task(links.batch(left.front(), left_out, parts.size() > 0)))));
      left.pop_front();
    } catch (const gpu::BufferError&) {
      if (left.front().end - left.front().first < 2) throw;
      halve(left);
    }
  }
  setup_.frame_watch->set_part(0, 1);
  FrameResult out = parts.joined();
  if (fitting_ < no_end) out.warnings.push_back(halved_warning());
  if (!left_out.empty()) out.warnings.push_back(left_out_warning(left_out, names.transmitter, names.receiver));
  if (setup_.elements.on()) {  // for all links at once
    Stopwatch watch;
    setup_.elements(out);
    out.seconds["elements"] += watch.lap();
  }
  out.seconds["frame"] = whole.lap();
  return out;
}

std::string BatchedFrames::halved_warning() const {
  const char* const rays = loop_.batches_share()
                               ? "rays are launched for the first of them, and the others use what these find"
                               : "rays are launched again for each of them";
  const bool asks = setup_.plan->trace.from_both_ends() || summed_;  // else frames begin with all receivers
  return fmt::format(
      "the lists of all receivers at once did not fit into {}: frames are computed for {} receivers at "
      "a time, and {}{}",
      setup_.device.name, fitting_, rays, asks ? fmt::format("; trace.batch_receivers = {} begins so", fitting_) : "");
}

}  // namespace wavetracer
