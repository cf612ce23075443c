// SPDX-License-Identifier: Apache-2.0
// Tests frames of paths made by hand, whose errors are known in advance.
// Lengths are chosen in nanoseconds of light, so that delays are round.
#include "study/path_error.hpp"
#include <doctest/doctest.h>
#include <cmath>
#include <stdexcept>

using namespace wavetracer;
using namespace wavetracer::study;

namespace {

constexpr double metres_a_ns = 0.299792458;

void add(Paths& paths, uint32_t tx, uint32_t rx, double delay_ns, double amplitude,
         const std::vector<uint32_t>& surfaces, const glm::dvec3& at = {}, uint8_t interaction = reflection,
         uint32_t instance = no_instance, double doppler_hz = 0) {
  paths.frame.push_back(0);
  paths.tx.push_back(tx);
  paths.rx.push_back(rx);
  paths.depth.push_back(static_cast<uint32_t>(surfaces.size()));
  paths.delay_s.push_back(1e-9 * delay_ns);
  paths.doppler_hz.push_back(doppler_hz);
  paths.a.push_back({amplitude, 0, 0, 0});
  for (const uint32_t surface : surfaces) {
    paths.vertex_surface.push_back(surface);
    paths.vertex_position_m.push_back(at);
    paths.vertex_interaction.push_back(interaction);
    paths.vertex_instance.push_back(instance);
  }
  paths.vertex_offset.push_back(paths.vertex_surface.size());
}

// Three paths of one link, with powers 0.64, 0.35 and 0.01.
Paths street() {
  Paths paths;
  add(paths, 0, 0, 100, 0.8, {});
  add(paths, 0, 0, 140, std::sqrt(0.35), {3}, {1, 2, 3});
  add(paths, 0, 0, 240, 0.1, {3, 5}, {4, 5, 6});
  return paths;
}

}  // namespace

TEST_CASE("a frame has no error against itself, in whatever order its paths are") {
  const Paths paths = street();
  Paths turned;
  add(turned, 0, 0, 240, 0.1, {3, 5}, {4, 5, 6});
  add(turned, 0, 0, 140, std::sqrt(0.35), {3}, {1, 2, 3});
  add(turned, 0, 0, 100, 0.8, {});
  for (const Paths& same : {paths, turned}) {
    const PathError error = path_error(paths, same);
    CHECK(error.reference_paths == 3);
    CHECK(error.paired == 3);
    CHECK(error.lost == 0);
    CHECK(error.spurious == 0);
    for (const double value : {error.lost_share, error.spurious_share, error.lost_power, error.spurious_power,
                               error.power_median_db, error.power_max_db, error.delay_spread_ns, error.delay_ns,
                               error.l1_m, error.l2_m, error.l1_relative, error.l2_relative})
      CHECK(value == 0);
    CHECK(error.mean_path_length_m == doctest::Approx(160 * metres_a_ns));
    CHECK(share_db(error.lost_power) == -std::numeric_limits<double>::infinity());
  }
}

TEST_CASE("lost and spurious paths: count, share and power; the sequence's order counts") {
  const Paths reference = street();
  Paths paths;
  add(paths, 0, 0, 100, 0.8, {});
  add(paths, 0, 0, 140, std::sqrt(0.35), {3}, {1, 2, 3});
  add(paths, 0, 0, 240, 0.2, {5, 3}, {4, 5, 6});
  const PathError error = path_error(reference, paths);
  CHECK(error.paired == 2);
  CHECK(error.lost == 1);
  CHECK(error.spurious == 1);
  CHECK(error.lost_share == doctest::Approx(1.0 / 3));
  CHECK(error.lost_power == doctest::Approx(0.01));
  CHECK(share_db(error.lost_power) == doctest::Approx(-20));
  CHECK(error.spurious_power == doctest::Approx(0.04));
  CHECK(error.power_max_db == doctest::Approx(10 * std::log10(1.03)));
  CHECK(error.l2_m == 0);  // the vertices are where they were
}

TEST_CASE("the surface of another vehicle, an edge, a wall that is passed: other paths, whatever their numbers") {
  Paths reference;
  add(reference, 0, 0, 140, 0.8, {3});
  for (const auto& [interaction, instance] :
       {std::pair{reflection, 0u}, {reflection, 1u}, {diffraction, no_instance}, {transmission, no_instance}}) {
    Paths both = reference, other;
    add(other, 0, 0, 150, 0.1, {3}, {}, interaction, instance);
    add(both, 0, 0, 150, 0.1, {3}, {}, interaction, instance);
    CHECK(path_error(reference, other).paired == 0);
    const PathError lost = path_error(both, reference);
    CHECK(lost.lost == 1);
    CHECK(lost.lost_power == doctest::Approx(0.01 / 0.65));
    CHECK(path_error(both, other).lost_power == doctest::Approx(0.64 / 0.65));
  }
}

TEST_CASE("spreads of Doppler shifts differ by what the powers make of them") {
  Paths reference, paths;
  add(reference, 0, 0, 100, 3, {}, {}, reflection, no_instance, 100);
  add(reference, 0, 0, 100, 1, {3}, {}, reflection, no_instance, -100);
  add(paths, 0, 0, 100, 3, {}, {}, reflection, no_instance, 100);
  // The spread of 0.9 and 0.1 of the power.
  CHECK(path_error(reference, paths).doppler_spread_hz == doctest::Approx(60));
  CHECK(path_error(reference, reference).doppler_spread_hz == 0);
}

