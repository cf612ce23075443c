# SPDX-License-Identifier: Apache-2.0
"""Writes C++ headers with the arguments of kernels, from the kernels' own declarations.

usage: kernel_calls.py RECORDS OUTPUT KERNEL_FILE...

RECORDS is the folder of the records that host and device share. OUTPUT gets a header for each file; a header whose
text stays is not written, so that nothing is compiled again. A kernel becomes a struct with a member for each argument,
of the same name and in the same order (host/gpu/kernel_of.hpp has the types of members):

    const global T* name    gpu::Global<const T> name
    global T* name          gpu::Global<T> name
    T name                  gpu::Value<T> name

T is the C++ type of a scalar, gpu::Vector<scalar, lanes>, or a record of RECORDS. Any other T, such as a macro or a
typedef of the kernel's file, is gpu::Any, and fits every buffer. Arguments that a macro of the file stands for, such as
`#define MORE const global uint* more,`, are std::optional, since the macro is empty in other builds. A kernel that is
declared in several branches of #if has one struct where only `const` differs, else one for each, with the branch in its
name: NAME_MACRO, NAME_not_MACRO.
"""
import re
import sys
from pathlib import Path

SCALARS = {"char": "int8_t", "uchar": "uint8_t", "short": "int16_t", "ushort": "uint16_t", "int": "int32_t",
           "uint": "uint32_t", "long": "int64_t", "ulong": "uint64_t", "float": "float", "double": "double"}


class Fault(Exception):
    """A declaration that the host cannot call."""


def records_of(folder):
    """Returns the C++ name of each record and the header that defines it, by its name in OpenCL C."""
    found = {}
    for path in sorted(folder.glob("*.h")):
        text = path.read_text()
        space = "device::" if "namespace wavetracer::device {" in text else ""
        for name in re.findall(r"^\} (wt_\w+);", text, re.MULTILINE):
            found[name] = (space + name, f"wavetracer/device/{path.name}")
    return found


def without_comments(text):
    text = re.sub(r"/\*.*?\*/|//[^\n]*", lambda comment: "\n" * comment[0].count("\n"), text, flags=re.DOTALL)
    return text.replace("\\\n", " ")


def negated(condition):
    return condition[4:] if condition.startswith("not_") else "not_" + condition


def follow_directive(line, conditions):
    """Changes the list of conditions that text behind this line of the preprocessor depends on."""
    word, _, rest = line.strip()[1:].strip().partition(" ")
    rest = re.sub(r"\W+", "_", rest.strip()).strip("_")
    if word in ("if", "ifdef"):
        conditions.append(rest)
    elif word == "ifndef":
        conditions.append("not_" + rest)
    elif word == "else":
        conditions[-1] = negated(conditions[-1])
    elif word == "elif":
        conditions[-1] = rest
    elif word == "endif":
        conditions.pop()


def closing(text, begin):
    """Returns the place of the parenthesis that closes the one before `begin`."""
    depth = 1
    for place in range(begin, len(text)):
        depth += (text[place] == "(") - (text[place] == ")")
        if depth == 0:
            return place
    raise Fault("a parenthesis is not closed")


class Argument:
    """An argument of a kernel: its type in C++, and the header that defines it."""

    def __init__(self, text, records):
        words = [word for word in re.findall(r"\w+|\*", text)
                 if word not in ("restrict", "__restrict", "volatile", "private")]
        self.name, self.const, self.pointer = words.pop(), "const" in words, "*" in words
        self.optional, self.header = False, None
        spaces = {"global", "__global", "constant", "__constant", "local", "__local"}
        space = spaces.intersection(words)
        rest = [word for word in words if word not in spaces and word not in ("const", "*")]
        if len(rest) != 1 or words.count("*") > 1 or self.pointer != bool(space) or space & {"local", "__local"}:
            raise Fault(f"`{text.strip()}` is neither a value nor a pointer to global memory")
        self.const = self.const or bool(space & {"constant", "__constant"})
        self.element = self.element_of(rest[0], records)
        if not self.pointer and self.element.startswith("gpu::"):
            raise Fault(f"`{text.strip()}`: a value is a scalar or a record of include/wavetracer/device")

    def element_of(self, name, records):
        vector = re.fullmatch(r"([a-z]+)(2|3|4|8|16)", name)
        if name in SCALARS:
            return SCALARS[name]
        if vector and vector[1] in SCALARS:
            return f"gpu::Vector<{SCALARS[vector[1]]}, {vector[2]}>"
        if name in records:
            self.header = records[name][1]
            return records[name][0]
        return "gpu::Any"

    def type(self):
        inner = f"gpu::Global<{'const ' if self.const else ''}{self.element}>" if self.pointer else \
            f"gpu::Value<{self.element}>"
        return f"std::optional<{inner}>" if self.optional else inner


