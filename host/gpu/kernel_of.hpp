// SPDX-License-Identifier: Apache-2.0
// Kernels whose arguments are checked where the host is compiled. cmake/kernel_calls.py makes a struct of every
// kernel's declaration, calls::PROGRAM::KERNEL in "kernel_calls/PROGRAM.hpp", with a member for each argument. A
// launch gives them by name and in their order: arguments in another order, one too few, or a buffer of other elements
// do not compile.
#pragma once
#include <concepts>
#include <cstddef>
#include <optional>
#include <type_traits>

#include "gpu/gpu.hpp"
#include "wavetracer/device/types.h"

namespace wavetracer::gpu {

// The elements of a kernel's buffer whose type only the kernel's program knows.
struct Any {};

// A vector of OpenCL C with so many lanes.
template <class Scalar, int lanes>
struct Vector {};

// Tells whether a kernel that is declared with elements of type Device may be given a buffer of elements of type Host.
// These are all such pairs.
template <class Device, class Host>
inline constexpr bool reads_as = std::same_as<Device, Host> || std::same_as<Device, Any>;
template <class Scalar, int lanes>
inline constexpr bool reads_as<Vector<Scalar, lanes>, Scalar> = true;
template <>
inline constexpr bool reads_as<Vector<float, 4>, wt_float4> = true;

template <class Host, class Device>
concept ReadAs = reads_as<Device, Host>;

// A pointer to global memory: a buffer, or a null pointer, which is NULL in the kernel. Element is const where the
// kernel only reads; a host's const buffer is a handle, so both kinds take it. The buffer must exist until the launch.
template <class Element>
class Global {
 public:
  using Device = std::remove_const_t<Element>;
  template <ReadAs<Device> Host>
  Global(const Buffer<Host>& buffer) : memory_(&buffer) {}
  template <ReadAs<Device> Host>
  Global(const Buffer<Host>* buffer) : memory_(buffer) {}
  template <std::same_as<Memory> Untyped>
  Global(const Untyped& memory) : memory_(&memory) {
    static_assert(std::same_as<Device, Any>, "an untyped buffer is given for typed elements");
  }
  template <std::same_as<std::nullptr_t> Null>
  Global(Null) {}
  // Words whose bits the kernel takes for another type of their size: planes of rays hold floats and integers.
  template <class Host>
  static Global bits_of(const Buffer<Host>* buffer) {
    static_assert(sizeof(Host) == sizeof(Element));
    Global out(nullptr);
    out.memory_ = buffer;
    return out;
  }
  template <class Host>
  static Global bits_of(const Buffer<Host>& buffer) {
    return bits_of(&buffer);
  }

 private:
  template <class Call>
  friend class KernelOf;
  const Memory* memory_ = nullptr;
};

// Numbers of type From, all of whose values a number of type To can hold.
template <class From, class To>
concept Fits =
    std::is_arithmetic_v<From> && std::is_arithmetic_v<To> && !std::same_as<From, To> && requires(From from) {
  To{from};
};

// A value of this type, or a number that fits.
template <class T>
class Value {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  Value(const T& value) : value_(value) {}
  template <Fits<T> From>
  Value(From value) : value_{value} {}
  template <class From>
  Value(From) = delete;

 private:
  template <class Call>
  friend class KernelOf;
  T value_;
};

// A kernel that is launched with the arguments of its declaration, Call. Arguments that only some builds of the kernel
// have are left out for the others. The kernel that the device has compiled must have the same names of arguments: it
// may have been read from another folder (WAVETRACER_KERNEL_DIR).
template <class Call>
class KernelOf {
 public:
  KernelOf() = default;
  // program: another one with a kernel of this name and these arguments.
  KernelOf(Context& context, const Definitions& definitions = {}, const char* program = Call::program_name)
      : kernel_(context.kernel(program, Call::kernel_name, definitions)) {}

  // Launches as Kernel does, with its errors; std::logic_error also where a name differs.
  void operator()(Range range, Stage stage, const Call& call) {
    size_t count = 0;
    call.each([&](const char*, const auto& argument) { count += given(argument); });
    kernel_.check_count(count);
    if (!named_) check_names(call);
    if (range.empty()) return;
    unsigned i = 0;
    call.each([&](const char*, const auto& argument) {
      if (given(argument)) set(i++, argument);
    });
    kernel_.enqueue(range, stage);
  }

 private:
  Kernel kernel_;
  bool named_ = false;  // the names are those of the kernel that the device has compiled

  void check_names(const Call& call) {
    unsigned i = 0;
    call.each([&](const char* name, const auto& argument) {
      if (given(argument)) kernel_.check_name(i++, name);
    });
    named_ = true;
  }

  template <class Argument>
  static bool given(const Argument&) {
    return true;
  }
  template <class Argument>
  static bool given(const std::optional<Argument>& argument) {
    return argument.has_value();
  }
  template <class Argument>
  void set(unsigned index, const std::optional<Argument>& argument) {
    set(index, *argument);
  }
  template <class Element>
  void set(unsigned index, const Global<Element>& argument) {
    kernel_.set_memory(index, argument.memory_);
  }
  template <class T>
  void set(unsigned index, const Value<T>& argument) {
    kernel_.set_value(index, &argument.value_, sizeof(T));
  }
};

}  // namespace wavetracer::gpu