TEST_CASE("one surface more or another link is another path") {
  Paths reference, paths;
  add(reference, 0, 1, 10, 1, {2});
  add(reference, 1, 0, 10, 1, {2});
  add(paths, 0, 1, 10, 1, {2, 2});
  add(paths, 0, 0, 10, 1, {2});
  const PathError error = path_error(reference, paths);
  CHECK(error.paired == 0);
  CHECK(error.lost == 2);
  CHECK(error.spurious == 2);
  CHECK(error.lost_power == doctest::Approx(1));
  CHECK(error.links == 1);
  CHECK(error.links_lost == 1);
  CHECK(error.links_spurious == 1);
  CHECK(error.power_max_db == 0);  // the error of the link that both have
  CHECK(std::isnan(error.delay_ns));
}

TEST_CASE("delay spread: two equal paths have half their distance, and a path alone has none") {
  CHECK(rms_spread(std::vector<double>{100, 140}, std::vector<double>{3, 3}) == doctest::Approx(20));
  // Bernoulli: sqrt(p (1 - p)) of the distance.
  CHECK(rms_spread(std::vector<double>{0, 100}, std::vector<double>{9, 1}) == doctest::Approx(30));
  CHECK(rms_spread(std::vector<double>{7}, std::vector<double>{2}) == 0);
  CHECK(std::isnan(rms_spread({}, {})));
  Paths reference, paths;
  add(reference, 0, 0, 100, 1, {});
  add(reference, 0, 0, 140, 1, {1});
  add(reference, 0, 1, 100, 1, {});
  add(paths, 0, 0, 100, 1, {});
  add(paths, 0, 1, 100, 1, {});
  const PathError error = path_error(reference, paths);
  CHECK(error.delay_spread_ns == doctest::Approx(10));                   // 20 and 0
  CHECK(error.power_median_db == doctest::Approx(5 * std::log10(2.0)));  // mean of the middle two: 3.01 and 0
  CHECK(error.power_max_db == doctest::Approx(10 * std::log10(2.0)));
}

TEST_CASE("delays of paired paths, and centroids in metres and path lengths") {
  Paths reference, moved;
  add(reference, 0, 0, 100, 1, {1}, {0, 0, 0});
  add(reference, 0, 0, 300, 1, {2, 3}, {9, 0, 0});
  add(moved, 0, 0, 103, 1, {1}, {3, -4, 0});
  add(moved, 0, 0, 299, 1, {2, 3}, {12, -4, 0});
  const PathError error = path_error(reference, moved);
  CHECK(error.delay_ns == doctest::Approx(2));
  CHECK(error.l1_m == doctest::Approx(7));
  CHECK(error.l2_m == doctest::Approx(5));
  CHECK(error.mean_path_length_m == doctest::Approx(200 * metres_a_ns));
  CHECK(error.l1_relative == doctest::Approx(7 / (200 * metres_a_ns)));
  CHECK(error.l2_relative == doctest::Approx(5 / (200 * metres_a_ns)));
}

TEST_CASE("powers count all ports of both antennas") {
  Paths reference;
  reference.rx_ports = 2;
  reference.tx_ports = 2;
  add(reference, 0, 0, 100, 1, {});
  reference.a[0] = {1, std::complex<double>(0, 1), 1, 1};
  add(reference, 0, 0, 140, 2, {1});
  Paths paths;
  paths.rx_ports = 2;
  paths.tx_ports = 2;
  add(paths, 0, 0, 140, 2, {1});
  CHECK(path_error(reference, paths).lost_power == doctest::Approx(0.5));
  CHECK_THROWS_AS(path_error(reference, Paths{}), std::invalid_argument);
}

TEST_CASE("frames without paths") {
  const PathError nothing = path_error({}, {}), all_lost = path_error(street(), {}), all_new = path_error({}, street());
  CHECK(std::isnan(nothing.lost_share));
  CHECK(std::isnan(nothing.l2_m));
  CHECK(all_lost.lost_share == 1);
  CHECK(all_lost.lost_power == doctest::Approx(1));
  CHECK(all_lost.links_lost == 1);
  CHECK(std::isnan(all_lost.l2_m));
  CHECK(all_new.spurious == 3);
  CHECK(std::isnan(all_new.spurious_share));
}

TEST_CASE("means over frames: sums of counts, running means of the rest, frames without a value left out") {
  PathErrorMean mean;
  CHECK(std::isnan(mean.mean().l2_m));
  Paths half;
  add(half, 0, 0, 100, 0.8, {});
  mean.add(path_error(street(), street()));
  mean.add(path_error(street(), half));  // no vertex, so no centroid
  mean.add(path_error({}, {}));
  const PathError error = mean.mean();
  CHECK(error.reference_paths == 6);
  CHECK(error.lost == 2);
  CHECK(error.lost_share == doctest::Approx(1.0 / 3));
  CHECK(error.lost_power == doctest::Approx(0.18));  // 0 and 0.36
  CHECK(error.power_max_db == doctest::Approx(-10 * std::log10(0.64)));
  CHECK(error.l2_m == 0);
  CHECK(error.mean_path_length_m == doctest::Approx(160 * metres_a_ns));
}
