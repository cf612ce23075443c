// SPDX-License-Identifier: Apache-2.0
// Figures 6.1 to 6.9: orders, and the chained and the open table, in a scene without motion.
// Claims: A. Zhdanov, TU Munich, 2014, sections 6.2.3 and 6.3.1.
#include "study/cache_claims.hpp"
#include "study/entry_views.hpp"
#include "study/experiment.hpp"
#include "study/order_claims.hpp"
#include "study/table_regions.hpp"

namespace wavetracer::study {
namespace {

using Names = std::vector<std::string>;

// Numbers of bins beside the thesis'.
constexpr uint32_t finer_bins[] = {32, 64, 128};
constexpr uint64_t operation_rays = 50000;
constexpr uint64_t large_buffer = 10 * thesis_chained_buffer;
const Names chained_tables = {"chained uniform", "chained Morton", "chained mixed"},
            mutexes = {"mutex uniform", "mutex Morton", "mutex mixed"},
            readers = {"readers uniform", "readers Morton", "readers mixed"};

Names counted_names(Names names) {
  for (std::string& name : names) name = counted_name(name);
  return names;
}

// Returns our tables, then the same as the thesis prints them.
Names with_printed(Names names) {
  const Names ours = names;
  for (const std::string& name : ours) names.push_back("printed " + name);
  return names;
}

const Names all_chained = with_printed(chained_tables), all_mutexes = with_printed(mutexes),
            printed_chained = Names(all_chained.begin() + 3, all_chained.end()),
            printed_mutexes = Names(all_mutexes.begin() + 3, all_mutexes.end()),
            mutexes_and_chained = with_printed({"mutex uniform", "mutex Morton", "mutex mixed", "chained mixed"});
const Names printed_readers = {"printed readers uniform", "printed readers Morton", "printed readers mixed"},
            chained_counted = counted_names(all_chained), mutexes_counted = counted_names(all_mutexes);

constexpr const char* no_time_of_a_ray = "rays are traced in packets and groups, so that no ray has a time of its own";
constexpr const char* operations_caption =
    "Time per segment of the cache's operations against the depth of the segment";
constexpr const char* regions_caption = "Time per segment of the cache's operations in each region of the table";
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

// Makes a study of one number of rays, depth by depth, or transmitter by transmitter.
CacheStudy operations_study(const std::string& name, std::vector<Setting> settings, bool by_transmitter) {
  return {.name = name,
          .settings = std::move(settings),
          .rays = {operation_rays},
          .few_rays = {operation_rays},
          .by_depth = !by_transmitter,
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

bool writes_longer_than_reads(const CacheRow& row) { return write_ns(row) > read_ns(row); }
bool writes_as_three_reads(const CacheRow& row) {
  const double reads = write_ns(row) / read_ns(row);
  return reads >= 2.5 && reads <= 3.5;
}
bool gathers_quickly(const CacheRow& row) { return gather_ns(row) < 0.1 * write_ns(row); }
// Judges the chained tables that keep their entries.
Judge<CacheRow> of_entries(std::optional<bool> (*holds)(const EntrySummary&)) {
  return of_each(chained_counted, [holds](const CacheRow& row) { return holds(row.entries); });
}
bool some_unused(const CacheRow& row) { return entries_used(row) < row.cache.entries; }
bool some_never_answer(const CacheRow& row) { return row.cache.entries_by_hits.front() > 0; }

// Returns the claims of figures 6.3 and 6.7 about tracing a segment against looking it up.
Claims<CacheRow> trace_claims(const Names& settings) {
  return {{"tracing takes longer than a read",
           of_each(settings, [](const CacheRow& row) { return trace_ns(row) > read_ns(row); })},
          {"tracing takes longer than ten reads",
           of_each(settings, [](const CacheRow& row) { return trace_ns(row) > 10 * read_ns(row); })},
          {"tracing takes longer than a write",
           of_each(settings, [](const CacheRow& row) { return trace_ns(row) > write_ns(row); })}};
}

// Returns the other claims of figure 6.3.
Claims<CacheRow> bucket_claims() {
  Claims<CacheRow> claims = trace_claims(all_chained);
  claims.push_back({"tracing takes longer for buckets than for other nodes", not_judged(no_time_of_a_ray)});
  return claims;
}
// Returns the other claims of figure 6.7.
Claims<CacheRow> region_claims() {
  Claims<CacheRow> claims = trace_claims(all_mutexes);
  claims.push_back({"regions that take longer to write and read are faster to trace",
                    across_regions(all_mutexes, access_ns, trace_ns, true)});
  claims.push_back({"busier regions are faster to trace", across_regions(all_mutexes, region_lookups, trace_ns, true)});
  return claims;
}

OrderFigure all_orders() {
  Series direction_origin = ordered("direction-origin");
  direction_origin.each_depth = true;  // the method is meant for rays that no longer share their origin
  const std::string h3dh = "hilbert3d-histogram", hz = "morton-histogram", to_2d = h3dh + "-hilbert2d",
                    to_3d = h3dh + "-hilbert3d";
  Claims<OrderRow> claims = h3dh_gains();
  claims.push_back({"H3DH and HZ are the fastest of the six orders, at {most} rays",
                    fastest_are({h3dh, hz}, {"morton", to_2d, to_3d})});
  claims.push_back(
      {"WS is the slowest, at every number of rays", none_slower_than_ws({"morton", h3dh, hz, to_2d, to_3d})});
  claims.push_back({"Z is slightly slower than H3DH and HZ, by a quarter at most, at {most} rays",
                    slightly_slower("morton", {h3dh, hz})});
  claims.push_back({"H3DH2DH is not slower than Z up to 50,000,000 rays", no_slower(to_2d, "morton", 0, 50000000)});
  claims.push_back({"H3DH2DH degrades sharply beyond 50,000,000 rays", degrades_beyond(to_2d, h3dh, 50000000)});
  claims.push_back({"H3DH3DH is not slower than H3DH2DH up to 16,000,000 rays", no_slower(to_3d, to_2d, 0, 16777216)});
  claims.push_back({"launches in two or three dimensions gain nothing over the same order in one", shapes_gain()});
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
  for (const uint32_t bins : finer_bins)
    for (const std::string& method : {h3dh, hz, to_2d, to_3d}) series.push_back(with_bins(ordered(method), bins));
  return {.series = series, .moves = false, .claims = claims};
}

const auto chained_operations =
    shared(operations_study("chained-operations",
                            with_counted({no_cache(), chained(1), chained(2), chained(3), as_printed(chained(1)),
                                          as_printed(chained(2)), as_printed(chained(3))}),
                            false));
const auto open_operations = shared(operations_study(
    "open-operations",
    with_counted({no_cache(), open_mutex(1), open_mutex(2), open_mutex(3), chained(3), as_printed(open_mutex(1)),
                  as_printed(open_mutex(2)), as_printed(open_mutex(3)), as_printed(chained(3))}),
    true));
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
     .doc = "chained cache: what a write and a read of a segment take, by hash",
     .title = "Operations of the chained table",
     .caption = operations_caption,
     .paragraph = "The thesis finds writes to the chained table to take longer than reads (at most 120 ms against "
                  "50 ms in its buckets, 80 against 40 in other nodes), and calls of the buffer next "
                  "to nothing (section 6.3.1, figure 6.2). Measured on {device} at {rays} rays. "
                  "What the table adds besides is the gathering of missed rays.",
     .figure =
         CacheFigure{
             .study = chained_operations,
             .view = operations_by_tree_depth(all_chained),
             .claims = {{"writes take longer than reads", of_each(all_chained, writes_longer_than_reads)},
                        {"the rest takes next to nothing: gathering less than a tenth of a write",
                         of_each(all_chained, gathers_quickly)},
                        {"writes take longer in buckets than in other nodes", of_entries(writes_longer_in_buckets)},
                        {"reads take longer in buckets than in other nodes", of_entries(reads_longer_in_buckets)}}}},
    {.name = "figure-6.3",
     .doc = "chained cache: writes and reads against tracing",
     .title = "Operations of the chained table and tracing",
     .caption = operations_caption,
     .paragraph = "The thesis finds almost no tracing operation to exceed 2 s, and draws writes "
                  "and reads far below it (section 6.3.1, figure 6.3; writes take 120 ms at most in figure 6.2). "
                  "Measured on {device} at {rays} rays. "
                  "A cache can only save time where a read is cheaper than tracing.",
     .figure =
         CacheFigure{.study = chained_operations, .view = operations(all_chained, true), .claims = bucket_claims()}},
    {.name = "figure-6.4",
     .doc = "chained cache: hits per entry",
     .title = "Hits of the chained table's entries",
     .caption = "Hits of the chained table's entries along the table",
     .paragraph = "The thesis finds hits spread evenly over the entries, entries of the buffer that are never used, "
                  "and some that are but never answer (section 6.3.1, figure 6.4). Measured on {device} at {rays} "
                  "rays, after a cold frame and a warm one.",
     .figure = CacheFigure{.study = chained_operations,
                           .view = hits_along_table(all_chained),
                           .claims = {{"hits are spread over the entries at least as evenly as by chance",
                                       of_entries(are_even)},
                                      {"there are no clusters of busy entries", of_entries(is_without_clusters)},
                                      {"some entries are left unused", of_each(chained_counted, some_unused)},
                                      {"some entries never answer", of_each(chained_counted, some_never_answer)}}}},
    {.name = "figure-6.5",
     .doc = "chained cache against none, 1,000 to 20,480,000 rays, by hash",
     .title = "Frames with the chained table",
     .caption = times_caption,
     .paragraph = "The thesis finds no chained cache of 50,000 entries faster than none, whatever the hash, "
                  "but between 2,560,000 and 10,240,000 rays (section 6.3.1, figure 6.5). "
                  "Measured on {device} with a warm table, one of them saves time {saves}.",
     .figure = CacheFigure{.study = chained_rays,
                           .view = times_by_rays,
                           .claims = {{"no gain below 2,560,000 and beyond 10,240,000 rays",
                                       everywhere(outside(2560000, 10240000), saves_not(chained_tables))},
                                      {"a gain from 2,560,000 to 10,240,000 rays",
                                       everywhere(between(2560000, 10240000), saves(chained_tables))},
                                      {"as printed: no gain below 2,560,000 and beyond 10,240,000 rays",
                                       everywhere(outside(2560000, 10240000), saves_not(printed_chained))},
                                      {"as printed: a gain from 2,560,000 to 10,240,000 rays",
                                       everywhere(between(2560000, 10240000), saves(printed_chained))}},
                           .settings = chained_tables}},
    {.name = "figure-6.6",
     .doc = "open cache: what a write and a read of a segment take, by hash",
     .title = "Operations of the open table",
     .caption = regions_caption,
     .paragraph = "The thesis finds most writes to the open table to take three times as long as most reads (60 ms "
                  "against 20 ms), and both to take less than in the chained table (section 6.3.1, figure 6.6). "
                  "Measured on {device} at {rays} rays.",
     .figure = CacheFigure{.study = open_operations,
                           .view = regions(mutexes_and_chained),
                           .claims = {{"writes take longer than reads", of_each(all_mutexes, writes_longer_than_reads)},
                                      {"writes take three times as long as reads",
                                       of_each(all_mutexes, writes_as_three_reads)},
                                      {"the rest takes next to nothing: gathering less than a tenth of a write",
                                       of_each(all_mutexes, gathers_quickly)},
                                      {"busier regions take longer to write",
                                       across_entries(mutexes_counted, &EntryGroup::write_cycles)},
                                      {"busier regions take longer to read",
                                       across_entries(mutexes_counted, &EntryGroup::read_cycles)},
                                      {"writes take less than in the chained table, with the mixed hash",
                                       is_less(write_ns, "mutex mixed", "chained mixed")},
                                      {"reads take less than in the chained table, with the mixed hash",
                                       is_less(read_ns, "mutex mixed", "chained mixed")}}}},
    {.name = "figure-6.7",
     .doc = "open cache: writes and reads against tracing",
     .title = "Operations of the open table and tracing",
     .caption = regions_caption,
     .paragraph = "The thesis finds operations of the open table much faster than tracing, "
                  "1 to 2.5 s against some 0.06 s (section 6.3.1, figure 6.7). Measured on {device} at {rays} rays.",
     .figure =
         CacheFigure{.study = open_operations, .view = regions(mutexes_and_chained, true), .claims = region_claims()}},
    {.name = "figure-6.8",
     .doc = "open cache with two locks against none, 1,000 to 20,480,000 rays, by hash",
     .title = "Frames with the open table",
     .caption = times_caption,
     .paragraph = "The thesis finds the open table with two locks to save time from some 50,000 rays on, "
                  "most with the mixed hash, then with the uniform one, then with Morton codes (section 6.3.1, "
                  "figure 6.8). "
                  "Measured on {device} with a warm table, one of them saves time {saves}.",
     .figure = CacheFigure{.study = open_rays,
                           .view = times_by_rays,
                           .claims = {{"the time of no cache, within 10%, up to 50,000 rays",
                                       everywhere(up_to(50000), all_take_the_time_of_none(readers, 10))},
                                      {"a gain beyond 50,000 rays", everywhere(above(50000), saves(readers))},
                                      {"the mixed hash is the fastest beyond 50,000 rays",
                                       everywhere(above(50000), fastest_is("readers mixed", readers))},
                                      {"Morton codes are the slowest of the three beyond 50,000 rays",
                                       everywhere(above(50000), slowest_is("readers Morton", readers))},
                                      {"a gain from fewer rays on than with the chained table, with the mixed hash",
                                       gains_earlier("readers mixed", "chained mixed")},
                                      {"as printed: a gain beyond 50,000 rays",
                                       everywhere(above(50000), saves(printed_readers))}},
                           .settings = readers}},
    {.name = "figure-6.9",
     .doc = "open cache with a mutex against none, rays in order",
     .title = "Frames with the open table, rays in order",
     .caption = times_caption,
     .paragraph = "With a mutex and rays in order (here H3DH; the thesis does not say which), "
                  "the thesis finds the open table to save time from some 16,000 rays on, "
                  "2 s at most at 2,048,000 (section 6.3.1, figure 6.9). Measured on {device} with a warm table, "
                  "one of them saves time {saves}.",
     .figure = CacheFigure{.study = open_rays_ordered,
                           .view = times_by_rays,
                           .claims = {{"a gain beyond 16,000 rays", everywhere(above(16000), saves(mutexes))},
                                      {"most seconds are saved at 2,048,000 rays", saves_most_at(mutexes, 2048000)},
                                      {"as printed: a gain beyond 16,000 rays",
                                       everywhere(above(16000), saves(printed_mutexes))}},
                           .settings = mutexes}},
};

}  // namespace

const std::vector<Experiment>& standing_figures() { return standing; }

}  // namespace wavetracer::study
