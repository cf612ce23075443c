// Figures of orders: the time of every series at every number of rays.
// Assumes that a frame without a cache, reuse or diffraction launches the rays of its transmitters and no others.
#include <fmt/format.h>
#include "study/order_claims.hpp"
#include "study/run.hpp"
#include "study/scripts.hpp"

namespace wavetracer::study {
namespace {

std::string point_line(const Experiment& experiment, const std::vector<OrderRow>& rows) {
  std::string text =
      fmt::format("{}: {} rays, tracing with the sort paid:", experiment.name, grouped(rows.front().rays));
  for (const OrderRow& row : rows)
    text += fmt::format("{} {} {} ms", &row == &rows.front() ? "" : ",", label(row.series),
                        plain(1e3 * row.times.paid_s()));
  return text;
}

RayRange series_range(const Request& request) {
  if (request.rays) return *request.rays;
  return request.quick ? RayRange{claimed_few, claimed_many} : RayRange{};
}

}  // namespace

Words order_words(const Experiment& experiment, const std::vector<OrderRow>& rows, const std::string& device) {
  const Fields fields = order_fields(rows, device);
  return {filled(experiment.paragraph, fields), judged(experiment.as<OrderFigure>()->claims, rows, fields),
          gain_table(rows)};
}

Findings measure(const OrderFigure& figure, const Experiment& experiment, const Request& request, const Host& host) {
  const std::vector<uint64_t> counts = ray_counts(series_range(request));
  Findings found;
  found.planned = counts.size();
  // Finds mistakes in the device, the scene and the ends before anything is measured.
  Config first = point_config(figure, request.config, counts.front(), false);
  apply(first, figure.series.front(), counts.front());
  found.device = Simulation(first, request.device).device();
  host.say(fmt::format("{}: {} series at {} to {} rays on {}", experiment.name, figure.series.size(),
                       grouped(counts.front()), grouped(counts.back()), found.device.name));
  std::vector<OrderRow> rows;
  uint64_t done = 0, all = 0;
  for (const uint64_t rays : counts) all += rays;
  for (const uint64_t rays : counts) {
    if (host.interrupted()) break;
    host.tell(experiment.name, done, all, "rays");
    done += rays;
    const std::vector<OrderRow> point =
        measure_orders(point_config(figure, request.config, rays, found.device.gpu), figure.series, rays, figure.frames,
                       request.device, request.repeats);
    host.say(point_line(experiment, point));
    rows.insert(rows.end(), point.begin(), point.end());
    ++found.points;
  }
  if (rows.empty()) return found;
  found.table = encode(order_columns(figure.frames > 1), rows);
  found.script = order_script(experiment.name, experiment.title + ", " + found.device.name, figure.series);
  found.words = order_words(experiment, rows, found.device.name);
  found.notes = {
      fmt::format("times: medians of {} warm frames, the series in turns; tracing is generate_rays, trace, "
                  "trace_moving, compact, scan and interact, the sort is order and sort, all from profiling events",
                  request.repeats),
      "every frame launches all rays of its transmitters: trace.reuse, trace.diffraction and cache.kind are off; where "
      "vehicles drive, it is the first frame of their drive"};
  return found;
}

}  // namespace wavetracer::study
