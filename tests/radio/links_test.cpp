// SPDX-License-Identifier: Apache-2.0
// Link figures against figures worked by hand.
// Rows are written down without any tracing.
#include "radio/links.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "radio/link_budget.hpp"
#include "radio/world.hpp"

using namespace wavetracer;

namespace {

constexpr double carrier_hz = 5.9e9;

void add(Paths& paths, uint32_t tx, uint32_t rx, uint32_t depth, double delay_s, double amplitude, double doppler_hz) {
  paths.frame.push_back(0);
  paths.tx.push_back(tx);
  paths.rx.push_back(rx);
  paths.depth.push_back(depth);
  paths.delay_s.push_back(delay_s);
  paths.a.push_back({amplitude, 0.0, 0.0, 0.0});
  paths.doppler_hz.push_back(doppler_hz);
}

// All pairs of so many ends.
std::vector<Link> all_links(uint32_t tx_count, uint32_t rx_count) {
  std::vector<Link> links;
  for (uint32_t tx = 0; tx < tx_count; ++tx)
    for (uint32_t rx = 0; rx < rx_count; ++rx) links.push_back({tx, rx});
  return links;
}

}  // namespace

TEST_CASE("gain, mean delay and spreads are weighted by power") {
  Paths paths;
  add(paths, 0, 1, 0, 1e-6, 2e-5, 100);  // powers 4 : 1
  add(paths, 0, 1, 2, 2e-6, 1e-5, -100);
  add(paths, 1, 0, 3, 3e-6, 1e-5, 7);
  const std::vector<LinkFigures> links = link_figures(paths, 0, all_links(2, 2), carrier_hz);
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
  CHECK(link_figures(paths, 0, all_links(1, 1), carrier_hz)[0].path_gain_db ==
        test::near(20 * std::log10(5e-5), 1e-13));
}

TEST_CASE("a link without a path, and one without power, are there and say so") {
  Paths paths;
  add(paths, 0, 1, 0, 1e-6, 0, 0);
  const std::vector<LinkFigures> links = link_figures(paths, 0, all_links(1, 2), carrier_hz);
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
  CHECK(link_figures(paths, 0, all_links(1, 1), carrier_hz)[0].mean_delay_s == 1e-6);
  CHECK(link_figures(paths, 3, all_links(1, 1), carrier_hz)[0].mean_delay_s == 2e-6);
  CHECK(link_figures(paths, 3, all_links(1, 1), carrier_hz)[0].frame == 3);
  CHECK(link_figures(paths, 1, all_links(1, 1), carrier_hz)[0].paths == 0);
}

TEST_CASE("spreads keep their digits beside a long delay") {
  Paths paths;
  add(paths, 0, 0, 0, 1e-3, 1e-5, 0);
  add(paths, 0, 0, 1, 1e-3 + 1e-12, 1e-5, 0);
  CHECK(link_figures(paths, 0, all_links(1, 1), carrier_hz)[0].rms_delay_spread_s == test::near(0.5e-12, 1e-6));
}

TEST_CASE("only the links that are asked for, each with its own rows") {
  Paths paths;
  for (uint32_t tx = 0; tx < 3; ++tx)
    for (uint32_t rx = 0; rx < 3; ++rx)
      for (uint32_t i = 0; i <= tx; ++i) add(paths, tx, rx, i, 1e-6 * (10 * tx + rx + 1), 1e-5, 0);
  const std::vector<LinkFigures> links =
      link_figures(paths, 0, std::vector<Link>{{0, 2}, {2, 0}, {2, 1}, {3, 0}}, carrier_hz);
  REQUIRE(links.size() == 4);
  CHECK(links[0].tx == 0);
  CHECK(links[0].rx == 2);
  CHECK(links[0].paths == 1);
  CHECK(links[0].mean_delay_s == test::near(3e-6, 1e-13));
  CHECK(links[1].paths == 3);
  CHECK(links[1].mean_delay_s == test::near(21e-6, 1e-13));
  CHECK(links[2].rx == 1);
  CHECK(links[2].mean_delay_s == test::near(22e-6, 1e-13));
  CHECK(links[3].paths == 0);
}

