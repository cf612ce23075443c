// SPDX-License-Identifier: Apache-2.0
// The program without the maps module, with another version of it, or in a wheel, where it must not be opened.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <cstdlib>
#include <filesystem>
#include "base/file.hpp"
#include "folders.hpp"
#include "temporary_folder.hpp"

namespace fs = std::filesystem;
using wavetracer::read_file;
using wavetracer::test::TemporaryFolder;

TEST_CASE("without the module the message says what to do, the exit code is 1, and GDAL is not even opened") {
  const TemporaryFolder folder;
  const fs::path file = folder.write("a.geojson", R"({"type":"FeatureCollection","features":[]})");
  const std::string program = wavetracer::test::program(), log = (folder.path() / "log").string();
  // Returns the program's messages, with the files that the loader opens (LD_DEBUG=files); variables: for its
  // environment.
  const auto said = [&](const std::string& variables) {
    const int status = std::system(fmt::format("{} LD_DEBUG=files '{}' convert '{}' -o '{}' > '{}' 2>&1", variables,
                                               program, file.string(), (folder.path() / "out").string(), log)
                                       .c_str());
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 1);
    return read_file(log);
  };
  const auto check = [](const std::string& text, const char* words) {
    CHECK(text.find(words) != text.npos);
    CHECK(text.find("file=libgdal") == text.npos);
  };
  const std::string absent = said("WAVETRACER_MAPS_MODULE=/nowhere.so");
  if (absent.find("built without it") == absent.npos) {
    check(absent, "wavetracer_maps.so, is not there (/nowhere.so): install wavetracer's Debian package");
    const fs::path other = folder.write("other.so",
                                        "\x7f"
                                        "ELF of another version; wavetracer maps, interface 0;");
    check(said("WAVETRACER_MAPS_MODULE=" + other.string()), "is not that of this version of wavetracer");
  }
  // A wheel's libraries lie in a folder of this name: here it is one that any library of the program is found in.
  const fs::path own = folder.path() / "wavetracer.libs";
  fs::create_directory(own);
  const std::string needed = fmt::format("ldd '{}' | sed -n 's/.*libfmt.* => \\(.*\\) (.*/\\1/p'", program);
  REQUIRE(std::system(fmt::format("cp $({}) '{}'", needed, own.string()).c_str()) == 0);
  check(said(fmt::format("LD_LIBRARY_PATH='{}' WAVETRACER_MAPS_MODULE='{}'", own.string(), WAVETRACER_MAPS_FILE)),
        "wheels come without it: convert the file with wavetracer's Debian package");
}
