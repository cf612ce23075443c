// SPDX-License-Identifier: Apache-2.0
// Elements of arrays against closed forms: distances between elements and their images, shortest ways over edges found
// by search, and phases of waves that pass elements as planes.
#include "wavetracer/arrays.hpp"

#include <algorithm>
#include <random>

#include "radio/array_world.hpp"
#include "radio/element_responses.hpp"
#include "radio/response_sum.hpp"
#include "radio/unfolded_path.hpp"
#include "radio/unit_phases.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// The largest error of the phase between elements against these lengths, radians at the carrier.
double phase_error(const ArrayWorld& world, const std::function<double(glm::dvec3, glm::dvec3)>& length_m) {
  const FrameResult frame = world.frame();
  const ElementModel model(world.config, world.scene);
  const ElementPaths pairs = model.element_paths(frame, 0);
  const auto sent = world.elements(world.config.transmitters[0]), heard = world.elements(world.config.receivers[0]);
  REQUIRE(pairs.rx_elements == heard.size());
  REQUIRE(pairs.tx_elements == sent.size());
  double worst = 0;
  for (size_t r = 0; r < heard.size(); ++r)
    for (size_t t = 0; t < sent.size(); ++t)
      worst = std::max(worst,
                       std::abs(pairs.delay_s[r * sent.size() + t] - length_m(sent[t], heard[r]) / speed_of_light_m_s));
  return 2 * std::numbers::pi * carrier_hz * worst;
}

}  // namespace

TEST_CASE("elements of a panel are numbered column by column, from -y and from the top, half a wavelength apart") {
  Config config;
  config.radio.frequency_hz = 3e9;
  ArrayConfig array = panel(2, 3);
  array.vertical_spacing_m = 0.2;
  config.arrays = {array};
  RadioEnd end;
  end.array = "panel";
  const auto positions = element_positions_m(config, end);
  const double half = 0.5 * speed_of_light_m_s / 3e9;
  REQUIRE(positions.size() == 6);
  const glm::dvec3 wanted[] = {{0, -half, 0.1}, {0, -half, -0.1}, {0, 0, 0.1},
                               {0, 0, -0.1},    {0, half, 0.1},   {0, half, -0.1}};
  for (size_t i = 0; i < 6; ++i) CHECK(glm::distance(positions[i], wanted[i]) < 1e-15);
  end.array = "";
  CHECK(element_positions_m(config, end) == std::vector<glm::dvec3>{glm::dvec3(0)});
  end.array = "panle";
  CHECK_THROWS_AS(element_positions_m(config, end), ConfigError);
  config.arrays[0].positions_m = {{1, 2, 3}, {4, 5, 6}};
  end.array = "panel";
  CHECK(element_positions_m(config, end) == std::vector<glm::dvec3>{{1, 2, 3}, {4, 5, 6}});
}

TEST_CASE("line of sight of two arrays: spherical waves have the exact distances, 2 m apart and 2 km apart") {
  for (const double away : {2.0, 2000.0}) {
    ArrayWorld world(panel(8, 8), panel(4, 2), {0, 0, 5}, {away, 0.3 * away, 1}, {20, 5, 3}, {200, -10, 30});
    world.add_path(0, 0, {}, {}, {});
    CAPTURE(away);
    CHECK(phase_error(world, [](auto p, auto q) { return glm::distance(p, q); }) < 1e-6);
    const FrameResult frame = world.frame();
    const ElementModel model(world.config, world.scene);
    const auto pairs = model.element_paths(frame, 0);
    const double centre = frame.paths.delay_s[0];
    for (size_t i = 0; i < pairs.delay_s.size(); ++i)
      CHECK(pairs.amplitude[i] == near(centre / pairs.delay_s[i], 1e-12));
  }
}

