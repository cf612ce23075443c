// SPDX-License-Identifier: Apache-2.0
// A sample of the frame's own rays is traced in every order, with the time of the sort; the best of two warm runs
// counts. Ray counts are rounded to powers of two: a million rays and a million and a half have the same best order.
#include "simulation/order_choice.hpp"
#include "base/digits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <ctime>
#include <span>
#include <sstream>

#include "simulation/warm_sample.hpp"

namespace wavetracer {

namespace {

// More rays would not change which order is fastest, and a start should not cost more than a frame or two.
constexpr uint64_t most_sample_rays = uint64_t{1} << 24;
// An order that needs a sort must be this much faster than none: a smaller gain is noise, and the next run would choose
// differently.
constexpr double least_gain = 1.03;

struct Candidate {
  OrderConfig order;
  double seconds = 0;
};

std::vector<Candidate> candidates(const OrderConfig& order, const LaunchConfig& launch) {
  std::vector<Candidate> all{{{"none", false, order.bin_num}}};
  const size_t dimensions = launch.shape.index();  // 0: auto
  for (const OrderMethodRow& method : order_methods) {
    const bool fits = method.launch_dimensions == 0 || dimensions == 0 || dimensions == method.launch_dimensions;
    if (method.key && fits) all.push_back({{method.name, false, order.bin_num}});
  }
  all.push_back({{"direction-origin", true, order.bin_num}});
  return all;
}

// All stages count, so the time of a sort counts, too.
double measure(gpu::Context& context, const DeviceScene& scene, const TraceConfig& sample, const OrderPlan& plan,
               const glm::dvec3& transmitter) {
  return warm_seconds(context, scene, sample, plan, {transmitter}, [](const auto& stages) {
    double sum = 0;
    for (const auto& [stage, seconds] : stages) sum += seconds;
    return sum;
  });
}

// Everything that the choice depends on but the device, which the context adds.
std::string subject_of(const Scene& scene, const OrderConfig& order, const LaunchConfig& launch,
                       const TraceConfig& sample) {
  const auto bytes = [](const auto& list) {
    return std::string_view(reinterpret_cast<const char*>(list.data()), list.size() * sizeof list[0]);
  };
  std::string subject = fmt::format(
      "order of rays, version 1\nrays 2^{} depth {} directions {} seed {} batch {} bins {} shape {} local {}\n",
      std::bit_width(*sample.rays), sample.max_depth, sample.directions.word(), sample.seed,
      sample.batch_rays.value_or(0), order.bin_num, launch.shape.word(), launch.local_size.value_or(0));
  for (const char* program : {"trace_bvh2", "trace_bvh8", "trace_packet16", "order_keys", "radix_sort",
                              "radix_sort_cpu", "bitonic_sort", "interact"})
    subject += gpu::program_source(program);
  return subject + std::string(bytes(scene.vertices)) + std::string(bytes(scene.triangles));
}

std::string name_of(const OrderConfig& order) {
  return order.method.text() + (order.each_depth ? " at each depth" : "");
}

std::string reason_of(std::vector<Candidate> measured, const Candidate& best, uint64_t rays) {
  std::sort(measured.begin(), measured.end(), [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
  const std::time_t now = std::time(nullptr);
  char date[32];
  std::strftime(date, sizeof date, "%Y-%m-%d", std::gmtime(&now));
  std::string text = fmt::format(
      "{} was chosen by tracing {} rays in every order, sort paid, on {}:", name_of(best.order), grouped(rays), date);
  for (const Candidate& c : measured) text += fmt::format(" {} {:.3g} ms,", name_of(c.order), c.seconds * 1e3);
  text.back() = '.';
  return text;
}

}  // namespace

OrderChoice choose_order(gpu::Context& context, const Scene& scene, const DeviceScene& device_scene,
                         const OrderConfig& asked, const LaunchConfig& launch, const TraceConfig& trace,
                         const std::vector<glm::dvec3>& transmitters) {
  if (transmitters.empty()) return {plan_order({}, launch), "no transmitter exists, so nothing was measured"};
  TraceConfig sample = trace;
  sample.rays = std::min(sample.rays.value_or(most_sample_rays), most_sample_rays);
  const std::string subject = subject_of(scene, asked, launch, sample);
  const auto choice_of = [&](OrderMethod method, bool each_depth, const std::string& reason) {
    OrderConfig order = asked;
    order.method = method;
    order.each_depth = each_depth;
    return OrderChoice{plan_order(order, launch), reason};
  };
  if (const auto kept = context.recall(subject)) {
    // The file has one line each for method, each_depth and reason.
    std::istringstream lines(*kept);
    std::string method, each_depth, reason;
    if (std::getline(lines, method) && std::getline(lines, each_depth) && std::getline(lines, reason))
      return choice_of(OrderMethod::named(method), each_depth == "1", reason + " (kept from an earlier run)");
  }
  std::vector<Candidate> all = candidates(asked, launch);
  for (Candidate& c : all)
    c.seconds = measure(context, device_scene, sample, plan_order(c.order, launch), transmitters.front());
  const auto fastest =
      std::min_element(all.begin() + 1, all.end(), [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
  const Candidate& best = fastest->seconds * least_gain < all.front().seconds ? *fastest : all.front();
  const std::string reason = reason_of(all, best, *sample.rays);
  context.keep(subject, fmt::format("{}\n{}\n{}\n", best.order.method.word(), int{best.order.each_depth}, reason));
  return choice_of(best.order.method, best.order.each_depth, reason);
}

}  // namespace wavetracer
