// SPDX-License-Identifier: Apache-2.0
// Studies of scenes whose answers are known: the image lattice of a box, a screen with an edge. Then the program. Cases
// that need a device are skipped with a message if there is none.
#include <signal.h>

#include <filesystem>

#include "accuracy/advice.hpp"
#include "accuracy/inputs.hpp"
#include "accuracy/study.hpp"
#include "app/gate.hpp"
#include "app/program.hpp"
#include "simulation/run.hpp"
#include "wavetracer/config_file.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

const glm::dvec3 size{8, 5, 3}, tx{1.37, 2.21, 1.55}, rx{6.13, 3.42, 0.87};

std::string end(const std::string& kind, const std::string& name, const glm::dvec3& at) {
  return fmt::format("[[{}]]\nname = \"{}\"\nposition_m = [{}, {}, {}]\npolarization = \"VH\"\n", kind, name, at.x,
                     at.y, at.z);
}

std::string config_text(const SceneFile& scene, const std::string& trace, const Points& receivers) {
  std::string text =
      fmt::format("scene.file = \"{}\"\n[trace]\n{}", scene.path().string(), trace) + end("transmitter", "tx", tx);
  for (size_t i = 0; i < receivers.size(); ++i) text += end("receiver", fmt::format("rx{}", i), receivers[i]);
  return text;
}

// Makes a screen between the transmitter and the first receiver, and a wall at the side that gives both a path.
SceneFile screen() {
  return SceneFile({Quad{{4, 0, 0}, {0, 4.5, 0}, {0, 0, 4}}, Quad{{-5, 9, -2}, {20, 0, 0}, {0, 0, 8}}});
}

accuracy::Study studied(const std::string& file, study::RayRange rays) {
  const accuracy::Request request{
      .file = file, .sets = {}, .rays = rays, .device = "", .repeats = 1, .command_line = ""};
  return accuracy::study(request, {[](const std::string&) {}, [] { return false; }});
}

const accuracy::Row& row(const accuracy::Study& study, const std::string& axis, const std::string& name) {
  for (const accuracy::Row& row : study.rows)
    if (row.setting.axis == axis && row.setting.name == name) return row;
  FAIL("no row " << axis << " " << name);
  return study.rows.front();
}

// Returns number and power of the paths of a box with walls of perfect conductors, by order: only distance reduces the
// power.
std::vector<std::pair<int, double>> lattice(int orders) {
  std::vector<std::pair<int, double>> out(orders + 1, {0, 0.0});
  for (int i = -orders; i <= orders; ++i)
    for (int j = -orders; j <= orders; ++j)
      for (int k = -orders; k <= orders; ++k) {
        const int order = std::abs(i) + std::abs(j) + std::abs(k);
        if (order > orders) continue;
        const double d =
            glm::distance(glm::dvec3(image(tx.x, size.x, i), image(tx.y, size.y, j), image(tx.z, size.z, k)), rx);
        ++out[order].first;
        out[order].second += 1 / (d * d);
      }
  return out;
}

}  // namespace

TEST_CASE("a box: a million rays lose nothing, and a depth loses what its images say") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene(reference::box_walls({0, 0, 0}, size));
  const std::string file = folder.file("box.toml", config_text(scene, "max_depth = 1\nrays = 1000000\n", {rx}));
  const accuracy::Study box = studied(file, {1000000, 1000000});
  const accuracy::Row& million = row(box, "rays", "1,000,000");
  CHECK(million.own);
  CHECK(million.paths == 7);
  CHECK(million.error.lost == 0);
  CHECK(million.error.lost_power == 0);
  CHECK(million.error.power_max_db == 0);
  CHECK(row(box, "depth", "2").reference);
  const auto order = lattice(2);  // 1, 6, 18 paths
  double whole = 0, found = 0;
  int lost = 24;
  for (const auto& [paths, power] : order) whole += power;
  for (const int depth : {0, 1}) {
    found += order[depth].second;
    lost = 25 - (depth == 0 ? 1 : 7);
    const accuracy::Row& shallow = row(box, "depth", std::to_string(depth));
    CHECK(shallow.error.lost_share == doctest::Approx(lost / 25.0));
    CHECK(shallow.error.lost_power == doctest::Approx(1 - found / whole).epsilon(0.01));
  }
  // A closed room of metal needs no other feature: its edges are convex on the outside only.
  CHECK(row(box, "diffraction", "off").error.lost == 0);
  CHECK(row(box, "transmission", "on").refusal ==
        "all materials are metals or half spaces, and no wave passes through them");
  CHECK(row(box, "scattering", "on").refusal.find("no material of the scene") == 0);
}

