// SPDX-License-Identifier: Apache-2.0
// Datagrams of VaN3Twin's protocol and the vehicles that they place, against texts as its client writes them.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "live/van3twin_message.hpp"
#include "live/van3twin_traffic.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer::live::van3twin {
namespace {

Question asked(const std::string& datagram) { return std::get<Question>(parse(datagram).value()); }

LocationUpdate at(const std::string& id, double x, double y, double bearing_deg = 90) {
  return {id, {x, y, 0}, bearing_deg};
}

std::vector<LiveType> two_types() {
  MountConfig low, high;
  low.name = "low";
  low.role = "receiver";
  high.name = "high";
  return {{"car", 4, 2, 1.5, 0, 2, {low, high}}, {"bus", 12, 2.5, 3, 2, 1, {}}};
}

}  // namespace

TEST_CASE("datagrams as the client of VaN3Twin writes them") {
  // std::to_string writes six digits after the point.
  const auto moved = std::get<LocationUpdate>(
      parse("LOC_UPDATE:veh12,-13.250000,7.000000,1.500000,270.000000,0.000000,-3.100000,0.000000").value());
  CHECK(moved.id == "veh12");
  CHECK(moved.position_m == glm::dvec3(-13.25, 7, 1.5));
  CHECK(moved.bearing_deg == 270);
  CHECK(confirmation(moved) == "LOC_CONFIRM:veh12");
  CHECK(asked("CALC_REQUEST_PATHGAIN:veh1,veh2").figure == Figure::path_gain);
  CHECK(asked("CALC_REQUEST_DELAY:veh1,veh2").figure == Figure::delay);
  CHECK(asked("CALC_REQUEST_LOS:veh1,obj2").to == "obj2");
  CHECK(std::holds_alternative<Shutdown>(parse("SHUTDOWN_SIONNA").value()));
  // A node that takes no part yet is at the origin: its id is 0, or none is found.
  for (const char* origin :
       {"CALC_REQUEST_LOS:0,veh1", "CALC_REQUEST_LOS:veh1,0", "CALC_REQUEST_LOS:,", "CALC_REQUEST_LOS:,veh1"})
    CHECK(is_about_origin(asked(origin)));
  CHECK(!is_about_origin(asked("CALC_REQUEST_LOS:veh0,veh10")));
}

TEST_CASE("a round of updates is whole once every vehicle has one") {
  const std::vector<LiveType> types = two_types();
  const LiveBounds bounds{{-100, -100, -1}, {100, 100, 10}};
  Traffic traffic(types, bounds, {});
  traffic.update(at("a", 0, 0));
  traffic.update(at("b", 10, 0));
  CHECK(traffic.round_is_whole());
  traffic.update(at("a", 1, 0));
  CHECK(!traffic.round_is_whole());
  traffic.update(at("b", 11, 0));
  CHECK(traffic.round_is_whole());
  traffic.update(at("c", 20, 0));  // a new one in the same round
  CHECK(traffic.round_is_whole());
  for (int round = 0; round < 4; ++round) traffic.update(at("a", round, 0));
  CHECK(traffic.size() == 1);  // the others have left
  CHECK(traffic.round_is_whole());
}

TEST_CASE("answers as the client of VaN3Twin reads them") {
  const Question gain = asked("CALC_REQUEST_PATHGAIN:a,b"), delay = asked("CALC_REQUEST_DELAY:a,b");
  const Question los = asked("CALC_REQUEST_LOS:a,b");
  const Link link{-97.5, 2.5e-7, true};
  CHECK(answer(gain, link) == "CALC_DONE_PATHGAIN:97.5");  // a loss, for all its name
  CHECK(answer(delay, link) == "CALC_DONE_DELAY:2.5e-07");
  CHECK(answer(los, link) == "CALC_DONE_LOS:[True]");
  CHECK(answer(gain, Link{}) == "CALC_DONE_PATHGAIN:300");
  CHECK(std::stof(answer(delay, Link{}).substr(16)) == 1e5F);
  CHECK(answer(los, Link{}) == "CALC_DONE_LOS:[False]");
  CHECK(answer(gain, {}) == "CALC_DONE_PATHGAIN:0");
  CHECK(answer(delay, {}) == "CALC_DONE_DELAY:0");
  CHECK(answer(los, {}) == "CALC_DONE_LOS:0");
  // The client has 100 bytes for an answer, one of which is a zero at the end.
  CHECK(confirmation(at(std::string(most_id_bytes, 'x'), 0, 0)).size() < 100);
  CHECK(answer(gain, Link{-1.0 / 3 * 1e-300, 0, false}).size() < 100);
}

