// SPDX-License-Identifier: Apache-2.0
// Context::recall knows device, driver and platform; its subject has everything else that the result depends on.
#include "simulation/device_proof.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "simulation/device_check.hpp"
#include "simulation/setup.hpp"
#include "wavetracer/version.hpp"

namespace wavetracer {
namespace {

constexpr const char* passed = "passed";

std::string subject_of(const CheckedFeatures& features) {
  const CacheConfig& cache = features.cache;
  std::string out = fmt::format("device check of wavetracer {}, kernels {}: {}", WAVETRACER_VERSION,
                                gpu::hash_of_sources(), features.words());
  if (cache.on())
    out += fmt::format(" {} {} {} {} {} {} {} {}", cache.hash_method, cache.division, cache.locking.text(),
                       cache.readers_number, cache.scope.text(), cache.hit_point.text(), cache.innerframe,
                       cache.statistics);
  return out;
}

bool all_passed(std::span<const CheckResult> results) { return std::ranges::all_of(results, &CheckResult::passed); }

}  // namespace

std::vector<CheckedFeatures> features_to_check(const Setup& setup) {
  CheckedFeatures common{
      .instances = !setup.plan->world.fleet.instances.empty(),
      .transmission = setup.plan->trace.transmission,
      .scattering = setup.plan->trace.scattering,
      .diffractions = setup.plan->trace.diffraction ? std::min(setup.plan->trace.max_diffractions, 3u) : 0,
      .reuse = setup.plan->reuse,
      .beams = setup.plan->trace.by_beams(),
      .ordered = setup.order.plan.key.has_value(),
      .sums = !setup.plan->asked.output.paths};
  if (setup.cache && !setup.cache->as_printed()) common.cache = setup.plan->asked.cache;
  std::vector<CheckedFeatures> out{common};
  const auto add = [&](CheckedWays ways) { out.push_back(CheckedFeatures::of(ways)); };
  const ExactPaths& exact = setup.exact_paths;
  if (exact.scattered) add(exact.scattered_edges ? CheckedWays::tile_edges : CheckedWays::tiles);
  if (exact.targets)
    add(exact.target_chains && exact.target_chains->takes_edges() ? CheckedWays::target_edges : CheckedWays::targets);
  if (exact.from_edges) add(CheckedWays::heard_edges);
  if (!setup.plan->scene.volumes.empty()) add(CheckedWays::vegetation);
  return out;
}

void keep_proof(gpu::Context& context, const CheckedFeatures& features, std::span<const CheckResult> results) {
  context.keep(subject_of(features), all_passed(results) ? passed : "failed");
}

void prove_device(gpu::Context& context, const CheckedFeatures& features) {
  if (context.recall(subject_of(features)) == passed) return;
  const std::vector<CheckResult> results = check_device(context, features);
  keep_proof(context, features, results);
  if (all_passed(results)) return;
  std::string failed, right;
  for (const CheckResult& result : results) {
    if (result.passed)
      right += (right.empty() ? "" : ", ") + result.name;
    else
      failed += fmt::format("\n  {}: {}", result.name, result.found);
  }
  const gpu::DeviceInfo& info = context.info();
  throw DeviceError(fmt::format(
      "{} ({}, driver {}) computes wrong results, so it is not used. These checks failed:{}\nThese passed: {}. Choose "
      "another device or another driver (`wavetracer devices --check` checks all of them), and please report this "
      "message",
      info.name, info.platform, info.driver, failed, right.empty() ? "none" : right));
}

}  // namespace wavetracer