TEST_CASE("figures of many links are those of each link alone") {
  Paths paths;
  std::vector<Link> links;
  for (uint32_t tx = 0; tx < 100; ++tx)
    for (uint32_t rx = 0; rx < 100; ++rx) {
      if ((tx * 7 + rx * 3) % 5 > 0) links.push_back({tx, rx});
      for (uint32_t i = 0; i < (tx + rx) % 4; ++i)
        add(paths, tx, rx, i, 1e-9 * (tx + 2 * rx + 3 * i), 1e-5 / (1 + i), i);
    }
  const std::vector<LinkFigures> all = link_figures(paths, 0, links, carrier_hz);
  REQUIRE(all.size() == links.size());
  for (size_t i = 0; i < links.size(); i += 97) {
    Paths alone;
    for (uint32_t k = 0; k < (links[i].tx + links[i].rx) % 4; ++k)
      add(alone, links[i].tx, links[i].rx, k, 1e-9 * (links[i].tx + 2 * links[i].rx + 3 * k), 1e-5 / (1 + k), k);
    const LinkFigures one = link_figures(alone, 0, std::vector{links[i]}, carrier_hz)[0];
    CHECK(all[i].paths == one.paths);
    if (one.paths > 0) CHECK(all[i].rms_delay_spread_s == one.rms_delay_spread_s);
  }
}

TEST_CASE("what a link misses is estimated from its own paths; nothing where it is not known who found them") {
  Paths paths;
  for (uint32_t i = 0; i < 3; ++i) add(paths, 0, 0, i, 1e-6 * (1 + i), 1e-5, 0);
  add(paths, 0, 1, 1, 1e-6, 1e-5, 0);
  CHECK(std::isnan(link_figures(paths, 0, all_links(1, 2), carrier_hz)[0].missed_power_share));
  for (uint32_t i = 0; i < 4; ++i) paths.depth[i] = 1;
  paths.quarters = {0b1111, 0b0001, 0b0010, 0b1110};
  const std::vector<LinkFigures> links = link_figures(paths, 0, all_links(1, 3), carrier_hz);
  // A path that one quarter of four found stands for (3/4)^4 / (1 - (3/4)^4) paths that none found, one that three
  // found for 1/255.
  const double once = 81.0 / 175, alike = (3.0 / 8 * 2 / once + 5) / 5;
  CHECK(links[0].missed_power_share == test::near(alike * 2 * once / 3, 1e-12));
  CHECK(links[1].missed_power_share == test::near(1.0 / 255, 1e-12));
  CHECK(std::isnan(links[2].missed_power_share));
}

// This is a two-ray ground: E = exp(-j k d1) / d1 + R exp(-j k d2) / d2, from the geometry alone.
TEST_CASE("two rays: path gain adds powers, narrowband gain adds fields, as in closed form") {
  const double c = 299792458.0, lambda = c / carrier_hz, pi = std::acos(-1.0);
  for (const double distance_m : {10.0, 33.3, 100.0, 517.0}) {
    CAPTURE(distance_m);
    const double direct_m = distance_m, reflected_m = std::hypot(distance_m, 2 * 1.6);
    const double direct = lambda / (4 * pi * direct_m), reflected = lambda / (4 * pi * reflected_m), factor = -0.93;
    Paths paths;
    add(paths, 0, 0, 0, direct_m / c, direct, 0);
    add(paths, 0, 0, 1, reflected_m / c, factor * reflected, 0);
    const LinkFigures link = link_figures(paths, 0, all_links(1, 1), carrier_hz)[0];
    const double squares = direct * direct + factor * factor * reflected * reflected;
    // Fields of two phasors: a^2 + b^2 + 2 a b cos(phase difference).
    const double coherent =
        squares + 2 * factor * direct * reflected * std::cos(2 * pi * (reflected_m - direct_m) / lambda);
    CHECK(link.path_gain_db == test::near(10 * std::log10(squares), 1e-12));
    CHECK(link.narrowband_gain_db == test::near(10 * std::log10(coherent), 1e-8));
  }
}

