// SPDX-License-Identifier: Apache-2.0
// Sampled rays and vegetation on the page of a run. Writes the pages that rays_page.py and vegetation_page.py open.
#include <doctest/doctest.h>
#include <filesystem>
#include <nlohmann/json.hpp>
#include "base/file.hpp"
#include "folders.hpp"
#include "output/sample_run.hpp"
#include "viewer/frame_blocks.hpp"
#include "viewer/made_runs.hpp"
#include "viewer/view.hpp"

using namespace wavetracer;
namespace fs = std::filesystem;

namespace {

const fs::path pages = fs::path(test::build_folder()) / "tests" / "viewer";

}  // namespace

TEST_CASE("sampled rays: on the page where a run holds them, and thinned out where they do not fit") {
  test::write_made_rays(pages / "rays");
  const ViewPage page = make_view(SavedRun(pages / "rays"), {});
  write_file(pages / "rays" / "view.html", page.html);
  CHECK(page.warnings == std::vector<std::string>{});
  CHECK(page.html.find("\"rays\":{\"highest_depth\":3,\"points\":[7,7],\"sources\":true}") != std::string::npos);
  const SampleRun sample;
  write_outputs(pages / "without_rays", sample.run(), sample.empty());
  CHECK(make_view(SavedRun(pages / "without_rays"), {}).html.find("\"rays\":null") != std::string::npos);
  std::string elements;
  const SavedWaypoints waypoints(pages / "rays" / "waypoints.h5");
  // 16 rows in 8 points' room: every second ray.
  const RayBlocks half = add_ray_blocks(waypoints, {0, 1}, {0, 0, 0}, 8 * 20, elements);
  CHECK(half.frames == nlohmann::json{4, 4});
  CHECK(half.warning.find("one of every 2 sampled rays") != std::string::npos);
  CHECK(half.highest_depth == 3);
  // Fewer frames have room for more of their rays, as the warning says.
  const RayBlocks one_frame = add_ray_blocks(waypoints, {1}, {0, 0, 0}, 8 * 20, elements);
  CHECK(one_frame.frames == nlohmann::json{7});
  CHECK(one_frame.warning.empty());
}

TEST_CASE("vegetation has triangles of its own, by material; a page without it has none") {
  const std::string trees =
      "generate = \"--seed 1 --blocks 2x2\"\n[[vegetation]]\ncentre_m = [-26.0, 2.0, 4.0]\nsize_m = [12.0, 10.0, 8.0]\n"
      "[[vegetation]]\nshape = \"box\"\ncentre_m = [20.0, 0.0, 1.0]\nsize_m = [2.0, 8.0, 2.0]\n"
      "material = \"deciduous_vegetation\"\n";
  test::write_made_run({.frames = 1, .scene = trees}, pages / "green");
  const ViewPage page = make_view(SavedRun(pages / "green"), {});
  write_file(pages / "green" / "view.html", page.html);
  CHECK(page.warnings.empty());
  CHECK(page.html.find(R"("vegetation":[["vegetation",224],["deciduous_vegetation",16]])") != std::string::npos);
  CHECK(page.html.find("id=\"block_vegetation\"") != std::string::npos);
  const std::string without = make_view(SavedRun(pages / "without_rays"), {}).html;
  CHECK(without.find("\"vegetation\":[]") != std::string::npos);
  CHECK(without.find("id=\"block_vegetation\"") == std::string::npos);
}