TEST_CASE("what a mechanism adds is the difference of two runs, and a recommendation holds") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = screen();
  const std::string file =
      folder.file("screen.toml", config_text(scene, "max_depth = 2\nrays = 3000\n", {rx, {2, 4, 1}}));
  const accuracy::Study edges = studied(file, {1000, 30000});
  const auto frame = [&](const std::vector<std::string>& keys) { return run(load_config(file, keys)).paths; };
  const Paths on = frame({"trace.diffraction=true"}), off = frame({"trace.diffraction=false"});
  const accuracy::Row& without = row(edges, "diffraction", "off");
  const study::PathError error = study::path_error(on, off);
  REQUIRE(error.lost > 0);
  CHECK(without.own);
  CHECK(without.error.lost == error.lost);
  CHECK(without.error.power_median_db == error.power_median_db);
  CHECK(without.error.power_max_db == error.power_max_db);
  CHECK(without.error.power_max_db > 0.01);
  // The promise of every recommendation is checked by separate runs.
  const Paths reference = frame({"trace.rays=300000"});
  for (const double limit : accuracy::allowed_losses) {
    const accuracy::Row* best = accuracy::cheapest(edges, {"rays", "auto"}, limit);
    REQUIRE(best);
    CHECK_FALSE(best->setting.keys.empty());
    CHECK(study::path_error(reference, frame(best->setting.keys)).lost_power <= limit);
  }
}

TEST_CASE("a setting that the configuration excludes has a row that says why") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = screen();
  const std::string file = folder.file(
      "join.toml", config_text(scene, "max_depth = 1\nrays = 1000\nreception = \"sphere\"\n", {rx, {2, 4, 1}}));
  const accuracy::Study spheres = studied(file, {1000, 1000});
  CHECK(row(spheres, "auto", "recall 0.9").refusal.find("trace.rays = \"auto\" launches more rays") !=
        std::string::npos);
  CHECK(row(spheres, "diffraction", "on").refusal.find("receives reflected rays only") != std::string::npos);
  CHECK(row(spheres, "rays", "1,000").measured());
}

TEST_CASE("a floor is refused, because the lists of other settings have paths of every gain") {
  const Folder folder;
  const SceneFile scene = screen();
  const std::string file =
      folder.file("floor.toml", config_text(scene, "discovery = \"beams\"\nfloor_db = -120\nmax_depth = 64\n", {rx}));
  CHECK_THROWS_WITH_AS(studied(file, {1000, 1000}), doctest::Contains("remove trace.floor_db, and"), ConfigError);
}

