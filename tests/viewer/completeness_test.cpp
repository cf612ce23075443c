// SPDX-License-Identifier: Apache-2.0
// Tests that pages name paths that may be missing. Writes pages that special_page.py opens.
#include <doctest/doctest.h>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include "base/file.hpp"
#include "folders.hpp"
#include "viewer/made_runs.hpp"
#include "viewer/view.hpp"

using namespace wavetracer;
namespace fs = std::filesystem;

namespace {

// Makes a run of two frames and its page, and returns what the page knows.
nlohmann::json page_of(test::MadeRun::Found found, const char* name) {
  const fs::path run = fs::path(test::build_folder()) / "tests" / "viewer" / name;
  test::write_made_run({.frames = 2, .found = found}, run);
  const std::string html = make_view(SavedRun(run), {}).html;
  write_file(run / "view.html", html);
  const std::string begin = "<script type=\"application/json\" id=\"meta\">";
  const size_t from = html.find(begin) + begin.size();
  return nlohmann::json::parse(html.substr(from, html.find("</script>", from) - from));
}

}  // namespace

TEST_CASE("the page has the certificate of beams, or says that it is not known what rays have missed") {
  using Found = test::MadeRun::Found;
  const nlohmann::json told = page_of(Found::rays, "rays_tell");
  CHECK(told["missed"].is_object());
  CHECK(told["missed_unknown"] == "");
  CHECK(told["certificate"].is_null());
  const nlohmann::json sparse = page_of(Found::sparse_rays, "sparse");
  CHECK(sparse["missed"].is_null());
  CHECK(sparse["missed_unknown"].get<std::string>().starts_with("the rays do not show it"));
  CHECK(sparse["certificate"].is_null());
  const nlohmann::json beams = page_of(Found::beams, "beams");
  CHECK(beams["missed"].is_null());
  CHECK(beams["missed_unknown"] == "");
  CHECK(beams["certificate"]["depth"] == 5);
  CHECK(beams["certificate"]["left_out_sr"] == 0x1p-29);
  CHECK(beams["certificate"]["left_out_share"] == doctest::Approx(0x1p-29 / (6 * 4 * std::acos(-1.0))));
  CHECK(beams["certificate"]["any_depth"] == true);
  CHECK(beams["certificate"]["edges"] == 2);
  CHECK(beams["certificate"]["left_out_power"] == 1e-11);
  CHECK(beams["certificate"]["floor_db"] == -120);
  CHECK(beams["certificate"]["weak_share"] == doctest::Approx(0.01).epsilon(0.01));
}
