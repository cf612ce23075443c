# SPDX-License-Identifier: Apache-2.0
"""Headers with the arguments of kernels (cmake/kernel_calls.py), and launches that must not compile.
kernel_calls_test.py SOURCE INCLUDES COMPILER...: INCLUDES are the folders that passes are compiled with, separated by
a bar."""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE, INCLUDES, COMPILER = Path(sys.argv[1]), sys.argv[2].split("|"), sys.argv[3:]
sys.path.insert(0, str(SOURCE / "cmake"))
import kernel_calls  # noqa: E402

RECORDS = kernel_calls.records_of(SOURCE / "include/wavetracer/device")


def structs(text):
    """Returns the members of each struct that a file of kernels becomes."""
    return {kernel.struct: [f"{argument.type()} {argument.name}" for argument in kernel.arguments]
            for kernel in kernel_calls.declarations(text, RECORDS)}


def errors(text):
    """Returns what the compiler says of a source, empty if it compiles."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "source.cpp"
        path.write_text(text)
        run = subprocess.run(COMPILER + ["-std=c++20", "-fsyntax-only"] + ["-I" + i for i in INCLUDES] + [str(path)],
                             capture_output=True, text=True, env={**os.environ, "LC_ALL": "C"})
    assert (run.returncode == 0) == ("error:" not in run.stderr), run.stderr
    return run.stderr if run.returncode else ""


class Declarations(unittest.TestCase):
    def test_types(self):
        found = structs("""// kernel void not_this(global uint* a) {}
__attribute__((reqd_work_group_size(WT_N, 1, 1))) kernel void k(const global uint* restrict a, global float4* b,
    global wt_surface* c, const global wt_material* d, global WT_KEY* e, ulong f, wt_legs_arguments g) {}""")
        self.assertEqual(found, {"k": ["gpu::Global<const uint32_t> a", "gpu::Global<gpu::Vector<float, 4>> b",
                                       "gpu::Global<wt_surface> c", "gpu::Global<const device::wt_material> d",
                                       "gpu::Global<gpu::Any> e", "gpu::Value<uint64_t> f",
                                       "gpu::Value<wt_legs_arguments> g"]})

    def test_branches(self):
        found = structs("""#ifdef A
kernel void same(const global uint* a, uint n) {}
kernel void other(global uint* a, uint n) {}
#else
kernel void same(global uint* a, uint n) {}
#if B == 2
kernel void other(global uint* b) {}
#endif
#endif""")
        self.assertEqual(found, {"same": ["gpu::Global<uint32_t> a", "gpu::Value<uint32_t> n"],
                                 "other_A": ["gpu::Global<uint32_t> a", "gpu::Value<uint32_t> n"],
                                 "other_not_A_B_2": ["gpu::Global<uint32_t> b"]})

    def test_arguments_of_some_builds(self):
        found = structs("""#ifdef A
#define MORE const global WT_LEAF *leaves, \\
  global ushort* links,
#else
#define MORE
#endif
kernel void k(global uint* a, MORE uint n) {}""")
        self.assertEqual(found["k"], ["gpu::Global<uint32_t> a", "std::optional<gpu::Global<const gpu::Any>> leaves",
                                      "std::optional<gpu::Global<uint16_t>> links", "gpu::Value<uint32_t> n"])

    def test_what_the_host_cannot_call(self):
        for text in ("kernel void k(local uint* a) {}", "kernel void k(unsigned int n) {}",
                     "kernel void k(float4 v) {}", "kernel void k(global uint* a,\n#ifdef A\nuint b,\n#endif\nuint n) {}",
                     "kernel\n#define X\nvoid k(uint n) {}", "kernel __attribute__((x)) int k(uint n) {}"):
            with self.assertRaises(kernel_calls.Fault, msg=text):
                structs(text)

    def test_a_header_is_written_when_it_changes(self):
        with tempfile.TemporaryDirectory() as folder:
            kernel, header = Path(folder) / "k.cl", Path(folder) / "out/k.hpp"
            def write(text):
                kernel.write_text(text)
                subprocess.run([sys.executable, "-B", SOURCE / "cmake/kernel_calls.py",
                                SOURCE / "include/wavetracer/device", header.parent, kernel], check=True)
            write("kernel void k(uint n) {}")
            os.utime(header, (1, 1))
            write("kernel void k(uint n) { n = 2; }")
            self.assertEqual(header.stat().st_mtime, 1)
            write("kernel void k(uint m) {}")
            self.assertNotEqual(header.stat().st_mtime, 1)

    def test_every_kernel_has_its_arguments(self):
        for path in sorted((SOURCE / "kernels").glob("*/*.cl")):
            self.assertGreater(len(structs(path.read_text())), 0, path)


LAUNCH = """#include "kernel_calls/visible.hpp"
namespace wavetracer {
void launch(gpu::KernelOf<calls::visible::visible>& kernel, const gpu::Buffer<wt_solved>& solved,
            const gpu::Buffer<double>& vertices, const gpu::Buffer<uint32_t>& sequences, uint32_t count, size_t size,
            const gpu::Buffer<wt_counters>* counters) {
  kernel({1, 1}, Stage::visible,
         calls::visible::visible{
             .solved = solved,
             .vertices = vertices,
             .sequences = sequences,
             .solved_count = count,
             .solved_counter = 5u,
             .max_depth = static_cast<uint32_t>(size),
             .out = solved,
             .out_vertices = vertices,
             .out_sequences = sequences,
             .capacity = count,
             .counters = counters});
}
}  // namespace wavetracer
"""


class Launches(unittest.TestCase):
    def refused(self, old, new, message):
        self.assertIn(old, LAUNCH)
        self.assertIn(message, errors(LAUNCH.replace(old, new)))

    def test_right_arguments_compile(self):
        self.assertEqual(errors(LAUNCH), "")
        self.assertEqual(errors(LAUNCH.replace(".counters = counters", ".counters = nullptr")), "")

    def test_a_swapped_pair(self):
        pair = [".solved_count = count,", ".solved_counter = 5u,"]
        self.refused("\n             ".join(pair), "\n             ".join(pair[::-1]), "solved_count")

    def test_a_swapped_pair_of_a_pass(self):
        path = SOURCE / "host/passes/fields.cpp"
        lines = path.read_text().splitlines(keepends=True)
        first = next(i for i, line in enumerate(lines) if ".receiver_of = " in line)
        self.assertEqual(errors("".join(lines)), "")
        lines[first], lines[first + 1] = lines[first + 1], lines[first]
        self.assertIn("fields::receiver_of", errors("".join(lines)))

    def test_a_missing_argument(self):
        self.refused(".capacity = count,", "", "gpu::Value<unsigned int>")
        self.refused(".out_vertices = vertices,", "", "gpu::Global<double>")

    def test_a_buffer_of_other_elements(self):
        self.refused(".vertices = vertices,", ".vertices = sequences,", "gpu::Global<const double>")
        self.refused(".counters = counters", ".counters = &solved", "gpu::Global<wt_counters>")

    def test_a_value_for_a_buffer_and_a_buffer_for_a_value(self):
        self.refused(".out = solved,", ".out = 0,", "gpu::Global<wt_solved>")
        self.refused(".solved_count = count,", ".solved_count = sequences,", "deleted")

    def test_a_number_that_may_not_fit(self):
        self.refused("static_cast<uint32_t>(size)", "size", "deleted")
        self.refused(".solved_counter = 5u,", ".solved_counter = 5.0f,", "deleted")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
