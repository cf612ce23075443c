// SPDX-License-Identifier: Apache-2.0
// Debian's assimp 5.2.5 leaks memory when it refuses a damaged model; that is not our fault, and a run reads few
// models. Only the leak sanitizer calls this.
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp.so"; }
