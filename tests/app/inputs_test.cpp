// SPDX-License-Identifier: Apache-2.0
// `validate` opens every file that a configuration names, by any key, and refuses files of another kind. A key with a
// file that this test does not know makes it fail.
#include <doctest/doctest.h>
#include <map>
#include "config/field_table.hpp"
#include "folders.hpp"
#include "program.hpp"

namespace {

const std::string generated = "scene.generate = \"--blocks 2\"\n",
                  sender = "[[transmitter]]\nname = \"t\"\nposition_m = [0, 0, 6]\n",
                  hearer = "[[receiver]]\nname = \"r\"\nposition_m = [50, 0, 2]\n", pair = sender + hearer,
                  track = "[[track]]\nid = \"a\"\ntype = \"passenger\"\nwaypoints = [[0, 3, -40, 0], [1, 3, -39, 0]]\n",
                  times = "[time]\nend_s = 0.5\nstep_s = 0.1\n";

// Returns a configuration whose key names the file: "FILE" stands for its name.
const std::map<std::string, std::string> with_file{
    {"scene.file", "scene.file = \"FILE.obj\"\n" + pair},
    {"scene.streets",
     "scene.file = \"" + wavetracer::test::source_folder() +
         "/configs/scenes/room/room.xml\"\nscene.streets = \"FILE.net.xml\"\n"
         "[[transmitter]]\nname = \"t\"\nposition_m = [1, 1, 2]\n[[receiver]]\nname = \"r\"\nposition_m = [2, 2, 1]\n"},
    {"trajectories.file", generated + pair + "[trajectories]\nfile = \"FILE.csv\"\n"},
    {"array.codebook", generated + sender + "array = \"panel\"\n" + hearer +
                           "[[array]]\nname = \"panel\"\nrows = 2\ncolumns = 2\ncodebook = \"FILE.csv\"\n"},
    {"transmitter.antenna", generated + sender + "antenna = \"FILE.csv\"\n" + hearer},
    {"receiver.antenna", generated + pair + "antenna = \"FILE.csv\"\n"},
    {"receiver_grid.antenna", generated + sender +
                                  "[[receiver_grid]]\nname = \"g\"\nx_min_m = 0\nx_max_m = 10\ny_min_m = 0\n"
                                  "y_max_m = 10\nstep_m = 5\nantenna = \"FILE.csv\"\n"},
    {"station.antenna",
     generated + pair + "[[station]]\nname = \"s\"\nposition_m = [0, 0, 5]\nantenna = \"FILE.csv\"\n"},
    {"mount.antenna",
     generated + pair + track + times + "[[mount]]\nname = \"roof\"\noffset_m = [0, 0, 1.6]\nantenna = \"FILE.csv\"\n"},
    {"vehicle_type.model",
     generated + pair + track + times + "[[vehicle_type]]\nname = \"passenger\"\nmodel = \"FILE.obj\"\n"},
    {"parked.file", generated + pair + "[[parked]]\nname = \"kerb\"\nfile = \"FILE.csv\"\ntype = \"passenger\"\n"},
};

}  // namespace

TEST_CASE("garbage in any input file is refused by validate, with the name of the file") {
  using namespace wavetracer::config;
  size_t keys = 0;
  for (const Table& table : tables())
    for (const Field& field : table.fields) {
      if (field.form != Form::input_file && field.form != Form::choice_or_file) continue;
      const std::string key = table.name + "." + field.name;
      CAPTURE(key);
      ++keys;
      REQUIRE(with_file.contains(key));
      std::string text = with_file.at(key);
      const size_t at = text.find("FILE");
      REQUIRE(at != std::string::npos);
      text.replace(at, 4, "garbage");
      const std::string name = text.substr(at, text.find('"', at) - at);
      const Folder folder;
      folder.file(name, "\x01\x02 this is, no file; of any kind\n{{{ <<<\n");
      const Outcome outcome = run_program({"validate", "-c", folder.file("a.toml", text)});
      CAPTURE(outcome.err);
      CHECK(outcome.code == 3);
      CHECK(contains(outcome.err, folder.path(name)));
      CHECK(outcome.out.empty());
    }
  CHECK(keys == with_file.size());
}

TEST_CASE("a codebook is checked where no antenna uses its array yet, and one that is right is accepted") {
  const Folder folder;
  const std::string text =
      generated + pair + "[[array]]\nname = \"panel\"\nrows = 1\ncolumns = 2\ncodebook = \"book.csv\"\n";
  const std::string config = folder.file("a.toml", text);
  folder.file("book.csv", "beam,element,re,im\n0,0,1,0\n0,2,1,0\n");
  const Outcome wrong = run_program({"validate", "-c", config});
  CHECK(wrong.code == 3);
  CHECK(contains(wrong.err, "element 2 is not there: the array has 2"));
  folder.file("book.csv", "beam,element,re,im\n0,0,1,0\n0,1,1,0\n");
  const Outcome right = run_program({"validate", "-c", config});
  CAPTURE(right.err);
  CHECK(right.code == 0);
}
