# SPDX-License-Identifier: Apache-2.0
"""Changes in a source folder since a commit."""

import subprocess


def git(top, *words):
    """Output of git, or None if it fails."""
    done = subprocess.run(["git", "-c", "safe.directory=*", "-C", top, *words], stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, text=True, check=False)
    return done.stdout if done.returncode == 0 else None


def changed_since(commit, top, rules):
    """Names of files that differ from the commit or are not in it; None if that cannot be determined, or
    if a file in `rules` changed as well."""
    changed = git(top, "diff", "--name-only", commit)
    added = git(top, "ls-files", "--others", "--exclude-standard")
    if changed is None or added is None:
        return None
    names = set((changed + added).split("\n")) - {""}
    return None if names & rules else names
