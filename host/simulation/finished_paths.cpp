// SPDX-License-Identifier: Apache-2.0
// The passes run in their order; only the numbers of rows are read between them.
#include "simulation/finished_paths.hpp"

#include <tbb/task_group.h>

#include <utility>

#include "radio/carriers.hpp"
#include "radio/constants.hpp"
#include "radio/world_records.hpp"
#include "simulation/tracing_depth.hpp"
#include "wavetracer/interaction_kinds.hpp"

namespace wavetracer {
namespace {

// The rows that are read of a frame before their number is known: a little more than in the last frame.
RowCounts expected_rows(const wt_counters& last) {
  return {last.rows + last.rows / 16 + 16, last.row_vertices + last.row_vertices / 16 + 64};
}

}  // namespace

FinishedPaths::FinishedPaths(gpu::Context& context, const Scene& scene, const Config& config, const World& world)
    : context_(context),
      distinct_(context, world.twins.receiver_of_transmitter, world.twins.transmitter_of_receiver),
      sort_(context),
      scan_(context),
      carriers_hz_(carriers_hz(config.radio)),
      host_counters_(context.host_memory(sizeof(wt_counters), "counters beside paths")) {
  if (config.trace.diffraction)
    groups_.emplace(context, plane_records(scene, world.fleet.models, world.fleet.instances),
                    tracing_depth(config.trace).edges, speed_of_light_m_s / config.radio.frequency_hz);
  if (!scene.volumes.empty()) vegetation_.emplace(context, volume_table(scene));
  for (const double carrier_hz : carriers_hz_) {
    Config at_carrier = config;
    at_carrier.radio.frequency_hz = carrier_hz;
    const FieldTables tables = make_field_tables(scene, at_carrier, world.fleet.models, world.fleet.instances);
    ports_ = tables.ports;
    fields_.emplace_back(context, tables, tracing_depth(config.trace).edges, scene.origin_m);
    if (const auto range_db = config.trace.diffraction_range_db; config.trace.diffraction && range_db)
      link_floors_.emplace(context, tables, *range_db, config.trace.transmission);
  }
}

void FinishedPaths::start(uint32_t frame, const DeviceScene& scene, DiffractedPaths* edges, const TargetRows* targets,
                          const RadioEnds& ends, const WorldState& world, const SolvedList& visible,
                          const std::vector<Link>* own, Rows rows, Counters& counters) {
  const bool carriers = rows == Rows::all_carriers;
  const uint32_t places =
      distinct_.keys(ends, own ? context_.buffer(link_masks(ends, *own), "own links") : ends.links, visible,
                     counters);  // distinct
  RowCounts most{}, expected{};
  last_.reset();
  const gpu::Buffer<wt_wedge>* wedges = edges ? &edges->wedges.list().wedges : nullptr;
  if (places > 0) {
    sort_(distinct_.sort_keys(), distinct_.order(), places, 32, Stage::distinct);  // sort
    distinct_.place(scene, wedges, ends, visible, counters);                       // distinct
    most = {counters.length(&wt_counters::rows, places, Stage::distinct),
            counters.length(&wt_counters::row_vertices, size_t{places} * visible.max_depth, Stage::distinct)};
    expected = counters.foresees() ? expected_rows(counters.last()) : most;
  }
  if (most.rows > 0) {
    scan_.prefix(distinct_.rows().counts, 2 * places, Stage::distinct);                                    // scan
    const gpu::Buffer<double>* inside = vegetation_ ? &(*vegetation_)(ends, visible, counters) : nullptr;  // vegetation
    if (groups_) (*groups_)(wedges, ends, visible, distinct_, distinct_.rows(), most.rows);  // path_groups
    if (groups_ && rows != Rows::summed) groups_->begin_read(expected.rows);
    if (rows != Rows::summed && counts_ahead(expected)) begin_count(counters);
    last_.emplace(FieldInputs{scene, wedges, targets ? &targets->points() : nullptr, ends, visible, inside, distinct_,
                              distinct_.rows()});
    for (size_t i = 0; i < (carriers ? fields_.size() : 1); ++i)
      fields_[i](*last_, world, most, rows == Rows::summed);  // fields
  }
  if (rows == Rows::summed) {
    if (!sums_) sums_.emplace(context_, carriers_hz_[0], ports_, groups_.has_value());
    (*sums_)(
        {fields_[0].rows(), groups_ ? &groups_->waves() : nullptr, groups_ ? &groups_->shared() : nullptr, most.rows},
        own ? *own : world.links, counters);  // link_sums
    return;
  }
  for (size_t i = 1; carriers && i < fields_.size(); ++i) fields_[i].begin_read_carrier(expected);
  fields_[0].begin_read(frame, expected);
  tbb::task_group room;  // another core makes it while the device works and groups are numbered
  room.run([this] { fields_[0].size_room(); });
  std::optional<RowCounts> count;
  if (most.rows > 0 && counts_ahead(expected)) count = wait_for_counts();
  if (count && groups_) groups_->number(count->rows);
  room.wait();
  if (count) fields_[0].fill_arriving(*count);
}

std::optional<LinkLimits> FinishedPaths::floor_links(const DeviceScene& scene, const RadioEnds& ends,
                                                     const WorldState& world, const SolvedList& visible,
                                                     Counters& counters) {
  if (!link_floors_) return {};
  fields_[0].set_ends(world);
  const gpu::Buffer<double>* inside = vegetation_ ? &(*vegetation_)(ends, visible, counters) : nullptr;  // vegetation
  (*link_floors_)(
      {scene, fields_[0].buffers(), ends, distinct_.receiver_of(), distinct_.transmitter_of(), visible, inside},
      counters);  // link_floors
  return link_floors_->limits(fields_[0].buffers().materials_of);
}

// Is the number of rows read before the device has finished? Frames of few paths have no use for it.
bool FinishedPaths::counts_ahead(RowCounts expected) const { return groups_ || expected.rows > Fields::rows_of_part; }

void FinishedPaths::begin_count(Counters& counters) {
  counters.buffer().begin_read(0, 1, host_counters_, Stage::distinct);
  counted_ = context_.mark();
}

RowCounts FinishedPaths::wait_for_counts() {
  context_.wait(counted_);
  const auto* const counted = static_cast<const wt_counters*>(host_counters_.data());
  return {counted->rows, counted->row_vertices};
}

void FinishedPaths::give_room(Paths paths) {
  if (groups_) groups_->give_room({std::exchange(paths.group, {}), std::exchange(paths.group_weight, {})});
  fields_[0].give_room(std::move(paths));
}

Paths FinishedPaths::take(const wt_counters& counted, LeftOut& left_out, std::vector<CarrierFields>* carriers) {
  if (counted.near_rows > 0) left_out = distinct_.left_out();
  const RowCounts count{counted.rows, counted.row_vertices};
  for (size_t i = 1; carriers && i < fields_.size(); ++i) {
    carriers->push_back(fields_[i].carrier(count));
    carriers->back().frequency_hz = carriers_hz_[i];
  }
  Paths paths = fields_[0].columns(count);
  if (groups_) groups_->set(paths);
  return paths;
}

RowChoice FinishedPaths::choose(std::span<const uint32_t> rows) { return fields_[0].choose(distinct_.rows(), rows); }

CarrierFields FinishedPaths::again(const RowChoice& choice) {
  if (!last_ || choice.count == 0) return {};
  fields_[0].again(*last_, choice);  // fields
  const RowCounts count{choice.count, 0};
  fields_[0].begin_read_carrier(count);
  context_.wait(context_.mark());
  return fields_[0].carrier(count);
}

std::span<const device::wt_link_sum> FinishedPaths::take_sums(const wt_counters& counted, LeftOut& left_out) {
  if (counted.near_rows > 0) left_out = distinct_.left_out();
  return sums_->read();
}

void upload_visible(gpu::Context& context, const PathGeometry& paths, SolvedList& visible) {
  visible.count = static_cast<uint32_t>(paths.size());
  if (visible.count == 0) return;
  if (visible.headers.size() < visible.count) visible.reserve(context, visible.count);
  const size_t stride = visible.max_depth;
  std::vector<wt_solved> headers;
  std::vector<double> vertices(3 * stride * paths.size());
  std::vector<uint32_t> steps(stride * paths.size());
  for (size_t path = 0; path < paths.size(); ++path) {
    const auto depth = static_cast<uint32_t>(paths.first[path + 1] - paths.first[path]);
    headers.push_back({paths.tx[path], paths.rx[path], depth, 0, WT_NONE, 0});
    for (uint32_t k = 0; k < depth; ++k) {
      const uint64_t from = paths.first[path] + k, to = path * stride + k;
      steps[to] = paths.surface[from] | find_interaction(paths.interaction[from])->step << WT_STEP_SHIFT;
      for (int axis = 0; axis < 3; ++axis) vertices[3 * to + axis] = paths.vertex[from][axis];
    }
  }
  visible.headers.write(headers, 0, Stage::distinct);
  visible.vertices.write(vertices, 0, Stage::distinct);
  visible.sequences.write(steps, 0, Stage::distinct);
}

}  // namespace wavetracer
