#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Consistency of the models for Gazebo.

    models_test.py SOURCE_DIR

models/p3at_rfid equals models/p3at, part by part, except for the mast, the antenna and its lift; the
mast's mass is included in its base link. Each model has a model.config that names an SDF file, and each
plugin that a model loads is built by CMake. Sibling elements in a model or world have unique names, as
SDFormat requires and `gz sdf --check` checks. Then checks that violations would be detected.
"""

import pathlib
import re
import shutil
import sys
import tempfile
import xml.etree.ElementTree

PLAIN, MOUNTED = "p3at", "p3at_rfid"
# Parts of the second robot that the first lacks: element and name, by parent element.
ADDED = {
    "model": {("link", "antenna"), ("joint", "lift_joint"), ("plugin", "lift")},
    "base_link": {("collision", "mast"), ("visual", "mast_foot"), ("visual", "mast_visual"),
                  ("visual", "mast_rail"), ("visual", "mast_head")},
}


# --- Comparison of the two robots -----------------------------------------------------------------

def key_of(element):
    return element.tag, element.get("name")


def text_of(element):
    return " ".join((element.text or "").split())


def model_in(path):
    return xml.etree.ElementTree.parse(path).getroot().find("model")


def without(element, added):
    return [child for child in element if key_of(child) not in added]


def difference(first, second, place):
    """The first difference between two elements, or None."""
    if first.tag != second.tag or first.attrib != second.attrib:
        return f"{place}: {key_of(first)} against {key_of(second)}"
    here = f"{place}/{first.get('name') or first.tag}"
    if text_of(first) != text_of(second):
        return f"{here}: '{text_of(first)}' against '{text_of(second)}'"
    if len(first) != len(second):
        return f"{here}: {[key_of(c) for c in first]} against {[key_of(c) for c in second]}"
    found = (difference(a, b, here) for a, b in zip(first, second))
    return next((fault for fault in found if fault), None)


def parts(model):
    """The common parts of the two robots: base_link's parts one by one, then the others."""
    base = model.find("link[@name='base_link']")
    inner = [child for child in without(base, ADDED["base_link"]) if child.tag != "inertial"]
    others = [child for child in without(model, ADDED["model"]) if child is not base]
    return inner + others


def lacking(model):
    """Expected additional parts that are missing."""
    base = model.find("link[@name='base_link']")
    for element, name in ((model, "model"), (base, "base_link")):
        for key in sorted(ADDED[name] - {key_of(child) for child in element}):
            yield f"{MOUNTED} has no {key[0]} '{key[1]}'"


def part_faults(plain, mounted):
    yield from lacking(mounted)
    first, second = parts(plain), parts(mounted)
    keys = [[key_of(part) for part in each] for each in (first, second)]
    if keys[0] != keys[1]:
        odd = [key for key in keys[0] + keys[1] if keys[0].count(key) != keys[1].count(key)]
        yield f"{PLAIN} and {MOUNTED} have other parts, or in another order: {odd}"
        return
    for one, other in zip(first, second):
        fault = difference(one, other, MOUNTED)
        if fault:
            yield fault


# --- The mast's mass ------------------------------------------------------------------------------

def body_of(model):
    """Mass, centre of mass and inertia about it (xx, yy, zz, xz) of the base link."""
    inertial = model.find("link[@name='base_link']/inertial")
    centre = [float(word) for word in inertial.findtext("pose").split()[:3]]
    inertia = [float(inertial.findtext(f"inertia/{name}")) for name in ("ixx", "iyy", "izz", "ixz")]
    return float(inertial.findtext("mass")), centre, inertia


def about(mass, centre, inertia, point):
    """The inertia about another point, by the parallel axis theorem."""
    x, y, z = (c - p for c, p in zip(centre, point))
    xx, yy, zz, xz = inertia
    return [xx + mass * (y * y + z * z), yy + mass * (x * x + z * z),
            zz + mass * (x * x + y * y), xz - mass * x * z]


def mast_of(model, mass):
    """The mast as a homogeneous box of its visual; its collision is slightly wider."""
    visual = model.find("link[@name='base_link']/visual[@name='mast_visual']")
    centre = [float(word) for word in visual.findtext("pose").split()[:3]]
    a, b, c = (float(word) for word in visual.findtext("geometry/box/size").split())
    return mass, centre, [mass / 12.0 * (b * b + c * c), mass / 12.0 * (a * a + c * c),
                          mass / 12.0 * (a * a + b * b), 0.0]


def mass_faults(plain, mounted):
    if mounted.find("link[@name='base_link']/visual[@name='mast_visual']") is None:
        return
    base, whole = body_of(plain), body_of(mounted)
    mast = mast_of(mounted, whole[0] - base[0])
    if mast[0] <= 0.0:
        yield f"the mast weighs {mast[0]} kg"
        return
    centre = [(base[0] * b + mast[0] * m) / whole[0] for b, m in zip(base[1], mast[1])]
    inertia = [b + m for b, m in zip(about(*base, centre), about(*mast, centre))]
    for expected, actual, what in ((centre, whole[1], "centre of mass"),
                                   (inertia, whole[2], "inertia xx, yy, zz, xz")):
        if max(abs(e - a) for e, a in zip(expected, actual)) > 2e-5:
            yield f"{MOUNTED}/base_link: {what} {actual}, of base and mast together {expected}"


