# SPDX-License-Identifier: Apache-2.0
"""Tables of ray orders, sorts and ray caches for docs/rays_studied.md, of the newest rows; see speed.py."""
from rows import of_device
from speed import CPU, H100, H200, digits, markdown, share, sources


def orders(groups):
    """Returns the factors by which an order makes all ray stages faster."""
    ways = [("Z", "morton"), ("H3DH", "hilbert3d-histogram, 16 bins"), ("direction-origin", "direction-origin"), ("born in order", "born in order")]
    lines, found = [], []
    for words, device, rays in (("10^6 rays, two CPU cores", CPU, 1000000), ("1.7 10^7 rays, H200", H200, 16777216)):
        for scene, place in (("Munich", "munich"), ("city of `configs/city.toml`", "demo city")):
            rows = [of_device(groups, "order", device, f"{place}, {rays} rays: {way}") for _, way in ways]
            if all(rows):
                lines.append([words, scene] + [digits(row["ratio"]) for row in rows])
                found += rows
    return markdown(["random launches to depth 7", "scene"] + [f"{name}, times as fast" for name, _ in ways], lines, 4, 2) + sources(found)


def sorts(groups):
    lines, found = [], []
    for bits, device, words, peers in ((32, H100, "H100", ["CUB", "Thrust"]), (64, H100, "H100", ["CUB", "Thrust"]),
                                       (32, CPU, "two CPU cores", ["tbb::parallel_sort", "hwy::VQSort, one thread"])):
        for power in (20, 22, 24, 26):
            rows = [of_device(groups, "sort", device, f"u{bits} + u32, n = 2^{power}: radix, against {peer}") for peer in peers]
            if any(rows):
                beside = "; ".join(f"{digits(row['ratio'])} of {peer}" for row, peer in zip(rows, peers) if row)
                lines.append([f"{bits}-bit, 2^{power}", words, digits(next(row for row in rows if row)["value"]), beside])
                found += rows
    return markdown(["keys with a 32-bit payload, random", "device", "Gkeys/s", "speed against others"], lines, 1, 2) + sources(found)


def radix_shares(groups):
    """Returns the speed of the radix sort as a share of CUB's, for keys with and without a word each."""
    lines, found = [], []
    for words, shape in (("32 bits", "u32"), ("32 bits and a word each", "u32 + u32"), ("64 bits", "u64"),
                         ("64 bits and a word each", "u64 + u32")):
        rows = [of_device(groups, "sort", H100, f"{shape}, n = 2^{power}: radix, against CUB") for power in (20, 22, 24, 26)]
        lines.append([words] + [digits(row["ratio"]) if row else "" for row in rows])
        found += [row for row in rows if row]
    return markdown(["keys", "2^20", "2^22", "2^24", "2^26"], lines, 4) + sources(found)


def cached_frames(groups):
    ways = [("no cache, rays in order", "no cache, in order"), ("concurrent, exact key", "exact, hash 1"),
            ("the same from the second segment on", "exact, hash 1, from depth 2"),
            ("concurrent, position key, 100 cells a component", "position, division 100"),
            ("concurrent, position key, 100,000 cells", "position, division 100000"),
            ("as the thesis: open, two locks, 200,000 cells", "as the thesis: open, position, division 200000"),
            ("no cache, rays at random", "no cache, random directions"), ("concurrent, exact key, rays at random", "exact, hash 1, random directions"),
            ("**no cache, sequences reused**", "no cache, sequences reused")]
    lines, found = [], []
    for transmitter in ("standing", "riding"):
        for words, way in ways:
            rows = [of_device(groups, "cached_frame", device, f"munich, {cars} cars, {transmitter} transmitter, {rays} rays: {way}")
                    for device, cars, rays in ((CPU, 20, "1e+06"), (H200, 100, "1e+06"), (H200, 100, "1e+07"))]
            lost = [f", loses {share(row['error'])}" if row and row["error"] else "" for row in rows]
            lines.append([transmitter, words] + [digits(row["value"]) + loss if row else "" for row, loss in zip(rows, lost)])
            found += rows
    return markdown(["transmitter", "frame, ms", "two CPU cores, 10^6 rays", "H200, 10^6", "H200, 10^7"], lines, 3, 2) + sources(found)


def cache_tables(groups):
    def cells(case, cell):
        rows = [of_device(groups, "cache", H200, f"{size}: {case}") for size in sizes]
        found.extend(rows)
        return [cell(row) if row else "" for row in rows]

    sizes, found = ("16 MB", "256 MB", "4 GB"), []
    lines = [["random reads of 64 bytes"] + cells("random reads of 64 bytes", lambda row: digits(row["value"]))]
    for name in ("concurrent", "chained", "open, mutex", "thesis' two locks"):
        lines.append([f"{name}, keys at random: in all, right"]
                     + cells(f"{name}, keys at random", lambda row: f"{digits(row['asked_g_s'])}, {digits(row['value'])}"))
    for name in ("concurrent", "thesis' two locks"):
        lines.append([f"{name}, 256 rays ask for one key: right"] + cells(f"{name}, 256 askers a key", lambda row: digits(row["value"])))
    return markdown(["10^9 look-ups a second"] + list(sizes), lines, 3) + sources(found)


def cache_reads(groups):
    """Returns the speed of puts and look-ups as a share of that of random reads of an entry's 64 bytes in as much memory."""
    columns = [("two CPU cores", CPU, "16 MB"), ("two CPU cores", CPU, "256 MB"),
               ("GPU", "NVIDIA", "16 MB"), ("GPU", "NVIDIA", "256 MB"), ("GPU", "NVIDIA", "4 GB")]
    def row_of(name, operation, device, size):
        return of_device(groups, "cache", device, f"{size}: {name}, {operation}, against random reads")

    tables, operations = ("concurrent", "chained", "open, mutex", "open, readers"), {"look-up": "keys at random", "put": "put"}
    columns = [column for column in columns if row_of(tables[0], "put", *column[1:])]
    if not columns:
        return ["No device was measured yet."]
    lines, found = [], []
    for words, operation in operations.items():
        for name in tables:
            rows = [row_of(name, operation, *column[1:]) for column in columns]
            lines.append([f"{name}: {words}"] + [digits(row["ratio"]) if row else "" for row in rows])
            found += rows
    return markdown(["speed beside random reads of 64 bytes"] + [f"{words}, {size}" for words, _, size in columns], lines, len(columns)) + sources(found)


TABLES = {"cache_reads": cache_reads, "radix_shares": radix_shares, "orders": orders, "sorts": sorts, "cached_frames": cached_frames, "cache_tables": cache_tables}
