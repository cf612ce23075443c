// SPDX-License-Identifier: Apache-2.0
// Defines the opaque types of kernels.h, and the one place where exceptions become its errors.
// A pass shares its context, so that it may outlive the handle of the caller's.
#pragma once
#include <exception>
#include <memory>
#include <new>
#include <span>
#include <string>

#include "wavetracer/kernels/context.hpp"
#include "wavetracer/kernels/kernels.h"

struct wavetracer_kernels_error {
  cl_int code;
  std::string message, kernel;
};

struct wavetracer_kernels_context {
  std::shared_ptr<const wavetracer::kernels::Context> context;
};

namespace wavetracer::kernels::c_face {

using SharedContext = std::shared_ptr<const Context>;

// Stores an error, unless the caller wants none or there is no memory for it.
inline void store(wavetracer_kernels_error** error, cl_int code, const char* message,
                  const std::string& kernel) noexcept {
  if (!error) return;
  try {
    *error = new wavetracer_kernels_error{code, message, kernel};
  } catch (const std::bad_alloc&) {
    *error = nullptr;
  }
}

// Returns what the function returns, or `failed` with an error if it throws.
template <class Result, class Function>
Result guarded(wavetracer_kernels_error** error, Result failed, const Function& function) noexcept {
  if (error) *error = nullptr;
  try {
    return function();
  } catch (const Error& thrown) {
    store(error, thrown.code(), thrown.what(), thrown.kernel());
  } catch (const std::bad_alloc&) {
    store(error, CL_OUT_OF_HOST_MEMORY, "the host has too little memory", {});
  } catch (const std::exception& thrown) {
    store(error, 0, thrown.what(), {});
  }
  return failed;
}

// Runs what returns nothing. Returns 1, or 0 with an error.
template <class Function>
int done_or_error(wavetracer_kernels_error** error, const Function& function) noexcept {
  return guarded(error, 0, [&] {
    function();
    return 1;
  });
}

// Returns the object that a caller gave. Throws Error if it is null.
template <class Object>
Object& given(Object* object) {
  if (!object) throw Error("the object that was given is null: making it has failed", 0, "");
  return *object;
}

inline Call call_of(cl_uint after_count, const cl_event* after, cl_event* done) {
  if (after_count != 0 && !after) throw Error("there are events to wait for, and their list is null", 0, "");
  return {.after = {after, after_count}, .done = done};
}

}  // namespace wavetracer::kernels::c_face
