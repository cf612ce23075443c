// SPDX-License-Identifier: Apache-2.0
// Tests that a device whose kernels are broken is refused and that the check of the broken kernel fails; a device that
// has passed is not checked again until its driver, kernels or features change.
#include "simulation/device_proof.hpp"

#include <algorithm>

#include "simulation/device_check.hpp"
#include "simulation/kernels_copy.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/simulation.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// The checks that fail: the first one, and all of them one after the other.
struct FailedChecks {
  std::string first, all;
};

FailedChecks failed_checks(const CheckedFeatures& features = {}) {
  const CopyInUse in_use;
  gpu::Context context;
  FailedChecks out;
  for (const CheckResult& result : check_device(context, features)) {
    if (result.passed) continue;
    if (out.first.empty()) out.first = result.name;
    out.all += result.name + ": " + result.found + "\n";
  }
  return out;
}

// Returns all failed checks; the first of them must be `check`.
std::string fails_first(const std::string& check, const CheckedFeatures& features = {}) {
  const FailedChecks failed = failed_checks(features);
  CAPTURE(failed.all);
  CHECK(failed.first == check);
  return failed.all;
}

// Tells whether proving the device has made it compute anything.
bool proof_computes(const CheckedFeatures& features = {}) {
  gpu::Context context;
  prove_device(context, features);
  return context.build_seconds() > 0;
}

CheckedFeatures with_cache() {
  CheckedFeatures out;
  out.cache.kind = "concurrent";
  return out;
}

// The files in which results of checks are kept.
std::vector<std::filesystem::path> kept_proofs(const CopyInUse& in_use) {
  std::vector<std::filesystem::path> out;
  for (const auto& entry : std::filesystem::directory_iterator(in_use.programs()))
    if (read_file(entry.path()).ends_with("passed")) out.push_back(entry.path());
  return out;
}

// A wrong thickness of walls. CPUs compute most paths in lanes.
struct BrokenSlab {
  BrokenLine shared{"include/wavetracer/device/slab.h", "const double kd = 2.0 * WT_PI",
                    "const double kd = 2.001 * WT_PI"};
  BrokenLine lanes{"kernels/lib/slab8.clh", "out.kd = 2.0 * WT_PI", "out.kd = 2.001 * WT_PI"};
};

}  // namespace

TEST_CASE("kernels that are not broken pass") {
  CHECK(failed_checks().all == "");
  CHECK(failed_checks(with_cache()).all == "");
}

TEST_CASE("a traversal that passes over triangles behind others fails the check of traversal") {
  gpu::Context context;
  const bool cpu = context.info().cpu;
  const BrokenLine broken = cpu ? BrokenLine("kernels/lib/packet16.clh", "(t < p->t)", "(t > p->t)")
                                : BrokenLine("kernels/lib/hit.clh", "(t < best.t ||", "(t > best.t ||");
  fails_first("traversal");
}

TEST_CASE("a sort with a wrong comparison fails the check of sorts") {
  const BrokenLine vectors("kernels/primitives/bitonic_sort.cl", "stride < n; stride *= 2",
                           "stride < n / 4; stride *= 2");
  const BrokenLine groups("kernels/primitives/bitonic_sort.cl", "stride = 16; stride < n;",
                          "stride = 16; stride < n / 4;");
  fails_first("sorts");
}

TEST_CASE("a field function that differs from the host's fails the check of fields, and no other") {
  const BrokenSlab broken;
  CHECK(!contains(fails_first("fields"), "paths:"));
}

TEST_CASE("two sequences where one should be, as without atomics, fail the check of sequences") {
  const BrokenLine broken("kernels/lib/trie.clh", "uint slot = wt_trie_hash(key) & mask;",
                          "uint slot = (wt_trie_hash(key) + (uint)(get_global_id(0) & 1)) & mask;");
  fails_first("sequences");
}

