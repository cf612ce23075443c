// Every record of the headers that host and device share has the same size and the same offsets on both.
// The headers' own text says which records and fields there are, so that none is left out of the table below.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <cstddef>
#include <map>
#include <regex>
#include <vector>
#include "gpu/gpu.hpp"
#include "gpu/temporary.hpp"
#include "wavetracer/device/arguments.h"
#include "wavetracer/device/cache.h"
#include "wavetracer/device/field_records.h"
#include "wavetracer/device/moving.h"
#include "wavetracer/device/records.h"
#include "wavetracer/device/waypoints.h"

using namespace wavetracer;
using namespace wavetracer::device;
using namespace wavetracer::test;

namespace {

struct Field {
  const char* name;
  size_t offset;
};
struct Record {
  const char* name;
  size_t bytes;
  std::vector<Field> fields;
};

#define FIELD(record, field) \
  { #field, offsetof(record, field) }

const std::vector<Record> records{
    {"wt_map_arguments",
     sizeof(wt_map_arguments),
     {FIELD(wt_map_arguments, parameter), FIELD(wt_map_arguments, level), FIELD(wt_map_arguments, faces)}},
    {"wt_launcher_arguments",
     sizeof(wt_launcher_arguments),
     {FIELD(wt_launcher_arguments, origin), FIELD(wt_launcher_arguments, root), FIELD(wt_launcher_arguments, source),
      FIELD(wt_launcher_arguments, heights)}},
    {"wt_launch_arguments",
     sizeof(wt_launch_arguments),
     {FIELD(wt_launch_arguments, first_index), FIELD(wt_launch_arguments, stride), FIELD(wt_launch_arguments, number),
      FIELD(wt_launch_arguments, capacity), FIELD(wt_launch_arguments, first_slot), FIELD(wt_launch_arguments, count)}},
    {"wt_samples_arguments",
     sizeof(wt_samples_arguments),
     {FIELD(wt_samples_arguments, capacity), FIELD(wt_samples_arguments, first), FIELD(wt_samples_arguments, count),
      FIELD(wt_samples_arguments, sample_capacity), FIELD(wt_samples_arguments, cosine),
      FIELD(wt_samples_arguments, sine)}},
    {"wt_bounces_arguments",
     sizeof(wt_bounces_arguments),
     {FIELD(wt_bounces_arguments, triangle_slots), FIELD(wt_bounces_arguments, extent_m),
      FIELD(wt_bounces_arguments, capacity), FIELD(wt_bounces_arguments, ray_count),
      FIELD(wt_bounces_arguments, interactions), FIELD(wt_bounces_arguments, trie_mask),
      FIELD(wt_bounces_arguments, now)}},
    {"wt_interact_arguments",
     sizeof(wt_interact_arguments),
     {FIELD(wt_interact_arguments, capacity), FIELD(wt_interact_arguments, ray_count),
      FIELD(wt_interact_arguments, trie_mask), FIELD(wt_interact_arguments, last), FIELD(wt_interact_arguments, now)}},
    {"wt_receive_arguments",
     sizeof(wt_receive_arguments),
     {FIELD(wt_receive_arguments, capacity), FIELD(wt_receive_arguments, ray_count),
      FIELD(wt_receive_arguments, receiver_capacity), FIELD(wt_receive_arguments, radius_m),
      FIELD(wt_receive_arguments, depth), FIELD(wt_receive_arguments, out_capacity)}},
    {"wt_candidates_arguments",
     sizeof(wt_candidates_arguments),
     {FIELD(wt_candidates_arguments, node_count), FIELD(wt_candidates_arguments, receiver_capacity),
      FIELD(wt_candidates_arguments, transmitter_count), FIELD(wt_candidates_arguments, max_reflections),
      FIELD(wt_candidates_arguments, capacity)}},
    {"wt_solve_arguments",
     sizeof(wt_solve_arguments),
     {FIELD(wt_solve_arguments, candidate_count), FIELD(wt_solve_arguments, max_depth),
      FIELD(wt_solve_arguments, capacity)}},
    {"wt_legs_arguments",
     sizeof(wt_legs_arguments),
     {FIELD(wt_legs_arguments, triangle_slots), FIELD(wt_legs_arguments, extent_m),
      FIELD(wt_legs_arguments, solved_count), FIELD(wt_legs_arguments, max_depth), FIELD(wt_legs_arguments, most)}},
    {"wt_lit_arguments",
     sizeof(wt_lit_arguments),
     {FIELD(wt_lit_arguments, node_count), FIELD(wt_lit_arguments, transmitter_count), FIELD(wt_lit_arguments, groups),
      FIELD(wt_lit_arguments, capacity)}},
    {"wt_scatter_arguments",
     sizeof(wt_scatter_arguments),
     {FIELD(wt_scatter_arguments, entry_count), FIELD(wt_scatter_arguments, row_count),
      FIELD(wt_scatter_arguments, rows_per_item), FIELD(wt_scatter_arguments, max_depth)}},
    {"wt_wedge_prefixes_arguments",
     sizeof(wt_wedge_prefixes_arguments),
     {FIELD(wt_wedge_prefixes_arguments, trie_mask), FIELD(wt_wedge_prefixes_arguments, node_count),
      FIELD(wt_wedge_prefixes_arguments, capacity)}},
    {"wt_sight_arguments",
     sizeof(wt_sight_arguments),
     {FIELD(wt_sight_arguments, count), FIELD(wt_sight_arguments, triangle_slots), FIELD(wt_sight_arguments, extent_m),
      FIELD(wt_sight_arguments, static_surfaces), FIELD(wt_sight_arguments, only_opaque),
      FIELD(wt_sight_arguments, kept_wedges)}},
    {"wt_wedge_join_arguments",
     sizeof(wt_wedge_join_arguments),
     {FIELD(wt_wedge_join_arguments, count), FIELD(wt_wedge_join_arguments, lanes),
      FIELD(wt_wedge_join_arguments, transmitter_count), FIELD(wt_wedge_join_arguments, groups),
      FIELD(wt_wedge_join_arguments, max_depth), FIELD(wt_wedge_join_arguments, capacity)}},
    {"wt_cache_lookup_arguments",
     sizeof(wt_cache_lookup_arguments),
     {FIELD(wt_cache_lookup_arguments, capacity), FIELD(wt_cache_lookup_arguments, count),
      FIELD(wt_cache_lookup_arguments, now), FIELD(wt_cache_lookup_arguments, touch),
      FIELD(wt_cache_lookup_arguments, static_surfaces), FIELD(wt_cache_lookup_arguments, radius_m),
      FIELD(wt_cache_lookup_arguments, widths)}},
    {"wt_cache_store_arguments",
     sizeof(wt_cache_store_arguments),
     {FIELD(wt_cache_store_arguments, capacity), FIELD(wt_cache_store_arguments, missed_capacity),
      FIELD(wt_cache_store_arguments, missed_count), FIELD(wt_cache_store_arguments, now),
      FIELD(wt_cache_store_arguments, static_surfaces), FIELD(wt_cache_store_arguments, widths)}},
    {"wt_planes_xy", sizeof(wt_planes_xy), {FIELD(wt_planes_xy, x), FIELD(wt_planes_xy, y)}},
    {"wt_bvh2_node",
     sizeof(wt_bvh2_node),
     {FIELD(wt_bvh2_node, left), FIELD(wt_bvh2_node, right), FIELD(wt_bvh2_node, left_z), FIELD(wt_bvh2_node, right_z),
      FIELD(wt_bvh2_node, child), FIELD(wt_bvh2_node, padding)}},
    {"wt_centred_node",
     sizeof(wt_centred_node),
     {FIELD(wt_centred_node, left), FIELD(wt_centred_node, right), FIELD(wt_centred_node, z),
      FIELD(wt_centred_node, child)}},
    {"wt_bvh2_triangle",
     sizeof(wt_bvh2_triangle),
     {FIELD(wt_bvh2_triangle, a), FIELD(wt_bvh2_triangle, b), FIELD(wt_bvh2_triangle, c)}},
    {"wt_bvh8_node",
     sizeof(wt_bvh8_node),
     {FIELD(wt_bvh8_node, planes), FIELD(wt_bvh8_node, child), FIELD(wt_bvh8_node, padding)}},
    {"wt_triangle_block",
     sizeof(wt_triangle_block),
     {FIELD(wt_triangle_block, corner), FIELD(wt_triangle_block, primitive), FIELD(wt_triangle_block, surface),
      FIELD(wt_triangle_block, padding)}},
    {"wt_moving_head",
     sizeof(wt_moving_head),
     {FIELD(wt_moving_head, instances), FIELD(wt_moving_head, nodes), FIELD(wt_moving_head, triangles),
      FIELD(wt_moving_head, triangle_slots), FIELD(wt_moving_head, padding)}},
    {"wt_instance",
     sizeof(wt_instance),
     {FIELD(wt_instance, row), FIELD(wt_instance, root), FIELD(wt_instance, first_surface),
      FIELD(wt_instance, first_primitive), FIELD(wt_instance, number)}},
    {"wt_body",
     sizeof(wt_body),
     {FIELD(wt_body, lower), FIELD(wt_body, root), FIELD(wt_body, upper), FIELD(wt_body, first_primitive)}},
    {"wt_surface",
     sizeof(wt_surface),
     {FIELD(wt_surface, normal), FIELD(wt_surface, offset), FIELD(wt_surface, lower), FIELD(wt_surface, upper)}},
    {"wt_exact_surface",
     sizeof(wt_exact_surface),
     {FIELD(wt_exact_surface, normal), FIELD(wt_exact_surface, offset), FIELD(wt_exact_surface, first_triangle),
      FIELD(wt_exact_surface, triangle_count), FIELD(wt_exact_surface, instance), FIELD(wt_exact_surface, opaque)}},
    {"wt_model_surface",
     sizeof(wt_model_surface),
     {FIELD(wt_model_surface, normal), FIELD(wt_model_surface, offset), FIELD(wt_model_surface, lower),
      FIELD(wt_model_surface, upper), FIELD(wt_model_surface, first_triangle),
      FIELD(wt_model_surface, triangle_count)}},
    {"wt_exact_instance",
     sizeof(wt_exact_instance),
     {FIELD(wt_exact_instance, rotation), FIELD(wt_exact_instance, position), FIELD(wt_exact_instance, velocity),
      FIELD(wt_exact_instance, angular_velocity), FIELD(wt_exact_instance, first_surface),
      FIELD(wt_exact_instance, first_model_surface), FIELD(wt_exact_instance, first_wedge),
      FIELD(wt_exact_instance, present)}},
    {"wt_candidate", sizeof(wt_candidate), {FIELD(wt_candidate, node), FIELD(wt_candidate, receiver)}},
    {"wt_wedge",
     sizeof(wt_wedge),
     {FIELD(wt_wedge, start), FIELD(wt_wedge, along), FIELD(wt_wedge, face), FIELD(wt_wedge, normal),
      FIELD(wt_wedge, length), FIELD(wt_wedge, exterior), FIELD(wt_wedge, cosine), FIELD(wt_wedge, sine),
      FIELD(wt_wedge, surfaces), FIELD(wt_wedge, instance), FIELD(wt_wedge, padding)}},
    {"wt_wedge_prefix",
     sizeof(wt_wedge_prefix),
     {FIELD(wt_wedge_prefix, node), FIELD(wt_wedge_prefix, origin), FIELD(wt_wedge_prefix, depth),
      FIELD(wt_wedge_prefix, last), FIELD(wt_wedge_prefix, image), FIELD(wt_wedge_prefix, along),
      FIELD(wt_wedge_prefix, away), FIELD(wt_wedge_prefix, length), FIELD(wt_wedge_prefix, quarters),
      FIELD(wt_wedge_prefix, pieces)}},
    {"wt_wedge_candidate",
     sizeof(wt_wedge_candidate),
     {FIELD(wt_wedge_candidate, node), FIELD(wt_wedge_candidate, back), FIELD(wt_wedge_candidate, wedges),
      FIELD(wt_wedge_candidate, receiver), FIELD(wt_wedge_candidate, quarters)}},
    {"wt_solved",
     sizeof(wt_solved),
     {FIELD(wt_solved, transmitter), FIELD(wt_solved, receiver), FIELD(wt_solved, depth), FIELD(wt_solved, blocked),
      FIELD(wt_solved, node), FIELD(wt_solved, quarters)}},
    {"wt_counters",
     sizeof(wt_counters),
     {FIELD(wt_counters, nodes), FIELD(wt_counters, trie_overflow), FIELD(wt_counters, candidates),
      FIELD(wt_counters, solved), FIELD(wt_counters, visible), FIELD(wt_counters, wedge_prefixes),
      FIELD(wt_counters, wedge_candidates), FIELD(wt_counters, ended)}},
    {"wt_waypoint",
     sizeof(wt_waypoint),
     {FIELD(wt_waypoint, position), FIELD(wt_waypoint, surface), FIELD(wt_waypoint, answered)}},
    {"wt_reception",
     sizeof(wt_reception),
     {FIELD(wt_reception, node), FIELD(wt_reception, transmitter), FIELD(wt_reception, receiver),
      FIELD(wt_reception, sample), FIELD(wt_reception, depth), FIELD(wt_reception, distance_m)}},
    {"wt_cache_entry",
     sizeof(wt_cache_entry),
     {FIELD(wt_cache_entry, cells), FIELD(wt_cache_entry, left), FIELD(wt_cache_entry, version),
      FIELD(wt_cache_entry, t), FIELD(wt_cache_entry, primitive), FIELD(wt_cache_entry, surface),
      FIELD(wt_cache_entry, time), FIELD(wt_cache_entry, origin), FIELD(wt_cache_entry, direction),
      FIELD(wt_cache_entry, next), FIELD(wt_cache_entry, receiver)}},
    {"wt_cache_region",
     sizeof(wt_cache_region),
     {FIELD(wt_cache_region, first_entry), FIELD(wt_cache_region, entries), FIELD(wt_cache_region, first_bucket),
      FIELD(wt_cache_region, buckets), FIELD(wt_cache_region, since), FIELD(wt_cache_region, stamp)}},
    {"wt_cache_counters",
     sizeof(wt_cache_counters),
     {FIELD(wt_cache_counters, conflicts), FIELD(wt_cache_counters, stale), FIELD(wt_cache_counters, stored),
      FIELD(wt_cache_counters, replaced), FIELD(wt_cache_counters, duplicates), FIELD(wt_cache_counters, dropped),
      FIELD(wt_cache_counters, exhausted), FIELD(wt_cache_counters, evicted), FIELD(wt_cache_counters, linked)}},
    {"wt_cache_cycles", sizeof(wt_cache_cycles), {FIELD(wt_cache_cycles, read), FIELD(wt_cache_cycles, write)}},
    {"wt_cache_widths",
     sizeof(wt_cache_widths),
     {FIELD(wt_cache_widths, cell_bits), FIELD(wt_cache_widths, surface_bits), FIELD(wt_cache_widths, primitive_bits)}},
    {"wt_material",
     sizeof(wt_material),
     {FIELD(wt_material, permittivity), FIELD(wt_material, thickness_m), FIELD(wt_material, scattering),
      FIELD(wt_material, cross_polar), FIELD(wt_material, lobe), FIELD(wt_material, padding)}},
    {"wt_antenna",
     sizeof(wt_antenna),
     {FIELD(wt_antenna, pattern), FIELD(wt_antenna, ports), FIELD(wt_antenna, first_sample), FIELD(wt_antenna, rows),
      FIELD(wt_antenna, columns), FIELD(wt_antenna, padding), FIELD(wt_antenna, theta_step),
      FIELD(wt_antenna, phi_step), FIELD(wt_antenna, first_phi), FIELD(wt_antenna, slant)}},
    {"wt_field_end",
     sizeof(wt_field_end),
     {FIELD(wt_field_end, position_m), FIELD(wt_field_end, velocity_m_s), FIELD(wt_field_end, rotation),
      FIELD(wt_field_end, antenna), FIELD(wt_field_end, padding)}},
    {"wt_row_totals",
     sizeof(wt_row_totals),
     {FIELD(wt_row_totals, rows), FIELD(wt_row_totals, vertices), FIELD(wt_row_totals, near),
      FIELD(wt_row_totals, padding)}},
    {"wt_path_row",
     sizeof(wt_path_row),
     {FIELD(wt_path_row, delay_s), FIELD(wt_path_row, gain_db), FIELD(wt_path_row, doppler_hz),
      FIELD(wt_path_row, aod_theta), FIELD(wt_path_row, aod_phi), FIELD(wt_path_row, aoa_theta),
      FIELD(wt_path_row, aoa_phi), FIELD(wt_path_row, a), FIELD(wt_path_row, tx), FIELD(wt_path_row, rx),
      FIELD(wt_path_row, depth), FIELD(wt_path_row, quarters)}},
    {"wt_vertex_row",
     sizeof(wt_vertex_row),
     {FIELD(wt_vertex_row, position), FIELD(wt_vertex_row, surface), FIELD(wt_vertex_row, instance),
      FIELD(wt_vertex_row, interaction), FIELD(wt_vertex_row, padding)}},
    {"wt_distinct_arguments",
     sizeof(wt_distinct_arguments),
     {FIELD(wt_distinct_arguments, row_count), FIELD(wt_distinct_arguments, max_depth),
      FIELD(wt_distinct_arguments, receiver_count), FIELD(wt_distinct_arguments, groups),
      FIELD(wt_distinct_arguments, twins), FIELD(wt_distinct_arguments, length_bits)}},
    {"wt_fields_arguments",
     sizeof(wt_fields_arguments),
     {FIELD(wt_fields_arguments, origin), FIELD(wt_fields_arguments, wavelength_m), FIELD(wt_fields_arguments, seed),
      FIELD(wt_fields_arguments, row_count), FIELD(wt_fields_arguments, max_depth),
      FIELD(wt_fields_arguments, transmissions), FIELD(wt_fields_arguments, scatters)}},
};

#undef FIELD

const std::vector<std::string> headers{"arguments.h", "bvh.h",     "cache.h",    "field_records.h",
                                       "moving.h",    "records.h", "waypoints.h"};

// Record name -> field names, as the headers declare them.
std::map<std::string, std::vector<std::string>> declared_records() {
  std::map<std::string, std::vector<std::string>> declared;
  const std::regex comment("//[^\n]*"), record("typedef struct \\{([^}]*)\\} (\\w+);"),
      field("(\\w+)\\s*(\\[[^;]*\\])?[,;]");
  for (const std::string& header : headers) {
    const std::string text =
        std::regex_replace(read_file(WAVETRACER_SOURCE "/include/wavetracer/device/" + header), comment, "");
    for (std::sregex_iterator r(text.begin(), text.end(), record), end; r != end; ++r) {
      const std::string body = (*r)[1];
      for (std::sregex_iterator f(body.begin(), body.end(), field); f != end; ++f) declared[(*r)[2]].push_back((*f)[1]);
    }
  }
  return declared;
}

}  // namespace

TEST_CASE("the table names every record and field of the headers, in order") {
  std::map<std::string, std::vector<std::string>> listed;
  for (const Record& record : records) {
    for (const Field& field : record.fields) listed[record.name].push_back(field.name);
  }
  CHECK(listed == declared_records());
}

TEST_CASE("sizes and offsets agree between host and device") {
  std::string body;
  std::vector<uint32_t> expected;
  const auto expect = [&](const std::string& expression, size_t value) {
    body += fmt::format("  out[{}] = (uint)({});\n", expected.size(), expression);
    expected.push_back(static_cast<uint32_t>(value));
  };
  for (const Record& record : records) {
    body += fmt::format("  {0} a_{0};\n", record.name);
    expect(fmt::format("sizeof({})", record.name), record.bytes);
    for (const Field& field : record.fields) {
      expect(fmt::format("(private char*)&a_{0}.{1} - (private char*)&a_{0}", record.name, field.name), field.offset);
    }
  }
  const TemporaryKernels kernels;
  std::string includes;
  for (const std::string& header : headers) includes += "#include \"wavetracer/device/" + header + "\"\n";
  kernels.add("layout.cl", includes + "kernel void layout(global uint* out) {\n" + body + "}\n");
  gpu::Context context;
  auto out = context.buffer<uint32_t>(expected.size(), "out");
  context.kernel("layout", "layout")({1, 1}, "test", out);
  CHECK(out.read() == expected);
}
