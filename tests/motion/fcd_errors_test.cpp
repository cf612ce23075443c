// SPDX-License-Identifier: Apache-2.0
// SUMO FCD that is broken: every fault is an InputError with file, line and advice.
// Line numbers are counted by hand: fcd() of motion_files.hpp puts the first timestep into line 3.
#include "motion_files.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using doctest::Contains;

namespace {

void fails(const std::string& content, const std::string& message, const TrajectoryOptions& options = {}) {
  CAPTURE(message);
  CHECK_THROWS_WITH_AS(read_text(content, options), Contains(message.c_str()), InputError);
}

std::string car(const std::string& attributes) { return "<vehicle id=\"a\" " + attributes + "/>"; }
const std::string good = car("x=\"1\" y=\"2\" angle=\"90\" speed=\"3\" type=\"car\"");

}  // namespace

TEST_CASE("attributes that are missing or no numbers") {
  const auto in_second = [](const std::string& element) { return fcd(timestep("0", good) + timestep("1", element)); };
  fails(in_second("<vehicle x=\"1\" y=\"2\"/>"), "drive.xml:4: <vehicle> has no attribute 'id'");
  fails(in_second(car("y=\"2\"")), "drive.xml:4: <vehicle id=\"a\"> has no attribute 'x'; if --fcd-output.attributes");
  fails(in_second(car("x=\"1\"")), "drive.xml:4: <vehicle id=\"a\"> has no attribute 'y'");
  fails(in_second(car("x=\"nan\" y=\"2\"")), "drive.xml:4: <vehicle id=\"a\">: x = 'nan' is not a finite number");
  fails(in_second(car("x=\"1\" y=\"inf\"")), "y = 'inf' is not a finite number");
  fails(in_second(car("x=\"1\" y=\"1e999\"")), "y = '1e999' is not a finite number");
  fails(in_second(car("x=\"1\" y=\"2,5\"")), "y = '2,5' is not a finite number");
  fails(in_second(car("x=\"1\" y=\"\"")), "y = '' is not a finite number");
  fails(in_second(car("x=\"1\" y=\"2\" z=\"up\"")), "z = 'up' is not a finite number");
  fails(in_second(car("x=\"1\" y=\"2\" angle=\"N\"")), "angle = 'N' is not a finite number");
  fails(in_second(car("x=\"1\" y=\"2\" speed=\"-nan\"")), "speed = '-nan' is not a finite number");
  fails(in_second(car("x=\"1\" y=\"2\" slope=\"90\"")), "slope = 90 is not within -90 to 90");
  fails(in_second(car("x=\"1\" y=\"2\" speed=\"-1073741824.00\"")), "is what SUMO writes for an unknown value");
  fails(fcd("<timestep>" + good + "</timestep>"), "drive.xml:3: <timestep> has no attribute 'time'");
  for (const char* time :
       {"", "now", "nan", "1:2", "00:60:00", "00:00:60", "1:24:00:00", "00:0.5:00", "1:2:3:4:5", "00:-1:00", "::"}) {
    fails(fcd(timestep(time, good)), std::string("drive.xml:3: <timestep>: time = '") + time + "' is neither");
  }
}

TEST_CASE("ids and types without control characters") {
  const std::string of = "x=\"1\" y=\"2\" angle=\"90\" speed=\"3\"";
  for (const std::string character : {"&#10;", "&#9;", "&#127;"}) {
    fails(fcd(timestep("0", "<vehicle id=\"a" + character + "b\" type=\"car\" " + of + "/>")),
          "its id or type contains a control character");
    fails(fcd(timestep("0", "<vehicle id=\"a\" type=\"c" + character + "r\" " + of + "/>")),
          "drive.xml:3: <vehicle id=\"a\">: its id or type contains a control character");
  }
}

TEST_CASE("times and ids out of order") {
  fails(fcd(timestep("5", good) + timestep("4", good)),
        "drive.xml:4: time goes backwards, from 5 s in line 3 to 4 s; timesteps must be in order");
  fails(fcd(timestep("5", good) + timestep("5.00", good)), "drive.xml:4: time stands still, from 5 s in line 3");
  fails(fcd(timestep("0", "") + timestep("1", good + "\n" + good)),
        "drive.xml:5: <vehicle id=\"a\"> has a second sample at 1 s, the first one is in line 4");
}

TEST_CASE("files of another kind") {
  fails("<?xml version=\"1.0\"?>\n<routes/>", "drive.xml:2: the root element is <routes>");
  fails("<routes/>", "run sumo with --fcd-output FILE");
  fails("<fcd-export/>", "drive.xml: the file has no <timestep>");
  fails(fcd(timestep("0", "")), "drive.xml: the file contains no vehicle");
  fails(fcd("<timestep time=\"0\"/>\n" + good), "drive.xml:4: <vehicle> is outside of a <timestep>");
  fails("", "drive.xml: the file is empty");
  fails("  \r\n ", "drive.xml: the file is empty");
  const TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(read_trajectories(folder.path() / "none.xml"), Contains("none.xml: no such file"), InputError);
  CHECK_THROWS_WITH_AS(read_trajectories(folder.path()), Contains("is a folder"), InputError);
}

