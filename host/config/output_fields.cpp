// SPDX-License-Identifier: Apache-2.0
// Rows of the field table about the files that a run writes.
// The doc of each row gives the reason for its default; the default itself is the initialiser in config.hpp.
#include "config/field_rows.hpp"

namespace wavetracer::config {

namespace {

Field paths_field() {
  return {.name = "paths",
          .slot = at(&Config::output, &OutputConfig::paths),
          .doc =
              "Write the paths to paths.h5. false: the device sums the paths of each link, and no path is read or "
              "written, which is faster and needs less memory where links are many, as in coverage maps. "
              "links.csv and summary.json are complete, and maps are made of them. Arrays with a codebook, "
              "responses and other carriers (radio.frequencies_hz) need paths."};
}

Field lifetimes_field() {
  return {
      .name = "lifetimes",
      .slot = at(&Config::output, &OutputConfig::lifetimes),
      .doc =
          "Compute for each path how far its ends and all vehicles may still move before it can end, the column "
          "lifetime_m of paths.h5: a lower bound in metres, and 0 where none is known. "
          "The host computes it, which takes time in each frame. Paths must be exact, and must be written: "
          "trace.reception = \"sphere\", trace.floor_db, trace.diffraction_floor_db and output.paths = false are refused."};
}

Field keep_shards_field() {
  return {.name = "keep_shards",
          .slot = at(&Config::output, &OutputConfig::keep_shards),
          .doc =
              "Keep the shards (part files) of a drive that is complete. "
              "false: they are removed once the merged files were compared with them, byte by byte. "
              "`merge` and interrupted runs always keep them."};
}

}  // namespace

Table output_table() {
  const auto o = [](auto member) { return at(&Config::output, member); };
  return {
      .name = "output",
      .doc = "The files that a run writes.",
      .fields = {
          {.name = "directory",
           .slot = o(&OutputConfig::directory),
           .form = Form::output_folder,
           .doc = "Folder for paths.h5, links.csv and summary.json; a relative path starts at the current folder. "
                  "`run -o` overrides it."},
          {.name = "shard_frames",
           .slot = o(&OutputConfig::shard_frames),
           .unit = "frames per file",
           .range = {1, 1e9},
           .doc = "The number of frames in each file that a drive is written to while it runs. "
                  "An interrupted run continues after the last complete file. "
                  "The first frame of each file cannot reuse sequences of earlier frames, "
                  "so fewer frames per file cost time, and more frames cost memory."},
          {.name = "waypoints",
           .slot = o(&OutputConfig::waypoints),
           .unit = "samples per transmitter",
           .range = {0, 1e9},
           .doc = "The number of rays, spread evenly over each launch, whose points are written to waypoints.h5, "
                  "from the launch to the last hit, for study and pictures. The files become large. 0 writes none."},
          {.name = "cache_entries",
           .slot = o(&OutputConfig::cache_entries),
           .doc = "Write every entry of the ray cache's table to cache_entries.h5 after each frame: where it is, "
                  "how often it answered, its age, and the cycles of its last answer and write. "
                  "For study: the whole table is read from the device. Needs cache.statistics = true."},
          paths_field(),
          lifetimes_field(),
          {.name = "min_gain_db",
           .slot = o(&OutputConfig::min_gain_db),
           .unit = "dB",
           .range = {-1000, 1000},
           .doc = "Weaker paths are left out of paths.h5. links.csv and summary.json have the number and the power of "
                  "the paths that this key and the next two leave out; all other numbers are for all paths. "
                  "Not given: no limit."},
          {.name = "dynamic_range_db",
           .slot = o(&OutputConfig::dynamic_range_db),
           .unit = "dB",
           .range = {0, 1000},
           .doc = "Paths that are weaker than the strongest path of their link and frame by more than this "
                  "are left out of paths.h5. Not given: no limit."},
          {.name = "max_paths_per_link",
           .slot = o(&OutputConfig::max_paths_per_link),
           .unit = "paths per link and frame",
           .range = {0, 4294967295.0},
           .none = "0",
           .doc = "Only this many paths, the strongest, are written to paths.h5. 0: all."},
          {.name = "compression",
           .slot = o(&OutputConfig::compression),
           .range = {0, 9},
           .doc = "Compression (deflate) of the columns of HDF5 files, 1 (fast) to 9; 0: none. Shards have none."},
          keep_shards_field()}};
}

}  // namespace wavetracer::config
