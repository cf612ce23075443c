// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/fields/fields.cl.
// One row per work-item; rows are read as records, once per frame.
#include "passes/fields.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "passes/advice.hpp"
#include "passes/read_room.hpp"
#include "passes/upload.hpp"
#include "wavetracer/device/path_rows.h"

namespace wavetracer {
namespace {

// The rows that a build of the kernel takes.
enum class FieldRows { all, without_corners, listed };

// CPUs: the most and the fewest rows of a work-item; those of one shape are computed eight at once.
constexpr uint32_t most_together = 512, fewest_together = 64;

// Are rows computed eight at once where they can be? The lanes of kernels/lib/field8.clh have no walls of layers and no
// losses on the way.
bool takes_runs(const gpu::DeviceInfo& device, const FieldTables& tables, bool apart) {
  return device.cpu && !apart && !tables.layered() && !tables.loses();
}

// The rows of a work-item: eight items for each core, so that cores end together.
uint32_t rows_of_item(const gpu::DeviceInfo& device, uint32_t rows) {
  const uint32_t items = 8 * std::max(1u, device.compute_units);
  return std::clamp((rows / items + 7) / 8 * 8, fewest_together, most_together);
}

const char* scatters_of(const FieldTables& tables) {
  if (!tables.scatters) return "0";
  if (!tables.reflects_scattered) return "1";
  return tables.bends_scattered ? "3" : "2";
}

gpu::Definitions build_of(const FieldTables& tables, uint32_t edges, FieldRows rows, bool in_runs = false) {
  return {{"WT_TOGETHER", std::to_string(in_runs ? most_together : 1) + "u"},
          {"WT_DIFFRACTS", std::to_string(std::min(edges, 3u))},
          {"WT_CORNER_EDGES", tables.corners && rows != FieldRows::without_corners ? "1" : "0"},
          {"WT_LISTED", rows == FieldRows::listed ? "1" : "0"},
          {"WT_EDGE_ENDS", tables.edge_ends ? "1" : "0"},
          {"WT_SCATTERS", scatters_of(tables)},
          {"WT_CELLS", tables.cells > 0 ? "1" : "0"},
          {"WT_TARGETS", tables.targets.laws.empty() ? "0"
                         : tables.reflects_echoes    ? "2"
                                                     : "1"},
          {"WT_FACETS", tables.targets.facets.empty() ? "0" : "1"},
          {"WT_LAYERS", tables.layered() ? "1" : "0"},
          {"WT_LOSSES", tables.loses() ? "1" : "0"}};
}

}  // namespace

Fields::Fields(gpu::Context& context, const FieldTables& tables, uint32_t edges, const glm::dvec3& origin_m)
    : Fields(context, tables, edges, origin_m, path_tuning_of(context.info()).corners_apart) {}

Fields::Fields(gpu::Context& context, const FieldTables& tables, uint32_t edges, const glm::dvec3& origin_m,
               bool corners_apart)
    : context_(context),
      apart_(edges > 0 && tables.corners && corners_apart),
      in_runs_(takes_runs(context.info(), tables, apart_)),
      kernel_(context, build_of(tables, edges, apart_ ? FieldRows::without_corners : FieldRows::all, in_runs_)),
      listed_build_(build_of(tables, edges, FieldRows::listed)),
      work_(tuning_of(context.info()).exact),
      transmitters_(tables.transmitters),
      ports_(tables.ports),
      arguments_{.origin = {origin_m.x, origin_m.y, origin_m.z},
                 .wavelength_m = tables.wavelength_m,
                 .seed = tables.seed,
                 .row_count = 0,
                 .row_capacity = 0,
                 .vertex_capacity = 0,
                 .max_depth = 0,
                 .transmissions = tables.transmissions,
                 .scatters = tables.scatters,
                 .air = tables.air,
                 .foliage_count = static_cast<uint32_t>(tables.foliages.size()),
                 .reflections = tables.reflections,
                 .rows_of_item = 1,
                 .for_sums = 0},
      materials_(context.buffer(tables.materials, "materials")),
      materials_of_(context.buffer(tables.materials_of, "materials of surfaces")),
      surface_of_tile_(context.buffer(tables.surface_of_tile, {"surfaces of tiles", advice::tiles})),
      area_of_tile_(context.buffer(tables.area_of_tile, {"areas of tiles", advice::tiles})),
      samples_(context.buffer(tables.samples, "antenna patterns")),
      antennas_(context.buffer(tables.antennas, "antennas")),
      foliages_(context.buffer(tables.foliages, "kinds of vegetation")),
      laws_(context.buffer(tables.targets.laws, "laws of targets")),
      lobes_(context.buffer(tables.targets.lobes, "lobes of targets")),
      facets_(context.buffer(tables.targets.facets, {"pieces of bodies", advice::pieces})) {
  if (apart_) listed_kernel_.emplace(context, listed_build_);
  make_room(context_, rows_, 1 << 12, "path rows");
  make_room(context_, vertices_, 1 << 14, "path vertex rows");
}

void Fields::set_ends(const WorldState& world) {
  const SharedList<EndState>* states[2] = {&world.transmitters, &world.receivers};
  const uint32_t first_antenna[2] = {0, transmitters_};
  for (int side = 0; side < 2; ++side) {
    if (ends_[side] && states[side]->shares(end_states_[side])) continue;
    upload_changed(context_, ends_[side], end_records_[side], field_ends(*states[side], first_antenna[side]),
                   "ends of paths");
    end_states_[side] = *states[side];
  }
}

calls::fields::fields Fields::call_of(const FieldInputs& inputs) const {
  return {.solved = inputs.visible.headers,
          .vertices = inputs.visible.vertices,
          .steps = inputs.visible.sequences,
          .transmitter_places = inputs.ends.transmitters,
          .receiver_places = inputs.ends.receivers,
          .receiver_of = inputs.distinct.receiver_of(),
          .transmitter_of = inputs.distinct.transmitter_of(),
          .rows = inputs.rows.rows,
          .delays = inputs.rows.delays,
          .quarters = inputs.rows.quarters,
          .before = inputs.rows.counts,
          .surfaces = inputs.scene.exact_surfaces,
          .materials_of = materials_of_,
          .materials = materials_,
          .wedges = inputs.wedges,
          .surface_of_tile = surface_of_tile_,
          .area_of_tile = area_of_tile_,
          .instances = inputs.scene.exact_instances,
          .transmitters = ends_[0],
          .receivers = ends_[1],
          .antennas = antennas_,
          .samples = samples_,
          .foliages = foliages_,
          .lengths_inside = inputs.lengths_inside,
          .targets = inputs.targets,
          .laws = laws_,
          .lobes = lobes_,
          .facets = facets_,
          .listed = apart_ ? &listed_ : nullptr,
          .out = rows_,
          .out_vertices = vertices_,
          .args = arguments_};
}

void Fields::operator()(const FieldInputs& inputs, const WorldState& world, RowCounts most, bool for_sums) {
  if (inputs.ends.moved || !ends_[0]) set_ends(world);
  make_room(context_, rows_, most.rows, "path rows");
  if (!for_sums) make_room(context_, vertices_, size_t{most.vertices} + WT_MAX_DEPTH, "path vertex rows");
  const uint32_t places = inputs.rows.places;
  arguments_.row_count = places;
  arguments_.row_capacity = static_cast<uint32_t>(rows_.size());
  arguments_.vertex_capacity = static_cast<uint32_t>(vertices_.size());
  arguments_.max_depth = inputs.visible.max_depth;
  arguments_.for_sums = for_sums;
  Work work = work_;
  if (in_runs_) work = {arguments_.rows_of_item = rows_of_item(context_.info(), places), 1};
  if (apart_) {
    make_room(context_, listed_, places + size_t{1}, "rows past corners");
    const uint32_t none = 0;
    context_.fill(listed_, &none, sizeof none, 0, sizeof none, Stage::fields);
  }
  const calls::fields::fields call = call_of(inputs);
  kernel_(work.range(places), Stage::fields, call);
  if (apart_) (*listed_kernel_)(work_.range(places), Stage::fields, call);
}

// Vertices keep their places, so they are written once more as they are.
RowChoice Fields::choose(const RowList& rows, std::span<const uint32_t> chosen) const {
  const std::vector<uint32_t> at = rows.rows.read(0, rows.places);
  std::vector<uint32_t> before = rows.counts.read(0, size_t{2} * rows.places), listed{0};
  uint32_t row = 0;
  for (uint32_t place = 0; place < rows.places && listed[0] < chosen.size(); ++place) {
    if (at[place] == WT_NO_ROW || row++ != chosen[listed[0]]) continue;
    before[place] = listed[0]++;
    listed.push_back(place);
  }
  return {context_.buffer(listed, "chosen rows"), context_.buffer(before, "numbers of chosen rows"), listed[0]};
}

void Fields::again(const FieldInputs& inputs, const RowChoice& choice) {
  if (!listed_kernel_) listed_kernel_.emplace(context_, listed_build_);
  calls::fields::fields call = call_of(inputs);
  call.before = choice.before;
  call.listed = choice.listed;
  (*listed_kernel_)(work_.range(choice.count), Stage::fields, call);
}

void Fields::make_host_rooms() {
  make_host_room(context_, rows_, host_rows_, "path rows");
  make_host_room(context_, vertices_, host_vertices_, "path vertex rows");
}

void Fields::begin_read(uint32_t frame, RowCounts expected) {
  make_host_rooms();
  read_ = {static_cast<uint32_t>(std::min<size_t>(expected.rows, rows_.size())),
           static_cast<uint32_t>(std::min<size_t>(expected.vertices, vertices_.size()))};
  parts_.clear();
  filled_.reset();
  frame_ = frame;
  const uint32_t count = 1 + read_.rows / rows_of_part;
  RowCounts from;
  for (uint32_t part = 1; part <= count; ++part) {
    const auto share = [&](uint32_t all) { return static_cast<uint32_t>(uint64_t{all} * part / count); };
    const RowCounts to{share(read_.rows), share(read_.vertices)};
    rows_.begin_read_part(from.rows, to.rows - from.rows, host_rows_, Stage::fields);
    vertices_.begin_read_part(from.vertices, to.vertices - from.vertices, host_vertices_, Stage::fields);
    if (count > 1) parts_.push_back({to, context_.mark()});
    from = to;
  }
  context_.flush();
}

void Fields::size_room() { room_ = sized_columns(read_, ports_, std::exchange(room_, {})); }

FrameRows Fields::rows_of(RowCounts count) const {
  return {{static_cast<const device::wt_path_row*>(host_rows_.data()), count.rows},
          {static_cast<const device::wt_vertex_row*>(host_vertices_.data()), count.vertices},
          frame_};
}

void Fields::fill_arriving(RowCounts count) {
  if (parts_.empty() || count.rows > read_.rows || count.vertices > read_.vertices) return;
  size_columns(room_, count);
  near_edges_ = 0;
  RowCounts from;
  for (const Part& part : parts_) {
    context_.wait(part.read);
    const RowCounts to{std::min(part.end.rows, count.rows), std::min(part.end.vertices, count.vertices)};
    near_edges_ += fill_part(room_, rows_of(count), from, to);
    from = to;
  }
  filled_ = count;
}

void Fields::begin_read_carrier(RowCounts expected) {
  make_host_rooms();
  read_ = {static_cast<uint32_t>(std::min<size_t>(expected.rows, rows_.size())), 0};
  rows_.begin_read(0, read_.rows, host_rows_, Stage::fields);
}

CarrierFields Fields::carrier(RowCounts count) {
  if (count.rows > read_.rows) rows_.read(0, count.rows, host_rows_, Stage::fields);
  CarrierFields out;
  near_edges_ = fill_carrier(out, {static_cast<const device::wt_path_row*>(host_rows_.data()), count.rows}, ports_);
  return out;
}

Paths Fields::columns(RowCounts count) {
  if (count.rows > read_.rows) rows_.read(0, count.rows, host_rows_, Stage::fields);
  if (count.vertices > read_.vertices) vertices_.read(0, count.vertices, host_vertices_, Stage::fields);
  if (std::exchange(filled_, {}) != count) {
    size_columns(room_, count);
    near_edges_ = fill_columns(room_, rows_of(count));
  }
  return std::exchange(room_, {});
}

}  // namespace wavetracer