TEST_CASE("the program writes table, plot and page; no link is an error; Ctrl-C ends it with 130") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = screen();
  const std::string file = folder.file("a.toml", config_text(scene, "max_depth = 1\nrays = 1000\n", {rx}));
  const std::string out = folder.path("out");
  const Outcome done = run_program({"accuracy", "-c", file, "-o", out, "--rays", "1e3:3e3", "--repeat", "1"});
  CAPTURE(done.err);
  REQUIRE(done.code == 0);
  CHECK(contains(done.out, "Rays, at most 10^-3"));
  CHECK(contains(done.out, "Diffraction (trace.diffraction=true): "));
  CHECK(contains(contents(out + "/accuracy.csv"), "\nrays,\"3,000\",false,false,"));
  CHECK(contains(contents(out + "/accuracy.csv"), "\nrays,\"1,000\",false,true,"));
  CHECK(contains(contents(out + "/accuracy.csv"), "\nrays,beams,true,false,"));
  const Outcome rays =
      run_program({"accuracy", "-c", file, "-o", out, "--rays", "1e3:1e3", "--repeat", "1", "--no-certify"});
  CHECK(rays.code == 0);
  CHECK(contains(contents(out + "/accuracy.csv"), "\nrays,\"10,000\",true,false,"));
  CHECK(contains(contents(out + "/accuracy.html"), "<h2>What to set</h2>"));
  CHECK(contains(contents(out + "/accuracy.gp"), "gnuplot accuracy.gp"));
  const Outcome no_link = run_program({"accuracy", "-c", file, "-o", out, "--set", "links.max_distance_m=1"});
  CHECK(no_link.code == 2);
  CHECK(contains(no_link.err, "has a link, so there is nothing to compare"));
  Gate gate;
  Program stopped({"accuracy", "-c", file, "-o", folder.path("cut"), "--repeat", "1000000"}, gate.at_launches());
  gate.wait_for(1);  // in the first launch of a kernel, which nothing lets go on
  CHECK(contains(stopped.messages(), "your own settings"));
  stopped.signal(SIGINT);
  const Outcome cut = stopped.wait();
  CHECK(cut.code == 130);
  CHECK(contains(cut.err, "interrupted before the first result; nothing new was written"));
  CHECK_FALSE(std::filesystem::exists(folder.path("cut")));
}

TEST_CASE("an interrupt leaves the settings that are complete") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = screen();
  const std::string file = folder.file("a.toml", config_text(scene, "max_depth = 1\nrays = 1000\n", {rx}));
  size_t said = 0;
  const accuracy::Request request{
      .file = file, .sets = {}, .rays = {1000, 10000}, .device = "", .repeats = 1, .command_line = ""};
  const accuracy::Study cut =
      accuracy::study(request, {[&](const std::string&) { ++said; }, [&] { return said == 4; }});
  REQUIRE(cut.rows.size() == 3);  // and one line before them
  CHECK(cut.planned > 10);
  CHECK(cut.rows[0].reference);
  for (const accuracy::Row& done : cut.rows) CHECK(done.error.reference_paths > 0);
  CHECK_FALSE(accuracy::recommendations(cut).empty());
}

namespace {

accuracy::InputStudy varied(const std::string& file, accuracy::InputErrors errors) {
  const accuracy::InputRequest request{
      .file = file, .sets = {}, .device = "", .frames = 1, .samples = 200, .errors = errors};
  return accuracy::study_inputs(request, {[](const std::string&) {}, [] { return false; }});
}

}  // namespace

TEST_CASE("inputs: the line of sight varies as 20 log of its length does, and only by where its ends are") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene({Quad{{-900, -900, -400}, {2, 0, 0}, {0, 2, 0}}});
  const std::string file = folder.file(
      "los.toml", fmt::format("scene.file = \"{}\"\n[trace]\nmax_depth = 0\nrays = 10\n", scene.path().string()) +
                      end("transmitter", "tx", {0, 0, 0}) + end("receiver", "rx", {100, 0, 0}));
  const accuracy::InputStudy study = varied(file, {.position_m = 1});
  REQUIRE(study.rows.size() == 1);
  const accuracy::InputRow& row = study.rows[0];
  CHECK(row.samples == 200);
  CHECK(row.gain_db.nominal == doctest::Approx(run(load_config(file)).paths.gain_db[0]));
  // Two ends with a standard deviation of 1 m along the line: 8.686 dB sqrt(2) / 100, 1.645 of it to either side.
  const double wanted = 2 * 1.6449 * 20 / std::log(10.0) * std::sqrt(2.0) / 100;
  CHECK(row.gain_db.high - row.gain_db.low == doctest::Approx(wanted).epsilon(0.12));
  CHECK(row.gain_share[0] > 0.99);
  CHECK(row.gain_share[2] < 1e-12);
  CHECK(row.gain_explained == doctest::Approx(1).epsilon(0.1));
  CHECK(row.delay_spread_ns.high == 0);
  CHECK(study.varied == std::array<bool, 4>{true, true, true, false});
}

