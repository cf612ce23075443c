// SPDX-License-Identifier: Apache-2.0
// Feeds files to a fuzz target, each once, without a fuzzer: replay_NAME FILE|FOLDER...
// A fault ends the process: reaching the end is the test.
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace {

size_t feed(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) {
    size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(path)) count += feed(entry.path());
    return count;
  }
  std::cout << path.string() << std::endl;  // printed before the input, which may end the process
  std::ifstream in(path, std::ios::binary);
  if (!in) return 0;
  const std::string content(std::istreambuf_iterator<char>(in), {});
  LLVMFuzzerTestOneInput(reinterpret_cast<const uint8_t*>(content.data()), content.size());
  return 1;
}

}  // namespace

int main(int count, char** arguments) {
  size_t fed = 0;
  for (int i = 1; i < count; ++i) fed += feed(arguments[i]);
  std::cout << fed << " inputs\n";
  return fed > 0 ? 0 : 1;  // a missing corpus must fail
}
