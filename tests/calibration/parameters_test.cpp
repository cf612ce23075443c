// SPDX-License-Identifier: Apache-2.0
// Parameters that patterns choose, and their values.
#include "calibration/parameters.hpp"

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

std::vector<std::string> names(const std::vector<std::string>& patterns, std::vector<std::string>& notes) {
  std::vector<std::string> out;
  for (const Parameter& parameter : chosen_parameters(world(), patterns, 1, notes)) out.push_back(parameter.name());
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

TEST_CASE("mistakes in patterns") {
  check_contains(pattern_mistake("concrete.permitivity"), "did you mean \"permittivity\"?");
  check_contains(pattern_mistake("concret"), "no surface has the material \"concret\"; did you mean \"concrete\"?");
  check_contains(pattern_mistake("unused"), "no surface has the material \"unused\"");
}

TEST_CASE("a parameter changes all records of its material, and theta 0 changes nothing") {
  std::vector<std::string> notes;
  const NamedRecords all = world();
  const std::vector<Parameter> parameters =
      chosen_parameters(all, {"concrete", "concrete.thickness", "concrete.scattering"}, 1, notes);
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