// d: half of the largest sum of both apertures; the first term that a plane leaves out is at most d^2 / (2 r).
TEST_CASE("line of sight of two arrays: plane waves err by the curvature that they leave out") {
  for (const double away : {5.0, 50.0, 500.0}) {
    ArrayWorld world(panel(8, 8), panel(4, 2), {0, 0, 5}, {away, 0, 5});
    world.config.radio.wavefront = "plane";
    world.add_path(0, 0, {}, {}, {});
    const double half = 0.5 * wavelength_m, aperture = half * (std::hypot(3.5, 3.5) + std::hypot(1.5, 0.5));
    const double bound = 2 * std::numbers::pi / wavelength_m * aperture * aperture / (2 * away);
    CAPTURE(away);
    const double error = phase_error(world, [](auto p, auto q) { return glm::distance(p, q); });
    CHECK(error < bound * 1.001);
    CHECK(error > bound * 0.5);
  }
}

TEST_CASE("plane waves: the phases of a uniform linear array are those of its steering vector") {
  const double azimuth = 30 * radians;
  ArrayWorld world(panel(1, 8), panel(1, 1), {0, 0, 0}, {100 * std::cos(azimuth), 100 * std::sin(azimuth), 0});
  world.config.radio.wavefront = "plane";
  world.add_path(0, 0, {}, {}, {});
  const FrameResult frame = world.frame();
  const auto a = ElementModel(world.config, world.scene).coefficients(frame, 0);
  REQUIRE(a.size() == 8);
  for (size_t n = 0; n < 8; ++n) {
    const Complex wanted = std::polar(std::abs(frame.paths.a[0][0]),
                                      std::numbers::pi * (static_cast<double>(n) - 3.5) * std::sin(azimuth)) *
                           (frame.paths.a[0][0] / std::abs(frame.paths.a[0][0]));
    CHECK(std::abs(a[n] - wanted) < 1e-9 * std::abs(wanted));
  }
}

TEST_CASE("reflections: the distances are those of the images in the mirrors, one after the other") {
  ArrayWorld world(panel(8, 4), panel(2, 2), {2, 1, 3}, {20, -6, 9}, {35, 10, 0}, {160, 0, 45});
  const uint32_t floor = world.add_plane({0, 0, 1}, {0, 0, 0}, concrete(infinity)),
                 wall = world.add_plane({0, 1, 0}, {0, 9, 0}, concrete(infinity)),
                 slope = world.add_plane({1, 0.2, 0}, {30, 0, 0}, concrete(infinity));
  world.add_reflections(0, 0, {floor, wall, slope});
  CHECK(phase_error(world, [&](glm::dvec3 p, glm::dvec3 q) {
          for (const uint32_t surface : {floor, wall, slope}) {
            const Surface& s = world.scene.surfaces[surface];
            p -= 2 * (glm::dot(p, s.normal) - s.offset_m) * s.normal;
          }
          return glm::distance(p, q);
        }) < 1e-6);
}

TEST_CASE("over an edge and over two, mirrors before and after: the shortest way, found by search") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto point = [&](double x) { return glm::dvec3(x + any(random), 3 * any(random), 3 * any(random)); };
  // The least of a convex function.
  const auto least = [](const auto& f) {
    double low = -60, high = 60;
    for (int i = 0; i < 200; ++i) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (f(a) < f(b) ? high : low) = f(a) < f(b) ? b : a;
    }
    return f(0.5 * (low + high));
  };
  for (int i = 0; i < 20; ++i) {
    UnfoldedPath path;
    path.count = 1 + i % 2;
    for (int k = 0; k < path.count; ++k)
      path.bends[static_cast<size_t>(k)] = {point(4.0 * k),
                                            glm::normalize(glm::dvec3(any(random), any(random), any(random) + 2))};
    const glm::dvec3 p = point(-5), q = point(10);
    const Bend &a = path.bends[0], &b = path.bends[1];
    const double found = path.count == 1
                             ? least([&](double s) {
                                 const glm::dvec3 at = a.point + s * a.along;
                                 return glm::distance(p, at) + glm::distance(at, q);
                               })
                             : least([&](double s) {
                                 return least([&](double t) {
                                   const glm::dvec3 at = a.point + s * a.along, then = b.point + t * b.along;
                                   return glm::distance(p, at) + glm::distance(at, then) + glm::distance(then, q);
                                 });
                               });
    CAPTURE(i);
    CHECK(path.between(p, q).length_m == near(found, 1e-12));
  }
}