TEST_CASE("a ray cache that finds no key fails its check, and no other") {
  const BrokenLine broken("kernels/lib/cache_entry.clh",
                          "return e->cells == q.cells && e->left == q.left && as_uint(e->origin[0])",
                          "return e->cells != q.cells && e->left == q.left && as_uint(e->origin[0])");
  fails_first("ray cache", with_cache());
}

TEST_CASE("beams that lose small pieces fail the check of paths, and no other") {
  const CheckedFeatures beams{.instances = true, .beams = true};
  CHECK(failed_checks(beams).all == "");
  const BrokenLine broken("kernels/discovery/beam_visible.cl", "counts.count = sr > WT_LEAST_SR;",
                          "counts.count = sr > 0.01;");
  fails_first("paths", beams);
}

TEST_CASE("ways beside tiles and within bodies that a kernel loses fail the check of paths") {
  const CheckedFeatures tiles = CheckedFeatures::of(CheckedWays::tile_edges);
  const CheckedFeatures bodies = CheckedFeatures::of(CheckedWays::targets);
  CHECK(failed_checks(tiles).all == "");
  CHECK(failed_checks(bodies).all == "");
  {
    const BrokenLine broken("kernels/edges/tile_edges.cl", "points[j].depth <= args->max_depth",
                            "points[j].depth < args->max_depth");
    fails_first("paths", tiles);
  }
  const BrokenLine broken("kernels/paths/target_bounces.cl",
                          "return wt_seen_side(point, surfaces, way->points[bounce->count - 1]);", "return 0;");
  fails_first("paths", bodies);
}

TEST_CASE("sums of links that count wrong fail their check, and no other") {
  const CheckedFeatures sums{.sums = true};
  CHECK(failed_checks(sums).all == "");
  const BrokenLine broken("kernels/fields/link_sums.cl", "sum->mean_delay_s += power * row->delay_s;",
                          "sum->mean_delay_s += power * row->delay_s * 1.001;");
  CHECK(!contains(fails_first("links", sums), "paths:"));
}

TEST_CASE("a simulation on a broken device is refused, every time") {
  const BrokenSlab broken;
  const CopyInUse in_use;
  Config config;
  config.scene.generate = "--blocks 2x2";
  config.transmitters = {{.name = "tx", .position_m = {0, 0, 5}}};
  config.receivers = {{.name = "rx", .position_m = {20, 1, 2}}};
  for (int start = 0; start < 2; ++start) {
    const std::string message = message_of<DeviceError>([&] { Simulation simulation(config); });
    CAPTURE(message);
    CHECK(contains(message, "computes wrong results"));
    CHECK(contains(message, "\n  fields: of "));
    CHECK(contains(message, "These passed: sorts, sums, traversal, sequences, paths."));
    CHECK(contains(message, "wavetracer devices --check"));
  }
}

TEST_CASE("what has passed is not checked again, until kernels or features are others") {
  const CopyInUse in_use;
  CHECK(proof_computes());
  CHECK(!proof_computes());
  CHECK(proof_computes({.transmission = true}));
  CHECK(!proof_computes({.transmission = true}));
  const BrokenLine changed("kernels/paths/crowns.cl", "// ", "//  ");
  CHECK(proof_computes());
  CHECK(!proof_computes());
}

TEST_CASE("what another driver has passed counts for nothing") {
  const CopyInUse in_use;
  gpu::Context context;
  CHECK(proof_computes());
  const auto kept = kept_proofs(in_use);
  REQUIRE(kept.size() == 1);
  std::string text = read_file(kept[0]);
  const std::string& driver = context.info().driver;
  const size_t at = text.rfind(driver);
  REQUIRE(at != std::string::npos);
  write_file(kept[0], text.replace(at, driver.size(), std::string(driver.size(), '9')));
  CHECK(proof_computes());
  CHECK(!proof_computes());
}

TEST_CASE("where nothing can be kept, every start checks") {
  const CopyInUse in_use;
  const Environment no_cache("WAVETRACER_NO_CACHE", "1");
  CHECK(proof_computes());
  CHECK(proof_computes());
}
