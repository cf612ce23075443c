// Figures 6.10 to 6.18: what moves. Caches in traffic, purged by the transmitter's position or by precision, by hash;
// correlation between frames; orders while the transmitters move.
// Claims: A. Zhdanov, TU Munich, 2014, section 6.3.2.
#include <memory>
#include "study/cache_claims.hpp"
#include "study/experiment.hpp"
#include "study/order_claims.hpp"
#include "study/ray_counts.hpp"

namespace wavetracer::study {
namespace {

constexpr const char *none = "no cache", *position_uniform = "position uniform", *position_morton = "position Morton",
                     *position_mixed = "position mixed", *precision_uniform = "precision 0.0125 uniform",
                     *precision_morton = "precision 0.0125 Morton", *precision_mixed = "precision 0.0125 mixed",
                     *precision_of_errors = "precision 0.093 mixed";
std::string unsorted(const std::string& setting) { return "unsorted " + setting; }
std::string printed(const std::string& setting) { return "printed " + setting; }

// The thesis' caches of by_hash().
const std::vector<std::string> caches = {position_uniform,  position_morton,  position_mixed,
                                         precision_uniform, precision_morton, precision_mixed};

constexpr const char* frames_caption = "Correlation and common surfaces of frames against time";
constexpr const char* frames_paragraph =
    "The thesis finds subsequent frames of traffic to correlate by about 25% on average, from less than 5% to almost "
    "50%, by equation 6.4 (section 6.3.2, figure 6.13), which leaves open which points are paired and, as printed, is "
    "not divided by the root of three. Measured on {device}, {rays} rays of a transmitter that drives {moved} m "
    "through {world} in {frames} frames; subsequent ones are {apart} m apart. The last row is the share of "
    "rays for which a sequence of the first frame, {age} s old, still stands.";

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
  claims.push_back({"the gain grows with the number of rays", gain_grows("hilbert3d-histogram")});
  return claims;
}

Claims<FramePair> frame_claims() {
  return {{"subsequent frames correlate by more than 25%", correlate_more_than(0.25)}};
}

// All in order, and two of them also without.
std::vector<Setting> with_orders(std::vector<Setting> settings) {
  for (Setting& setting : settings) setting = with_order(setting);
  for (const Setting& setting : {position(3), precision(thesis_residual, 3)})
    settings.push_back({unsorted(setting.name), setting.apply});
  return settings;
}

const auto centroid_study = std::make_shared<const CacheStudy>(
    CacheStudy{.name = "centroids",
               .settings = {no_cache(), position(), precision(thesis_residual), as_printed(position()),
                            as_printed(precision(thesis_residual))},
               .rays = {claimed_many},
               .few_rays = {claimed_many},
               .drives = {"fixed", "moving", "thesis"},
               .centroids = true});
const auto purging = std::make_shared<const CacheStudy>(
    CacheStudy{.name = "purging",
               .settings = {no_cache(), position(), precision(thesis_residual), precision(thesis_residual_of_errors),
                            as_printed(position()), as_printed(precision(thesis_residual)),
                            as_printed(precision(thesis_residual_of_errors)), ours(), exact(), reuse_instead()},
               .rays = {1000, 5000, 10000, 20000, 30000, 49000, 70000, 90000, 200000, 500000, 900000},
               .few_rays = {1000, 10000, 49000},
               .drives = {"fixed", "moving", "thesis"}});
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

const std::vector<Experiment> traffic = {
    {.name = "figure-6.10",
     .doc = "traffic: distance of centroids with a cache from those without, frame by frame",
     .title = "Distance of centroids",
     .caption = "Distance of centroids and its running mean",
     .paragraph = "Figure 6.10 of the thesis shows its program at work: the centroids of two clouds of points, their "
                  "distance in the frame and its average so far (equations 6.2 and 6.3). Here both are drawn frame "
                  "by frame, of path vertices with a cache against none. Measured on {device} at {rays} rays.",
     .figure = CacheFigure{.study = centroid_study,
                           .view = centroids(
                               {position_mixed, precision_mixed, printed(position_mixed), printed(precision_mixed)})}},
    {.name = "figure-6.11",
     .doc = "traffic: time with position purging, precision purging and no cache",
     .title = "Frames in traffic by purging",
     .caption = "Average time of a frame against the number of rays",
     .paragraph = "The thesis finds the open table to take 10% less time than no cache for few and medium numbers of "
                  "rays and 15% for many if purged by position, 30% and 17% by precision 0.0125 (section 6.3.2, "
                  "figure 6.11). Measured on {device}.",
     .figure =
         CacheFigure{.study = purging,
                     .view = savings_by_rays,
                     .claims = {{"10% less time if purged by position", where(saves_percent(position_mixed, 10))},
                                {"15% less time if purged by position, for many rays",
                                 where(saves_percent(position_mixed, 15))},
                                {"17% less time if purged by precision", where(saves_percent(precision_mixed, 17))},
                                {"30% less time if purged by precision, for few and medium numbers of rays",
                                 where(saves_percent(precision_mixed, 30))},
                                {"less time by precision than by position",
                                 where(less(warm_s, precision_mixed, position_mixed))},
                                {"as printed: 10% less time if purged by position",
                                 where(saves_percent(printed(position_mixed), 10))},
                                {"as printed: 17% less time if purged by precision",
                                 where(saves_percent(printed(precision_mixed), 17))}}}},
    {.name = "figure-6.12",
     .doc = "traffic: error with position purging and precision purging",
     .title = "Errors in traffic by purging",
     .caption = "Error against the number of rays",
     .paragraph = "The thesis finds the centroid of the points to be off by 2 units at most if purged by position, "
                  "but for 8 at the first number of rays, and by 7 at most by precision 0.093, three times as far on "
                  "average, and leaves open what a unit is to a path (section 6.3.2, figure 6.12). Measured on "
                  "{device}, of path vertices in metres.",
     .figure =
         CacheFigure{
             .study = purging,
             .view = errors_by_rays,
             .claims = {{"off by 2 m at most if purged by position", where(at_most(l2_m, position_mixed, 2), l2_m)},
                        {"off by 7 m at most by precision 0.093", where(at_most(l2_m, precision_of_errors, 7), l2_m)},
                        {"off farther by precision than by position",
                         where(less(l2_m, position_mixed, precision_of_errors), l2_m)},
                        {"on average three times as far by precision as by position",
                         on_average(l2_m, precision_of_errors, position_mixed, 2.5, 3.5)},
                        {"reasonable, within 10% of the mean path, if purged by position",
                         where(at_most(l2_relative, position_mixed, 0.1), l2_m)},
                        {"reasonable, within 10% of the mean path, by precision 0.093",
                         where(at_most(l2_relative, precision_of_errors, 0.1), l2_m)},
                        {"as printed: off by 2 m at most if purged by position",
                         where(at_most(l2_m, printed(position_mixed), 2), l2_m)},
                        {"as printed: off by 7 m at most by precision 0.093",
                         where(at_most(l2_m, printed(precision_of_errors), 7), l2_m)},
                        {"as printed: on average three times as far by precision as by position",
                         on_average(l2_m, printed(precision_of_errors), printed(position_mixed), 2.5, 3.5)}}}},
    {.name = "figure-6.13",
     .doc = "correlation of what rays hit between 100 frames of a drive, as coherence-frames finds it",
     .title = "Correlation between frames",
     .caption = frames_caption,
     .paragraph = frames_paragraph,
     .figure = FrameFigure{.claims = frame_claims(), .frames = 100, .traffic = true}},
    {.name = "figure-6.14",
     .doc = "traffic: time by hash function",
     .title = "Frames in traffic by hash function",
     .caption = "Average time of a frame by hash function",
     .paragraph = "If purged by position, the thesis finds Morton codes 15% faster than the uniform hash from 20,000 "
                  "rays on, and the mixed one like the uniform; if purged by precision, Morton codes slower than no "
                  "cache (section 6.3.2, figure 6.14). Measured on {device}.",
     .figure = CacheFigure{.study = hashing,
                           .view = savings_by_rays,
                           .claims = {{"by position, Morton codes take 15% less time than the uniform hash",
                                       where(less(warm_s, position_morton, position_uniform, 1 / 0.85))},
                                      {"by position, the mixed hash takes the time of the uniform one",
                                       on_average(warm_s, position_mixed, position_uniform, 0.95, 1.05)},
                                      {"by precision, Morton codes take more time than no cache",
                                       where(less(warm_s, none, precision_morton))},
                                      {"by precision, the uniform hash takes the time of Morton codes by position",
                                       on_average(warm_s, precision_uniform, position_morton, 0.9, 1.1)},
                                      {"by precision, the mixed hash takes the time of Morton codes by position",
                                       on_average(warm_s, precision_mixed, position_morton, 0.9, 1.1)}}}},
    {.name = "figure-6.15",
     .doc = "traffic: error by hash function",
     .title = "Errors in traffic by hash function",
     .caption = "Error by hash function",
     .paragraph = "By position, the thesis finds the error with Morton codes on average twice that with the uniform "
                  "hash, and the mixed one's like the uniform's; by precision, Morton codes the most accurate "
                  "(section 6.3.2, figure 6.15). Its lookups do not compare keys, so that collisions of a hash are "
                  "errors; in tables \"printed\" they are so here, in ours they are misses, and a hash decides only "
                  "which segments find room. Measured on "
                  "{device}.",
     .figure =
         CacheFigure{
             .study = hashing,
             .view = errors_by_rays,
             .claims = {{"by position, the centroid is off farther with Morton codes than with the uniform hash",
                         where(less(l2_m, position_uniform, position_morton))},
                        {"by position, twice as far off with Morton codes as with the uniform hash",
                         where(less(l2_m, position_uniform, position_morton, 2))},
                        {"by position, as far with the mixed hash as with the uniform one",
                         on_average(l2_m, position_mixed, position_uniform, 0.8, 1.25)},
                        {"by precision, less far with Morton codes than with the uniform hash",
                         where(less(l2_m, precision_morton, precision_uniform))},
                        {"by precision, as far with the mixed hash as with the uniform one",
                         on_average(l2_m, precision_mixed, precision_uniform, 0.8, 1.25)},
                        {"as printed: by position, twice as far off with Morton codes as with the uniform hash",
                         on_average(l2_m, printed(position_morton), printed(position_uniform), 1.5, 2.5)},
                        {"as printed: by position, as far with the mixed hash as with the uniform one",
                         on_average(l2_m, printed(position_mixed), printed(position_uniform), 0.8, 1.25)},
                        {"as printed: by precision, less far with Morton codes than with the uniform hash",
                         on_average(l2_m, printed(precision_morton), printed(precision_uniform), 0, 1)}}}},
    {.name = "figure-6.16",
     .doc = "traffic: time by hash function, rays in order",
     .title = "Frames in traffic by hash function, rays in order",
     .caption = "Average time of a frame by hash function, rays in order",
     .paragraph = "With rays in order (here H3DH; the thesis does not say which), the thesis finds caches to save "
                  "nothing, but those by precision with "
                  "the uniform and the mixed hash up to some 37,000 rays (section 6.3.2, figure 6.16). Measured on "
                  "{device}.",
     .figure = CacheFigure{.study = hashing_ordered,
                           .view = savings_by_rays,
                           .claims = {{"one of the caches saves time", where(saves(caches))},
                                      {"by precision, the uniform hash is faster than no cache",
                                       where(less(warm_s, precision_uniform, none))},
                                      {"by precision, the mixed hash is faster than no cache",
                                       where(less(warm_s, precision_mixed, none))}}}},
    {.name = "figure-6.17",
     .doc = "traffic: error by hash function, rays in order",
     .title = "Errors in traffic by hash function, rays in order",
     .caption = "Error by hash function, rays in order",
     .paragraph =
         "With rays in order, the thesis finds the error of the caches that save time, those by precision "
         "with the uniform and the mixed hash, to hover around 5 units, more than by position, and sorting "
         "to reduce the error slightly (section 6.3.2, figure 6.17, and its fourth conclusion). Measured on {device}.",
     .figure =
         CacheFigure{
             .study = hashing_ordered,
             .view = errors_by_rays,
             .claims = {{"the centroid is off farther by precision than by position, with the uniform hash",
                         where(less(l2_m, position_uniform, precision_uniform))},
                        {"around 5 m by precision with the uniform hash",
                         mean_between(l2_m, precision_uniform, 4, 6, "m")},
                        {"around 5 m by precision with the mixed hash", mean_between(l2_m, precision_mixed, 4, 6, "m")},
                        {"sorting reduces the error by position",
                         on_average(l2_m, position_mixed, unsorted(position_mixed), 0, 1)},
                        {"sorting reduces the error by precision",
                         on_average(l2_m, precision_mixed, unsorted(precision_mixed), 0, 1)}}}},
    {.name = "figure-6.18",
     .doc = "traffic: average time of a frame while the transmitters move, reordered against not",
     .title = "Frames in traffic, with reordering and without",
     .caption = "Time a ray against the number of rays",
     .paragraph = "Without a cache, the thesis finds reordering to take 23% less time than no reordering (WS) at "
                  "1,000 rays and almost 60% less, 2.5 times the speed, at 49,000, and the gain to grow with the "
                  "number of rays (section 6.3.2, figure 6.18). Measured on {device}, averaged over {frames} frames "
                  "of traffic whose transmitters move.{reason} Rays born in order need no sort.",
     .figure = OrderFigure{.series = {unordered(), ordered("hilbert3d-histogram"), born_ordered()},
                           .moves = true,
                           .claims = moving_gains()}},
    {.name = "coherence-frames",
     .doc = "correlation of what rays hit between the frames of a drive, bounce by bounce",
     .title = "Coherence between frames",
     .caption = frames_caption,
     .paragraph = frames_paragraph,
     .figure = FrameFigure{.claims = frame_claims()}},
};

}  // namespace

const std::vector<Experiment>& traffic_figures() { return traffic; }

}  // namespace wavetracer::study
