// SPDX-License-Identifier: Apache-2.0
// Claims about rows of settings called "printed ...".
// Their ranges are those of the claims that they repeat.
#include "study/printed_claims.hpp"
#include "study/traffic_settings.hpp"

namespace wavetracer::study {
namespace {

const std::string by_position_uniform = printed(position_uniform), by_position_morton = printed(position_morton),
                  by_position_mixed = printed(position_mixed), by_precision_uniform = printed(precision_uniform),
                  by_precision_morton = printed(precision_morton), by_precision_mixed = printed(precision_mixed);

}  // namespace

Claims<CacheRow> printed_hash_times() {
  const std::vector<std::string> faster = {by_position_uniform, by_position_morton, by_position_mixed,
                                           by_precision_uniform, by_precision_mixed};
  std::vector<std::string> all = faster;
  all.insert(all.end(), {none, by_precision_morton});
  return repeated<CacheRow>(
      {{"as printed: by precision, Morton codes take the most time of all",
        where(slowest_is(by_precision_morton, all))},
       {"as printed: the second worst is no cache: all others save time", where(all_save(faster))},
       {"as printed: by position, the uniform hash takes less time than no cache", where(saves({by_position_uniform}))},
       {"as printed: by position, Morton codes take 15% less time than the uniform hash, from 20,000 rays on",
        where(less(warm_s, by_position_morton, by_position_uniform, 1 / 0.85)), Range{20000, 49000}},
       {"as printed: by position, the mixed hash takes the time of the uniform one",
        on_average(warm_s, by_position_mixed, by_position_uniform, 0.95, 1.05)},
       {"as printed: by precision, Morton codes take more time than no cache",
        where(less(warm_s, none, by_precision_morton))},
       {"as printed: by precision, the mixed hash takes the time of the uniform one",
        on_average(warm_s, by_precision_mixed, by_precision_uniform, 0.95, 1.05)},
       {"as printed: by precision, the uniform hash takes the time of Morton codes by position",
        on_average(warm_s, by_precision_uniform, by_position_morton, 0.9, 1.1)},
       {"as printed: by precision, the mixed hash takes the time of Morton codes by position",
        on_average(warm_s, by_precision_mixed, by_position_morton, 0.9, 1.1)}});
}

Claims<CacheRow> printed_ordered_times() {
  return repeated<CacheRow>(
      {{"as printed: caches by position, and by precision with Morton codes, save no time",
        where(saves_not({by_position_uniform, by_position_morton, by_position_mixed, by_precision_morton}))},
       {"as printed: by precision, the uniform hash is faster than no cache, up to 37,000 rays",
        where(less(warm_s, by_precision_uniform, none)), up_to(37000)},
       {"as printed: by precision, the mixed hash is faster than no cache, up to 37,000 rays",
        where(less(warm_s, by_precision_mixed, none)), up_to(37000)},
       {"as printed: by precision, the uniform hash takes noticeably more time than no cache at 61,000 rays",
        where(less(warm_s, none, by_precision_uniform, 1.05)), at_rays(61000)},
       {"as printed: by precision, the mixed hash takes noticeably more time than no cache at 61,000 rays",
        where(less(warm_s, none, by_precision_mixed, 1.05)), at_rays(61000)}});
}

Claims<CacheRow> printed_ordered_errors() {
  return repeated<CacheRow>(
      {{"as printed: the centroid is off farther by precision than by position, with the uniform hash",
        where(less(l2_m, by_position_uniform, by_precision_uniform))},
       {"as printed: around 5 m by precision with the uniform hash",
        mean_between(l2_m, by_precision_uniform, 4, 6, "m")},
       {"as printed: around 5 m by precision with the mixed hash", mean_between(l2_m, by_precision_mixed, 4, 6, "m")},
       {"as printed: sorting reduces the error by position",
        on_average(l2_m, by_position_mixed, unsorted(by_position_mixed), 0, 1)},
       {"as printed: sorting reduces the error by precision",
        on_average(l2_m, by_precision_mixed, unsorted(by_precision_mixed), 0, 1)}});
}

}  // namespace wavetracer::study
