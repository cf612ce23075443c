// SPDX-License-Identifier: Apache-2.0
// Names of vehicle types to sizes.
// Sizes are those of SUMO's documentation.
#include "motion/vehicle_types.hpp"

#include <doctest/doctest.h>

using namespace wavetracer;

TEST_CASE("classes are found in the names that SUMO's tools give to types") {
  const auto length = [](const char* name) { return sumo_type(name).value().length_m; };
  CHECK(sumo_type("bus").value() == VehicleType{"bus", 12, 2.5, 3.4});
  CHECK(length("veh_passenger") == 5);  // randomTrips, osmWebWizard
  CHECK(length("truck_truck") == 7.1);
  CHECK(length("Bus/articulated") == 12);
  CHECK(length("truck2") == 7.1);
  CHECK(length("rail_urban") == 109.5);
  CHECK(length("DEFAULT_BIKETYPE") == 1.6);
  CHECK(length("my-motorcycle") == 2.2);
  CHECK(sumo_type("TRAILER").value().name == "TRAILER");
  for (const char* name : {"", "t0", "business", "carriage", "_", "\xC3\xA4"}) {
    CAPTURE(name);
    CHECK_FALSE(sumo_type(name));
  }
}
