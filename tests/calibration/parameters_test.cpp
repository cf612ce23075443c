// SPDX-License-Identifier: Apache-2.0
// Parameters that patterns choose, and their values.
#include "calibration/chosen_parameters.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "check_contains.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::calibration;
using test::check_contains;

namespace {

constexpr double carrier_hz = 1e9, farad_m = 8.8541878128e-12;

device::wt_material material(double permittivity, double conductivity, double thickness_m) {
  device::wt_material out{};
  out.permittivity[0] = permittivity;
  out.permittivity[1] = -conductivity / (2 * std::acos(-1.0) * carrier_hz * farad_m);
  out.thickness_m = thickness_m;
  out.scattering = 0.4;
  return out;
}

// The second record is of a material that no surface uses; the last ones are those of a vehicle and of
// a layer of a wall.
NamedRecords world() {
  return {{"concrete", "unused", "metal", "air", "glass.clear", "concrete", "concrete"},
          {material(5, 0.1, 0.2), device::wt_material{}, material(1, 1e7, 0.1), material(1, 0, 0.1),
           material(6, 0, std::numeric_limits<double>::infinity()), material(5, 0.1, 0.2), material(5, 0.1, 0.03)},
          {false, false, false, false, false, false, true},
          carrier_hz,
          true};
}

EndPlaces ends() { return {{{"mast", {1, 2, 30}, {90, 0, 0}}, {"roof.1", {5, 6, 7}, {0, -10, 0}}}}; }

std::vector<std::string> names(const std::vector<std::string>& patterns, std::vector<std::string>& notes) {
  std::vector<std::string> out;
  for (const Parameter& parameter : chosen_parameters(world(), ends(), patterns, {}, notes))
    out.push_back(parameter.name());
  return out;
}

std::string pattern_mistake(const std::string& pattern) {
  std::vector<std::string> notes;
  try {
    names({pattern}, notes);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("patterns choose what can be fitted, and each once") {
  std::vector<std::string> notes;
  CHECK(names({"*"}, notes) ==
        std::vector<std::string>{"concrete.permittivity", "concrete.conductivity", "glass.clear.permittivity"});
  CHECK(notes.empty());  // nothing was asked for by its name
  CHECK(names({"concrete.thickness", "conc*", "concrete.permittivity"}, notes) ==
        std::vector<std::string>{"concrete.thickness", "concrete.permittivity", "concrete.conductivity"});
  CHECK(names({"glass.clear.thickness", "metal.conductivity", "glass.clear.conductivity"}, notes).empty());
  REQUIRE(notes.size() == 3);
  check_contains(notes[0], "glass.clear.thickness is not fitted: it is inf m in the configuration");
  check_contains(notes[1], "metal.conductivity is not fitted: it is a good conductor");
  check_contains(notes[2], "glass.clear.conductivity is not fitted: it is 0 in the configuration; give it a value");
}

TEST_CASE("a material whose name has a dot is chosen by its name, with and without a property") {
  std::vector<std::string> notes;
  CHECK(names({"glass.clear"}, notes) == std::vector<std::string>{"glass.clear.permittivity"});
  CHECK(names({"glass.clear.permittivity"}, notes) == std::vector<std::string>{"glass.clear.permittivity"});
  CHECK_FALSE(move_paths({"glass.clear", "*"}));
  CHECK(move_paths({"*", "mast.height"}));
}

TEST_CASE("mistakes in patterns") {
  check_contains(pattern_mistake("concrete.permitivity"), "did you mean \"permittivity\"?");
  check_contains(pattern_mistake("concret"), "no surface has the material \"concret\"; did you mean \"concrete\"?");
  check_contains(pattern_mistake("unused"), "no surface has the material \"unused\"");
}

TEST_CASE("a parameter changes all records of its material, and theta 0 changes nothing") {
  std::vector<std::string> notes;
  const NamedRecords all = world();
  const std::vector<Parameter> parameters =
      chosen_parameters(all, ends(), {"concrete", "concrete.thickness", "concrete.scattering"}, {}, notes);
  REQUIRE(parameters.size() == 4);
  CHECK(parameters[0].records == std::vector<uint32_t>{0, 5, 6});
  CHECK(parameters[2].records == std::vector<uint32_t>{0, 5});  // a layer of a wall has a thickness of its own
  const std::vector<double> theta{0.3, -0.2, 0.1, 0.5};
  const auto records = with_parameters(all, parameters, theta);
  for (const size_t i : {0, 5}) {
    CHECK(records[i].permittivity[0] == doctest::Approx(1 + 4 * std::exp(0.3)));
    CHECK(records[i].permittivity[1] / all.records[i].permittivity[1] == doctest::Approx(std::exp(-0.2)));
    CHECK(records[i].thickness_m == doctest::Approx(0.2 * std::exp(0.1)));
    CHECK(records[i].scattering == doctest::Approx(1 / (1 + 1.5 * std::exp(-0.5))));
  }
  CHECK(records[4].permittivity[0] == 6);
  const auto same = with_parameters(all, parameters, std::vector<double>(4, 0));
  for (size_t i = 0; i < same.size(); ++i) CHECK(std::memcmp(&same[i], &all.records[i], sizeof same[i]) == 0);
  for (size_t p = 0; p < 4; ++p) {
    constexpr double step = 1e-6;
    const double slope = (parameters[p].value(theta[p] + step) - parameters[p].value(theta[p] - step)) / (2 * step);
    CHECK(parameters[p].error(theta[p], 1) == doctest::Approx(slope).epsilon(1e-6));
  }
}

TEST_CASE("values of properties are those that a record was made of") {
  const device::wt_material record = material(5, 0.1, 0.2);
  CHECK(value_of(record, Property::permittivity, carrier_hz) == 5);
  CHECK(value_of(record, Property::conductivity, carrier_hz) == doctest::Approx(0.1).epsilon(1e-9));
  CHECK(value_of(record, Property::thickness, carrier_hz) == 0.2);
  CHECK(value_of(record, Property::scattering, carrier_hz) == 0.4);
  CHECK_FALSE(std::signbit(value_of(material(5, 0, 0.2), Property::conductivity, carrier_hz)));
}

TEST_CASE("ends are fitted where they are named, after materials, and angles before places") {
  std::vector<std::string> notes;
  CHECK(names({"mast.height", "mast.yaw", "concrete.permittivity", "receivers.height"}, notes) ==
        std::vector<std::string>{"concrete.permittivity", "mast.yaw", "mast.height", "receivers.height"});
  CHECK(names({"roof.?.x", "*.roll"}, notes) == std::vector<std::string>{"mast.roll", "roof.1.roll", "roof.1.x"});
  CHECK(names({"*.height"}, notes) == std::vector<std::string>{"mast.height", "roof.1.height", "receivers.height"});
  CHECK(move_paths({"*", "mast.y"}));
  CHECK_FALSE(move_paths({"*", "mast.yaw", "concrete.thickness"}));
  check_contains(
      pattern_mistake("mat.height"),
      "no transmitter is called \"mat\"; did you mean \"mast.height\"?; there are mast.height, roof.1.height, "
      "receivers.height");
  check_contains(pattern_mistake("receivers.x"), "there are mast.x, roof.1.x");
  check_contains(pattern_mistake("mast.hight"), "did you mean \"height\"?");
}

TEST_CASE("values of ends are sums, and their places follow") {
  std::vector<std::string> notes;
  const std::vector<Parameter> parameters =
      chosen_parameters(world(), ends(), {"roof.1.height", "mast.yaw", "mast.x", "receivers.height"}, {}, notes);
  REQUIRE(parameters.size() == 4);
  CHECK(parameters[0].start == 90);
  CHECK(parameters[0].error(0.3, 0.5) == 5);  // the usual uncertainty of an angle is 5 degrees
  CHECK(parameters[1].error(0.3, parameters[1].prior) == 0.5);
  const EndPlaces at = with_parameters(ends(), parameters, std::vector<double>{0.2, -0.4, 0.3, 0.1});
  CHECK(at.transmitters[0].yaw_pitch_roll_deg.x == doctest::Approx(92));
  CHECK(at.transmitters[1].position_m.z == doctest::Approx(6.6));
  CHECK(at.transmitters[0].position_m.x == doctest::Approx(1.3));
  CHECK(at.receivers_rise_m == doctest::Approx(0.1));
  CHECK_FALSE(at.same_points(ends()));
  CHECK(with_parameters(ends(), parameters, std::vector<double>{0.2, 0, 0, 0}).same_points(ends()));
  CHECK(with_parameters(ends(), parameters, std::vector<double>(4, 0)) == ends());
}

TEST_CASE("standard deviations that are given replace the usual ones") {
  std::vector<std::string> notes;
  const auto priors = [&](const Priors& of) {
    std::vector<double> out;
    for (const Parameter& parameter :
         chosen_parameters(world(), ends(), {"concrete.permittivity", "mast.yaw", "mast.height"}, of, notes))
      out.push_back(parameter.prior);
    return out;
  };
  CHECK(priors({}) == std::vector<double>{0.5, 0.5, 0.5});
  CHECK(priors({2, {"mast.height=0.2", "mast.yaw=1"}}) == std::vector<double>{1, 0.1, 0.2});
  CHECK(priors({1, {"*.permittivity=0.3", "mast.*=2"}}) == std::vector<double>{0.3, 0.2, 2});
  for (const char* wrong : {"mast.height", "mast.height=0", "mast.height=-1", "mast.height=much"}) {
    CAPTURE(wrong);
    CHECK_THROWS_WITH_AS(priors({1, {wrong}}), doctest::Contains("give NAME=VALUE"), ConfigError);
  }
  CHECK_THROWS_WITH_AS(priors({1, {"mast.roll=3"}}),
                       doctest::Contains("there are concrete.permittivity, mast.yaw, mast.height"), ConfigError);
}
