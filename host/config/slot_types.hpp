// SPDX-License-Identifier: Apache-2.0
// Type traits for code that visits a slot of the field table.
#pragma once
#include <optional>
#include <type_traits>

namespace wavetracer::config {

template <class T>
struct Number {
  using Type = T;
  static constexpr bool optional = false;
};
template <class T>
struct Number<std::optional<T>> {
  using Type = T;
  static constexpr bool optional = true;
};
template <class T>
constexpr bool is_integer = std::is_integral_v<typename Number<T>::Type>;

template <class... F>
struct Overload : F... {
  using F::operator()...;
};
template <class... F>
Overload(F...) -> Overload<F...>;

}  // namespace wavetracer::config
