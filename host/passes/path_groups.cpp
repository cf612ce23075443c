// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/fields/path_groups.cl.
// One row per work-item; records are read once per frame.
#include "passes/path_groups.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "passes/read_room.hpp"

namespace wavetracer {

PathGroups::PathGroups(gpu::Context& context, const std::vector<uint32_t>& planes_of, uint32_t edges,
                       double wavelength_m)
    : context_(context),
      kernel_(context, {{"WT_DIFFRACTS", std::to_string(std::min(edges, 2u))}}),
      work_(tuning_of(context.info()).exact),
      arguments_{.wavelength_m = wavelength_m, .row_count = 0, .row_capacity = 0, .max_depth = 0, .padding = 0},
      planes_of_(context.buffer(planes_of, "planes of surfaces")) {
  make_room(context_, shared_count_, 1, "number of paths of several waves");
  make_rows(1 << 12);
}

void PathGroups::make_rows(size_t most) {
  make_room(context_, waves_, most, "waves of paths");
  make_room(context_, shared_, most, "waves of paths of several");
}

void PathGroups::operator()(const gpu::Buffer<wt_wedge>* wedges, const RadioEnds& ends, const SolvedList& visible,
                            const Distinct& distinct, const RowList& rows, uint32_t most) {
  make_rows(most);
  context_.fill(shared_count_, 0u, Stage::path_groups);
  arguments_.row_count = rows.places;
  arguments_.row_capacity = static_cast<uint32_t>(waves_.size());
  arguments_.max_depth = visible.max_depth;
  kernel_(work_.range(rows.places), Stage::path_groups,
          calls::path_groups::path_groups{.solved = visible.headers,
                                          .vertices = visible.vertices,
                                          .steps = visible.sequences,
                                          .transmitter_places = ends.transmitters,
                                          .receiver_places = ends.receivers,
                                          .receiver_of = distinct.receiver_of(),
                                          .transmitter_of = distinct.transmitter_of(),
                                          .rows = rows.rows,
                                          .before = rows.counts,
                                          .wedges = wedges,
                                          .planes_of = planes_of_,
                                          .out = waves_,
                                          .shared = shared_,
                                          .shared_count = shared_count_,
                                          .args = arguments_});
}

void PathGroups::begin_read(uint32_t expected) {
  make_host_room(context_, waves_, host_waves_, "waves of paths");
  make_host_room(context_, shared_, host_shared_, "waves of paths of several");
  make_host_room(context_, shared_count_, host_shared_count_, "number of paths of several waves");
  read_ = std::min<size_t>(expected, waves_.size());
  shared_read_ = std::min(last_shared_ + last_shared_ / 16 + 16, shared_.size());
  waves_.begin_read(0, read_, host_waves_, Stage::path_groups);
  shared_.begin_read(0, shared_read_, host_shared_, Stage::path_groups);
  shared_count_.begin_read(0, 1, host_shared_count_, Stage::path_groups);
  numbered_ = {};
}

void PathGroups::number(size_t count) {
  if (count <= read_) numbered_ = numbered(count);
}

void PathGroups::set(Paths& paths) {
  const size_t count = paths.size();
  if (numbered_.group.size() != count) {
    if (count > read_) waves_.read(0, count, host_waves_, Stage::path_groups);
    numbered_ = numbered(count);
  }
  paths.group = std::exchange(numbered_.group, {});
  paths.group_weight = std::exchange(numbered_.weight, {});
}

// The groups of the first rows, which have been read.
GroupColumns PathGroups::numbered(size_t count) {
  last_shared_ = count > 0 ? *static_cast<const uint32_t*>(host_shared_count_.data()) : 0;
  if (last_shared_ > shared_read_) shared_.read(0, last_shared_, host_shared_, Stage::path_groups);
  return number_groups({static_cast<const device::wt_path_wave*>(host_waves_.data()), count},
                       {static_cast<const device::wt_path_waves*>(host_shared_.data()), last_shared_},
                       std::exchange(room_, {}));
}

}  // namespace wavetracer
