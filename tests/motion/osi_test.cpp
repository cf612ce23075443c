// SPDX-License-Identifier: Apache-2.0
// Traces of OSI: those that ASAM's own bindings wrote (files/make_osi.py), and messages of our own that are wrong. The
// closed form of that drive is a circle of 20 m at 10 m/s, nose down by 0.1 rad.
#include "folders.hpp"
#include "motion/readers.hpp"

#include <cmath>
#include <protozero/pbf_writer.hpp>

#include "motion/osi_schema.hpp"
#include "motion_files.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using doctest::Contains;

namespace {

Trajectories read_file(const std::string& name, const TrajectoryOptions& options = {}) {
  return read_trajectories(test::source_folder() + "/tests/motion/files/" + name, options);
}

std::string content_of(const std::string& name) {
  std::ifstream in(test::source_folder() + "/tests/motion/files/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

const Track& track_of(const Trajectories& t, const std::string& id) {
  for (const Track& track : t.tracks)
    if (track.id == id) return track;
  FAIL("no track " << id);
  return t.tracks[0];
}

// Messages after their lengths.
std::string trace_of(const std::vector<std::string>& messages) {
  std::string out;
  for (const std::string& m : messages) {
    for (int k = 0; k < 4; ++k) out += static_cast<char>(m.size() >> 8 * k & 255);
    out += m;
  }
  return out;
}

std::string timed(uint32_t nanos, const std::string& object) {
  std::string out;
  protozero::pbf_writer writer(out);
  {
    protozero::pbf_writer time(writer, osi::ground_truth::timestamp);
    time.add_uint32(osi::timestamp::nanos, nanos);
  }
  writer.add_message(osi::ground_truth::moving_object, object);
  return out;
}

std::string object_at(std::optional<uint64_t> number, std::optional<double> x) {
  std::string out;
  protozero::pbf_writer writer(out);
  if (number) {
    protozero::pbf_writer id(writer, osi::moving_object::id);
    id.add_uint64(osi::identifier::value, *number);
  }
  protozero::pbf_writer base(writer, osi::moving_object::base);
  if (x) {
    protozero::pbf_writer position(base, osi::base_moving::position);
    position.add_double(osi::triple::first, *x);
  }
  return out;
}

Trajectories read_messages(const std::vector<std::string>& messages) {
  return read_text(trace_of(messages), {}, "a.osi");
}

}  // namespace

TEST_CASE("a trace of ASAM's bindings: times, sizes, classes, and the middle of the footprint") {
  for (const char* name : {"ground_truth.osi", "sensor_view.osi"}) {
    CAPTURE(name);
    const Trajectories t = read_file(name);
    REQUIRE(t.tracks.size() == 3);
    CHECK(t.first_time_s == 100);
    CHECK(t.last_time_s == doctest::Approx(100.5).epsilon(1e-12));
    CHECK(t.step_s == doctest::Approx(0.1).epsilon(1e-9));
    const Track& car = track_of(t, "7");
    CHECK(t.types[car.type] == VehicleType{"passenger", 4.6, 1.9, 1.4});
    CHECK(t.types[track_of(t, "8").type] == VehicleType{"bus", 11, 2.6, 3.2});
    CHECK(t.types[track_of(t, "9").type] == VehicleType{"pedestrian", 0.215, 0.478, 1.719});
    REQUIRE(car.samples.size() == 6);
    REQUIRE(car.segments.size() == 1);
    for (int frame = 0; frame < 6; ++frame) {
      CAPTURE(frame);
      const double angle = 10.0 / 20 * 0.1 * frame, yaw = angle + pi / 2;
      const Sample& s = car.samples[static_cast<size_t>(frame)];
      check_near(s.position_m, {20 * std::cos(angle), 20 * std::sin(angle), 2}, 1e-9);
      CHECK(s.yaw_rad == doctest::Approx(yaw).epsilon(1e-12));
      CHECK(s.pitch_rad == doctest::Approx(-0.1).epsilon(1e-12));
      check_near(s.velocity_m_s,
                 {10 * std::cos(0.1) * std::cos(yaw), 10 * std::cos(0.1) * std::sin(yaw), -10 * std::sin(0.1)}, 1e-9);
    }
    check_near(track_of(t, "8").samples[5].position_m, {-30, 5, 0});
    check_near(track_of(t, "9").samples[5].position_m, {3, 4.7, 0}, 1e-9);
    const bool sensors = std::string(name) == "sensor_view.osi";
    CHECK(t.warnings.size() == (sensors ? 1 : 0));
    if (sensors) check_contains(t.warnings[0], "6 messages have the time of the one before them");
  }
}

TEST_CASE("a type of the configuration goes before the size of the object; gzip is read") {
  const Trajectories t = read_file("ground_truth.osi", {.types = {{"bus", 13, 2.5, 3}}});
  CHECK(t.types[track_of(t, "8").type] == VehicleType{"bus", 13, 2.5, 3});
  const Trajectories packed = read_text(gzip(content_of("ground_truth.osi")), {}, "drive.osi.gz");
  CHECK(packed.tracks.size() == 3);
}

TEST_CASE("a type that only the run knew which wrote the trace has the size that is in the trace") {
  const auto object = [](bool sized) {
    std::string out;
    protozero::pbf_writer writer(out);
    writer.add_message(osi::moving_object::id, std::string("\x08\x03", 2));
    {
      protozero::pbf_writer base(writer, osi::moving_object::base);
      const auto triple = [&base](uint32_t field, double x, double y, double z) {
        protozero::pbf_writer of(base, field);
        of.add_double(osi::triple::first, x);
        of.add_double(osi::triple::second, y);
        of.add_double(osi::triple::third, z);
      };
      if (sized) triple(osi::base_moving::dimension, 4.5, 1.8, 1.4);
      triple(osi::base_moving::position, 1, 2, 0.7);
    }
    protozero::pbf_writer source(writer, osi::moving_object::source_reference);
    source.add_string(osi::external_reference::type, std::string(osi::reference_type));
    source.add_string(osi::external_reference::identifier, "ego");
    source.add_string(osi::external_reference::identifier, "sedan");
    return out;
  };
  const std::string trace = trace_of({timed(0, object(true))}), without = trace_of({timed(0, object(false))});
  const auto type_with = [&](const TrajectoryOptions& options) {
    const Trajectories t = read_text(trace, options, "a.osi");
    check_near(track_of(t, "ego").samples[0].position_m, {1, 2, 0}, 1e-12);
    return t.types[track_of(t, "ego").type];
  };
  CHECK(type_with({.default_type = std::nullopt}) == VehicleType{"sedan", 4.5, 1.8, 1.4});
  CHECK(type_with({.types = {{"sedan", 5, 2, 1.5}}, .default_type = std::nullopt}) == VehicleType{"sedan", 5, 2, 1.5});
  CHECK(type_with({.default_type = VehicleType{"any", 4, 2, 1}}) == VehicleType{"sedan", 4, 2, 1});
  CHECK_THROWS_WITH_AS(read_text(without, {.default_type = std::nullopt}, "a.osi"),
                       Contains("the vehicle type 'sedan' is unknown: add a [[vehicle_type]]"), InputError);
}

TEST_CASE("classes there and here lead to each other") {
  for (const char* word :
       {"passenger", "delivery", "truck", "trailer", "bus", "motorcycle", "bicycle", "tram", "rail"}) {
    CAPTURE(word);
    CHECK(osi::object_class(word).object == osi::vehicle_object);
    CHECK(osi::class_of_number(osi::object_class(word).vehicle) == word);
  }
  CHECK(osi::object_class("veh_coach").vehicle == 12);
  CHECK(osi::object_class("DEFAULT_PEDTYPE").object == osi::pedestrian_object);
  CHECK(osi::object_class("unheard").object == osi::other_object);
}

TEST_CASE("fields that are not there: a place alone makes a car of SUMO's size, its heading that of the motion") {
  const Trajectories t = read_messages({timed(0, object_at(3, 1)), timed(100000000, object_at(3, 2))});
  REQUIRE(t.tracks.size() == 1);
  CHECK(t.types[0].name == "other");
  check_near(t.tracks[0].samples[1].velocity_m_s, {10, 0, 0}, 1e-9);
}

TEST_CASE("what is wrong with a trace is said with the file and the number of the message") {
  const auto check = [](const std::string& content, const char* text) {
    CAPTURE(text);
    CHECK_THROWS_WITH_AS(read_text(content, {}, "a.osi"), Contains(text), InputError);
  };
  const std::string good = trace_of({timed(0, object_at(3, 1))});
  check(good.substr(0, good.size() - 1), "a.osi: the file ends inside of message 1");
  check(good + std::string(2, '\0'), "a.osi: the file ends inside of message 2");
  check(good + std::string("\xff\xff\xff\xff", 4), "message 2 would have 4294967295 bytes");
  check(trace_of({timed(0, "\x0a\x7f")}), "message 1 is damaged, or no message of OSI");
  check(trace_of({timed(0, object_at({}, 1))}), "message 1 has a moving object without an id");
  check(trace_of({timed(0, object_at(3, {}))}), "message 1 has no position of moving object 3");
  check(trace_of({timed(0, object_at(3, std::nan("")))}), "moving object 3 that are not finite");
  check(trace_of({timed(1000000000, object_at(3, 1))}), "has the time 0 s and 1000000000 ns");
  check(trace_of({timed(5, object_at(3, 1)), timed(4, object_at(3, 1))}), "message 2 goes back in time");
  check(trace_of({std::string("\x0a\x00", 2)}), "message 1 has no timestamp");
  check(trace_of({std::string("\x12\x00", 2)}), "1 messages, and no moving object in them");
  check("\x89MCAP0\r\n", "this is an MCAP file");
}
