// SPDX-License-Identifier: Apache-2.0
// link_floors: the floor of a link follows from its strongest path, as the host evaluates it, and from the largest
// gains of its antennas; what a path that is left out had is found in the link that lacks most.
#include "passes/link_floors.hpp"

#include <cmath>
#include <numbers>

#include "passes/field_columns.hpp"
#include "radio/most_power.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr double range_db = 47;

// A floor over the power of the strongest path, for antennas without a gain: one wavelength, for the edge, and the
// amplitude of a wave at 1 m are the factors that bounds of paths over one edge lack.
const double floor_of_power =
    std::pow(10.0, -range_db / 10) / std::pow(carrier_wave_m / (4 * std::numbers::pi), 2) / carrier_wave_m;

struct Floors {
  std::vector<float> floors;
  uint32_t receivers;
  double second;
  float unit;
  float at(uint32_t tx, uint32_t rx) const { return floors.at(size_t{tx} * receivers + rx); }
};

// links: the transmitter and the receiver of each row. receiver_of, transmitter_of: ends in one place.
Floors floors_of(const FieldWorld& world, const std::vector<Link>& links, const std::vector<uint32_t>& receiver_of,
                 const std::vector<uint32_t>& transmitter_of) {
  const FieldTables tables = make_field_tables(world.scene, world.config);
  const DeviceScene scene = make_device_scene(context(), world.scene, false, 200);
  const RadioEnds ends = make_radio_ends(context(), world.state.transmitters, world.state.receivers, {});
  SolvedList visible = upload_rows(world.rows, most_steps);
  std::vector<wt_solved> headers = visible.headers.read(0, visible.count);
  for (size_t i = 0; i < links.size(); ++i) {
    headers[i].transmitter = links[i].tx;
    headers[i].receiver = links[i].rx;
  }
  visible.headers.write(headers);
  Fields fields(context(), tables, 0, world.scene.origin_m);
  fields.set_ends(world.state);
  Counters counters(context());
  LinkFloors pass(context(), tables, range_db, false);
  const auto receivers = context().buffer(receiver_of, "receivers of transmitters");
  const auto transmitters = context().buffer(transmitter_of, "transmitters of receivers");
  const FieldBuffers buffers = fields.buffers();
  for (int again = 0; again < 2; ++again)  // nothing is left of the call before
    pass({scene, buffers, ends, receivers, transmitters, visible, nullptr}, counters);
  CHECK(pass.most_left_out() == 0);
  const LinkLimits limits = pass.limits(buffers.materials_of);
  gpu::Buffer<uint32_t> left_out = limits.left_out;  // the same memory
  left_out.write(std::vector<uint32_t>{7, 12, 5}, size_t{2});
  CHECK(pass.most_left_out() == 12 / std::exp2(24));
  return {limits.floors.read(0, world.state.transmitters.size() * world.state.receivers.size()), limits.receiver_count,
          limits.second, limits.left_out_unit};
}

double power_of(const Paths& paths, size_t i) {
  double power = 0;
  for (const std::complex<double>& a : paths.a[i]) power += std::norm(a);
  return power;
}

}  // namespace

TEST_CASE("link_floors: the strongest path of a link counts, with the largest gains of its antennas") {
  const std::map<std::string, double> gains{
      {"isotropic", 1}, {"short-dipole", 1.5}, {"dipole", 1.6409223769845852}, {"tr38901", std::pow(10.0, 0.8)}};
  std::vector<PathRow> rows = path_of_each_kind();
  std::erase_if(rows, [](const PathRow& row) {
    return std::ranges::any_of(row.steps, [](uint32_t step) { return (step & WT_STEP_KIND) == WT_STEP_DIFFRACTION; });
  });
  rows.push_back(field_row({5, 5, 2}, {5, 5, 2 + 1e-7}, {}, {}));  // ends that touch have no line of sight
  for (const auto& [antenna, gain] : gains) {
    CAPTURE(antenna);
    const FieldWorld world(rows, antenna);
    const Paths paths = on_host(world);
    REQUIRE(paths.size() + 1 == rows.size());
    std::vector<Link> links;
    for (uint32_t i = 0; i < rows.size(); ++i) links.push_back({i, i});
    const std::vector<uint32_t> alone(rows.size(), WT_NONE);
    const Floors found = floors_of(world, links, alone, alone);
    CHECK(found.receivers == rows.size());
    CHECK(found.second == doctest::Approx(1 / carrier_wave_m));
    CHECK(found.unit == doctest::Approx(std::exp2(24) * std::pow(10.0, -range_db / 10)));
    const double most = 2 * gain * 2 * gain;  // two ports at either end
    for (size_t i = 0; i < paths.size(); ++i)
      CHECK(found.at(paths.tx[i], paths.rx[i]) ==
            doctest::Approx(floor_of_power * power_of(paths, i) / most).epsilon(1e-5).scale(0));
    CHECK(std::ranges::count(found.floors, 0.0f) == static_cast<ptrdiff_t>(rows.size() * rows.size() - paths.size()));
  }
}

TEST_CASE("link_floors: a path between two ends that both send counts with its weaker direction") {
  // Ends A and B: transmitter 0 and receiver 1 are A. A's antenna looks away from B when it sends.
  const glm::dvec3 a{-30, 0, 2}, b{-6, 0, 5};
  FieldWorld world({field_row(a, b, {}, {}), field_row(b, a, {}, {}),
                    field_row(a, b, {WT_STEP_REFLECTION | ground}, {{-30 + 24 * 2.0 / 7, 0, 0}})},
                   "isotropic");
  world.config.transmitters[0].antenna = "tr38901";
  world.state.transmitters[0].rotation = glm::dmat3(-1, 0, 0, 0, -1, 0, 0, 0, 1);
  const Paths paths = on_host(world);
  REQUIRE(paths.size() == 3);
  const double there = floor_of_power * power_of(paths, 0) / (2 * std::pow(10.0, 0.8) * 2),
               back = floor_of_power * power_of(paths, 1) / 4;
  REQUIRE(there < 0.1 * back);
  const std::vector<Link> links{{0, 0}, {1, 1}, {0, 0}};
  const Floors alone = floors_of(world, links, {WT_NONE, WT_NONE, WT_NONE}, {WT_NONE, WT_NONE, WT_NONE});
  CHECK(alone.at(1, 1) == doctest::Approx(back).epsilon(1e-5).scale(0));
  CHECK(alone.at(0, 0) >= static_cast<float>(there * (1 - 1e-5)));
  const Floors twins = floors_of(world, links, {1, 0, WT_NONE}, {1, 0, WT_NONE});
  CHECK(twins.at(0, 0) == alone.at(0, 0));
  CHECK(twins.at(1, 1) == doctest::Approx(there).epsilon(1e-5).scale(0));
}
