// SPDX-License-Identifier: Apache-2.0
// The bound of a row is the largest of the times that its parts need alone.
#include "kernel_rows.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace wavetracer::bench {
namespace {

std::string work_text(const KernelWork& work) {
  std::string text = fmt::format("{:.4g} B", work.bytes);
  if (work.gathers > 0) text += fmt::format(", {:.3g} random places of {} B", work.gathers, work.slots ? 64 : 8);
  return text + fmt::format(" and {:.4g} operations{} each", work.operations, work.in_double ? " in double" : "");
}

}  // namespace

KernelRows::KernelRows(gpu::DeviceInfo info, const DeviceLimits& limits, std::set<std::string, std::less<>> wanted,
                       size_t runs, std::string command)
    : info_(std::move(info)), limits_(limits), wanted_(std::move(wanted)), runs_(runs), command_(std::move(command)) {}

void KernelRows::print(const MeasuredKernel& m) {
  const KernelWork& work = m.work;
  const std::array<std::pair<double, const char*>, 4> bounds{
      {{m.elements * work.bytes / limits_.bytes_s, "its bytes"},
       {m.elements * work.gathers / (work.slots ? limits_.slots_s : limits_.words_s), "its random accesses"},
       {m.elements * work.operations / (work.in_double ? limits_.doubles_s : limits_.singles_s), "its operations"},
       {m.launches * limits_.launch_s, "its launches"}}};
  const auto& [bound_s, what] = *std::ranges::max_element(bounds);
  Result result;
  result.bench = "kernels";
  result.name = fmt::format("{}, {}", m.kernel, m.variant);
  result.device = info_.name;
  result.value = m.seconds * 1e3;
  result.unit = "ms";
  result.better = Better::lower;
  result.baseline = what;
  result.baseline_value = bound_s * 1e3;
  result.error = m.wrong;
  result.exact = true;
  result.detail = fmt::format("{:.3g} times the bound; {:.4g} {} in {:.0f} launches; {}; {:.4g} M elements/s{}",
                              m.seconds / bound_s, m.elements, m.element, m.launches, work_text(work),
                              m.elements / m.seconds * 1e-6, m.remark.empty() ? "" : "; " + m.remark);
  result.extra = {{"kernel", m.kernel},
                  {"device_kind", info_.cpu ? "cpu" : "gpu"},
                  {"time_over_bound", m.seconds / bound_s},
                  {"elements", m.elements},
                  {"launches", m.launches},
                  {"element_bytes", work.bytes},
                  {"bytes_s", bounds[0].first},
                  {"gathers_s", bounds[1].first},
                  {"operations_s", bounds[2].first},
                  {"launches_s", bounds[3].first},
                  {"samples", m.samples}};
  bench::print(result, command_);
  printed_.insert(m.kernel);
}

void KernelRows::measure(gpu::Context& context, const KernelCase& c) {
  if (std::ranges::none_of(c.kernels, [&](const auto& share) { return wants(share.first); })) return;
  std::map<std::string, std::vector<double>> seconds;
  std::map<std::string, uint64_t> launches;
  size_t wrong = 0;
  for (size_t run = 0; run <= runs_; ++run) {
    c.prepare();
    context.finish();
    context.reset_profile();
    c.run();
    context.profile();
    for (const auto& [kernel, time] : context.kernel_times()) {
      if (run > 0) seconds[kernel].push_back(time.seconds);
      launches[kernel] = time.launches;
    }
    if (run == 0) wrong = c.wrong();
  }
  for (const auto& [kernel, share] : c.kernels) {
    if (!wants(kernel) || !seconds.contains(kernel)) continue;
    print({.kernel = kernel,
           .variant = c.variant,
           .element = share.element,
           .elements = share.elements,
           .seconds = median(seconds.at(kernel)),
           .launches = static_cast<double>(launches.at(kernel)),
           .work = share.work,
           .samples = runs_,
           .wrong = static_cast<double>(wrong),
           .remark = c.remark});
  }
}

void KernelRows::print_coverage(std::span<const std::string> kernels) {
  std::string without;
  for (const std::string& kernel : kernels)
    if (!has(kernel)) without += (without.empty() ? "" : ", ") + kernel;
  if (!without.empty()) fmt::print(stderr, "bench_kernels: no row for {}\n", without);
  Result result;
  result.bench = "kernels";
  result.name = "kernels with a row";
  result.device = info_.name;
  result.value = static_cast<double>(printed_.size());
  result.unit = "kernels";
  result.detail = fmt::format(
      "copy {:.4g} GB/s, {:.4g} and {:.4g} G/s random places of 64 and 8 B, {:.4g} G operations/s in float, {:.4g} in "
      "double, {:.3g} us per launch{}",
      limits_.bytes_s * 1e-9, limits_.slots_s * 1e-9, limits_.words_s * 1e-9, limits_.singles_s * 1e-9,
      limits_.doubles_s * 1e-9, limits_.launch_s * 1e6, without.empty() ? "" : "; without: " + without);
  bench::print(result, command_);
}

}  // namespace wavetracer::bench
