// Host side of kernels/fields.cl.
// One row per work-item; rows are read as records, once per frame.
#include "passes/fields.hpp"

namespace wavetracer {
namespace {

// Room for so many elements on the device and on the host.
template <class T>
void make_room(gpu::Context& context, gpu::Buffer<T>& buffer, gpu::HostMemory& host, size_t count, const char* name) {
  if (count <= buffer.size()) return;
  const size_t larger = count + count / 4;
  buffer = context.buffer<T>(larger, name);
  host = context.host_memory(larger * sizeof(T), name);
}

}  // namespace

Fields::Fields(gpu::Context& context, const FieldTables& tables, bool diffracts, const glm::dvec3& origin_m)
    : context_(context),
      kernel_(context.kernel("fields", "fields",
                             {{"WT_DIFFRACTS", diffracts ? "1" : "0"}, {"WT_SCATTERS", tables.scatters ? "1" : "0"}})),
      work_(tuning_of(context.info()).exact),
      transmitters_(tables.transmitters),
      ports_(tables.ports),
      arguments_{.origin = {origin_m.x, origin_m.y, origin_m.z},
                 .wavelength_m = tables.wavelength_m,
                 .seed = tables.seed,
                 .row_count = 0,
                 .max_depth = 0,
                 .transmissions = tables.transmissions,
                 .scatters = tables.scatters},
      materials_(context.buffer(tables.materials, "materials")),
      materials_of_(context.buffer(tables.materials_of, "materials of surfaces")),
      surface_of_tile_(context.buffer(tables.surface_of_tile, "surfaces of tiles")),
      area_of_tile_(context.buffer(tables.area_of_tile, "areas of tiles")),
      samples_(context.buffer(tables.samples, "antenna patterns")),
      antennas_(context.buffer(tables.antennas, "antennas")) {
  make_room(context_, rows_, host_rows_, 1 << 12, "path rows");
  make_room(context_, vertices_, host_vertices_, 1 << 14, "path vertex rows");
}

void Fields::operator()(const DeviceScene& scene, const gpu::Buffer<wt_wedge>* wedges, const RadioEnds& ends,
                        const WorldState& world, const SolvedList& visible, const Distinct& distinct,
                        const RowList& rows, const device::wt_row_totals& totals) {
  const std::vector<device::wt_field_end> records[2] = {field_ends(world.transmitters, 0),
                                                        field_ends(world.receivers, transmitters_)};
  for (int side = 0; side < 2; ++side) {
    if (ends_[side].size() < records[side].size())
      ends_[side] = context_.buffer<device::wt_field_end>(records[side].size(), "ends of paths");
    ends_[side].write(records[side], 0, "fields");
  }
  make_room(context_, rows_, host_rows_, totals.rows, "path rows");
  make_room(context_, vertices_, host_vertices_, totals.vertices, "path vertex rows");
  arguments_.row_count = rows.places;
  arguments_.max_depth = visible.max_depth;
  kernel_(work_.range(rows.places), "fields", visible.headers, visible.vertices, visible.sequences, ends.transmitters,
          ends.receivers, distinct.receiver_of(), distinct.transmitter_of(), rows.rows, rows.delays, rows.quarters,
          rows.counts, rows.vertex_counts, scene.exact_surfaces, materials_of_, materials_, wedges, surface_of_tile_,
          area_of_tile_, scene.exact_instances, ends_[0], ends_[1], antennas_, samples_, rows_, vertices_, arguments_);
}

Paths Fields::read(uint32_t frame, const device::wt_row_totals& totals) {
  context_.flush();  // the device works while the host makes room
  Paths paths = sized_columns(totals.rows, totals.vertices, frame, ports_);
  const auto rows = rows_.read(0, totals.rows, host_rows_, "fields");
  const auto vertices = vertices_.read(0, totals.vertices, host_vertices_, "fields");
  fill_columns(paths, rows, vertices);
  return paths;
}

CarrierFields Fields::read_carrier(const device::wt_row_totals& totals) {
  CarrierFields out;
  if (totals.rows > 0) fill_carrier(out, rows_.read(0, totals.rows, host_rows_, "fields"), ports_);
  return out;
}

}  // namespace wavetracer
