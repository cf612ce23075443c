// SPDX-License-Identifier: Apache-2.0
// `wavetracer devices` lists OpenCL devices and the one that a run would use and, with --check, checks what they
// compute. The list is in the order of the ICD; --device accepts its index.
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include "app/check_devices.hpp"
#include "app/commands.hpp"
#include "base/aligned_text.hpp"
#include "gpu/gpu.hpp"
#include "gpu/pocl.hpp"

namespace wavetracer::app {
namespace {

std::string gibibytes(uint64_t bytes) { return fmt::format("{:.1f} GiB", static_cast<double>(bytes) / (1 << 30)); }

struct DevicesOptions {
  std::string device;
  bool check = false;
};

void list() {
  const std::vector<gpu::DeviceInfo> devices = gpu::list_devices();
  const size_t chosen = gpu::choose_device(devices, "");
  if (const std::string note = gpu::pocl_cache_note(); !note.empty()) std::cerr << "warning: " << note << "\n";
  std::vector<std::vector<std::string>> rows = {
      {"", "index", "platform", "name", "type", "memory", "largest buffer", "units", "work-group", "fp64", "driver"}};
  for (const gpu::DeviceInfo& d : devices)
    rows.push_back({d.index == chosen ? "*" : "", fmt::format("{}", d.index), d.platform, d.name,
                    d.gpu   ? "GPU"
                    : d.cpu ? "CPU"
                            : "other",
                    gibibytes(d.global_memory), gibibytes(d.max_buffer), fmt::format("{}", d.compute_units),
                    fmt::format("{}", d.max_work_group), d.fp64 ? "yes" : "no", d.driver});
  std::cout << aligned_text(rows);
}

}  // namespace

void add_devices(CLI::App& program, Invocation& invocation) {
  CLI::App* command =
      program.add_subcommand("devices", "List the OpenCL devices; * marks the one that a run uses by default");
  const auto options = std::make_shared<DevicesOptions>();
  CLI::Option* const check =
      command->add_flag("--check", options->check,
                        "Check the computations of each device, even if it was checked before, and report errors");
  command
      ->add_option("--device", options->device,
                   "Check only this one: its index, or a part of its name or of its platform's name")
      ->needs(check);
  command->callback([options, &invocation] {
    if (!options->check) return list();
    if (!check_devices(options->device)) invocation.code = ExitCode::device;
  });
}

}  // namespace wavetracer::app