TEST_CASE("inputs: permittivity gives the interval of runs with that permittivity; nothing varied varies nothing") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene(std::vector<Part>{{{Quad{{-50, -50, 0}, {200, 0, 0}, {0, 100, 0}}}, "stone"}});
  const auto text = [&](double permittivity) {
    return fmt::format(
               "scene.file = \"{}\"\n[trace]\nmax_depth = 1\nrays = 20000\n[[material]]\nname = \"stone\"\n"
               "permittivity = {}\nthickness_m = inf\n",
               scene.path().string(), permittivity) +
           end("transmitter", "tx", {0, 0, 4}) + end("receiver", "rx", {40, 0, 5});
  };
  const auto gain = [&](double factor) {
    const Paths paths = run(load_config(folder.file("at.toml", text(1 + 4 * factor)))).paths;
    double sum = 0;
    for (const double db : paths.gain_db) sum += std::pow(10, db / 10);
    return 10 * std::log10(sum);
  };
  const std::string file = folder.file("ground.toml", text(5));
  const accuracy::InputStudy study = varied(file, {0, 0, 0.4, 0});
  REQUIRE(study.rows.size() == 1);
  const accuracy::InputInterval& got = study.rows[0].gain_db;
  const auto [low, high] = std::minmax({gain(std::exp(-0.4 * 1.6449)), gain(std::exp(0.4 * 1.6449))});
  CHECK(got.nominal == doctest::Approx(gain(1)).epsilon(1e-9));
  CHECK(std::abs(got.low - low) < 0.03 * (high - low));
  CHECK(std::abs(got.high - high) < 0.03 * (high - low));
  CHECK(study.rows[0].gain_share[2] == 1);
  CHECK(study.frames_run == 400);
  CHECK(study.frames_with_rays < 60);
  CHECK(study.late.discoveries > 40);
  CHECK(study.late.power == 0);
  const accuracy::InputStudy still = varied(file, {0, 0, 0, 0});
  CHECK(still.rows[0].gain_db.low == still.rows[0].gain_db.nominal);
  CHECK(still.rows[0].gain_db.high == still.rows[0].gain_db.nominal);
}

TEST_CASE("the program writes intervals of a drive with vehicles, and refuses spheres") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = screen();
  const std::string file =
      folder.file("drive.toml",
                  config_text(scene, "max_depth = 2\nrays = 3000\n", {rx}) +
                      "[[track]]\nid = \"car\"\nwaypoints = [[0, 2, 6, 0], [1, 9, 6, 0]]\n[[mount]]\nname = \"roof\"\n"
                      "role = \"receiver\"\noffset_m = [0, 0, 1.6]\n");
  const std::string out = folder.path("out");
  const Outcome done = run_program({"accuracy", "--inputs", "-c", file, "-o", out, "--samples", "6", "--frames", "2"});
  CAPTURE(done.err);
  REQUIRE(done.code == 0);
  CHECK(contains(done.out, "shares        path gain: position "));
  CHECK(contains(done.out, ", vehicles "));
  const std::string csv = contents(out + "/inputs.csv");
  CHECK(contains(csv, "gain_vehicles_share,gain_explained,spread_position_share"));
  CHECK(std::ranges::count(csv, '\n') == 1 + 2 * 2);
  CHECK(contains(contents(out + "/inputs.gp"), "inputs.csv"));
  const Outcome spheres =
      run_program({"accuracy", "--inputs", "-c", file, "-o", out, "--set", "trace.reception=\"sphere\""});
  CHECK(spheres.code == 2);
  CHECK(contains(spheres.err, "keeps no sequences"));
}
