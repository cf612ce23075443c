// What Debian's assimp 5.2.5 leaks where it refuses a damaged model is none of ours, and a run reads few models.
// Only the leak sanitizer asks for this.
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp.so"; }
