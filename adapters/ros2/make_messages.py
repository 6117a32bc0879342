#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Generates C++ with CDR serialization, and IDL for DDS topic descriptors, from ROS 2 .msg files.

    make_messages.py OUT_DIR ROOT…

Each ROOT contains PACKAGE/msg/NAME.msg. Writes OUT_DIR/ros2_messages.h, ros2_messages.cc, ros2_topics.idl
and dds_types.cc. They include the name of each message, its definition as stored in MCAP files and bags,
and the type hash by which ROS 2 distinguishes versions (RIHS01: the SHA-256 of the type description as
JSON).
"""

import dataclasses
import hashlib
import json
import pathlib
import re
import sys

# Type in C++, type in IDL, and type_id in type descriptions.
PRIMITIVES = {
    "bool": ("bool", "boolean", 15), "byte": ("std::uint8_t", "octet", 16),
    "int8": ("std::int8_t", "int8", 2), "uint8": ("std::uint8_t", "uint8", 3),
    "int16": ("std::int16_t", "int16", 4), "uint16": ("std::uint16_t", "uint16", 5),
    "int32": ("std::int32_t", "int32", 6), "uint32": ("std::uint32_t", "uint32", 7),
    "int64": ("std::int64_t", "int64", 8), "uint64": ("std::uint64_t", "uint64", 9),
    "float32": ("float", "float", 10), "float64": ("double", "double", 11),
    "string": ("std::string", "string", 17)}
NESTED = 1
BOUNDED_STRING = 21
ARRAY = 48  # added to the type_id of the elements
SEQUENCE = 144
FIELD = re.compile(r"^(?P<type>[\w/]+)(?:<=(?P<bound>\d+))?(?P<list>\[(?P<count>\d*)\])?\s+(?P<name>\w+)"
                   r"(?P<rest>.*)$")


class BadMessage(Exception):
    """A line of a .msg file that cannot be parsed, or a message of unknown type."""


@dataclasses.dataclass
class Field:
    """A field; `type` is a primitive type or the full name of a message."""

    name: str
    type: str
    bound: int  # maximum length of a string, 0 for unbounded
    is_list: bool
    count: int  # length of an array, 0 for a sequence of any length
    default: str


@dataclasses.dataclass
class Message:
    """A message type, PACKAGE/msg/NAME."""

    package: str
    name: str
    text: str
    fields: list
    constants: list

    @property
    def full_name(self):
        return f"{self.package}/msg/{self.name}"


def full_type(word, package):
    if word in PRIMITIVES:
        return word
    if "/" not in word:
        return f"{package}/msg/{word}"
    other, name = word.split("/")
    return f"{other}/msg/{name}"


def read_message(path):
    package = path.parent.parent.name
    message = Message(package, path.stem, path.read_text(encoding="utf-8"), [], [])
    for number, line in enumerate(message.text.split("\n"), 1):
        line = line.split("#")[0].strip()
        if not line:
            continue
        found = FIELD.match(line)
        if not found:
            raise BadMessage(f"{path}:{number}: '{line}' is no field")
        rest = found["rest"].strip()
        if rest.startswith("="):
            message.constants.append((found["type"], found["name"], rest[1:].strip()))
            continue
        message.fields.append(Field(found["name"], full_type(found["type"], package),
                                    int(found["bound"] or 0), found["list"] is not None,
                                    int(found["count"] or 0), rest))
    return message


def in_order(messages):
    """Sorts messages so that each comes after those that it contains."""
    done = {}

    def add(message):
        for field in message.fields:
            if field.type not in PRIMITIVES:
                if field.type not in messages:
                    raise BadMessage(f"{message.full_name} needs {field.type}, which is in no folder")
                add(messages[field.type])
        done.setdefault(message.full_name, message)

    for name in sorted(messages):
        add(messages[name])
    return list(done.values())


def needs(message, messages):
    """All messages that a message contains, directly or indirectly, by name."""
    found = {}
    for field in message.fields:
        if field.type not in PRIMITIVES:
            found[field.type] = messages[field.type]
            found.update(needs(messages[field.type], messages))
    return found


# --- Type hashes ----------------------------------------------------------------------------------

def described_field(field):
    number = PRIMITIVES[field.type][2] if field.type in PRIMITIVES else NESTED
    if field.bound:
        number = BOUNDED_STRING
    if field.is_list:
        number += ARRAY if field.count else SEQUENCE
    return {"name": field.name,
            "type": {"type_id": number, "capacity": field.count, "string_capacity": field.bound,
                     "nested_type_name": "" if field.type in PRIMITIVES else field.type}}


def described(message):
    return {"type_name": message.full_name,
            "fields": [described_field(field) for field in message.fields]}


def type_hash(message, messages):
    """Type hash of REP-2016: of the type description without defaults, with referenced types by name."""
    others = needs(message, messages)
    text = json.dumps({"type_description": described(message),
                       "referenced_type_descriptions": [described(others[name])
                                                        for name in sorted(others)]},
                      ensure_ascii=True, separators=(", ", ": "))
    return "RIHS01_" + hashlib.sha256(text.encode("ascii")).hexdigest()


def definition(message, messages):
    """The message definition, followed by those of the contained messages under their names."""
    parts = [message.text]
    others = needs(message, messages)
    for name in sorted(others):
        package, _, short = name.split("/")
        parts.append(f"{'=' * 80}\nMSG: {package}/{short}\n{others[name].text}")
    return "".join(part if part.endswith("\n") else part + "\n" for part in parts)


# --- C++ ------------------------------------------------------------------------------------------

def cpp_type(field):
    if field.type in PRIMITIVES:
        inner = PRIMITIVES[field.type][0]
    else:
        package, _, name = field.type.split("/")
        inner = f"{package}::{name}"
    if not field.is_list:
        return inner
    return f"std::array<{inner}, {field.count}>" if field.count else f"std::vector<{inner}>"


def cpp_default(field):
    if field.default:
        return f"{{{field.default}}}"
    return "" if field.type not in PRIMITIVES or field.type == "string" and not field.is_list else "{}"


def cpp_struct(message):
    lines = [f"namespace {message.package} {{", f"struct {message.name} {{"]
    for kind, name, value in message.constants:
        lines.append(f"  static constexpr {PRIMITIVES[kind][0]} k{name} = {value};")
    for field in message.fields:
        lines.append(f"  {cpp_type(field)} {field.name}{cpp_default(field)};")
    lines += ["};", f"}}  // namespace {message.package}", ""]
    return "\n".join(lines)


def cpp_name(message):
    return f"{message.package}::{message.name}"


def header(messages):
    structs = "\n".join(cpp_struct(message) for message in messages)
    declared = "\n".join(f"void write(CdrWriter& cdr, const {cpp_name(m)}& m);\n"
                         f"void read(CdrReader& cdr, {cpp_name(m)}& m);\n"
                         f"const Ros2Type& type_of(const {cpp_name(m)}& m);" for m in messages)
    return ("// Made by make_messages.py from .msg files.\n#pragma once\n\n#include <array>\n"
            "#include <cstdint>\n#include <string>\n#include <vector>\n\n"
            '#include "adapters/ros2/cdr.h"\n#include "adapters/ros2/ros2_type.h"\n\n'
            "namespace tagfield::ros2 {\n\n" + structs + "\n" + declared +
            "\n\n}  // namespace tagfield::ros2\n")


def cpp_text(text):
    return 'R"msg(' + text + ')msg"'


def source(messages):
    by_name = {message.full_name: message for message in messages}
    parts = []
    for m in messages:
        writes = "".join(f"  write(cdr, m.{field.name});\n" for field in m.fields)
        reads = "".join(f"  read(cdr, m.{field.name});\n" for field in m.fields)
        parts.append(
            f"void write(CdrWriter& cdr, const {cpp_name(m)}& m) {{\n{writes}}}\n\n"
            f"void read(CdrReader& cdr, {cpp_name(m)}& m) {{\n{reads}}}\n\n"
            f"const Ros2Type& type_of(const {cpp_name(m)}& /*m*/) {{\n"
            f'  static const Ros2Type type{{"{m.full_name}",\n      "{type_hash(m, by_name)}",\n'
            f"      {cpp_text(definition(m, by_name))},\n      [](const void* message) {{\n"
            f"        return to_cdr(*static_cast<const {cpp_name(m)}*>(message));\n      }}}};\n"
            "  return type;\n}\n")
    return ('// Made by make_messages.py from .msg files.\n#include "adapters/ros2/ros2_messages.h"\n\n'
            "namespace tagfield::ros2 {\n\n" + "\n".join(parts) + "\n}  // namespace tagfield::ros2\n")


# --- IDL ------------------------------------------------------------------------------------------

def idl_field(field):
    if field.type in PRIMITIVES:
        inner = PRIMITIVES[field.type][1]
    else:
        package, _, name = field.type.split("/")
        inner = f"{package}::msg::dds_::{name}_"
    if field.bound:
        inner = f"string<{field.bound}>"
    if field.is_list and not field.count:
        return f"sequence<{inner}> {field.name}"
    return f"{inner} {field.name}" + (f"[{field.count}]" if field.is_list else "")


def idl(messages):
    parts = []
    for m in messages:
        fields = "".join(f"    {idl_field(field)};\n" for field in m.fields)
        parts.append(f"module {m.package} {{ module msg {{ module dds_ {{\n"
                     f"  @final struct {m.name}_ {{\n{fields}  }};\n}}; }}; }};\n")
    return "// Made by make_messages.py from .msg files.\n" + "".join(parts)


# --- Cyclone DDS ----------------------------------------------------------------------------------

def c_name(full_name):
    package, _, name = full_name.split("/")
    return f"{package}_msg_dds__{name}_"


def lending(field):
    """C++ code that makes a field of the C struct refer to the data of the C++ struct."""
    target = f"c.{field.name}"
    value = f"m.{field.name}"
    if field.bound:
        return f"  copy_text({value}, {target});\n"
    if field.is_list and field.count:
        return f"  std::copy({value}.begin(), {value}.end(), {target});\n"
    if field.is_list and (field.type == "string" or field.type not in PRIMITIVES):
        inner = "char*" if field.type == "string" else c_name(field.type)
        return f"  lend_list<{inner}>({value}, {target}, arena);\n"
    if field.is_list:
        return f"  lend_numbers({value}, {target});\n"
    if field.type == "string":
        return f"  {target} = const_cast<char*>({value}.c_str());\n"
    if field.type not in PRIMITIVES:
        return f"  lend({value}, {target}, arena);\n"
    return f"  {target} = {value};\n"


def dds_source(messages):
    parts = []
    for m in messages:
        body = "".join(lending(field) for field in m.fields)
        arena = " arena" if "arena" in body else ""
        parts.append(f"static void lend(const {cpp_name(m)}& m, {c_name(m.full_name)}& c, Arena&{arena}) {{\n"
                     f"{body}}}\n")
    entries = "".join(f'    {{"{m.full_name}", entry<{cpp_name(m)}, {c_name(m.full_name)}>('
                      f"{c_name(m.full_name)}_desc)}},\n" for m in messages)
    return ('// Made by make_messages.py from .msg files.\n#include "adapters/ros2/dds_types.h"\n\n'
            '#include "adapters/ros2/internal/lend.h"\n#include "adapters/ros2/ros2_messages.h"\n'
            '#include "adapters/ros2/ros2_topics.h"\n\nnamespace tagfield::ros2 {\n\n'
            + "\n".join(parts) + "\n"
            "const std::map<std::string, DdsType>& dds_types() {\n"
            "  static const std::map<std::string, DdsType> types = {\n" + entries +
            "  };\n  return types;\n}\n\n}  // namespace tagfield::ros2\n")


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    out = pathlib.Path(sys.argv[1])
    try:
        read = [read_message(path) for root in sys.argv[2:]
                for path in sorted(pathlib.Path(root).glob("*/msg/*.msg"))]
        messages = in_order({message.full_name: message for message in read})
    except BadMessage as error:
        sys.exit(f"make_messages.py: {error}")
    out.mkdir(parents=True, exist_ok=True)
    for name, text in (("ros2_messages.h", header(messages)), ("ros2_messages.cc", source(messages)),
                       ("ros2_topics.idl", idl(messages)), ("dds_types.cc", dds_source(messages))):
        (out / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
