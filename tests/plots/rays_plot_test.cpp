// SPDX-License-Identifier: Apache-2.0
// Sampled rays from above: segments and centroids of rows that can be counted by hand, and the figure of a run.
#include "plots/rays_plot.hpp"
#include <doctest/doctest.h>
#include <filesystem>
#include "output/sample_run.hpp"
#include "plots/plots.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/output.hpp"

using namespace wavetracer;
using namespace wavetracer::plots;

namespace {

// Three rays from (0, 0, 9): one that meets (1, 0, 0), passes a receiver and meets (1, 2, 0), one that meets (3, 0, 0)
// and is lost, one that is lost at once.
WaypointRows three_rays() {
  using enum WaypointKind;
  using Source = WaypointSource;
  WaypointRows rows;
  const auto add = [&](uint64_t sample, uint32_t depth, WaypointKind kind, glm::dvec3 at, Source source) {
    rows.frame.push_back(0);
    rows.tx.push_back(0);
    rows.sample.push_back(sample);
    rows.depth.push_back(depth);
    rows.kind.push_back(kind);
    rows.position_m.push_back(at);
    rows.surface.push_back(no_surface);
    rows.instance.push_back(no_instance);
    rows.source.push_back(source);
  };
  add(1, 0, launch, {0, 0, 9}, Source::launch);
  add(1, 1, reflection, {1, 0, 0}, Source::traced);
  add(1, 2, hit, {7, 7, 7}, Source::cache);
  add(1, 2, reflection, {1, 2, 0}, Source::cache);
  add(2, 0, launch, {0, 0, 9}, Source::launch);
  add(2, 1, reflection, {3, 0, 0}, Source::cache);
  add(2, 2, miss, {3, 0, 1}, Source::traced);
  add(3, 0, launch, {0, 0, 9}, Source::launch);
  add(3, 1, miss, {0, 0, 10}, Source::traced);
  return rows;
}

}  // namespace

TEST_CASE("segments lead from point to point, without receivers and the metre behind a miss") {
  const std::vector<RaySegment> all = ray_segments(three_rays(), 1);
  REQUIRE(all.size() == 3);
  CHECK(all[0].x1 == 1);
  CHECK(all[0].number == 1);
  CHECK(all[1].x0 == 1);
  CHECK(all[1].y1 == 2);
  CHECK(all[1].number == 2);
  CHECK(all[1].source == WaypointSource::cache);
  CHECK(all[2].x0 == 0);
  CHECK(all[2].x1 == 3);
  CHECK(ray_segments(three_rays(), 2).size() == 2);  // the first and the third ray are drawn
}

TEST_CASE("centroids are those of the hits of a segment") {
  const std::vector<RayCentroid> centroids = ray_centroids(three_rays());
  REQUIRE(centroids.size() == 2);
  CHECK(centroids[0].hits == 2);
  CHECK(centroids[0].answered == 1);
  CHECK(centroids[0].position_m == glm::dvec3{2, 0, 0});
  CHECK(centroids[1].number == 2);
  CHECK(centroids[1].answered == 1);
  CHECK(centroids[1].position_m == glm::dvec3{1, 2, 0});
}

TEST_CASE("the figure's tables hold them, and a run without paths still has rays") {
  const Figure figure = rays_figure(three_rays(), ", 2 s", {});
  CHECK(figure.title == "Sampled rays, 2 s");
  CHECK(figure.data[0].text == "x0_m,y0_m,x1_m,y1_m,segment,source\n0,0,1,0,1,1\n1,0,1,2,2,2\n0,0,3,0,1,2\n");
  CHECK(figure.data[1].text == "segment,hits,answered,x_m,y_m,z_m\n1,2,1,2,0,0\n2,1,1,1,2,0\n");
  const test::TemporaryFolder folder;
  SampleRun sample;
  sample.config.output.waypoints = 3;
  std::vector<FrameResult> frames = sample.empty();
  frames.front().waypoints = three_rays();
  write_outputs(folder.path() / "run", sample.run(), frames);
  PlotChoice choice;
  choice.what = {"rays"};
  const PlotReport report = plot_run(SavedRun(folder.path() / "run"), choice, folder.path() / "plots");
  CHECK(std::filesystem::exists(folder.path() / "plots" / "rays.csv"));
  CHECK(std::filesystem::exists(folder.path() / "plots" / "rays.gp"));
}
