// SPDX-License-Identifier: Apache-2.0
// bench_hard prints the measurements of the hard suite (tests/hard), each with its tolerance.
// It exits with 1 if a case fails, so that a table is never made of wrong figures unnoticed.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "gpu/gpu.hpp"
#include "hard/cases.hpp"
#include "json_line.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

// Returns whether all cases pass.
bool run(const std::string& device, const std::string& command) {
  const std::vector<gpu::DeviceInfo> devices = gpu::list_devices();
  const std::string name = devices[gpu::choose_device(devices, device)].name;
  bool all = true;
  for (const test::HardTopic& topic : test::hard_topics) {
    for (const test::HardCase& c : topic.run(device)) {
      Result result{"hard", c.name, name, c.measured, c.unit, Better::lower, "at most", c.tolerance, 0, c.expectation};
      result.extra["topic"] = topic.name;
      result.extra["tolerance"] = c.tolerance;
      result.extra["holds"] = c.holds();
      print(result, command);
      if (!c.holds()) fmt::print(stderr, "bench_hard: {} does not hold: {}\n", c.name, c.expectation);
      all = all && c.holds();
    }
  }
  return all;
}

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app("Figures of the hard cases: geometry and numbers at their limits");
  std::string device;
  app.add_option("--device", device, "as for wavetracer run");
  CLI11_PARSE(app, argc, argv);
  try {
    return bench::run(device, bench::command_line(argc, argv)) ? 0 : 1;
  } catch (const Error& error) {
    fmt::print(stderr, "bench_hard: {}\n", error.what());
    return static_cast<int>(error.code());
  }
}