TEST_CASE("a point that scatters stays where it is") {
  UnfoldedPath path;
  path.count = 1;
  path.bends[0] = {{1, 2, 3}, glm::dvec3(0)};
  const PathSpread spread = path.between({4, 6, 3}, {1, 2, 15});
  CHECK(spread.length_m == near(17, 1e-15));
  CHECK(spread.amplitude == near(1.0 / 60, 1e-15));
}

TEST_CASE("over three parallel edges, length and amplitude are those of the closed form") {
  UnfoldedPath path;
  path.count = 3;
  for (const double x : {2.0, 5.0, 6.0}) path.bends[x < 3 ? 0 : x < 6 ? 1 : 2] = {{x, 0, 0.3 * x}, {0, 0, 1}};
  const PathSpread across = path.between({0, 0, 4}, {13, 0, 4});  // parts of 2, 3, 1 and 7 m
  CHECK(across.length_m == near(13, 1e-12));
  CHECK(across.amplitude == near(1 / std::sqrt(2.0 * 3 * 1 * 7 * 13), 1e-12));
  CHECK(path.between({0, 0, 4}, {13, 0, 9}).length_m == near(std::hypot(13, 5), 1e-12));
}

TEST_CASE("a point that scatters between two edges parts the path in two") {
  const Bend before{{3, 1, 2}, glm::normalize(glm::dvec3(0.1, -0.2, 1))}, point{{8, -1, 3}, glm::dvec3(0)},
      after{{12, 2, 1}, glm::normalize(glm::dvec3(0.3, 0.5, -1))};
  const glm::dvec3 from(-2, 0, 1), to(17, 3, 2);
  UnfoldedPath whole, first, second;
  whole.count = 3, first.count = second.count = 1;
  whole.bends = {before, point, after};
  first.bends[0] = before;
  second.bends[0] = after;
  const PathSpread a = first.between(from, point.point), b = second.between(point.point, to),
                   all = whole.between(from, to);
  CHECK(all.length_m == near(a.length_m + b.length_m, 1e-12));
  CHECK(all.amplitude == near(a.amplitude * b.amplitude, 1e-10));
}

TEST_CASE("phases of turns are those of the library's sine and cosine") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1e5, 1e5);
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const double turns = i < 9 ? 0.125 * (i - 4) : any(random);
    double re = 0, im = 0;
    unit_phases(&turns, 1, &re, &im);
    const double angle = -2 * std::numbers::pi * (turns - std::nearbyint(turns));
    worst = std::max(worst, std::abs(Complex(re, im) - std::polar(1.0, angle)));
  }
  CHECK(worst < 5e-15);
}

TEST_CASE("sums at many frequencies are those of each, evenly spaced or not") {
  std::vector<double> frequencies;
  for (int k = 0; k < 1000; ++k) frequencies.push_back(carrier_hz + (k - 500) * 1e8 / 999);
  const auto check = [&](bool even) {
    const FrequencyAxis axis(frequencies);
    CHECK((axis.step_hz != 0) == even);
    const std::vector<double> delay_s{1.2345e-6, 3.3e-8, 7e-7}, amplitude{1, 0.5, 2};
    const std::vector<Complex> coefficients{{1, 2}, {-0.5, 0.25}};
    ResponseSum sum(axis, 2);
    REQUIRE(ResponseSum::pairs_at_once(axis, 2) >= 3);
    sum.add(delay_s.data(), amplitude.data(), 3, coefficients);
    double worst = 0;
    for (size_t pair = 0; pair < 3; ++pair)
      for (size_t c = 0; c < 2; ++c)
        for (size_t k = 0; k < frequencies.size(); ++k) {
          const long double turns = static_cast<long double>(frequencies[k]) * delay_s[pair];
          const double angle = -2 * std::numbers::pi * static_cast<double>(turns - std::floor(turns));
          worst =
              std::max(worst, std::abs(sum.value(c, pair, k) - coefficients[c] * std::polar(amplitude[pair], angle)));
        }
    CHECK(worst < 1e-10);
  };
  check(true);
  frequencies[17] += 5;
  check(false);
}

