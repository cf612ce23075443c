# SPDX-License-Identifier: Apache-2.0
"""wavetracer.kernels on arrays of pyopencl, against NumPy. Exits with 77 where pyopencl is not installed."""
import sys

import numpy as np

try:
    import pyopencl as cl
    import pyopencl.array
except ImportError:
    print("skipped: there is no pyopencl")
    sys.exit(77)
import wavetracer
from wavetracer import kernels

device = cl.get_platforms()[0].get_devices()[0]
context = cl.Context([device])
queue = cl.CommandQueue(context)
random = np.random.default_rng(1)


def refused(kind, text, function, *arguments, **options):
    try:
        function(*arguments, **options)
    except kind as error:
        assert text in str(error), error
        return error
    raise AssertionError(f"not refused: {text}")


for dtype in (np.uint32, np.uint64):
    for method in ("automatic", "radix", "bitonic"):
        for n in (1, 100, 20000):
            data = random.integers(0, np.iinfo(dtype).max, n, dtype, endpoint=True)
            keys = cl.array.to_device(queue, data)
            memory = keys.base_data.int_ptr
            event = kernels.sort(keys, method=method)
            assert isinstance(event, cl.Event)
            event.wait()
            assert keys.base_data.int_ptr == memory and np.array_equal(keys.get(), np.sort(data)), (dtype, method, n)
            keys, order = cl.array.to_device(queue, data), cl.array.zeros(queue, n, np.uint32)
            kernels.argsort(keys, order, method=method)
            assert np.array_equal(order.get(), np.argsort(data, kind="stable")), (dtype, method, n)

# Values of 32 bits move with their keys; a range of bits leaves equal ones in their order.
data, weights = random.integers(0, 2**32, 5000, np.uint32), random.random(5000, np.float32)
keys, values = cl.array.to_device(queue, data), cl.array.to_device(queue, weights)
kernels.sort(keys, values, first_bit=4, end_bit=12)
order = np.argsort(data >> 4 & 255, kind="stable")
assert np.array_equal(keys.get(), data[order]) and np.array_equal(values.get(), weights[order])

# The commands wait for an event of the user's.
gate = cl.UserEvent(context)
keys = cl.array.to_device(queue, data)
queue.finish()
done = kernels.sort(keys, wait_for=[gate])
assert done.command_execution_status != cl.command_execution_status.COMPLETE
gate.set_status(cl.command_execution_status.COMPLETE)
done.wait()
assert np.array_equal(keys.get(), np.sort(data))

words, total = cl.array.to_device(queue, data), cl.array.zeros(queue, 1, np.uint32)
kernels.scan(words, total)
assert np.array_equal(words.get(), np.concatenate([[0], np.cumsum(data, dtype=np.uint32)[:-1]]).astype(np.uint32))
assert total.get()[0] == np.sum(data, dtype=np.uint32)
data[::3] = kernels.NOTHING
words, indices = cl.array.to_device(queue, data), cl.array.zeros(queue, len(data), np.uint32)
kernels.compact(words, indices, total)
expected = np.flatnonzero(data != kernels.NOTHING)
assert total.get()[0] == len(expected) and np.array_equal(indices.get()[:len(expected)], expected)

# Morton keys are the bits of cells in turn; a number of cells that is no power of two makes a histogram.
for curve, cells, dtype in (("morton2", 1 << 16, np.uint32), ("morton3", 7, np.uint32), ("morton5", 1 << 12, np.uint64)):
    d = int(curve[-1])
    cell = random.integers(0, cells, (2000, d), np.uint64)
    points = cl.array.to_device(queue, ((cell + 0.5) / cells * 4 - 1).astype(np.float32))
    keys = cl.array.zeros(queue, 2000, dtype)
    kernels.curve_keys(points, keys, curve, d * [-1], d * [3], cells).wait()
    expected = sum((cell[:, k] >> np.uint64(bit) & np.uint64(1)) << np.uint64(bit * d + k)
                   for k in range(d) for bit in range(16))
    assert np.array_equal(keys.get(), expected), curve
    assert expected.max() < 1 << kernels.curve_bits(curve, cells)

# Along a Hilbert curve each step goes from a cell to one beside it.
for curve, side in (("hilbert2", 16), ("hilbert3", 8)):
    d = int(curve[-1])
    cell = np.stack(np.unravel_index(random.permutation(side**d), d * (side,)), axis=1)
    points = cl.array.to_device(queue, (cell + 0.5).astype(np.float32))
    keys, order = cl.array.zeros(queue, side**d, np.uint64), cl.array.zeros(queue, side**d, np.uint32)
    kernels.curve_keys(points, keys, curve, d * [0], d * [side], side)
    kernels.argsort(keys, order, end_bit=kernels.curve_bits(curve, side))
    assert (np.abs(np.diff(cell[order.get()], axis=0)).sum(axis=1) == 1).all(), curve

# Wrong arguments are refused with advice; errors are those of the package.
refused(ValueError, "elements are float32", kernels.sort, cl.array.to_device(queue, weights))
refused(ValueError, "array.copy()", kernels.sort, words[1:])
refused(ValueError, "method: 'quick' is none of", kernels.sort, words, method="quick")
refused(ValueError, "values: 10 elements for 5000 keys", kernels.sort, words, values[:10])
refused(ValueError, "must be (n, 2)", kernels.curve_keys, points, keys, "hilbert2", [0, 0], [1, 1], 4)
refused(ValueError, "curve: 'peano' is none of", kernels.curve_keys, points, keys, "peano", [0, 0], [1, 1], 4)
refused(ValueError, "keys: 10 elements for 512 points", kernels.curve_keys, points, keys[:10], "hilbert3", [0] * 3, [1] * 3, 4)
refused(wavetracer.DeviceError, "4194304 cells", kernels.curve_keys, points, keys, "hilbert3", [0] * 3, [1] * 3, 1 << 22)
error = refused(wavetracer.DeviceError, "bits 9 to 4", kernels.sort, words, first_bit=9, end_bit=4)
assert isinstance(error, kernels.KernelError) and error.opencl_code == 0 and error.kernel == ""
unordered = cl.CommandQueue(context, properties=cl.command_queue_properties.OUT_OF_ORDER_EXEC_MODE_ENABLE)
refused(kernels.KernelError, "out of order", kernels.sort, words.with_queue(unordered))
print(f"sorted on {device.name}")