# --- Files and plugins ----------------------------------------------------------------------------

def built_plugins(root):
    """File names of the shared libraries built by adapters/gazebo_classic."""
    folder = root / "adapters/gazebo_classic"
    text = "\n".join(path.read_text(encoding="utf-8")
                     for path in (folder / "CMakeLists.txt", folder / "robot.cmake"))
    text = re.sub(r"#[^\n]*", "", text)

    def unrolled(match):
        variable, values, body = match.groups()
        return "".join(body.replace("${" + variable + "}", value) for value in values.split())

    text = re.sub(r"foreach\((\w+) ([^)]*)\)(.*?)endforeach\(\)", unrolled, text, flags=re.DOTALL)
    names = re.findall(r"add_library\((\w+) SHARED|\btagfield_rfid_plugin\((\w+) \w+\.cc", text)
    return {f"lib{shared or plugin}.so" for shared, plugin in names}


def file_faults(root):
    plugins = built_plugins(root)
    for folder in sorted(path for path in (root / "models").iterdir() if path.is_dir()):
        config = folder / "model.config"
        if not config.is_file():
            yield f"models/{folder.name} has no model.config"
            continue
        named = [text_of(sdf) for sdf in xml.etree.ElementTree.parse(config).iter("sdf")]
        if not named:
            yield f"models/{folder.name}/model.config names no <sdf>"
        for name in named:
            if not (folder / name).is_file():
                yield f"models/{folder.name}/model.config names {name}, which is not there"
        for file in sorted(folder.glob("*.sdf")):
            for plugin in xml.etree.ElementTree.parse(file).iter("plugin"):
                if plugin.get("filename") not in plugins:
                    yield (f"models/{folder.name}/{file.name} loads {plugin.get('filename')}, "
                           f"built are {sorted(plugins)}")


def name_faults(root):
    """Sibling elements with the same name, except for plugins, whose names are their kinds."""
    for folder in ("models", "worlds", "templates", "examples"):
        for file in sorted((root / folder).rglob("*.sdf")):
            for element in xml.etree.ElementTree.parse(file).iter():
                names = [child.get("name") for child in element if child.tag != "plugin"]
                for name in sorted({name for name in names if name and names.count(name) > 1}):
                    yield (f"{file.relative_to(root)}: <{element.tag} name=\"{element.get('name')}\">"
                           f" has more than one child called '{name}'")


def faults(root):
    plain, mounted = (model_in(root / "models" / name / "model.sdf") for name in (PLAIN, MOUNTED))
    return [*part_faults(plain, mounted), *mass_faults(plain, mounted), *file_faults(root),
            *name_faults(root)]


# --- Detection of planted faults ------------------------------------------------------------------

PLANTED = (  # a file, the old text, the new text, part of the expected message
    ("p3at/model.sdf", "<mass>1</mass>", "<mass>2</mass>", "front_left_wheel"),
    ("p3at_rfid/model.sdf", "<samples>720</samples>", "<samples>360</samples>", "samples"),
    ("p3at_rfid/model.sdf", "<track>0.48</track>", "<track>0.40</track>", "track"),
    ("p3at/model.sdf", '<visual name="belly">', '<visual name="bottom">', "bottom"),
    ("p3at_rfid/model.sdf", '<visual name="mast_rail">', '<visual name="rail">', "mast_rail"),
    ("p3at_rfid/model.sdf", "<mass>13.5</mass>", "<mass>14</mass>", "centre of mass"),
    ("p3at_rfid/model.sdf", "<ixz>0.1328</ixz>", "<ixz>0</ixz>", "inertia"),
    ("rfid_tag/model.sdf", "libgazeboRfidTagPlugin.so", "libRfidTagPlugin.so", "libRfidTagPlugin"),
    ("rfid_antenna/model.config", "model.sdf", "antenna.sdf", "antenna.sdf"),
    ("rfid_tag_set/model.config", None, None, "no model.config"),
    ("rfid_tag/model.sdf", '<visual name="label_visual">', '<visual name="label">', "'label'"),
)


def blind_spots(root):
    """Planted faults that this test does not detect."""
    for number, (name, old, new, says) in enumerate(PLANTED):
        with tempfile.TemporaryDirectory(prefix="models_test-") as folder:
            copy = pathlib.Path(folder)
            shutil.copytree(root / "models", copy / "models")
            shutil.copytree(root / "adapters/gazebo_classic", copy / "adapters/gazebo_classic")
            path = copy / "models" / name
            if old is None:
                path.unlink()
            else:
                text = path.read_text(encoding="utf-8")
                if old not in text:
                    yield f"planted fault {number}: {name} has no {old}"
                path.write_text(text.replace(old, new, 1), encoding="utf-8")
            found = faults(copy)
            if not any(says in fault for fault in found):
                yield f"{name} with {new} for {old} gives {found}, expected one with {says!r}"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    found = [*faults(root), *blind_spots(root)]
    count = len(parts(model_in(root / "models" / PLAIN / "model.sdf")))
    if count < 30:
        found.append(f"only {count} parts of {PLAIN} were compared")
    for fault in found:
        print(fault)
    print(f"{count} parts compared and {len(PLANTED)} planted faults, {len(found)} failures")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
