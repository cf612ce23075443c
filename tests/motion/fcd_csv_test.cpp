// SPDX-License-Identifier: Apache-2.0
// SUMO's FCD as CSV gives what the same FCD gives as XML. The texts are in the forms of xml2csv.py and of SUMO itself.
#include "motion_files.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using doctest::Contains;

namespace {

Trajectories read_rows(const std::string& text, const TrajectoryOptions& options = {}) {
  return read_text(text, options, "fcd.csv");
}

std::string problem_of(const std::string& text, const TrajectoryOptions& options = {}) {
  try {
    read_rows(text, options);
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

void check_same(const Trajectories& a, const Trajectories& b) {
  REQUIRE(a.tracks.size() == b.tracks.size());
  for (size_t i = 0; i < a.tracks.size(); ++i) {
    CHECK(a.tracks[i].id == b.tracks[i].id);
    CHECK(a.types[a.tracks[i].type] == b.types[b.tracks[i].type]);
    REQUIRE(a.tracks[i].samples.size() == b.tracks[i].samples.size());
    for (size_t k = 0; k < a.tracks[i].samples.size(); ++k) {
      const Sample &s = a.tracks[i].samples[k], &t = b.tracks[i].samples[k];
      CHECK(s.time_s == t.time_s);
      CHECK(s.position_m == t.position_m);
      CHECK(s.yaw_rad == t.yaw_rad);
      CHECK(s.velocity_m_s == t.velocity_m_s);
    }
  }
}

std::string with(std::string text, char from, char to) {
  for (char& c : text)
    if (c == from) c = to;
  return text;
}

const std::string sumo_header =
    "timestep_time;vehicle_angle;vehicle_id;vehicle_lane;vehicle_pos;vehicle_slope;vehicle_speed;vehicle_type;"
    "vehicle_x;vehicle_y\n";
const std::string sumo_rows =
    "0.00;90.00;a;e_0;1;0.00;10.00;truck;10.125;0.5\n"
    "0.00;0.00;b;f_0;2;30.00;1.00;passenger;50.5;20.25\n"
    "0.10;90.00;a;e_0;2;0.00;10.00;truck;11.125;0.5\n"
    "0.20;;;;;;;;;\n"
    "0.30;0.00;b;f_0;2;30.00;1.00;passenger;50.5;20.5\n";
const std::string same_as_xml =
    timestep("0.00",
             "<vehicle id=\"a\" x=\"10.125\" y=\"0.5\" angle=\"90\" type=\"truck\" speed=\"10\" slope=\"0\"/>"
             "<vehicle id=\"b\" x=\"50.5\" y=\"20.25\" angle=\"0\" type=\"passenger\" speed=\"1\" slope=\"30\"/>") +
    timestep("0.10",
             "<vehicle id=\"a\" x=\"11.125\" y=\"0.5\" angle=\"90\" type=\"truck\" speed=\"10\" slope=\"0\"/>") +
    timestep("0.20", "") +
    timestep("0.30",
             "<vehicle id=\"b\" x=\"50.5\" y=\"20.5\" angle=\"0\" type=\"passenger\" speed=\"1\" slope=\"30\"/>");

}  // namespace

TEST_CASE("CSV of xml2csv.py is the FCD that it was made of, with every separator, quotes, gzip and CRLF") {
  const Trajectories xml = read_text(fcd(same_as_xml));
  const std::string csv = sumo_header + sumo_rows;
  std::string crlf;
  for (const char c : csv) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  for (const std::string& text :
       {csv, with(csv, ';', ','), with(csv, ';', '\t'), with(csv, ';', '|'), crlf, "\xEF\xBB\xBF" + csv, gzip(csv)}) {
    const Trajectories t = read_rows(text);
    check_same(t, xml);
    CHECK(t.warnings.size() == xml.warnings.size());
  }
  std::string quoted = csv;
  for (const std::string id : {";a;", ";b;"})
    for (size_t at = quoted.find(id); at != quoted.npos; at = quoted.find(id, at + 2))
      quoted.replace(at, 3, ";\"" + id.substr(1, 1) + "\";");
  check_same(read_rows(quoted), xml);
  // Newer releases write names alone, without those of the elements.
  check_same(read_rows("time;angle;id;lane;pos;slope;speed;type;x;y\n" + sumo_rows), xml);
}

TEST_CASE("rows of persons and of riders") {
  const std::string text =
      "person_id;person_x;person_y;timestep_time;vehicle_id;vehicle_x;vehicle_y;vehicle_angle\n"
      ";;;0;bus;10;0;90\n"
      "walker;5;5;0;;;;\n"
      "rider1;11;0;1;bus;11;0;90\n"
      "rider2;11;0;1;bus;11;0;90\n"
      "walker;5;6;1;;;;\n"
      ";;;2;bus;12;0;90\n"
      "walker;5;7;2;;;;\n";
  const Trajectories alone = read_rows(text);
  REQUIRE(alone.tracks.size() == 1);
  CHECK(alone.tracks[0].id == "bus");
  CHECK(alone.tracks[0].samples.size() == 3);
  check_contains(alone.warnings.at(0), "3 samples of persons and containers were left out");
  check_contains(alone.warnings.at(1), "2 samples of riders were left out");
  TrajectoryOptions options;
  options.persons = true;
  const Trajectories all = read_rows(text, options);
  REQUIRE(all.tracks.size() == 2);
  CHECK(all.tracks[1].id == "person:walker");
  CHECK(all.tracks[1].samples.size() == 3);
}

TEST_CASE("what is wrong with such a file is said with its line, and what to do") {
  check_contains(problem_of("timestep_time;vehicle_id;vehicle_speed\n0;a;3\n"),
                 "fcd.csv:1: the header has no column 'vehicle_x'; the CSV of SUMO's --fcd-output has timestep_time");
  check_contains(problem_of("vehicle_arrival;vehicle_depart;vehicle_id\n9;0;a\n"),
                 "fcd.csv:1: the header has no column 'timestep_time'; the CSV of SUMO's --fcd-output has");
  check_contains(problem_of("timestep_time;edge_id;lane_id\n0;a;3\n"),
                 "fcd.csv:1: the header has no column 'vehicle_id'");
  check_contains(problem_of(sumo_header + "0.00;90.00;a;e_0\n"), "fcd.csv:2: the row has 4 cells, the header 10");
  check_contains(problem_of(sumo_header + "now;90.00;a;e_0;1;0;1;truck;1;1\n"),
                 "fcd.csv:2: <timestep>: time = 'now' is neither");
  check_contains(problem_of(sumo_header + "0;90.00;a;e_0;1;0;1;truck;;1\n"),
                 "fcd.csv:2: vehicle 'a' has no attribute 'x'");
  check_contains(problem_of(sumo_header + "0;90.00;a;e_0;1;0;1;truck;one;1\n"),
                 "fcd.csv:2: vehicle 'a': x = 'one' is not a finite");
  check_contains(problem_of(sumo_header + "1;90;a;e_0;1;0;1;truck;1;1\n0;90;a;e_0;1;0;1;truck;1;1\n"),
                 "fcd.csv:3: time goes backwards");
  check_contains(problem_of(sumo_header + "0;90;a;e_0;1;0;1;truck;1;1\n0;90;a;e_0;1;0;1;truck;1;1\n"),
                 "a second sample at 0 s");
  check_contains(problem_of(sumo_header + "0;;;;;;;;;\n"), "the file contains no vehicle");
  check_contains(problem_of("time;id;x;y\n0;a;1;2\n"), "separated by commas, not by semicolons");
  check_contains(problem_of("timestep_time;vehicle_id;vehicle_x;vehicle_x;vehicle_y\n0;a;1;1;2\n"),
                 "column 'vehicle_x' twice");
}

TEST_CASE("hours, minutes and seconds; vehicles off the network") {
  const Trajectories t = read_rows(
      "timestep_time;vehicle_id;vehicle_x;vehicle_y\n00:00:01.00;a;1;2\n00:00:02.00;a;-1073741824.00;-1073741824.00\n"
      "00:00:03.00;a;2;2\n");
  CHECK(t.first_time_s == 1);
  CHECK(t.last_time_s == 3);
  CHECK(t.tracks.at(0).samples.size() == 2);
}

TEST_CASE(
    "degrees are placed by a georeference, on the ground unless the file has heights; without one they are refused") {
  TrajectoryOptions options;
  options.from_degrees = [](const glm::dvec2& degrees) {
    return glm::dvec2(1e5, 1e5) * (degrees - glm::dvec2(11.5, 48.1));
  };
  options.ground = [](const glm::dvec2&) { return std::optional<double>(500); };
  const std::string said = "<!-- <fcd-output.geo value=\"true\"/> -->\n";
  const auto drive = [](const std::string& more, double first = 11.5) {  // 10 m/s to the east
    std::string steps;
    for (int k = 0; k < 4; ++k) {
      char place[100];
      std::snprintf(place, sizeof place,
                    "<vehicle id=\"a\" x=\"%.9f\" y=\"48.100000000\" angle=\"90\" speed=\"10\"%s/>", first + 1e-4 * k,
                    more.c_str());
      steps += timestep(std::to_string(k), place);
    }
    return "<fcd-export>\n" + steps + "</fcd-export>\n";
  };
  for (const std::string& text : {said + drive(""), drive("")}) {
    const Trajectories t = read_text(text, options);
    for (int k = 0; k < 4; ++k)
      check_near(t.tracks.at(0).samples[static_cast<size_t>(k)].position_m, {10 * k - 2.5, 0, 500}, 1e-3);
    CHECK(t.tracks[0].segments.size() == 1);
    CHECK(t.warnings.size() == (text.starts_with("<!--") ? 0 : 1));
    CHECK_THROWS_WITH_AS(read_text(text),
                         Contains("longitude and latitude (--fcd-output.geo), which need a georeference"), InputError);
  }
  check_contains(read_text(drive(""), options).warnings.at(0), "taken as longitude and latitude");
  CHECK(read_text(said + drive(" z=\"512\""), options).tracks.at(0).samples[0].position_m.z == 512);
  options.above_ground = true;
  CHECK(read_text(said + drive(" z=\"12\""), options).tracks.at(0).samples[0].position_m.z == 512);
  CHECK_THROWS_WITH_AS(read_text(said + drive("", 200), options),
                       Contains("drive.xml:3: <vehicle id=\"a\">: longitude 200"), InputError);
  CHECK_THROWS_WITH_AS(read_text(said + fcd(timestep("0", "<vehicle id=\"a\" x=\"10\" y=\"0\" speed=\"10\"/>") +
                                            timestep("1", "<vehicle id=\"a\" x=\"20\" y=\"0\" speed=\"10\"/>"))
                                            .substr(39),
                                 options),
                       Contains("as if x and y were metres"), InputError);
  // The same as CSV, with SUMO's six decimals: a decimetre.
  std::string csv = "timestep_time;vehicle_id;vehicle_x;vehicle_y;vehicle_speed;vehicle_angle\n";
  for (int k = 0; k < 4; ++k) csv += std::to_string(k) + ";a;" + std::to_string(11.5 + 1e-4 * k) + ";48.100000;10;90\n";
  const Trajectories t = read_text(csv, options);
  check_near(t.tracks.at(0).samples[3].position_m, {27.5, 0, 500}, 1e-3);
  check_contains(t.warnings.at(1), "positions have 6 decimals of a degree, and so an error of 0.056 m");
  options.offset_m.x = 1;
  CHECK_THROWS_WITH_AS(read_text(csv, options), Contains("remove trajectories.offset_m"), ConfigError);
}
