// SPDX-License-Identifier: Apache-2.0
// Claims: A. Zhdanov, TU Munich, 2014, section 6.3.2.
#include "study/hash_claims.hpp"

#include "study/traffic_settings.hpp"

namespace wavetracer::study {
namespace {

std::string itself(const std::string& setting) { return setting; }

}  // namespace

Claims<CacheRow> hash_times(SettingName* of) {
  // Those that the thesis finds faster than no cache, and all others that its figure shows.
  const std::vector<std::string> faster = {of(position_uniform), of(position_morton), of(position_mixed),
                                           of(precision_uniform), of(precision_mixed)};
  std::vector<std::string> others = faster;
  others.push_back(none);
  return {{"by precision, Morton codes take the most time of all", where(slowest_is(of(precision_morton), others))},
          {"the second worst is no cache: all others save time", where(all_save(faster))},
          {"by position, the uniform hash takes less time than no cache", where(saves({of(position_uniform)})),
           std::nullopt, Origin::repetition},
          {"by position, Morton codes take 15% less time than the uniform hash, from 20,000 rays on",
           where(less(warm_s, of(position_morton), of(position_uniform), 1 / 0.85)), Range{20000, 49000}},
          {"by position, the mixed hash takes the time of the uniform one",
           on_average(warm_s, of(position_mixed), of(position_uniform), 0.95, 1.05)},
          {"by precision, Morton codes take more time than no cache", where(less(warm_s, none, of(precision_morton)))},
          {"by precision, the mixed hash takes the time of the uniform one",
           on_average(warm_s, of(precision_mixed), of(precision_uniform), 0.95, 1.05)},
          {"by precision, the uniform hash takes the time of Morton codes by position",
           on_average(warm_s, of(precision_uniform), of(position_morton), 0.9, 1.1)},
          {"by precision, the mixed hash takes the time of Morton codes by position",
           on_average(warm_s, of(precision_mixed), of(position_morton), 0.9, 1.1)}};
}

Claims<CacheRow> ordered_times(SettingName* of) {
  return {{"caches by position, and by precision with Morton codes, save no time",
           where(saves_not({of(position_uniform), of(position_morton), of(position_mixed), of(precision_morton)}))},
          {"by precision, the uniform hash is faster than no cache, up to 37,000 rays",
           where(less(warm_s, of(precision_uniform), none)), up_to(37000)},
          {"by precision, the mixed hash is faster than no cache, up to 37,000 rays",
           where(less(warm_s, of(precision_mixed), none)), up_to(37000)},
          {"by precision, the uniform hash takes noticeably more time than no cache at 61,000 rays",
           where(less(warm_s, none, of(precision_uniform), 1.05)), at_rays(61000)},
          {"by precision, the mixed hash takes noticeably more time than no cache at 61,000 rays",
           where(less(warm_s, none, of(precision_mixed), 1.05)), at_rays(61000)}};
}

Claims<CacheRow> ordered_errors(SettingName* of) {
  return {{"the centroid is off farther by precision than by position, with the uniform hash",
           where(less(l2_m, of(position_uniform), of(precision_uniform)))},
          {"around 5 m by precision with the uniform hash", mean_between(l2_m, of(precision_uniform), 4, 6, "m")},
          {"around 5 m by precision with the mixed hash", mean_between(l2_m, of(precision_mixed), 4, 6, "m")},
          {"sorting reduces the error by position",
           on_average(l2_m, of(position_mixed), unsorted(of(position_mixed)), 0, 1)},
          {"sorting reduces the error by precision",
           on_average(l2_m, of(precision_mixed), unsorted(of(precision_mixed)), 0, 1)}};
}

Claims<CacheRow> with_printed(Claims<CacheRow> (*claims)(SettingName*), const Claims<CacheRow>& further) {
  Claims<CacheRow> out = claims(itself), as_printed = repeated(claims(printed));
  for (Claim<CacheRow>& claim : as_printed) claim.words = "as printed: " + claim.words;
  out.insert(out.end(), further.begin(), further.end());
  out.insert(out.end(), as_printed.begin(), as_printed.end());
  return out;
}

}  // namespace wavetracer::study
