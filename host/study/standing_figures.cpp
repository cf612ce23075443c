// SPDX-License-Identifier: Apache-2.0
// Figures 6.1 to 6.9: orders, and the chained and the open table, in a scene without motion.
// Claims: A. Zhdanov, TU Munich, 2014, sections 6.2.3 and 6.3.1.
#include "study/buffer_views.hpp"
#include "study/entry_views.hpp"
#include "study/experiment.hpp"
#include "study/order_claims.hpp"
#include "study/standing_claims.hpp"
#include "study/table_regions.hpp"

namespace wavetracer::study {
namespace {

constexpr uint64_t operation_rays = 50000;
constexpr uint64_t large_buffer = 10 * thesis_chained_buffer;
constexpr const char* buffer_caption = "Times of the cache's operations, entry by entry along the buffer";
constexpr const char* times_caption = "Time of a frame against the number of rays";
std::shared_ptr<const CacheStudy> shared(CacheStudy study) {
  return std::make_shared<const CacheStudy>(std::move(study));
}

// Returns settings, each with its counted twin.
std::vector<Setting> with_counted(std::vector<Setting> settings) {
  const size_t count = settings.size();
  for (size_t i = 1; i < count; ++i) settings.push_back(counted(settings[i]));
  return settings;
}

// The chained tables are there for comparison, and because their look-ups tell the hash from the rest.
std::vector<Setting> mutexes_beside_chained() {
  std::vector<Setting> out =
      with_counted({no_cache(), open_mutex(1), open_mutex(2), open_mutex(3), as_printed(open_mutex(1)),
                    as_printed(open_mutex(2)), as_printed(open_mutex(3))});
  for (const uint32_t hash_method : {1u, 2u, 3u})
    for (const Setting& table : {chained(hash_method), as_printed(chained(hash_method))}) out.push_back(table);
  return out;
}

// Makes a study of one number of rays, also at depth 1, or also transmitter by transmitter.
CacheStudy operations_study(const std::string& name, std::vector<Setting> settings, bool by_transmitter) {
  return {.name = name,
          .settings = std::move(settings),
          .rays = {operation_rays},
          .few_rays = {operation_rays},
          .at_once = 20,
          .first_depth = true,
          .by_transmitter = by_transmitter};
}

// The numbers of rays are 1,000 doubled up to the thesis' 20,480,000 at most, which is the last.
CacheStudy rays_study(const std::string& name, std::vector<Setting> settings) {
  CacheStudy study{
      .name = name, .settings = std::move(settings), .rays = {}, .few_rays = {1000, 16000, 64000}, .at_once = 4};
  for (uint64_t count = 1000; count < 20480000; count *= 2) study.rays.push_back(count);
  study.rays.push_back(20480000);
  return study;
}

OrderFigure all_orders() {
  Series direction_origin = ordered("direction-origin");
  direction_origin.each_depth = true;  // the method is meant for rays that no longer share their origin
  const std::string h3dh = "hilbert3d-histogram", hz = "morton-histogram", to_2d = h3dh + "-hilbert2d",
                    to_3d = h3dh + "-hilbert3d";
  Claims<OrderRow> claims = repeated(h3dh_gains());
  claims.push_back(
      {"H3DH and HZ are the fastest of the six orders", fastest_are({h3dh, hz}, {"morton", to_2d, to_3d})});
  claims.push_back(
      {"WS is the slowest, at every number of rays", all_faster_than_ws({"morton", h3dh, hz, to_2d, to_3d})});
  claims.push_back(
      {"Z is slightly slower than H3DH and HZ, by a quarter at most", slightly_slower("morton", {h3dh, hz})});
  claims.push_back(
      {"H3DH2DH is not slower than Z up to 50,000,000 rays", no_slower(to_2d, "morton"), Range{50000, 50000000}});
  claims.push_back({"H3DH2DH degrades sharply beyond 50,000,000 rays", degrades_beyond(to_2d, h3dh, 50000000)});
  claims.push_back(
      {"H3DH3DH is not slower than H3DH2DH up to 16,000,000 rays", no_slower(to_3d, to_2d), Range{50000, 16777216}});
  claims = over_bins(claims);
  claims.push_back(
      {"launches in two or three dimensions gain nothing over the same order in one", shapes_gain_nothing()});
  std::vector<Series> series = {unordered(),
                                ordered("morton"),
                                ordered(h3dh),
                                ordered(hz),
                                ordered(to_2d),
                                ordered(to_3d),
                                direction_origin,
                                born_ordered(),
                                with_shape(unordered(), "2d"),
                                with_shape(unordered(), "3d"),
                                with_shape(ordered(h3dh), "2d"),
                                with_shape(ordered(h3dh), "3d")};
  return {.series = with_finer_bins(series, {h3dh, hz, to_2d, to_3d}),
          .moves = false,
          .claims = claims,
          .range = {50000, Range::open}};
}

const auto chained_operations =
    shared(operations_study("chained-operations",
                            with_counted({no_cache(), chained(1), chained(2), chained(3), as_printed(chained(1)),
                                          as_printed(chained(2)), as_printed(chained(3))}),
                            false));
const auto open_operations = shared(operations_study("open-operations", mutexes_beside_chained(), true));
const auto chained_rays =
    shared(rays_study("chained-rays", {no_cache(), chained(1), chained(2), chained(3), chained(1, large_buffer),
                                       chained(2, large_buffer), chained(3, large_buffer), as_printed(chained(1)),
                                       as_printed(chained(2)), as_printed(chained(3)), ours(), born_in_order()}));
const auto open_rays = shared(rays_study(
    "open-rays", {no_cache(), open_readers(1), open_readers(2), open_readers(3), as_printed(open_readers(1)),
                  as_printed(open_readers(2)), as_printed(open_readers(3)), chained(3), ours(), born_in_order()}));
const auto open_rays_ordered = shared(
    rays_study("open-rays-ordered",
               {with_order(no_cache()), with_order(open_mutex(1)), with_order(open_mutex(2)), with_order(open_mutex(3)),
                with_order(as_printed(open_mutex(1))), with_order(as_printed(open_mutex(2))),
                with_order(as_printed(open_mutex(3))), with_order(ours())}));

const std::vector<Experiment> standing = {
    {.name = "figure-6.1",
     .doc = "time against 1,000 to 10,000,000 rays, for every order and launch shape",
     .title = "Ray orders and launch shapes",
     .caption = "Time a ray against the number of rays",
     .paragraph = "The thesis finds H3DH and HZ the fastest of its six orders and no order (WS) the slowest at every "
                  "number of rays, buffers mapped to two and three dimensions no faster than H3DH (section 6.2.3), "
                  "and reordering to take 23% less time at 1,000 rays and to give 2.5 times the speed at 49,000 "
                  "(figure 6.18). Measured on {device}.{reason} Rays born in order need no sort.",
     .figure = all_orders()},
    {.name = "figure-6.2",
     .doc = "chained cache: writes, calls of the buffer and reads along the buffer, by hash",
     .title = "Operations of the chained table",
     .caption = buffer_caption,
     .paragraph = "The thesis finds writes to the chained table to take longer than reads (at most 120 ms against "
                  "50 ms in its buckets, 80 against 40 in other nodes), and calls of the buffer next "
                  "to nothing (section 6.3.1, figure 6.2). Measured on {device} at {rays} rays.",
     .figure = CacheFigure{.study = chained_operations, .view = along_buffer({all_chained}), .claims = write_claims()}},
    {.name = "figure-6.3",
     .doc = "chained cache: the same with tracing",
     .title = "Operations of the chained table and tracing",
     .caption = buffer_caption,
     .paragraph = "The thesis finds almost no tracing operation to exceed 2 s, and draws writes "
                  "and reads far below it (section 6.3.1, figure 6.3; writes take 120 ms at most in figure 6.2). "
                  "Measured on {device} at {rays} rays. "
                  "A cache can only save time where a read is cheaper than tracing.",
     .figure =
         CacheFigure{
             .study = chained_operations, .view = along_buffer({all_chained, true}), .claims = bucket_claims()}},
    {.name = "figure-6.4",
     .doc = "chained cache: hits per entry",
     .title = "Hits of the chained table's entries",
     .caption = "Hits of the chained table's entries along the table",
     .paragraph = "The thesis finds hits spread evenly over the entries, entries of the buffer that are never used, "
                  "and some that are but never answer (section 6.3.1, figure 6.4). Measured on {device} at {rays} "
                  "rays, after a cold frame and a warm one.",
     .figure = CacheFigure{.study = chained_operations, .view = hits_along_table(all_chained), .claims = hit_claims()}},
    {.name = "figure-6.5",
     .doc = "chained cache against none, 1,000 to 20,480,000 rays, by hash",
     .title = "Frames with the chained table",
     .caption = times_caption,
     .paragraph = "The thesis finds no chained cache of 50,000 entries faster than none, whatever the hash, "
                  "but between 2,560,000 and 10,240,000 rays (section 6.3.1, figure 6.5). "
                  "Measured on {device} with a warm table, one of them saves time {saves}.",
     .figure =
         CacheFigure{
             .study = chained_rays, .view = times_by_rays, .claims = window_claims(), .settings = chained_tables}},
    {.name = "figure-6.6",
     .doc = "open cache: writes, calls of the buffer and reads along the buffer, by hash",
     .title = "Operations of the open table",
     .caption = buffer_caption,
     .paragraph = "The thesis finds most writes to the open table to take three times as long as most reads (60 ms "
                  "against 20 ms), and both to take less than in the chained table (section 6.3.1, figure 6.6). "
                  "Measured on {device} at {rays} rays.",
     .figure =
         CacheFigure{
             .study = open_operations, .view = along_buffer({all_mutexes, false, true}), .claims = lock_claims()}},
    {.name = "figure-6.7",
     .doc = "open cache: the same with tracing",
     .title = "Operations of the open table and tracing",
     .caption = buffer_caption,
     .paragraph = "The thesis finds operations of the open table much faster than tracing, "
                  "1 to 2.5 s against some 0.06 s (section 6.3.1, figure 6.7). Measured on {device} at {rays} rays.",
     .figure =
         CacheFigure{
             .study = open_operations, .view = along_buffer({all_mutexes, true, true}), .claims = region_claims()}},
    {.name = "figure-6.8",
     .doc = "open cache with two locks against none, 1,000 to 20,480,000 rays, by hash",
     .title = "Frames with the open table",
     .caption = times_caption,
     .paragraph = "The thesis finds the open table with two locks to save time from some 50,000 rays on, "
                  "most with the mixed hash, then with the uniform one, then with Morton codes (section 6.3.1, "
                  "figure 6.8). "
                  "Measured on {device} with a warm table, one of them saves time {saves}.",
     .figure = CacheFigure{.study = open_rays, .view = times_by_rays, .claims = open_claims(), .settings = readers}},
    {.name = "figure-6.9",
     .doc = "open cache with a mutex against none, rays in order",
     .title = "Frames with the open table, rays in order",
     .caption = times_caption,
     .paragraph = "With a mutex and rays in order (here H3DH; the thesis does not say which), "
                  "the thesis finds the open table to save time from some 16,000 rays on, "
                  "2 s at most at 2,048,000 (section 6.3.1, figure 6.9). Measured on {device} with a warm table, "
                  "one of them saves time {saves}.",
     .figure =
         CacheFigure{
             .study = open_rays_ordered, .view = times_by_rays, .claims = ordered_claims(), .settings = mutexes}},
};

}  // namespace

const std::vector<Experiment>& standing_figures() { return standing; }

}  // namespace wavetracer::study