TEST_CASE("a response is the sum of the coefficients of its paths, each with the delay between its elements") {
  ArrayWorld world(panel(2, 3), panel(2, 1), {2, 1, 3}, {60, 4, 1}, {35, 10, 0}, {160, 0, 45});
  world.config.transmitters[0].polarization = "VH";
  world.config.receivers[0].polarization = "cross";
  const uint32_t floor = world.add_plane({0, 0, 1}, {0, 0, 0}, concrete(infinity));
  world.add_path(0, 0, {}, {}, {});
  world.add_reflections(0, 0, {floor});
  FrameResult frame = world.frame();
  frame.paths.doppler_hz = {100, -250};
  const ElementModel model(world.config, world.scene);
  CHECK(model.tx_antennas(0) == 12);
  CHECK(model.rx_antennas(0) == 4);
  const std::vector<double> frequencies{carrier_hz, carrier_hz + 7e6}, times{0, 1e-3};
  const auto h = model.response(frame, {0, 0}, frequencies, times);
  REQUIRE(h.size() == 2 * 4 * 12 * 2);
  double worst = 0, largest = 0;
  for (size_t time = 0; time < 2; ++time)
    for (size_t r = 0; r < 4; ++r)
      for (size_t t = 0; t < 12; ++t)
        for (size_t k = 0; k < 2; ++k) {
          Complex sum = 0;
          for (size_t row = 0; row < 2; ++row) {
            const ElementPaths pairs = model.element_paths(frame, row);
            const size_t pair = r / 2 * 6 + t / 2;
            sum += frame.paths.a[row][r % 2 * 2 + t % 2] * pairs.amplitude[pair] *
                   std::polar(1.0, 2 * std::numbers::pi *
                                       std::fmod(frame.paths.doppler_hz[row] * times[time] -
                                                     frequencies[k] * pairs.delay_s[pair],
                                                 1.0));
          }
          worst = std::max(worst, std::abs(h[((time * 4 + r) * 12 + t) * 2 + k] - sum));
          largest = std::max(largest, std::abs(sum));
        }
  CHECK(worst < 1e-9 * largest);
  // At the carrier and the time of the frame the same by coefficients.
  Complex sum = 0;
  for (size_t row = 0; row < 2; ++row)
    sum += model.coefficients(frame, row)[3 * 12 + 7] *
           std::polar(1.0, -2 * std::numbers::pi * std::fmod(carrier_hz * frame.paths.delay_s[row], 1.0));
  CHECK(std::abs(sum - h[(3 * 12 + 7) * 2]) < 1e-9 * largest);
}

TEST_CASE("subcarriers are those of OFDM, and [response] fills the rows of each link") {
  ArrayWorld world(panel(1, 2), panel(1, 1), {0, 0, 0}, {40, 0, 0});
  world.add_path(0, 0, {}, {}, {});
  world.config.response.bandwidth_hz = 20e6;
  world.config.response.subcarriers = 4;
  world.config.response.times = 2;
  CHECK(response_frequencies_hz(world.config) ==
        std::vector<double>{carrier_hz - 10e6, carrier_hz - 5e6, carrier_hz, carrier_hz + 5e6});
  CHECK(response_times_s(world.config) == std::vector<double>{0, 1e-3});
  FrameResult frame = world.frame();
  const ElementModel model(world.config, world.scene);
  const Responses all = make_responses(model, world.config, frame);
  CHECK(all.row_offset == std::vector<uint64_t>{0, 4});
  const auto h = model.response(frame, {0, 0}, response_frequencies_hz(world.config), response_times_s(world.config));
  REQUIRE(all.h.size() == h.size());
  for (size_t i = 0; i < h.size(); ++i) CHECK(std::abs(Complex(all.h[i]) - h[i]) < 1e-7 * std::abs(h[i]));
  // A link without a path has a response of zeros.
  frame.paths = Paths{};
  for (const auto& value : make_responses(model, world.config, frame).h) CHECK(value == std::complex<float>(0));
  world.config.response.bandwidth_hz.reset();
  CHECK(make_responses(model, world.config, frame).h.empty());
}
