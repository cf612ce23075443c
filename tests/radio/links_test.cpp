// Link figures against figures worked by hand.
// Rows are written down without any tracing.
#include "radio/links.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "radio/world.hpp"

using namespace wavetracer;

namespace {

void add(Paths& paths, uint32_t tx, uint32_t rx, uint32_t depth, double delay_s, double amplitude, double doppler_hz) {
  paths.frame.push_back(0);
  paths.tx.push_back(tx);
  paths.rx.push_back(rx);
  paths.depth.push_back(depth);
  paths.delay_s.push_back(delay_s);
  paths.a.push_back({amplitude, 0.0, 0.0, 0.0});
  paths.doppler_hz.push_back(doppler_hz);
}

}  // namespace

TEST_CASE("gain, mean delay and spreads are weighted by power") {
  Paths paths;
  add(paths, 0, 1, 0, 1e-6, 2e-5, 100);  // powers 4 : 1
  add(paths, 0, 1, 2, 2e-6, 1e-5, -100);
  add(paths, 1, 0, 3, 3e-6, 1e-5, 7);
  const std::vector<LinkFigures> links = link_figures(paths, 0, 2, 2);
  REQUIRE(links.size() == 4);
  for (size_t i = 0; i < 4; ++i) {
    CHECK(links[i].tx == i / 2);
    CHECK(links[i].rx == i % 2);
  }
  const LinkFigures& two = links[1];
  CHECK(two.paths == 2);
  CHECK(two.los);
  CHECK(two.path_gain_db == test::near(10 * std::log10(5e-10), 1e-13));
  CHECK(two.mean_delay_s == test::near(1.2e-6, 1e-13));
  CHECK(two.rms_delay_spread_s == test::near(0.4e-6, 1e-12));
  CHECK(two.doppler_spread_hz == test::near(80, 1e-12));

  const LinkFigures& single = links[2];
  CHECK(single.paths == 1);
  CHECK_FALSE(single.los);
  CHECK(single.mean_delay_s == 3e-6);
  CHECK(single.rms_delay_spread_s == 0);
  CHECK(single.doppler_spread_hz == 0);
}

TEST_CASE("all ports count") {
  Paths paths;
  add(paths, 0, 0, 1, 1e-6, 3e-5, 0);
  paths.a[0][3] = {0, 4e-5};
  CHECK(link_figures(paths, 0, 1, 1)[0].path_gain_db == test::near(20 * std::log10(5e-5), 1e-13));
}

TEST_CASE("a link without a path, and one without power, are there and say so") {
  Paths paths;
  add(paths, 0, 1, 0, 1e-6, 0, 0);
  const std::vector<LinkFigures> links = link_figures(paths, 0, 1, 2);
  REQUIRE(links.size() == 2);
  for (const LinkFigures& link : links) {
    CHECK(std::isinf(link.path_gain_db));
    CHECK(link.path_gain_db < 0);
    CHECK(std::isnan(link.mean_delay_s));
    CHECK(std::isnan(link.rms_delay_spread_s));
    CHECK(std::isnan(link.doppler_spread_hz));
  }
  CHECK(links[0].paths == 0);
  CHECK_FALSE(links[0].los);
  CHECK(links[1].paths == 1);
  CHECK(links[1].los);
}

TEST_CASE("rows of other frames are passed over") {
  Paths paths;
  add(paths, 0, 0, 0, 1e-6, 1e-5, 0);
  add(paths, 0, 0, 1, 2e-6, 1e-5, 0);
  paths.frame[1] = 3;
  CHECK(link_figures(paths, 0, 1, 1)[0].mean_delay_s == 1e-6);
  CHECK(link_figures(paths, 3, 1, 1)[0].mean_delay_s == 2e-6);
  CHECK(link_figures(paths, 3, 1, 1)[0].frame == 3);
  CHECK(link_figures(paths, 1, 1, 1)[0].paths == 0);
}

TEST_CASE("spreads keep their digits beside a long delay") {
  Paths paths;
  add(paths, 0, 0, 0, 1e-3, 1e-5, 0);
  add(paths, 0, 0, 1, 1e-3 + 1e-12, 1e-5, 0);
  CHECK(link_figures(paths, 0, 1, 1)[0].rms_delay_spread_s == test::near(0.5e-12, 1e-6));
}