TEST_CASE("fields of a group are added, and powers of groups; a path may be in several by parts") {
  Paths paths;
  add(paths, 0, 0, 0, 1e-6, 3e-5, 0);
  add(paths, 0, 0, 1, 1e-6 + 0.5 / carrier_hz, 1e-5, 0);  // half a turn later
  add(paths, 0, 0, 1, 1e-6, 2e-5, 0);
  paths.a[0][3] = {0, 1e-5};
  const auto gain_db = [&] { return link_figures(paths, 0, all_links(1, 1), carrier_hz)[0].path_gain_db; };
  CHECK(gain_db() == test::near(10 * std::log10(15e-10), 1e-13));
  paths.group = {only_group(0), only_group(0), only_group(1)};
  paths.group_weight.assign(3, whole_weight);
  CHECK(gain_db() == test::near(10 * std::log10(4e-10 + 1e-10 + 4e-10), 1e-9));
  paths.group[1] = {1, 0, no_group, no_group};
  paths.group_weight[1] = {0.8, 0.6, 0, 0};
  const double first = std::pow(3 - 0.6, 2) + 1, second = std::pow(2 - 0.8, 2);
  CHECK(gain_db() == test::near(10 * std::log10((first + second) * 1e-10), 1e-9));
  CHECK(link_figures(paths, 0, all_links(1, 1), carrier_hz)[0].sum_of_powers_db ==
        test::near(10 * std::log10(15e-10), 1e-13));
}

TEST_CASE("narrowband gains of pairs of ports are summed; of one path both gains are the same") {
  Paths paths;
  add(paths, 0, 0, 1, 1.234e-6, 3e-5, 0);
  paths.a[0][3] = {0, 4e-5};
  const LinkFigures one = link_figures(paths, 0, all_links(1, 1), carrier_hz)[0];
  CHECK(one.narrowband_gain_db == test::near(one.path_gain_db, 1e-13));
  add(paths, 0, 0, 1, 1.234e-6 + 0.5 / carrier_hz, 3e-5, 0);  // half a turn later: cancels the first port alone
  const LinkFigures two = link_figures(paths, 0, all_links(1, 1), carrier_hz)[0];
  CHECK(two.narrowband_gain_db == test::near(20 * std::log10(4e-5), 1e-9));
  CHECK(two.path_gain_db == test::near(10 * std::log10(34e-10), 1e-13));
  CHECK(std::isinf(link_figures(Paths{}, 0, all_links(1, 1), carrier_hz)[0].narrowband_gain_db));
}

// kTB at 290 K: -173.975 dBm/Hz (e.g. ITU-R P.372).
TEST_CASE("a link budget: received power, and signal to k T B and noise figure") {
  RadioConfig radio;
  CHECK(std::isnan(link_budget(radio, -80).received_dbm));
  CHECK(std::isnan(link_budget(radio, -80).snr_db));
  radio.transmit_power_dbm = 23;
  CHECK(link_budget(radio, -80).received_dbm == -57);
  CHECK(std::isnan(link_budget(radio, -80).snr_db));
  radio.bandwidth_hz = 1;
  CHECK(noise_dbm(radio) == doctest::Approx(-173.975).epsilon(1e-5));
  radio.bandwidth_hz = 10e6;
  radio.noise_figure_db = 9;
  CHECK(noise_dbm(radio) == doctest::Approx(-94.975).epsilon(1e-5));
  CHECK(link_budget(radio, -80).snr_db == doctest::Approx(37.975).epsilon(1e-4));
  CHECK(std::isinf(link_budget(radio, -INFINITY).snr_db));
}
