// SPDX-License-Identifier: Apache-2.0
// Tests the ends that launch, and moving objects: listeners, ends in both roles and masked links; edges of vehicles as
// instances and as static meshes; drives that reuse sequences; and launches, orders, batches and caches, which must not
// change paths.
#include "simulation/bends.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

Config screens_config(const SceneFile& file, const Points& transmitters, const Points& receivers) {
  Config config = config_of(file.path(), transmitters, receivers, 300000, 3);
  config.trace = diffracting(300000, 3);
  config.trace.max_diffractions = 2;
  return config;
}

// Checks that the paths of link (tx, rx) of one run are, row by row and to the last bit, those of a link of another
// run.
void check_link(const Paths& a, uint32_t tx, uint32_t rx, const Paths& b, uint32_t other_tx, uint32_t other_rx) {
  const std::vector<Row> rows = rows_of(a, tx, rx);
  CHECK(rows.size() > 20);
  CHECK(rows == rows_of(b, other_tx, other_rx));
}

const Points a_b{{-9.3, 0.7, 1.9}, {9.1, -1.2, 2.3}}, c_d{{1.3, 2.1, 3.7}, {-2.7, -7.9, 1.1}};

// A car that bends around a truck; antennas stand beside the street.
const std::vector<Straight> vehicles{{"car", "passenger", {-20.3, -3.1, 0}, {9.7, 0.4, 0}, 0, 4},
                                     {"truck", "truck", {19.6, 5.1, 0.01}, {-7.9, -1.3, 0}, 0, 4}};
const Points mast{{-31.3, 2.17, 4.1}}, posts{{20.3, -5.7, 1.6}, {-6.1, 8.3, 2.2}, {7.7, 1.9, 0.9}};

Config drive(const std::filesystem::path& scene, double step_s, uint64_t rays) {
  Config config = config_of(scene, mast, posts, rays, 2);
  config.trace = diffracting(rays, 2);
  config.trace.reuse = false;
  add_vehicles(config, vehicles, step_s);
  return config;
}

double matrix_error(const Paths& a, size_t i, const Paths& b, size_t j) {
  double size = 0, error = 0;
  for (size_t port = 0; port < 4; ++port) {
    size += std::norm(a.a[i][port]);
    error += std::norm(a.a[i][port] - b.a[j][port]);
  }
  return std::sqrt(error / size);
}

}  // namespace

TEST_CASE("several transmitters and receivers: each link as if it were alone") {
  const SceneFile file(screens());
  const Paths all = run(screens_config(file, a_b, c_d)).paths;
  for (uint32_t t = 0; t < 2; ++t)
    for (uint32_t r = 0; r < 2; ++r) check_link(all, t, r, run(screens_config(file, {a_b[t]}, {c_d[r]})).paths, 0, 0);
}

TEST_CASE("masked links: no path, no rays for ends without a link, and the others unchanged") {
  const SceneFile file(screens());
  Config config = screens_config(file, a_b, c_d);
  const FrameResult all = run(config);
  CHECK(all.counts.rays == 4 * 300000);  // two transmitters, two listeners
  config.links.transmitters = {"tx1"};
  config.links.receivers = {"rx0"};
  const FrameResult one = run(config);
  CHECK(one.counts.rays == 2 * 300000);
  check_link(one.paths, 1, 0, all.paths, 1, 0);
  CHECK(one.paths.size() == rows_of(all.paths, 1, 0).size());
}

TEST_CASE("ends that send and receive launch once, and find both directions") {
  const SceneFile file(screens());
  const FrameResult twins = run(screens_config(file, a_b, a_b));
  const FrameResult one_way = run(screens_config(file, {a_b[0]}, {a_b[1]}));
  CHECK(twins.counts.rays == 2 * 300000);
  CHECK(one_way.counts.rays == 2 * 300000);
  check_link(twins.paths, 0, 1, one_way.paths, 0, 0);
  const auto found = by_key(twins.paths);
  size_t back = 0;
  for (const auto& [key, points] : found) {
    auto [tx, rx, kinds, numbers] = key;
    std::ranges::reverse(kinds);
    std::ranges::reverse(numbers);
    const auto other = found.find({rx, tx, kinds, numbers});
    REQUIRE(other != found.end());
    for (size_t k = 0; k < points.size(); ++k)
      CHECK(glm::distance(points[k], other->second[points.size() - 1 - k]) < 1e-9);
    back += tx > rx;
  }
  CHECK(2 * back == static_cast<size_t>(std::ranges::count_if(found, [](const auto& entry) {
          return std::get<0>(entry.first) != std::get<1>(entry.first);
        })));
}

