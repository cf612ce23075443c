// SPDX-License-Identifier: Apache-2.0
// The table of orders against the words of order.method.
#include "wavetracer/order_methods.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string>

using namespace wavetracer;

TEST_CASE("every word of order.method but auto stands in one row, as a name or as a mnemonic") {
  std::set<std::string> words;
  for (const OrderMethodRow& row : order_methods) {
    CHECK(words.insert(row.name.text()).second);
    if (row.mnemonic != row.name) CHECK(words.insert(row.mnemonic.text()).second);
  }
  CHECK(words.insert("auto").second);
  CHECK(words == std::set<std::string>(OrderMethod::words.begin(), OrderMethod::words.end()));
}

TEST_CASE("a method is found by both of its words, and auto is not found") {
  for (const OrderMethodRow& row : order_methods) {
    CHECK(find_order_method(row.name)->name == row.name);
    CHECK(find_order_method(row.mnemonic)->name == row.name);
  }
  CHECK_FALSE(find_order_method("auto"));
  CHECK_FALSE(find_order_method("WS")->key);
  CHECK(find_order_method("H3DH2DH")->launch_dimensions == 2);
  CHECK(find_order_method("H3DH3DH")->launch_dimensions == 3);
}
