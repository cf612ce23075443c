// What Debian's GDAL 3.6.2 leaks where it opens a damaged map, such as a spatial reference of GML with a wrong closing
// tag, is none of ours, and a run reads few maps. What this program itself forgets of maps that are whole, the tests of
// maps find: they run under the leak sanitizer without this. Only the leak sanitizer asks for it.
extern "C" const char* __lsan_default_suppressions() { return "leak:libgdal.so"; }