TEST_CASE("XML that is not well-formed") {
  fails(fcd(timestep("0", "<vehicle id=\"a\" x=1/>")), "drive.xml:3:38: not well-formed XML");
  fails("<fcd-export>\n<timestep time=\"0\">\n</fcd-export>", "drive.xml:3:3: not well-formed XML: mismatched tag");
  fails("<fcd-export/>\n<fcd-export/>", "drive.xml:2:1: not well-formed XML: junk after document element");
  fails(fcd(timestep("0", "&unknown;")), "not well-formed XML: undefined entity");
  fails(fcd(timestep("0", std::string("<vehicle\0/>", 11))), "drive.xml:3:28: not well-formed XML");
}

TEST_CASE("every cut of a file is an error, plain or gzip") {
  const std::string whole = fcd(timestep("0", good) + timestep("1", good));
  for (size_t size = 1; size < whole.rfind('>'); ++size) {
    CAPTURE(size);
    CHECK_THROWS_WITH_AS(read_text(whole.substr(0, size)), Contains("drive.xml:"), InputError);
  }
  fails(whole.substr(0, whole.size() - 14), "drive.xml:5: the file ends before </fcd-export>: let sumo finish");
  const std::string packed = gzip(whole);
  for (size_t size = 0; size < packed.size(); ++size) {
    CAPTURE(size);
    CHECK_THROWS_WITH_AS(read_text(packed.substr(0, size)), Contains("drive.xml"), InputError);
  }
  fails(packed.substr(0, packed.size() - 9), "the gzip stream ends too early");
  std::string damaged = packed;
  damaged[packed.size() - 6] ^= 1;  // in its checksum
  fails(damaged, "copy the file again");
}

TEST_CASE("longitude and latitude are refused where there is no georeference") {
  const std::string advice = "the coordinates are longitude and latitude (--fcd-output.geo)";
  for (const char* word : {"true", "1", "Yes"}) {
    fails("<?xml version=\"1.0\"?>\n<!-- generated by SUMO\n<fcd-output.geo value=\"" + std::string(word) +
              "\"/>\n-->\n<fcd-export/>",
          "drive.xml:2: " + advice);
  }
  CHECK_NOTHROW(read_text("<!-- <fcd-output.geo value=\"false\"/> -->" + fcd(timestep("0", good)).substr(39)));
  const auto drive = [](double start, double step) {  // at 10 m/s
    std::string steps;
    for (int k = 0; k < 3; ++k) {
      steps += timestep(std::to_string(k),
                        car("x=\"" + std::to_string(start + k * step) + "\" y=\"48.1\" angle=\"90\" speed=\"10\""));
    }
    return fcd(steps);
  };
  fails(drive(11.57, 1.3e-4), "drive.xml: " + advice);
  CHECK_NOTHROW(read_text(drive(11.57, 10)));
  CHECK_NOTHROW(read_text(drive(11000, 1.3e-4)));  // unusual, but no degrees
  std::string back = drive(0, 10);                 // into a car park and out of it again, at the same place
  back.insert(back.find("</fcd"), timestep("9000", car("x=\"20\" y=\"48.1\" angle=\"90\" speed=\"10\"")));
  CHECK_NOTHROW(read_text(back));
}

TEST_CASE("unknown types are errors where there is no default; sizes and scale must be positive") {
  TrajectoryOptions options;
  options.default_type.reset();
  fails(fcd(timestep("0", car("x=\"1\" y=\"2\" type=\"spaceship\""))),
        "drive.xml:3: the vehicle type 'spaceship' is unknown: add a [[vehicle_type]] with its length_m", options);
  options.types = {{"spaceship", 0, 1, 1}};
  CHECK_THROWS_WITH_AS(read_text(fcd(""), options), Contains("vehicle type 'spaceship': 0 m is not a valid size"),
                       ConfigError);
  options.types.clear();
  options.scale = 0;
  CHECK_THROWS_WITH_AS(read_text(fcd(""), options), Contains("the scale of trajectories is 0"), ConfigError);
}

TEST_CASE("a small file that unpacks to gigabytes ends early, with the limit") {
  const std::string head = "<fcd-export>\n<timestep time=\"0\">" + good;
  const std::string blanks(size_t{120} << 20, ' '), letters(size_t{2} << 20, 'a');
  fails(gzip(head + blanks + "</timestep></fcd-export>", Z_BEST_COMPRESSION),
        "drive.xml: unpacks to more than 300 times its");
  fails(gzip("time,id,x,y\n" + blanks, Z_BEST_COMPRESSION), "drive.xml:2: the line does not end");
  const std::string too_long = " of more than 1048576 bytes begins here";
  for (const bool packed : {false, true})
    for (const char* open : {"<vehicle id=\"", "<!--", "<"}) {
      const std::string text = head + "\n" + open + letters;
      fails(packed ? gzip(text) : text, "drive.xml:3: a tag, an attribute or a comment" + too_long);
    }
  CHECK(read_text(head + "<!--" + letters.substr(0, 900000) + "--></timestep></fcd-export>").tracks.size() == 1);
}

TEST_CASE("a vehicle at SUMO's invalid value is absent, whatever else is unknown of it") {
  const std::string off =
      car("x=\"-1073741824.00\" y=\"-1073741824.00\" z=\"-1073741824.00\" slope=\"-1073741824.00\"");
  const Trajectories t =
      read_text(fcd(timestep("0", good) + timestep("1", off) + timestep("2", car("x=\"7\" y=\"2\""))));
  REQUIRE(t.tracks.size() == 1);
  CHECK(t.tracks[0].samples.size() == 2);
  check_contains(t.warnings.at(1), "1 samples have x or y = -1073741824");
  fails(fcd(timestep("0", off)), "drive.xml: the file contains no vehicle");
}
