// The rows of the field table, one a key of the config file, in the order in which `init` writes them.
// The reason for each default stands in the doc of its row; the default itself is the initialiser in config.hpp.
#include "config/field_table.hpp"

#include "config/field_rows.hpp"

namespace wavetracer::config {
namespace {

Table trace_table() {
  const auto t = [](auto member) { return at(&Config::trace, member); };
  return {
      .name = "trace",
      .doc = "How rays discover the surfaces that paths may touch.",
      .fields = {
          {.name = "rays",
           .slot = t(&TraceConfig::rays),
           .unit = "rays a transmitter",
           .range = {1, 2147483648.0},
           .none = "auto",
           .doc = "More rays find more of the weak paths; those found are exact in any case. The default finds more "
                  "than 99% of the paths of a city quarter at depth 5. auto: as many as recall asks for, along the "
                  "Hilbert curve."},
          {.name = "recall",
           .slot = t(&TraceConfig::recall),
           .range = {0, 1, true},
           .doc = "Of rays = \"auto\": the share of the paths that is to be found, estimated from how much one ray "
                  "alone has met (Good and Turing). The last percent costs more rays than all before it."},
          {.name = "max_rays",
           .slot = t(&TraceConfig::max_rays),
           .unit = "rays a transmitter",
           .range = {1, 2147483648.0},
           .doc = "Of rays = \"auto\": never more than this, whatever recall asks for."},
          {.name = "reuse",
           .slot = t(&TraceConfig::reuse),
           .doc = "Keep what rays of earlier frames of a drive have found. Its paths are solved anew in every frame, "
                  "so they are exact, and more are found with fewer rays."},
          {.name = "refresh_rays",
           .slot = t(&TraceConfig::refresh_rays),
           .unit = "rays a transmitter",
           .range = {0, 2147483648.0},
           .none = "0",
           .doc = "Of a frame that reuses, at most rays; each such frame launches other ones of their directions. 0: a "
                  "tenth of rays, since little is new from one frame to the next. rays = \"auto\" decides by itself."},
          {.name = "forget_frames",
           .slot = t(&TraceConfig::forget_frames),
           .unit = "frames",
           .range = {1, 4294967295.0},
           .doc = "A sequence of surfaces that neither a ray nor a path has followed for so long is dropped. 50 frames "
                  "are 5 s at 10 Hz."},
          {.name = "max_depth",
           .slot = t(&TraceConfig::max_depth),
           .unit = "interactions",
           .range = {0, 32},
           .doc = "0 is line of sight alone. Beyond 5 a path in a street canyon carries little power."},
          {.name = "reflection", .slot = t(&TraceConfig::reflection), .doc = "Specular reflection."},
          {.name = "diffraction",
           .slot = t(&TraceConfig::diffraction),
           .doc = "Diffraction at edges, by the uniform theory of diffraction. Costs a launch of every receiver that "
                  "does not send; with it shadows are filled."},
          {.name = "max_diffractions",
           .slot = t(&TraceConfig::max_diffractions),
           .unit = "a path",
           .range = {1, 2},
           .doc = "2 adds paths over two edges, straight from one to the other: the field behind a whole building, and "
                  "a candidate for every pair of edges that both ends see."},
          {.name = "free_edges",
           .slot = t(&TraceConfig::free_edges),
           .doc = "Edges of a single face diffract too, as half planes: screens, signs, the rims of open "
                  "meshes. That of the ground never does: the world goes on where the map ends."},
          {.name = "diffraction_rays",
           .slot = t(&TraceConfig::diffraction_rays),
           .unit = "rays a receiver",
           .range = {0, 2147483648.0},
           .none = "0",
           .doc = "With diffraction, of a receiver that does not send, at most rays. 0: a tenth of rays, but 100,000 "
                  "at least: edges are met by many rays."},
          {.name = "transmission",
           .slot = t(&TraceConfig::transmission),
           .doc = "Transmission through surfaces, straight on, each a slab as thick as its material says. Rays then "
                  "split at every surface, so it may double the tracing with each transmission allowed."},
          {.name = "max_transmissions",
           .slot = t(&TraceConfig::max_transmissions),
           .unit = "a path",
           .range = {1, 32},
           .doc = "They count for max_depth too. 2 pass through one building or vehicle."},
          {.name = "scattering",
           .slot = t(&TraceConfig::scattering),
           .doc = "Diffuse scattering by surfaces whose material has a coefficient (material.scattering), one tile a "
                  "path, from the transmitter to the tile to the receiver."},
          {.name = "tile_m",
           .slot = t(&TraceConfig::tile_m),
           .unit = "m",
           .range = {0, 1e6, true},
           .doc = "No tile of scattering is longer. Half as long are four times as many paths, and about a quarter of "
                  "the error."},
          {.name = "directions",
           .slot = t(&TraceConfig::directions),
           .doc = "Launch directions. horizon: dense at the slopes that paths between these ends can have, by their "
                  "heights above the ground and the size of the scene, with a quarter of the rays spread evenly. "
                  "hilbert: even over the sphere. Both go along a Hilbert curve, so that neighbours in memory are "
                  "neighbours in space. fibonacci, random: even, in other orders."},
          {.name = "seed",
           .slot = t(&TraceConfig::seed),
           .range = {0, 9223372036854775807.0},
           .doc = "Of directions = \"random\"."},
          {.name = "reception",
           .slot = t(&TraceConfig::reception),
           .doc = "exact: rays only find surfaces, paths are solved by the image method. sphere: a ray that passes "
                  "within sphere_radius_m of a receiver is its path, as in the thesis: lengths are a little wrong, "
                  "some paths lost and some none at all. Frames then reuse no sequences, each is traced whole."},
          {.name = "sphere_radius_m",
           .slot = t(&TraceConfig::sphere_radius_m),
           .unit = "m",
           .range = {0, 1e4, true},
           .doc = "Of reception = \"sphere\". A larger sphere loses fewer paths, and errs more in those it finds."},
          {.name = "batch_rays",
           .slot = t(&TraceConfig::batch_rays),
           .unit = "rays",
           .range = {0, 2147483648.0},
           .none = "0",
           .doc = "Rays in flight at once, which bounds the device memory; results do not depend on it. 0: chosen "
                  "from the device."},
      }};
}

Table order_table() {
  const auto o = [](auto member) { return at(&Config::order, member); };
  return {
      .name = "order",
      .doc = "Sorting of the rays before they are traced. Paths do not depend on it, time does.",
      .fields = {
          {.name = "method",
           .slot = o(&OrderConfig::method),
           .doc = "The plain name or the mnemonic of the method. none: with trace.directions = \"hilbert\" rays are "
                  "born in order and need no sort. direction-origin: by direction first, then by where the ray starts, "
                  "for each_depth. auto: the fastest, by a short measurement that is kept for the next run."},
          {.name = "each_depth",
           .slot = o(&OrderConfig::each_depth),
           .doc = "Sort before every depth, not only the first. With method = \"auto\" it is chosen too."},
          {.name = "bin_num",
           .slot = o(&OrderConfig::bin_num),
           .unit = "bins a direction component",
           .range = {1, 1024},
           .doc = "Of the histogram methods. 16, as in the thesis, sorts 12 bits; more bins, finer order, more passes "
                  "of the sort."},
      }};
}

Table launch_table() {
  const auto l = [](auto member) { return at(&Config::launch, member); };
  return {
      .name = "launch",
      .doc = "The shape in which the rays of a depth are handed to the device. Paths do not depend on it, time does.",
      .fields = {
          {.name = "shape",
           .slot = l(&LaunchConfig::shape),
           .doc = "auto: 1d, but 2d and 3d for the two methods that map the sorted rays along a curve of that "
                  "dimension, and those accept nothing else."},
          {.name = "local_size",
           .slot = l(&LaunchConfig::local_size),
           .unit = "work-items a group",
           .range = {0, 1024},
           .none = "0",
           .doc = "A power of two, spread evenly over the dimensions. 0: what suits the device."},
      }};
}

// With the words of each Choice, and that of an optional that is not set, as choices.
std::vector<Table> with_words(std::vector<Table> tables) {
  Config sample;
  for (Table& table : tables) {
    if (table.append) table.append(sample);
    for (Field& field : table.fields) {
      const Slot slot = field.slot(sample, 0);
      if (const auto* choice = std::get_if<ChoiceSlot>(&slot))
        field.choices.assign(choice->words.begin(), choice->words.end());
      else if (!field.none.empty() && field.none != "0")
        field.choices = {field.none};
    }
  }
  return tables;
}

}  // namespace

const std::vector<Table>& tables() {
  static const std::vector<Table> all = with_words({
      scene_table(),
      trajectories_table(),
      time_table(),
      links_table(),
      {.name = "radio",
       .doc = "The carrier, and the link budget.",
       .fields = {{.name = "frequency_hz",
                   .slot = at(&Config::radio, &RadioConfig::frequency_hz),
                   .unit = "Hz",
                   .range = {1e6, 1e12},
                   .doc = "5.9 GHz is the band of vehicle communication (ITS-G5, C-V2X). ITU-R P.2040 materials hold "
                          "from 1 to 100 GHz, most of them."},
                  {.name = "transmit_power_dbm",
                   .slot = at(&Config::radio, &RadioConfig::transmit_power_dbm),
                   .unit = "dBm",
                   .range = {-200, 200},
                   .doc = "Of each transmitter, for received powers in links.csv, plots and maps. Not given: gains "
                          "alone. 23 dBm is usual for ITS-G5 and C-V2X."},
                  {.name = "bandwidth_hz",
                   .slot = at(&Config::radio, &RadioConfig::bandwidth_hz),
                   .unit = "Hz",
                   .range = {1, 1e12},
                   .doc = "Of the noise, k T B at 290 K, for signal-to-noise ratios beside received powers; paths do "
                          "not depend on it. 10 MHz is a channel of ITS-G5."},
                  {.name = "noise_figure_db",
                   .slot = at(&Config::radio, &RadioConfig::noise_figure_db),
                   .unit = "dB",
                   .range = {0, 100},
                   .doc = "Of each receiver: how much its noise is above k T B. 0 is a receiver without noise of its "
                          "own, 9 dB one that 3GPP assumes for vehicles."}}},
      trace_table(),
      order_table(),
      launch_table(),
      cache_table(),
      live_table(),
      {.name = "output",
       .doc = "What is written.",
       .fields = {{.name = "directory",
                   .slot = at(&Config::output, &OutputConfig::directory),
                   .form = Form::output_folder,
                   .doc =
                       "Folder for paths.h5, links.csv and summary.json, from the current folder where it is relative; "
                       "`run -o` overrides it."},
                  {.name = "shard_frames",
                   .slot = at(&Config::output, &OutputConfig::shard_frames),
                   .unit = "frames a file",
                   .range = {1, 1e9},
                   .doc = "Of a drive. An interrupted run goes on after the last file that is whole; the first frame "
                          "of each is cold where frames reuse sequences, so fewer frames cost time, more cost "
                          "memory."},
                  {.name = "waypoints",
                   .slot = at(&Config::output, &OutputConfig::waypoints),
                   .unit = "samples a transmitter",
                   .range = {0, 1e9},
                   .doc = "Of these rays, spread evenly over each launch, waypoints.h5 gets every point from launch to "
                          "last hit, for study and pictures. They are many: 0 writes none."},
                  {.name = "min_gain_db",
                   .slot = at(&Config::output, &OutputConfig::min_gain_db),
                   .unit = "dB",
                   .range = {-1000, 1000},
                   .doc = "Weaker paths are left out of paths.h5. What this and the next two keys leave out is counted "
                          "with its power in links.csv and summary.json, whose other figures are those of all paths. "
                          "Not given: none."},
                  {.name = "dynamic_range_db",
                   .slot = at(&Config::output, &OutputConfig::dynamic_range_db),
                   .unit = "dB",
                   .range = {0, 1000},
                   .doc = "Paths that are weaker than the strongest of their link and frame by more than this are left "
                          "out of paths.h5. Not given: none."},
                  {.name = "max_paths_per_link",
                   .slot = at(&Config::output, &OutputConfig::max_paths_per_link),
                   .unit = "paths a link and frame",
                   .range = {0, 4294967295.0},
                   .none = "0",
                   .doc = "Only so many, the strongest, are written to paths.h5. 0: all."},
                  {.name = "keep_shards",
                   .slot = at(&Config::output, &OutputConfig::keep_shards),
                   .doc = "Keep the shards of a drive beside the merged files, so that a later --resume or merge finds "
                          "them. false: where one process has computed all frames, they go once the merged files "
                          "were read back, which halves the space on the disk; a later --resume begins anew."}}},
      material_table(),
      transmitter_table(),
      receiver_table(),
      receiver_grid_table(),
      mount_table(),
      vehicle_type_table(),
      track_table(),
      live_vehicle_table(),
  });
  return all;
}

Config prototype() {
  Config c;
  for (const Table& table : tables())
    if (table.append) table.append(c);
  return c;
}

}  // namespace wavetracer::config