TEST_CASE("edges of vehicles diffract as those of the same bodies in the scene, wherever they have moved and turned") {
  const SceneFile file(street());
  Simulation moving(drive(file.path(), 1, 1000000));
  size_t by_edges = 0;
  for (const uint32_t frame : {1u, 2u, 3u}) {
    CAPTURE(frame);
    const Paths paths = moving.run_frame(frame).paths;
    std::vector<Mesh> meshes;
    for (const Part& part : street()) meshes.push_back(mesh_of(part));
    for (const Straight& vehicle : vehicles) meshes.push_back(mesh_of(vehicle, frame));
    const MeshFile baked(meshes);
    Config config = config_of(baked.path(), mast, posts, 1000000, 2);
    config.trace = diffracting(1000000, 2);
    const Paths still = run(config).paths;
    CHECK(paths.size() == still.size());
    CHECK(missing(still, paths) == 0);
    const std::vector<uint32_t> other = counterparts(paths, still);
    double apart_m = 0, error = 0, delay_error = 0;
    for (size_t i = 0; i < paths.size(); ++i) {
      CAPTURE(i);
      REQUIRE(other[i] != no_row);
      const size_t j = other[i], first = paths.vertex_offset[i], its = still.vertex_offset[j];
      for (size_t k = 0; k < paths.depth[i]; ++k) {
        CHECK(paths.vertex_interaction[first + k] == still.vertex_interaction[its + k]);
        apart_m =
            std::max(apart_m, glm::distance(paths.vertex_position_m[first + k], still.vertex_position_m[its + k]));
        by_edges +=
            paths.vertex_interaction[first + k] == diffraction && paths.vertex_instance[first + k] != no_instance;
      }
      error = std::max(error, matrix_error(paths, i, still, j));
      delay_error = std::max(delay_error, std::abs(paths.delay_s[i] / still.delay_s[j] - 1));
    }
    CHECK(apart_m < 1e-9);
    CHECK(error < 1e-9);
    CHECK(delay_error < 1e-12);
  }
  CHECK(by_edges > 100);
}

TEST_CASE("the edges of an antenna's own vehicle do not diffract next to it; those of others do, and its own later") {
  const SceneFile file(street());
  Config config = drive(file.path(), 1, 300000);
  config.mounts = {{.name = "roof", .on = "passenger", .role = "both", .offset_m = {-0.4, 0.2, 1.7}}};
  Simulation moving(config);
  const uint32_t car = moving.instances()[0].id == "car" ? 0 : 1;
  size_t own_later = 0, others = 0;
  for (const uint32_t frame : {0u, 1u, 2u, 3u}) {
    const FrameResult result = moving.run_frame(frame);
    const Paths& paths = result.paths;
    for (size_t i = 0; i < paths.size(); ++i) {
      const bool sent = result.world.transmitters[paths.tx[i]].instance == car;
      const bool received = result.world.receivers[paths.rx[i]].instance == car;
      for (uint64_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k) {
        if (paths.vertex_interaction[k] != diffraction || paths.vertex_instance[k] == no_instance) continue;
        const bool own = paths.vertex_instance[k] == car && (sent || received);
        const bool next = (sent && k == paths.vertex_offset[i]) || (received && k + 1 == paths.vertex_offset[i + 1]);
        CHECK_FALSE((own && next));
        own_later += own;
        others += !own && (sent || received);
      }
    }
  }
  CHECK(own_later > 0);
  CHECK(others > 5);
}

TEST_CASE("a drive that reuses sequences finds frame by frame what cold frames find") {
  const SceneFile file(street());
  Config config = drive(file.path(), 0.125, 200000);
  Simulation cold(config);
  config.trace.reuse = true;
  Simulation reusing(config);
  size_t all = 0, lost = 0;
  for (uint32_t frame = 0; frame < 16; ++frame) {
    const FrameResult found = reusing.run_frame(frame);
    if (frame % 5 != 4) continue;
    CAPTURE(frame);
    const FrameResult complete = cold.run_frame(frame);
    CHECK(found.counts.rays * 5 < complete.counts.rays);
    CHECK(missing(found.paths, complete.paths) <=
          complete.paths.size() / 100);  // reuse keeps sequences that rays of all frames found
    lost += missing(complete.paths, found.paths);
    all += complete.paths.size();
  }
  CHECK(all > 300);
  CHECK(static_cast<double>(lost) <= 0.01 * static_cast<double>(all));
}

TEST_CASE("batches, orders and exact caches: the same bytes") {
  const SceneFile file(street());
  Config config = drive(file.path(), 1, 300000);
  config.trace.max_diffractions = 2;
  const auto paths_of = [](const Config& c) { return Simulation(c).run_frame(2).paths; };
  const Paths plain = paths_of(config);
  CHECK(std::ranges::count(plain.vertex_interaction, diffraction) > 100);
  for (const uint64_t batch : {uint64_t{7000}, uint64_t{100000}}) {
    CAPTURE(batch);
    Config other = config;
    other.trace.batch_rays = batch;
    CHECK(identical(paths_of(other), plain));
  }
  for (const OrderMethod method : std::to_array<OrderMethod>({"Z", "H3DH2DH", "direction-origin"})) {
    CAPTURE(method);
    Config other = config;
    other.order = {.method = method, .each_depth = true};
    CHECK(identical(paths_of(other), plain));
  }
  for (const CacheKind kind : std::to_array<CacheKind>({"chained", "open", "concurrent"})) {
    CAPTURE(kind);
    Config other = config;
    other.cache.kind = kind;
    other.cache.key = "exact";
    CHECK(identical(paths_of(other), plain));
  }
}

TEST_CASE("refined launches find no path that a large launch does not, and nearly all of those") {
  const SceneFile file(street());
  Config config = drive(file.path(), 1, 4000000);
  config.trace.max_diffractions = 2;
  const Paths all = Simulation(config).run_frame(2).paths;
  config.trace.rays = {};
  config.trace.recall = 0.999;
  const Paths refined = Simulation(config).run_frame(2).paths;
  CAPTURE(all.size());
  CHECK(missing(refined, all) == 0);
  // Recall counts sequences; a face of a car seen edge on is one sequence, and many paths over its edges.
  CHECK(missing(all, refined) < all.size() / 20);
}
