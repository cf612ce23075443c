#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes copies of the headers of the device that compute with tangents instead of doubles (docs/design/gradients.md).

tangent_headers.py DEVICE OUTPUT: the headers of the folder DEVICE are written to OUTPUT, in the namespace
wavetracer::tangent. A copy has the code of its header line by line; only the type of its numbers is another one.
records.hpp there turns records of the device into those of the copies.
"""
import pathlib
import re
import sys

# These headers have no numbers that are differentiated; host/gradient/CMakeLists.txt lists all that are not copied.
PLAIN = {"types.h", "records.h", "lanes.h"}
# These have counterparts that are written by hand.
BY_HAND = {"vector.h": "gradient/tangent_vector.hpp", "elementary.h": "gradient/tangent_elementary.hpp"}
# So have these functions: some have no derivative by their operations where a number is 0 or too large, and the
# others take most of the time.
FUNCTIONS_BY_HAND = {"complex.h": ["wt_times", "wt_over", "wt_size", "wt_root"],
                     "transition.h": ["wt_transition_over_root"]}
# Numbers in tables with these names, and in lists, are never differentiated.
PLAIN_TABLES = r"(?:samples|s|area_of_tile|delays|triangles|triangle|own)"


def without_functions(text, names):
    for name in names:
        text, count = re.subn(rf"^inline \w+ {name}\([^)]*\) \{{.*?^\}}\n", "", text, flags=re.M | re.S)
        if count != 1:
            sys.exit(f"tangent_headers.py: {name} is there {count} times, not once")
    return text


def included(text):
    return re.findall(r'#include "wavetracer/device/(\w+\.h)"', text)


def copied(name, text):
    text = without_functions(text, FUNCTIONS_BY_HAND.get(name, []))
    # Macros that make vectors differ from those of the device.
    own = re.findall(r"^#define (WT_\w+).*WT_DOUBLE[23]", text, flags=re.M) + ["WT_DOUBLE2", "WT_DOUBLE3"]
    for macro in own + ["WT_EIGHTH_TURN"]:
        text = re.sub(rf"\b{macro}\b", macro + "_TANGENT", text)
    text = re.sub(rf"\bWT_GLOBAL double(?=\* {PLAIN_TABLES}\b)", "WT_GLOBAL @", text)
    text = re.sub(r"\bdouble(?= \w+(?:\[\w+\])+ = \{[-+\d.eExp,\s{}]*\};)", "@", text)
    text = re.sub(r"\bdouble\b", "Tangent", text).replace("@", "double")
    # Paths over targets have no derivatives.
    text = text.replace("#define WT_TARGETS 2", "#define WT_TARGETS 0").replace("WT_TARGETS", "WT_TARGETS_TANGENT")
    text = text.replace("WT_EDGES_BESIDE", "WT_EDGES_BESIDE_TANGENT")
    text = text.replace("wavetracer::device", "wavetracer::tangent")
    text = text.replace("WAVETRACER_DEVICE_", "WAVETRACER_TANGENT_")
    text = re.sub(r"(#define WAVETRACER_TANGENT_\w+\n)", r'\1#include "gradient/tangent.hpp"\n', text, count=1)
    for header in included(text):
        if header not in PLAIN:
            text = text.replace(f"wavetracer/device/{header}", BY_HAND.get(header, f"tangent/{header}"))
    return text


def without_comments(text):
    return re.sub(r"//.*", "", text)


def converters(text):
    """Text of functions that turn the records of field_records.h into those of its copy."""
    out = ""
    for body, name in re.findall(r"typedef struct \{(.*?)\} (\w+);", without_comments(text), flags=re.S):
        if not re.search(r"\bdouble\b", body):
            continue
        members = []
        for statement in body.split(";"):
            words = re.sub(r"\[\w+\]", "", statement).strip()
            if words:
                members += [part.split()[-1] for part in words.split(",")]
        out += f"inline {name} constant(const device::{name}& in) {{\n  {name} out;\n"
        out += "".join(f"  copy_member(out.{member}, in.{member});\n" for member in members)
        out += "  return out;\n}\n"
    return out


RECORDS = """// This file is made by cmake/tangent_headers.py. Records with numbers that do not depend on any parameter.
#pragma once
#include <cstddef>
#include <type_traits>

#include "tangent/field_records.h"
#include "wavetracer/device/field_records.h"

namespace wavetracer::tangent {

template <class To, class From>
void copy_member(To& to, const From& from) {
  if constexpr (std::is_array_v<To>) {
    for (std::size_t i = 0; i < std::extent_v<To>; ++i) copy_member(to[i], from[i]);
  } else {
    to = from;
  }
}

"""


def write(path, text):
    if not path.exists() or path.read_text() != text:  # so sources are compiled again only if a header changes
        path.write_text(text)


def main():
    device, output = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    output.mkdir(parents=True, exist_ok=True)
    for header in sorted(device.glob("*.h")):
        if header.name not in PLAIN and header.name not in BY_HAND:
            note = f"// This file is made by cmake/tangent_headers.py from wavetracer/device/{header.name}.\n"
            write(output / header.name, note + copied(header.name, header.read_text()))
    records = converters((device / "field_records.h").read_text())
    write(output / "records.hpp", RECORDS + records + "\n}  // namespace wavetracer::tangent\n")


main()
