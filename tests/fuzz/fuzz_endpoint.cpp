// SPDX-License-Identifier: Apache-2.0
// Fuzz target: the address that a server listens at, and the file of its token. No socket is opened.
#include "fuzz/fuzz.hpp"
#include "live/endpoint.hpp"
#include "live/token.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  static fuzz::MemoryFile file;
  const std::string text(fuzz::text_of(data, size));
  fuzz::accept_or_refuse([&] { live::parse_endpoint(text); });
  return fuzz::accept_or_refuse([&] {
    const std::string token = live::read_token(file.write(data, size));
    if (!live::same_token(token, token) || live::same_token(token, token + " ")) std::abort();
  });
}
