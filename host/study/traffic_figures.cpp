// SPDX-License-Identifier: Apache-2.0
// Figures 6.10 to 6.13, and coherence-frames: caches in traffic, whose entries expire by the transmitter's position or
// by precision; correlation between frames.
// Claims: A. Zhdanov, TU Munich, 2014, section 6.3.2.
#include <memory>
#include "study/cache_claims.hpp"
#include "study/experiment.hpp"
#include "study/ray_counts.hpp"
#include "study/traffic_settings.hpp"

namespace wavetracer::study {
namespace {

constexpr const char* frames_caption = "Correlation and common surfaces of frames against time";
constexpr const char* frames_paragraph =
    "The thesis finds subsequent frames of traffic to correlate by about 25% on average, "
    "from less than 5% to almost 50%, by equation 6.4 (section 6.3.2, figure 6.13), which leaves open "
    "which points are paired and, as printed, is not divided by the root of three. Measured on {device}, "
    "{rays} rays of a transmitter that drives {moved} m through {world} in {frames} frames; "
    "subsequent ones are {apart} m apart. The last row is the share of rays for which a sequence of "
    "the first frame, {age} s old, still stands.";

// The numbers of rays of figures 6.11 and 6.12; few and medium ones of them, and many.
constexpr Range traffic_range{1000, 90000}, few_and_medium{1000, 50000}, many{70000, 90000}, after_first{1001, 90000};
const ValueForm metres = unit_form("m");

Claims<FramePair> frame_claims() {
  return {{"subsequent frames correlate by about 25% on average: 20 to 30%", correlate_on_average(0.2, 0.3)},
          {"the correlation falls below 5%", correlation_falls_below(0.05)},
          {"the correlation rises to almost 50%, and no further", correlation_rises_to(0.5)}};
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
const std::vector<Experiment> traffic = {
    {.name = "figure-6.10",
     .doc = "traffic: distance of centroids with a cache from those without, frame by frame",
     .title = "Distance of centroids",
     .caption = "Distance of centroids and its running mean",
     .paragraph = "Figure 6.10 of the thesis shows its program at work: the centroids of two clouds of points, "
                  "their distance in the frame and its average so far (equations 6.2 and 6.3). "
                  "Here both are drawn frame by frame, of path vertices with a cache against none. "
                  "Measured on {device} at {rays} rays.",
     .figure = CacheFigure{.study = centroid_study,
                           .view = centroids(
                               {position_mixed, precision_mixed, printed(position_mixed), printed(precision_mixed)})}},
    {.name = "figure-6.11",
     .doc = "traffic: time with position purging, precision purging and no cache",
     .title = "Frames in traffic by purging",
     .caption = "Average time of a frame against the number of rays",
     .paragraph = "The thesis finds the open table to take 10% less time than no cache for few and medium numbers "
                  "of rays and 15% for many if purged by position, 30% and 17% by precision 0.0125 (section 6.3.2, "
                  "figure 6.11). Measured on {device}.",
     .figure =
         CacheFigure{
             .study = purging,
             .view = savings_by_rays,
             .claims =
                 {{"constantly less time than no cache if purged by position", where(saves({position_mixed}))},
                  {"the difference grows with the number of rays if purged by position", saving_grows(position_mixed)},
                  {"10% less time if purged by position, for small and medium numbers of rays (up to 50,000)",
                   where_saved(position_mixed, 10), few_and_medium},
                  {"15% less time if purged by position, for many rays (from 70,000 to 90,000)",
                   where_saved(position_mixed, 15), many},
                  {"17% less time if purged by precision, for many rays (from 70,000 to 90,000)",
                   where_saved(precision_mixed, 17), many},
                  {"30% less time if purged by precision, for few and medium numbers of rays (up to 50,000)",
                   where_saved(precision_mixed, 30), few_and_medium},
                  {"less time than no cache if purged by precision", where(saves({precision_mixed}))},
                  {"less time by precision than by position", where(less(warm_s, precision_mixed, position_mixed))},
                  {"as printed: 10% less time if purged by position", where_saved(printed(position_mixed), 10),
                   few_and_medium, Origin::repetition},
                  {"as printed: 17% less time if purged by precision", where_saved(printed(precision_mixed), 17), many,
                   Origin::repetition}},
             .range = traffic_range}},
    {.name = "figure-6.12",
     .doc = "traffic: error with position purging and precision purging",
     .title = "Errors in traffic by purging",
     .caption = "Error against the number of rays",
     .paragraph = "The thesis finds the centroid of the points to be off by 2 units at most if purged by position, "
                  "but for 8 at the first number of rays, and by 7 at most by precision 0.093, "
                  "three times as far on average, and leaves open what a unit is to a path (section 6.3.2, "
                  "figure 6.12). Measured on {device}, of path vertices in metres.",
     .figure =
         CacheFigure{
             .study = purging,
             .view = errors_by_rays,
             .claims =
                 {{"off by some 8 m if purged by position, at the first number of rays",
                   value_between(l2_m, position_mixed, 6, 10, "m"), at_rays(1000)},
                  {"off by 2 m at most if purged by position, beyond the first number of rays",
                   where(at_most(l2_m, position_mixed, 2, metres)), after_first},
                  {"off by 7 m at most by precision 0.093", where(at_most(l2_m, precision_of_errors, 7, metres))},
                  {"off farther by precision than by position", where(less(l2_m, position_mixed, precision_of_errors))},
                  {"on average three times as far by precision as by position",
                   on_average(l2_m, precision_of_errors, position_mixed, 2.5, 3.5)},
                  {"reasonable, within 10% of the mean path, if purged by position",
                   where(at_most(l2_relative, position_mixed, 0.1, share_form()))},
                  {"reasonable, within 10% of the mean path, by precision 0.093",
                   where(at_most(l2_relative, precision_of_errors, 0.1, share_form()))},
                  {"as printed: off by some 8 m if purged by position, at the first number of rays",
                   value_between(l2_m, printed(position_mixed), 6, 10, "m"), at_rays(1000), Origin::repetition},
                  {"as printed: off by 2 m at most if purged by position, beyond the first number of rays",
                   where(at_most(l2_m, printed(position_mixed), 2, metres)), after_first, Origin::repetition},
                  {"as printed: off by 7 m at most by precision 0.093",
                   where(at_most(l2_m, printed(precision_of_errors), 7, metres)), traffic_range, Origin::repetition},
                  {"as printed: on average three times as far by precision as by position",
                   on_average(l2_m, printed(precision_of_errors), printed(position_mixed), 2.5, 3.5), traffic_range,
                   Origin::repetition}},
             .range = traffic_range}},
    {.name = "figure-6.13",
     .doc = "correlation of what rays hit between 100 frames of a drive, as coherence-frames finds it",
     .title = "Correlation between frames",
     .caption = frames_caption,
     .paragraph = frames_paragraph,
     .figure = FrameFigure{.claims = frame_claims(), .frames = 100, .traffic = true}},
    {.name = "coherence-frames",
     .doc = "correlation of what rays hit between the frames of a drive, bounce by bounce",
     .title = "Coherence between frames",
     .caption = frames_caption,
     .paragraph = frames_paragraph,
     .figure = FrameFigure{.claims = repeated(frame_claims())}},
};

}  // namespace

const std::vector<Experiment>& traffic_figures() { return traffic; }

}  // namespace wavetracer::study
