// SPDX-License-Identifier: Apache-2.0
// Checks several sets of features, so that every kernel of ordinary runs is checked once.
#include "app/check_devices.hpp"
#include <fmt/format.h>
#include <iostream>
#include <vector>
#include "gpu/gpu.hpp"
#include "simulation/device_check.hpp"
#include "simulation/device_proof.hpp"

namespace wavetracer::app {
namespace {

bool check_features(gpu::Context& context, const CheckedFeatures& features) {
  const std::vector<CheckResult> results = check_device(context, features);
  keep_proof(context, features, results);
  bool all = true;
  std::cout << "  " << features.words() << "\n";
  for (const CheckResult& result : results) {
    all &= result.passed;
    std::cout << fmt::format("    {:9}  {:6}  {} ({:.0f} ms)\n", result.name, result.passed ? "right" : "WRONG",
                             result.found, 1e3 * result.seconds)
              << std::flush;
  }
  return all;
}

// If the device is not used, the reason was printed.
bool check_one(const gpu::DeviceInfo& info, bool asked_for) {
  std::cout << fmt::format("{}: {} ({}), driver {}\n", info.index, info.name, info.platform, info.driver);
  if (const std::string lacks = gpu::lacks(info); !lacks.empty()) {
    std::cout << "  cannot be used: it lacks " << lacks << "\n";
    return !asked_for;
  }
  bool all = true;
  try {
    gpu::Context context(std::to_string(info.index));
    for (const CheckedFeatures& features : all_checked_features()) all &= check_features(context, features);
  } catch (const DeviceError& error) {
    std::cout << "  cannot be used: " << error.what() << "\n";
    return false;
  }
  std::cout << (all ? "  All that was checked is right.\n"
                    : "  This device computes wrong results with this driver, so runs refuse it.\n");
  return all;
}

}  // namespace

bool check_devices(const std::string& device_text) {
  const std::vector<gpu::DeviceInfo> devices = gpu::list_devices();
  const size_t chosen = gpu::choose_device(devices, device_text);  // throws if there is none
  bool all = true;
  for (const gpu::DeviceInfo& info : devices)
    if (device_text.empty() || info.index == chosen) all &= check_one(info, !device_text.empty());
  return all;
}

}  // namespace wavetracer::app
