// SPDX-License-Identifier: Apache-2.0
// Tests of the program cache on disk: nothing but the exact file of the exact key is ever taken.
// No device is needed: the payload is any string.
#include "gpu/cache.hpp"
#include <doctest/doctest.h>
#include <set>
#include "base/hash.hpp"
#include "gpu/temporary.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using gpu::ProgramCache;
using gpu::ProgramKey;

namespace {

const ProgramKey key{"kernel void k() {}", "-cl-std=CL3.0", "platform", "OpenCL 3.0", "device", "1.0"};
const std::string compiled("binary\0with\nzeros", 17);

}  // namespace

TEST_CASE("FNV-1a of 128 bits agrees with the published vectors") {
  // RFC 9923 gives the offset basis; the other values follow from its definition in exact integer arithmetic.
  CHECK(fnv1a_128("") == "6c62272e07bb014262b821756295c58d");
  CHECK(fnv1a_128("a") == "d228cb696f1a8caf78912b704e4a8964");
  CHECK(fnv1a_128("foobar") == "343e1662793c64bf6f0d3597ba446f18");
}

TEST_CASE("the second hash sees every byte and the length") {
  std::set<uint64_t> seen{mix64("")};
  std::string text(40, '\0');
  CHECK(seen.insert(mix64(text)).second);
  CHECK(seen.insert(mix64(text + '\0')).second);
  for (char& c : text) {
    c = 1;
    CHECK(seen.insert(mix64(text)).second);
    c = 0;
  }
}

TEST_CASE("what was stored is loaded, and nothing else lies in the folder") {
  const TemporaryFolder folder;
  const ProgramCache cache(folder.path() / "new" / "programs");
  CHECK_FALSE(cache.load(key));
  cache.store(key, compiled);
  REQUIRE(cache.load(key));
  CHECK(*cache.load(key) == compiled);
  CHECK(cache.path(key).filename().string().size() == 32);
  const auto files = std::filesystem::directory_iterator(folder.path() / "new" / "programs");
  CHECK(std::distance(begin(files), end(files)) == 1);
  cache.store(key, "newer");
  CHECK(*cache.load(key) == "newer");
}

TEST_CASE("every field of the key counts, and fields do not run together") {
  const TemporaryFolder folder;
  const ProgramCache cache(folder.path());
  cache.store(key, compiled);
  for (std::string ProgramKey::*field : {&ProgramKey::source, &ProgramKey::options, &ProgramKey::platform,
                                         &ProgramKey::platform_version, &ProgramKey::device, &ProgramKey::driver}) {
    ProgramKey other = key;
    (other.*field) += "x";
    CHECK_FALSE(cache.load(other));
    CHECK(cache.path(other) != cache.path(key));
    // Even under the same name, as after a collision of hashes, another key's file is not taken.
    std::filesystem::copy_file(cache.path(key), cache.path(other));
    CHECK_FALSE(cache.load(other));
  }
  ProgramKey shifted = key;
  shifted.platform = key.platform + key.platform_version;
  shifted.platform_version.clear();
  CHECK(cache.path(shifted) != cache.path(key));
}

TEST_CASE("a file with any byte changed, cut or added is ignored") {
  const TemporaryFolder folder;
  const ProgramCache cache(folder.path());
  cache.store(key, compiled);
  const std::filesystem::path path = cache.path(key);
  const std::string whole = read_file(path);
  for (size_t i = 0; i < whole.size(); ++i) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 0x20);
    write_file(path, changed);
    CAPTURE(i);
    CHECK_FALSE(cache.load(key));
    write_file(path, whole.substr(0, i));
    CHECK_FALSE(cache.load(key));
  }
  write_file(path, whole + "x");
  CHECK_FALSE(cache.load(key));
  write_file(path, whole);
  CHECK(cache.load(key));
}

TEST_CASE("a folder that cannot be made or read is no error") {
  const TemporaryFolder folder;
  write_file(folder.path() / "file", "not a folder");
  const ProgramCache under_a_file(folder.path() / "file" / "programs");
  CHECK(under_a_file.store(key, compiled)
            .find("compiled kernels cannot be kept in " + (folder.path() / "file/programs").string()) == 0);
  CHECK_FALSE(under_a_file.load(key));
  // A folder where the program's file should be: the rename fails and the temporary file goes.
  const ProgramCache blocked(folder.path() / "programs");
  write_file(blocked.path(key) / "in_the_way", "");
  CHECK(blocked.store(key, compiled).find("so each start compiles them again") != std::string::npos);
  CHECK_FALSE(blocked.load(key));
  const auto files = std::filesystem::directory_iterator(folder.path() / "programs");
  CHECK(std::distance(begin(files), end(files)) == 1);
}

TEST_CASE("the environment says where, and whether") {
  const std::string name = ProgramCache({}).path(key).filename().string();
  const Environment on("WAVETRACER_NO_CACHE", nullptr);
  {
    const Environment cache_home("XDG_CACHE_HOME", "/somewhere"), home("HOME", "/home/user");
    CHECK(ProgramCache::from_environment().path(key) == "/somewhere/wavetracer/programs/" + name);
  }
  {
    const Environment cache_home("XDG_CACHE_HOME", ""), home("HOME", "/home/user");
    CHECK(ProgramCache::from_environment().path(key) == "/home/user/.cache/wavetracer/programs/" + name);
  }
  {
    const Environment cache_home("XDG_CACHE_HOME", nullptr), home("HOME", nullptr);
    const ProgramCache off = ProgramCache::from_environment();
    off.store(key, compiled);
    CHECK_FALSE(off.load(key));
  }
  const TemporaryFolder folder;
  const Environment cache_home("XDG_CACHE_HOME", folder.path().c_str()), no_cache("WAVETRACER_NO_CACHE", "1");
  ProgramCache::from_environment().store(key, compiled);
  CHECK_FALSE(ProgramCache::from_environment().load(key));
  CHECK(std::filesystem::is_empty(folder.path()));
}
