// SPDX-License-Identifier: Apache-2.0
// Rows of the field table about the search for paths.
// The doc of each row gives the reason for its default; the default itself is the initialiser in config.hpp.
#include "config/field_rows.hpp"

namespace wavetracer::config {

Table trace_table() {
  const auto t = [](auto member) { return at(&Config::trace, member); };
  return {
      .name = "trace",
      .doc =
          "The search of rays for the surfaces that paths may touch. A key that asks for paths or leaves some out is "
          "refused where another key has switched its kind of path off, as trace.scattering_floor_db without "
          "trace.scattering_reflections; other keys without effect are warnings of the run.",
      .fields = {
          {.name = "discovery",
           .slot = t(&TraceConfig::discovery),
           .doc =
               "The way that the sequences of surfaces are found. rays: many rays sample them, which misses some. "
               "beams: what each end sees is followed as a whole, mirror by mirror; this misses nothing but what "
               "lies in beams that are too thin to follow, and the run tells their solid angle. Beams use none of "
               "the keys about rays, such as trace.rays; with trace.reuse, frames keep what ends that stand see of "
               "surfaces that stand. With trace.transmission they follow waves through up to trace.max_transmissions surfaces, which takes "
               "some times as long. auto: beams for one frame of at most 4,000 surfaces in which nothing moves and no vehicle has a "
               "body, with trace.max_depth of at most 6, without transmission, scattering and targets, and where nothing needs "
               "rays; else rays. There the complete list takes a few times as long as a frame of the default number "
               "of rays. summary.json says which was taken, and why (features.beams)."},
          {.name = "rays",
           .slot = t(&TraceConfig::rays),
           .unit = "rays per transmitter",
           .range = {1, 2147483648.0},
           .none = "auto",
           .doc = "More rays find more of the weak paths; the paths that are found are exact in any case. "
                  "The default finds more than 99% of the paths of a city quarter at depth 5. "
                  "auto: as many rays as trace.recall needs, launched along a Hilbert curve."},
          {.name = "recall",
           .slot = t(&TraceConfig::recall),
           .range = {0, 1, true},
           .doc = "Only with rays = \"auto\": the share of all paths that must be found. "
                  "It is estimated from the sequences that only one ray has met (Good-Turing estimate). "
                  "The last percent costs more rays than all before it."},
          {.name = "max_rays",
           .slot = t(&TraceConfig::max_rays),
           .unit = "rays per transmitter",
           .range = {1, 2147483648.0},
           .doc = "Only with rays = \"auto\": the largest number of rays, whatever recall asks for."},
          {.name = "reuse",
           .slot = t(&TraceConfig::reuse),
           .doc = "Keep the sequences of surfaces that rays of earlier frames of a drive have found. "
                  "Their paths are computed anew in every frame, so they are exact, and fewer rays find more paths."},
          {.name = "refresh_rays",
           .slot = t(&TraceConfig::refresh_rays),
           .unit = "rays per transmitter",
           .range = {0, 2147483648.0},
           .none = "0",
           .doc = "The largest number of rays in a frame that reuses sequences of earlier frames; "
                  "each such frame launches other directions. 0: a tenth of trace.rays, "
                  "because little is new from one frame to the next. "
                  "With rays = \"auto\" the number is chosen automatically."},
          {.name = "discover_every_s",
           .slot = t(&TraceConfig::discover_every_s),
           .unit = "s",
           .range = {0, 3600},
           .doc =
               "A frame that reuses sequences launches rays only if the last frame that did so is at least this old; "
               "the frames between compute the paths of the known sequences, exactly, at their own poses. "
               "For steps of a millisecond, 0.1 is a good value. Rays are launched at once where a vehicle appears "
               "or a transmitter begins to send. 0: every frame launches rays. "
               "Each launch of rays measures which paths the frames before it may have missed: "
               "the entry late of summary.json."},
          {.name = "forget_frames",
           .slot = t(&TraceConfig::forget_frames),
           .unit = "frames",
           .range = {1, 4294967295.0},
           .doc = "A sequence of surfaces is dropped after this many frames in which no ray "
                  "and no path has followed it; only frames that launch rays are counted. "
                  "50 frames are 5 s at 10 Hz."},
          {.name = "max_depth",
           .slot = t(&TraceConfig::max_depth),
           .unit = "interactions",
           .range = {0, 64},
           .doc = "The largest number of interactions of one path. 0 computes the line of sight only. "
                  "Beyond 5, a path in a street canyon carries little power."},
          {.name = "floor_db",
           .slot = t(&TraceConfig::floor_db),
           .unit = "dB",
           .range = {-400, 0},
           .doc = "Only with discovery = \"beams\", and without diffraction and scattering: the path gain between "
                  "isotropic antennas, without their own gains, below which a path need not be found. Beams whose "
                  "paths are all weaker are not followed, so a large max_depth costs little: with max_depth = 64 the "
                  "list has every path above this gain, whatever its number of reflections. The run tells the power "
                  "of the beams that were not followed. Weaker paths that are found are kept."},
          {.name = "reflection", .slot = t(&TraceConfig::reflection), .doc = "Specular reflection."},
          {.name = "diffraction",
           .slot = t(&TraceConfig::diffraction),
           .doc = "Diffraction at edges, by the uniform theory of diffraction (UTD). It fills the shadows. "
                  "It also launches rays from every receiver that is not a transmitter too, which costs time."},
          {.name = "max_diffractions",
           .slot = t(&TraceConfig::max_diffractions),
           .unit = "diffractions per path",
           .range = {1, 8},
           .doc = "2 adds paths over two edges, with a straight line from one edge to the other: "
                  "the field behind a whole building. Pairs of edges that buildings hide from each other "
                  "are left out; trying the others takes time: in a city of 36 blocks some ten times "
                  "as long as one diffraction. With 2 and more each link also gets a few paths over up to "
                  "so many edges: those that a string between its ends touches when it is pulled tight over "
                  "the roofs or around corners, and those a little under it. They take little time, "
                  "and reach receivers far behind the houses. Such a path has no other interactions, and max_depth, "
                  "which must be at least 2, does not limit its edges."},
          {.name = "diffraction_floor_db",
           .slot = t(&TraceConfig::diffraction_floor_db),
           .unit = "dB",
           .range = {-400, 0},
           .doc = "Only with diffraction: the path gain between isotropic antennas of one polarization each, without "
                  "their own gains, below which a path over one edge or two may be left out. The program compares an "
                  "upper bound of the gain with this value. The bound assumes perfect reflections, so no stronger path "
                  "is lost, and weaker ones may be kept. Paths over three edges and more, along a roof or a wall, and "
                  "over ends of edges are always kept. Many weak paths together have power, too: choose a floor 20 dB "
                  "below the weakest link that matters. Not given: none is left out."},
          {.name = "diffraction_range_db",
           .slot = t(&TraceConfig::diffraction_range_db),
           .unit = "dB",
           .range = {30, 400},
           .none = "auto",
           .doc = "Only with diffraction: a path over one edge or two may be left out if it is surely weaker by this "
                  "than the strongest path of its link that has no edge. The program compares an upper bound of its "
                  "gain, with the largest gains of both antennas, with the gain of that path, and it says how much the "
                  "paths that it has left out can have together. Links that have paths over edges alone keep all, and "
                  "paths that diffraction_floor_db always keeps are kept here too. 400 leaves out none. auto: 45 with "
                  "output.paths = false, where only sums are written; else none is left out."},
          {.name = "free_edges",
           .slot = t(&TraceConfig::free_edges),
           .doc = "Edges that belong to one face only also diffract, as half planes: screens, "
                  "signs and the borders of open meshes. The border of the ground never diffracts, "
                  "because the real ground continues where the map ends."},
          {.name = "edge_ends",
           .slot = t(&TraceConfig::edge_ends),
           .doc =
               "Only with diffraction, for paths over one edge of the scene. Where an edge ends in the open, as at the "
               "corner of a roof or of a screen, false: its wave stops at the end, and the field has a step there; "
               "true: its wave is that of an edge with an end, and fades beyond it. This adds paths by way of ends, "
               "a few percent in a city."},
          {.name = "diffraction_rays",
           .slot = t(&TraceConfig::diffraction_rays),
           .unit = "rays per receiver",
           .range = {0, 2147483648.0},
           .none = "0",
           .doc =
               "Only with diffraction, scattering_reflections or target_reflections: the largest number of rays from a "
               "receiver that is not a transmitter too. 0: a tenth of trace.rays, but at least 100,000, because many rays meet "
               "each edge."},
          {.name = "edge_rays",
           .slot = t(&TraceConfig::edge_rays),
           .unit = "rays per edge",
           .range = {0, 65536},
           .none = "auto",
           .doc = "Only with diffraction, where nothing moves: the number of rays that start at each edge that a "
                  "transmitter sees, for each way on which it sees it. They go where the edge sends the wave, and "
                  "receivers try what passes near them, so receivers launch no rays. That is faster and finds more "
                  "where there are many receivers, as in coverage maps. 0: receivers launch diffraction_rays each. "
                  "auto: 3000 where nothing moves, no vehicle has a body, no frame reuses another, more than 1000 "
                  "receivers do not transmit, diffraction_rays is not "
                  "given, and nothing is asked for that rays from edges cannot find; else 0."},
          {.name = "transmission",
           .slot = t(&TraceConfig::transmission),
           .doc = "Transmission straight through surfaces. Each surface is a slab whose thickness is "
                  "that of its material. Rays split at every surface, so each transmission "
                  "that is allowed may double the time of tracing."},
          {.name = "max_transmissions",
           .slot = t(&TraceConfig::max_transmissions),
           .unit = "transmissions per path",
           .range = {1, 64},
           .doc = "The largest number of transmissions of one path. Each also counts as an interaction for max_depth. "
                  "A path through one building or vehicle needs 2."},
          {.name = "scattering",
           .slot = t(&TraceConfig::scattering),
           .doc = "Diffuse scattering by surfaces and vegetation whose material has a scattering coefficient "
                  "(material.scattering). They are divided into tiles and cells, and a path goes from the transmitter "
                  "to one of them to the receiver, with reflections on the way by scattering_reflections."},
          {.name = "tile_m",
           .slot = t(&TraceConfig::tile_m),
           .unit = "m",
           .range = {0, 1e6, true},
           .doc = "The largest side length of a tile of scattering. Half the length gives four times as many paths "
                  "and about a quarter of the error; of vegetation, which is cut into cells, eight times as many."},
          {.name = "scattering_reflections",
           .slot = t(&TraceConfig::scattering_reflections),
           .unit = "reflections",
           .range = {0, 63},
           .doc =
               "Only with scattering: the largest number of reflections of a path before its tile, and of those "
               "after it. 0: paths scatter straight from the transmitter to a tile to the receiver. All interactions "
               "together are at most max_depth. It launches rays from every receiver that is not a transmitter "
               "too, and makes many paths: where they are too many, give scattering_floor_db. Vegetation scatters "
               "without reflections in any case."},
          {.name = "scattering_diffraction",
           .slot = t(&TraceConfig::scattering_diffraction),
           .doc =
               "Only with diffraction and scattering_reflections: one of the interactions before a tile, or one of those "
               "after it, may be a diffraction at an edge, from which the path goes straight to the tile, or on which it "
               "comes straight from it. Corners do not diffract there. Each edge that an end sees is tried with each "
               "tile that the other end sees, so large scenes need scattering_floor_db."},
          {.name = "scattering_floor_db",
           .slot = t(&TraceConfig::scattering_floor_db),
           .unit = "dB",
           .range = {-400, 0},
           .doc =
               "Only with scattering_reflections: the path gain between isotropic antennas, without their own gains, "
               "below which a path that scatters and is reflected or diffracted may be left out. The program compares "
               "an upper bound of the gain with this value. The bound assumes perfect reflections and the best "
               "orientation of the tile, so no stronger path is lost, and weaker ones may be kept. Ways to tiles from "
               "which even the shortest way on is too weak are not looked for. The entry weak of summary.json is the "
               "number of paths that are left out after both of their ways were found. Not given: none is left out."},
          {.name = "target",
           .slot = t(&TraceConfig::target),
           .doc = "Paths that go by targets, where there are any: see [[target_model]]."},
          {.name = "target_reflections",
           .slot = t(&TraceConfig::target_reflections),
           .unit = "reflections",
           .range = {0, 63},
           .doc =
               "Only with targets: the largest number of reflections of a path before its target, and of those "
               "after it. 0: paths go straight from the transmitter to the target to the receiver. All interactions "
               "together are at most max_depth. It launches rays from every receiver that is not a transmitter too."},
          {.name = "target_diffraction",
           .slot = t(&TraceConfig::target_diffraction),
           .doc =
               "Only with diffraction and target_reflections: one of the interactions before a target, and one of those "
               "after it, may be a diffraction at an edge, from which the path goes straight to the target, or on "
               "which it comes straight from it. Corners do not diffract there. Each edge that an end sees is tried "
               "with each point of a target."},
          {.name = "target_floor_db",
           .slot = t(&TraceConfig::target_floor_db),
           .unit = "dB",
           .range = {-400, 0},
           .doc =
               "Only with targets: the path gain between isotropic antennas, without their own gains, below which a path "
               "over a target may be left out. The program compares an upper bound with it, the radar equation with the "
               "largest cross section of the point and perfect reflections, so no stronger path is lost, and weaker ones "
               "may be kept. With many targets and target_reflections it saves most of their time. The entry weak of "
               "summary.json is the number of paths that are left out after their ways were found. Not given: none is "
               "left out."},
          {.name = "directions",
           .slot = t(&TraceConfig::directions),
           .doc = "Launch directions. horizon: dense at the slopes that paths between these ends can have, "
                  "given their heights above the ground and the size of the scene; "
                  "a quarter of the rays is spread evenly. "
                  "hilbert: evenly spread over the sphere. Both follow a Hilbert curve, "
                  "so that neighbours in memory are neighbours in space. fibonacci and random: evenly spread, "
                  "in other orders."},
          {.name = "seed",
           .slot = t(&TraceConfig::seed),
           .range = {0, 9223372036854775807.0},
           .doc = "The seed of directions = \"random\", and of the random phases of scattered paths."},
          {.name = "reception",
           .slot = t(&TraceConfig::reception),
           .doc = "exact: rays only find surfaces, and paths are computed by the image method. "
                  "sphere: a ray that passes within sphere_radius_m of a receiver is taken as a path, "
                  "as in the thesis; lengths are a little wrong, some paths are missed, and some are reported "
                  "that do not exist. Frames then reuse no sequences: each frame is traced completely."},
          {.name = "sphere_radius_m",
           .slot = t(&TraceConfig::sphere_radius_m),
           .unit = "m",
           .range = {0, 1e4, true},
           .doc = "Only with reception = \"sphere\". A larger sphere misses fewer paths and makes larger errors "
                  "in those that it finds."},
          {.name = "batch_rays",
           .slot = t(&TraceConfig::batch_rays),
           .unit = "rays",
           .range = {0, 2147483648.0},
           .none = "0",
           .doc = "The number of rays that are traced at once, which limits the device memory; "
                  "results do not depend on it. 0: chosen for the device."},
          {.name = "batch_receivers",
           .slot = t(&TraceConfig::batch_receivers),
           .unit = "receivers",
           .range = {0, 4294967295.0},
           .none = "0",
           .doc =
               "Only with diffraction, scattering_reflections or output.paths = false, in a run of one frame: the number of receivers that are computed "
               "at once. It limits the memory of coverage maps, because every receiver keeps what its rays have "
               "found; results do not depend on it. 0: 8192, and more on devices with much memory."},
      }};
}

}  // namespace wavetracer::config