class Kernel:
    """One declaration of a kernel."""

    def __init__(self, name, conditions, arguments):
        self.name, self.conditions, self.arguments = name, conditions, arguments

    def merged(self, other):
        """Takes `const` from arguments that have it in one branch only; returns False if more differs."""
        def rest(kernel):
            return [(a.name, a.element, a.pointer, a.optional) for a in kernel.arguments]
        if rest(self) != rest(other):
            return False
        for mine, theirs in zip(self.arguments, other.arguments):
            mine.const = mine.const and theirs.const
        return True


def arguments_of(text, macros, records):
    """Returns the arguments of a list; those that a macro of the file stands for are optional."""
    out = []
    for part in filter(str.strip, text.split(",")):
        macro = re.match(r"\s*(\w+)\b", part)[1]
        if macro in macros:
            for more in filter(str.strip, macros[macro].split(",")):
                out.append(Argument(more, records))
                out[-1].optional = True
            part = part.replace(macro, "", 1)
        if part.strip():
            out.append(Argument(part, records))
    return out


def declarations(text, records):
    """Returns the kernels of a file, in their order."""
    text = without_comments(text)
    conditions, macros, kernels, count = [], {}, [], 0
    for found in re.finditer(r"^[ \t]*#[^\n]*|\b(?:__)?kernel\s+(?:__attribute__\s*\(\(.*?\)\)\)?\s*)?void\s+(\w+)\s*\(",
                             text, re.MULTILINE):
        if not found[1]:
            define = re.match(r"\s*#\s*define\s+(\w+)\s+(.*\bglobal\b[^()]*,)\s*$", found[0])
            if define:
                macros[define[1]] = define[2]
            follow_directive(found[0], conditions)
            continue
        end = closing(text, found.end())
        if "#" in text[found.end():end]:
            raise Fault(f"{found[1]}: a directive among the arguments; let a macro stand for those that depend on it")
        kernel = Kernel(found[1], list(conditions), arguments_of(text[found.end():end], macros, records))
        count += 1
        if not any(known.name == kernel.name and known.merged(kernel) for known in kernels):
            kernels.append(kernel)
    words = re.findall(r"\b(?:__)?kernel\b", re.sub(r"^[ \t]*#.*", "", text, flags=re.MULTILINE))
    if len(words) != count:
        raise Fault("kernels are declared as `kernel void NAME(...)`, with attributes before or behind `kernel`")
    names = [kernel.name for kernel in kernels]
    for kernel in kernels:
        kernel.struct = kernel.name if names.count(kernel.name) == 1 else "_".join([kernel.name] + kernel.conditions)
    return kernels


def struct_of(program, kernel):
    lines = [f"struct {kernel.struct} {{",
             f'  static constexpr const char* program_name = "{program}";',
             f'  static constexpr const char* kernel_name = "{kernel.name}";']
    for argument in kernel.arguments:
        lines.append(f"  {argument.type()} {argument.name}{' = {}' if argument.optional else ''};")
    declared = ", ".join(f"{a.type()} {a.name}" for a in kernel.arguments)
    lines += [f'  static constexpr std::string_view declared = "{declared}";',
              "  // Calls visit(name, argument) for each argument, in their order.",
              "  template <class Visit>",
              "  void each(Visit&& visit) const {"]
    lines += [f'    visit("{a.name}", {a.name});' for a in kernel.arguments]
    return "\n".join(lines + ["  }", "};", ""])


def header_of(path, records):
    program = path.stem
    kernels = declarations(path.read_text(), records)
    headers = sorted({a.header for kernel in kernels for a in kernel.arguments if a.header})
    includes = "".join(f'#include "{header}"\n' for header in headers)
    structs = "\n".join(struct_of(program, kernel) for kernel in kernels)
    return (f"// The kernels of {path.name}, by their declarations. Generated by cmake/kernel_calls.py: do not edit.\n"
            f"#pragma once\n#include <optional>\n#include <string_view>\n\n#include \"gpu/kernel_of.hpp\"\n{includes}\n"
            f"namespace wavetracer::calls::{program} {{\n\n{structs}\n}}  // namespace wavetracer::calls::{program}\n")


def main():
    records = records_of(Path(sys.argv[1]))
    output = Path(sys.argv[2])
    output.mkdir(parents=True, exist_ok=True)
    for path in map(Path, sys.argv[3:]):
        try:
            text = header_of(path, records)
        except Fault as fault:
            sys.exit(f"{path}: {fault}")
        header = output / f"{path.stem}.hpp"
        if not header.exists() or header.read_text() != text:
            header.write_text(text)


if __name__ == "__main__":
    main()
