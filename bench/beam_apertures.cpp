// SPDX-License-Identifier: Apache-2.0
// beam_apertures prints the facets of a generated city and the apertures of an antenna's beams in it, as JSON on
// standard output, for bench/figures/beam_tree.py. Coordinates are those of the city, in metres.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "passes/beam_gather.hpp"
#include "passes/beam_visible.hpp"
#include "passes/sequences.hpp"
#include "scene/load.hpp"
#include "simulation/beam_tracing.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

constexpr uint32_t most_apertures = 1 << 16, most_chunks = 1 << 17;

using Json = nlohmann::json;

struct Options {
  std::string device, city = "--seed 12 --blocks 4x4 --block-m 60 --street-m 14 --floors 4:6";
  std::vector<double> at_m{26, 2, 5};
  uint32_t depth = 2;
};

Json point(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

Json corners_of(const wt_aperture& aperture, const glm::dvec3& origin_m) {
  Json out = Json::array();
  for (uint32_t i = 0; i < aperture.count; ++i) {
    const double* const c = aperture.corners + 3 * i;
    out.push_back(point(glm::dvec3(c[0], c[1], c[2]) + origin_m));
  }
  return out;
}

Json facet_rows(const Facets& facets, const Scene& scene) {
  Json out = Json::array();
  for (const wt_facet& facet : facets.facets) {
    Json corners = Json::array();
    for (uint32_t i = 0; i < facet.count; ++i)
      corners.push_back(point(facets.corners[facet.first_corner + i] + scene.origin_m));
    out.push_back({{"surface", facet.surface},
                   {"normal", {facet.normal[0], facet.normal[1], facet.normal[2]}},
                   {"corners_m", std::move(corners)}});
  }
  return out;
}

Json run(const Options& options) {
  gpu::Context context(options.device);
  Config config;
  config.scene.generate = options.city;
  const Scene scene = load_scene(config);
  const DeviceScene device = make_device_scene(context, scene, false);
  const Facets facets = WorldFacets(scene, {}).fixed();
  const BeamTree tree = make_beam_tree(context, facets);
  const Launcher end{.transmitter = 0,
                     .position_m = glm::dvec3(options.at_m[0], options.at_m[1], options.at_m[2]) - scene.origin_m};

  BeamLists lists(context);
  lists.apertures = context.buffer<wt_aperture>(most_apertures, "apertures");
  lists.next = context.buffer<wt_aperture>(most_apertures, "apertures");
  const std::vector<wt_aperture> roots = beam_roots({&end, 1});
  lists.apertures.write(roots, 0, Stage::beam_gather);
  Sequences set(context, 1 << 18);
  set.clear();
  BeamGather gather(context, tree.depth);
  BeamVisible visible(context);
  const BeamMirrors mirrors = make_beam_mirrors(context, {.mirrors = lossless_mirrors(scene.surfaces.size())});
  Json rows = Json::array();
  auto count = static_cast<uint32_t>(roots.size());
  for (uint32_t depth = 1; depth <= options.depth && count > 0; ++depth) {
    lists.counters.write(std::vector<wt_beam_counters>(1), 0, Stage::beam_gather);
    const BeamStep step{.depth = depth, .max_depth = options.depth + 1};
    const uint32_t chunks = gather(tree, device, lists, 0, count, step, most_chunks);
    if (chunks > most_chunks) throw RuntimeError("too many candidates for a figure");
    visible(tree, device, mirrors, lists, 0, chunks, step, set.trie());
    count = lists.counters.read_one(0, Stage::beam_visible).apertures;
    if (count > most_apertures) throw RuntimeError("too many apertures for a figure");
    std::vector<wt_aperture> found = lists.next.read();
    found.resize(count);
    for (const wt_aperture& one : found)
      rows.push_back({{"depth", depth},
                      {"surface", one.surface},
                      {"image_m", point(glm::dvec3(one.image[0], one.image[1], one.image[2]) + scene.origin_m)},
                      {"corners_m", corners_of(one, scene.origin_m)}});
    std::swap(lists.apertures, lists.next);
  }
  return {{"device", context.info().name},
          {"antenna_m", options.at_m},
          {"facets", facet_rows(facets, scene)},
          {"apertures", std::move(rows)}};
}

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app("Prints the facets of a generated city, and the apertures of an antenna's beams in it, as JSON");
  bench::Options options;
  app.add_option("--device", options.device, "as for wavetracer run");
  app.add_option("--city", options.city, "options of `wavetracer scene city`");
  app.add_option("--at", options.at_m, "place of the antenna, m")->expected(3);
  app.add_option("--depth", options.depth, "the last depth whose apertures are printed")->check(CLI::Range(1, 5));
  CLI11_PARSE(app, argc, argv);
  try {
    std::puts(bench::run(options).dump().c_str());
  } catch (const Error& error) {
    fmt::print(stderr, "beam_apertures: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
