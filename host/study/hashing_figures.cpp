// SPDX-License-Identifier: Apache-2.0
// Figures 6.14 to 6.18: caches in traffic by hash function, with rays in order and without; orders while the
// transmitters move.
// Claims: A. Zhdanov, TU Munich, 2014, section 6.3.2.
#include <memory>
#include "study/cache_claims.hpp"
#include "study/experiment.hpp"
#include "study/hash_claims.hpp"
#include "study/order_claims.hpp"
#include "study/traffic_settings.hpp"

namespace wavetracer::study {
namespace {

// The numbers of rays of figures 6.14, 6.15 and 6.18, and of figures 6.16 and 6.17.
constexpr Range hash_range{1000, 49000}, ordered_range{1000, 61000};

// The thesis' caches of by_hash().
const std::vector<std::string> caches = {position_uniform,  position_morton,  position_mixed,
                                         precision_uniform, precision_morton, precision_mixed};

std::vector<Setting> by_hash() {
  std::vector<Setting> settings = {no_cache()};
  for (const uint32_t hash : {1u, 2u, 3u}) settings.push_back(position(hash));
  for (const uint32_t hash : {1u, 2u, 3u}) settings.push_back(precision(thesis_residual, hash));
  for (const uint32_t hash : {1u, 2u, 3u}) settings.push_back(as_printed(position(hash)));
  for (const uint32_t hash : {1u, 2u, 3u}) settings.push_back(as_printed(precision(thesis_residual, hash)));
  settings.push_back(ours());
  return settings;
}

Claims<OrderRow> moving_gains() {
  Claims<OrderRow> claims = h3dh_gains();
  claims.push_back({"reordering takes less time at every number of rays", all_faster_than_ws({"hilbert3d-histogram"})});
  claims.push_back({"the gain grows with the number of rays", gain_grows("hilbert3d-histogram")});
  return over_bins(claims);
}

// Returns all settings in order, and also no cache and two caches without order.
std::vector<Setting> with_orders(std::vector<Setting> settings) {
  for (Setting& setting : settings) setting = with_order(setting);
  for (const Setting& setting : {no_cache(), position(3), precision(thesis_residual, 3), as_printed(position(3)),
                                 as_printed(precision(thesis_residual, 3))})
    settings.push_back({unsorted(setting.name), setting.apply});
  return settings;
}

const auto hashing = std::make_shared<const CacheStudy>(
    CacheStudy{.name = "hashing",
               .settings = by_hash(),
               .rays = {1000, 5000, 10000, 20000, 37000, 49000, 100000, 200000, 490000},
               .few_rays = {1000, 10000, 49000},
               .drives = {"fixed", "thesis"}});
const auto hashing_ordered = std::make_shared<const CacheStudy>(
    CacheStudy{.name = "hashing-ordered",
               .settings = with_orders(by_hash()),
               .rays = {1000, 5000, 10000, 20000, 37000, 49000, 61000, 100000, 200000, 610000},
               .few_rays = {1000, 10000, 61000},
               .drives = {"fixed", "thesis"}});

const std::vector<Experiment> hashes = {
    {.name = "figure-6.14",
     .doc = "traffic: time by hash function",
     .title = "Frames in traffic by hash function",
     .caption = "Average time of a frame by hash function",
     .paragraph = "If purged by position, the thesis finds Morton codes 15% faster than the uniform hash "
                  "from 20,000 rays on, and the mixed one like the uniform; if purged by precision, "
                  "Morton codes slower than no cache (section 6.3.2, figure 6.14). Measured on {device}.",
     .figure =
         CacheFigure{
             .study = hashing,
             .view = savings_by_rays,
             .claims = with_printed(
                 hash_times,
                 {{"Morton codes by position take less time than the uniform hash by precision, for many rays (from 37,000 to 49,000)",
                   where(less(warm_s, position_morton, precision_uniform)), Range{37000, 49000}}}),
             .range = hash_range}},
    {.name = "figure-6.15",
     .doc = "traffic: error by hash function",
     .title = "Errors in traffic by hash function",
     .caption = "Error by hash function",
     .paragraph = "By position, the thesis finds the error with Morton codes on average twice "
                  "that with the uniform hash, and the mixed one's like the uniform's; by precision, "
                  "Morton codes the most accurate (section 6.3.2, figure 6.15). Its lookups do not compare keys, "
                  "so that collisions of a hash are errors; in tables \"printed\" they are so here, "
                  "in ours they are misses, and a hash decides only which segments find room. Measured on {device}.",
     .figure =
         CacheFigure{
             .study = hashing,
             .view = errors_by_rays,
             .claims =
                 {{"by position, the centroid is off farther with Morton codes than with the uniform hash",
                   where(less(l2_m, position_uniform, position_morton))},
                  {"by position, on average twice as far off with Morton codes as with the uniform hash",
                   on_average(l2_m, position_morton, position_uniform, 1.5, 2.5)},
                  {"by position, as far with the mixed hash as with the uniform one",
                   on_average(l2_m, position_mixed, position_uniform, 0.8, 1.25)},
                  {"by precision, less far with Morton codes than with the uniform hash",
                   where(less(l2_m, precision_morton, precision_uniform))},
                  {"by precision, as far with the mixed hash as with the uniform one",
                   on_average(l2_m, precision_mixed, precision_uniform, 0.8, 1.25)},
                  {"by precision, the uniform and the mixed hash are off farthest of all",
                   where(largest_are(l2_m, {precision_uniform, precision_mixed}, caches))},
                  {"Morton codes are off less far by position than by precision",
                   where(less(l2_m, position_morton, precision_morton))},
                  {"as printed: by position, on average twice as far off with Morton codes as with the uniform hash",
                   on_average(l2_m, printed(position_morton), printed(position_uniform), 1.5, 2.5), std::nullopt,
                   Origin::repetition},
                  {"as printed: by position, as far with the mixed hash as with the uniform one",
                   on_average(l2_m, printed(position_mixed), printed(position_uniform), 0.8, 1.25), std::nullopt,
                   Origin::repetition},
                  {"as printed: by precision, less far with Morton codes than with the uniform hash",
                   on_average(l2_m, printed(precision_morton), printed(precision_uniform), 0, 1), std::nullopt,
                   Origin::repetition}},
             .range = hash_range}},
    {.name = "figure-6.16",
     .doc = "traffic: time by hash function, rays in order",
     .title = "Frames in traffic by hash function, rays in order",
     .caption = "Average time of a frame by hash function, rays in order",
     .paragraph = "With rays in order (here H3DH; the thesis does not say which), the thesis finds caches "
                  "to save nothing, but those by precision with the uniform and the mixed hash up to some 37,000 "
                  "rays (section 6.3.2, figure 6.16). Measured on {device}.",
     .figure =
         CacheFigure{
             .study = hashing_ordered,
             .view = savings_by_rays,
             .claims = with_printed(
                 ordered_times,
                 {{"without a cache, reordering gives 2.5 times the speed at 49,000 rays",
                   where(less(warm_s, none, unsorted(none), 2.5)), at_rays(49000), Origin::repetition},
                  {"without a cache, reordering gives 2.5 times the speed at 49,000 rays, the sort counted once",
                   where(less(once_s, none, unsorted(none), 2.5)), at_rays(49000), Origin::repetition}}),
             .range = ordered_range}},
    {.name = "figure-6.17",
     .doc = "traffic: error by hash function, rays in order",
     .title = "Errors in traffic by hash function, rays in order",
     .caption = "Error by hash function, rays in order",
     .paragraph =
         "With rays in order, the thesis finds the error of the caches that save time, those by precision with "
         "the uniform and the mixed hash, to hover around 5 units, more than by position, "
         "and sorting to reduce the error slightly (section 6.3.2, figure 6.17, and its fourth conclusion). "
         "Measured on {device}.",
     .figure = CacheFigure{.study = hashing_ordered,
                           .view = errors_by_rays,
                           .claims = with_printed(ordered_errors),
                           .range = ordered_range}},
    {.name = "figure-6.18",
     .doc = "traffic: average time of a frame while the transmitters move, reordered against not",
     .title = "Frames in traffic, with reordering and without",
     .caption = "Time a ray against the number of rays",
     .paragraph = "Without a cache, the thesis finds reordering to take 23% less time than no reordering (WS) "
                  "at 1,000 rays and almost 60% less, 2.5 times the speed, at 49,000, and the gain to grow with "
                  "the number of rays (section 6.3.2, figure 6.18). Measured on {device}, "
                  "averaged over {frames} frames of traffic whose transmitters move.{reason} Rays born "
                  "in order need no sort.",
     .figure = OrderFigure{.series = with_finer_bins({unordered(), ordered("hilbert3d-histogram"), born_ordered()},
                                                     {"hilbert3d-histogram"}),
                           .moves = true,
                           .claims = moving_gains(),
                           .range = hash_range}},
};

}  // namespace

const std::vector<Experiment>& hashing_figures() { return hashes; }

}  // namespace wavetracer::study
