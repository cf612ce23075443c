// SPDX-License-Identifier: Apache-2.0
// Debian's GDAL 3.6.2 leaks memory when it opens a damaged map, such as a spatial reference of GML with a wrong closing
// tag; that is not our fault, and a run reads few maps. Leaks of this program with valid maps are found by the tests of
// maps, which run under the leak sanitizer without this. Only the leak sanitizer calls it.
extern "C" const char* __lsan_default_suppressions() { return "leak:libgdal.so"; }