TEST_CASE("other datagrams are no messages") {
  const std::string numbers = ",0,0,0,0,0,0,0", id(most_id_bytes, 'x');
  CHECK(parse("LOC_UPDATE:" + id + numbers));
  for (const std::string& wrong : {std::string(),
                                   std::string("LOC_UPDATE:"),
                                   "LOC_UPDATE:" + id + "x" + numbers,
                                   "LOC_UPDATE:" + numbers,
                                   std::string("LOC_UPDATE:a,0,0,0,0,0,0"),
                                   "LOC_UPDATE:a,0" + numbers,
                                   std::string("LOC_UPDATE:a,nan,0,0,0,0,0,0"),
                                   std::string("LOC_UPDATE:a,0,inf,0,0,0,0,0"),
                                   std::string("LOC_UPDATE:a,1e300,0,0,0,0,0,0"),
                                   std::string("LOC_UPDATE:a,1x,0,0,0,0,0,0"),
                                   std::string("LOC_UPDATE:a,,0,0,0,0,0,0"),
                                   std::string("LOC_UPDATE:a b") + numbers,
                                   std::string("LOC_UPDATE:\xc3\xa9") + numbers,
                                   std::string("CALC_REQUEST_LOS:a"),
                                   std::string("CALC_REQUEST_LOS:a,b,c"),
                                   std::string("CALC_REQUEST_NOISE:a,b"),
                                   std::string("SHUTDOWN_SIONNA_NOW"),
                                   std::string("loc_update:a") + numbers,
                                   std::string(most_bytes + 1, 'L'),
                                   std::string("CALC_REQUEST_LOS:a,b\0", 21)})
    CHECK_MESSAGE(!parse(wrong), wrong);
}

TEST_CASE("vehicles take places, miss rounds and leave") {
  const std::vector<LiveType> types = two_types();
  const LiveBounds bounds{{-100, -100, -1}, {100, 100, 10}};
  Traffic traffic(types, bounds, {{0, 0, 0}, true});
  CHECK(traffic.update(at("a", 10, 0)) == Traffic::Placed::yes);
  CHECK(traffic.update(at("b", 20, 0, 0)) == Traffic::Placed::yes);
  CHECK(traffic.update(at("c", 30, 0, 225)) == Traffic::Placed::yes);  // the third place is that of the bus
  CHECK(traffic.update(at("d", 40, 0)) == Traffic::Placed::no_place);
  const std::vector<LivePose> poses = traffic.poses();
  REQUIRE(poses.size() == 3);
  CHECK(!traffic.has_changed());
  // The front bumper is half a length ahead of the middle: east, north, and south-west of it.
  const double half = std::numbers::sqrt2 / 2;
  CHECK(glm::distance(poses[0].position_m, {8, 0, 0}) < 1e-12);
  CHECK(glm::distance(poses[1].position_m, {20, -2, 0}) < 1e-12);
  CHECK(glm::distance(poses[2].position_m, {30 + 6 * half, 6 * half, 0}) < 1e-12);
  CHECK(poses[2].type == "bus");
  CHECK(glm::distance(poses[1].orientation * glm::dvec3(1, 0, 0), {0, 1, 0}) < 1e-12);
  CHECK(traffic.transmitter("a") == "a/high");  // the low one does not send
  CHECK(traffic.receiver("a") == "a/low");
  CHECK(traffic.transmitter("c").empty());
  CHECK(traffic.transmitter("d").empty());

  // The same update again changes nothing. "b" is not heard of any more: after two more rounds its place is free.
  for (int round = 0; round < 3; ++round) {
    CHECK(traffic.size() == 3);
    traffic.update(at("a", 10, 0));
    traffic.update(at("c", 30, 0, 225));
  }
  CHECK(traffic.size() == 2);
  CHECK(traffic.has_changed());
  CHECK(traffic.update(at("d", 40, 0)) == Traffic::Placed::yes);
  CHECK(traffic.poses().size() == 3);
  // A vehicle that drives out of the scene gives up its place.
  CHECK(traffic.update(at("d", 400, 0)) == Traffic::Placed::outside);
  CHECK(traffic.has_changed());
  CHECK(traffic.size() == 2);
  CHECK(traffic.transmitter("d").empty());
}

TEST_CASE("offsets, and positions of the middle") {
  const std::vector<LiveType> types = two_types();
  const LiveBounds bounds{{-100, -100, -1}, {100, 100, 10}};
  Traffic traffic(types, bounds, {{1000, -500, -1.5}, false});
  CHECK(traffic.update({"a", {-990, 520, 1.5}, 45}) == Traffic::Placed::yes);
  CHECK(traffic.poses().front().position_m == glm::dvec3(10, 20, 0));
}

}  // namespace wavetracer::live::van3twin
